#pragma once

// Turns features of a file into shapes, planar graphs and axes. medial/io/read.h reads files.

#include "medial/compute.h"
#include "medial/document.h"

namespace medial {

using ItemWork = std::function<Status(std::size_t i, int threads)>;
/// Runs work(i, threads) for every item i, on at most `threads` threads in all: first items of
/// large weight one after another on all threads, then small ones side by side on one thread each.
/// If work(i) depends on i alone, so does the outcome. Errors: that of the lowest failing item, as
/// an error of feature i; cancelled (`cancel` was set before the last item began).
Status for_each_item(std::span<const double> weights, int threads, const ItemWork& work,
                     const std::atomic<bool>* cancel = nullptr);

/// Leaves a feature out with a note if there is `left_out` and the error is the feature's own.
bool leave_out_feature(const Error& error, std::vector<std::string>* left_out);
/// for_each_item() of a document; its work's errors name features of its file. Returns what stays.
Result<std::vector<std::size_t>> for_each_feature(const DocumentInfo& file,
                                                  std::span<const double> weights, int threads,
                                                  const ItemWork& work,
                                                  std::vector<std::string>* left_out,
                                                  const std::atomic<bool>* cancel = nullptr);

/// The rule for what is inside where rings cross or overlap.
enum class RepairRule : std::uint8_t {
  none,        ///< such rings are an error
  make_valid,  ///< the file's own fill rule, or even-odd for outer rings and holes
  even_odd,    ///< points that an odd number of rings enclose
  non_zero,    ///< points with a nonzero winding number
};

struct LoadOptions {
  /// Splits edges that cross, and decides what is inside; tries straight rings unsplit first.
  RepairRule repair = RepairRule::none;
  ArcOptions arcs;            ///< how free-form curves become arcs
  bool skip_invalid = false;  ///< leaves out features that make no shape, with a note each
  bool part = false;  ///< of a larger document: may be empty; no note counts what is left out
  double fit = 0;     ///< smooths boundaries within this, without loops in disks of it; 0: no
  bool keep_contours = false;  ///< fills ShapeItem::contours, also from rings
  int threads = 0;             ///< this and the next two: see Options
  std::function<void(double)> progress = {};
  const std::atomic<bool>* cancel = nullptr;
};

/// Totals over all features.
struct LoadReport {
  ShapeReport shapes;
  ArcReport arcs;
  std::uint64_t features = 0, left_out = 0, specks = 0;  ///< specks: loops too small for a fit
  LoadReport& operator+=(const LoadReport& part);
};

/// The shape of each feature, in order: applies fill rules, turns curves into arcs, repairs. Notes
/// say what a repair changed, and what was left out and why. Errors: empty; cancelled; those of
/// approximate_by_arcs(), build_shape() and fit_smooth_contour(), with the place.
Result<Document<ShapeItem>> load_shapes(Document<Feature> features, const LoadOptions& options = {},
                                        LoadReport* report = nullptr);

/// Points, lines and boundaries, unchanged.
struct LoosePieces {
  std::vector<Chain> chains;
  std::vector<std::uint32_t> feature;  ///< of each chain
  Document<Attributes> features;
};

/// The whole content of features as chains, in order. Errors: those of approximate_by_arcs().
Result<LoosePieces> load_loose(Document<Feature> features, const ArcOptions& options = {});
/// Errors: those of build_planar_graph(), with feature, ring in the feature, and vertex.
Result<PlanarGraph> planar_graph_of(const LoosePieces& pieces,
                                    const PlanarGraphOptions& options = {});
/// Calls use(graph) with planar_graph_of(pieces). If `use` fails with `unsupported`, a ring and a
/// point, as rounding cannot separate two things, calls it again with graphs in which they touch.
/// Returns their PlanarGraphOptions::reach, or 0. Errors: of planar_graph_of(), the last of `use`.
Result<double> with_planar_graph(const LoosePieces& pieces, bool node_crossings,
                                 const std::function<Status(PlanarGraph& graph)>& use);

/// Totals over all features.
struct AxesReport {
  Statistics statistics;
  std::uint64_t unresolved = 0;  ///< parts and holes too fine for the grid of an axis of pixels
  std::uint32_t pixels = 0;      ///< PixelGrid::pixels that do for all; the largest: none known
  std::uint64_t sites = 0;       ///< of axes in parts
  std::uint64_t by_disks = 0;    ///< axes that `disks` computed instead of the method asked for
  std::vector<std::string> left_out;  ///< a note on each feature left out
};

struct AxesOptions : Options {
  bool skip_invalid = false;  ///< leaves out features whose axis fails, if there is a report
};
/// The axis of every shape by compute(); `threads`, `progress` and `cancel` apply to all together.
/// Pixels are Document::pixel by default. Errors: those of compute().
Result<Document<AxisItem>> compute_axes(Document<ShapeItem> shapes, AxesOptions options = {},
                                        AxesReport* report = nullptr);

}  // namespace medial
