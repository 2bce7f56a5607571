#pragma once

// From the features of a file to shapes, planar graphs and axes. medial/io/read.h reads files.

#include "medial/compute.h"
#include "medial/document.h"

namespace medial {

/// Runs work(i, threads) for every item i, on at most `threads` threads in all. Items of large
/// weight run one after another with all threads each, then the small ones side by side with one.
/// What work(i) does must depend on i alone; then so does the outcome. Errors: that of the lowest
/// item with one, as an error of feature i; cancelled (work not begun when `cancel` is set).
Status for_each_item(std::span<const double> weights, int threads,
                     const std::function<Status(std::size_t i, int threads)>& work,
                     const std::atomic<bool>* cancel = nullptr);

/// The results of for_each_item().
template <class T>
Result<std::vector<T>> map_items(std::span<const double> weights, int threads,
                                 const std::function<Result<T>(std::size_t i, int threads)>& work,
                                 const std::atomic<bool>* cancel = nullptr) {
  std::vector<T> results(weights.size());
  const auto keep = [&](std::size_t i, int own_threads) -> Status {
    Result<T> result = work(i, own_threads);
    if (!result) return std::move(result).error();
    results[i] = std::move(result).value();
    return success();
  };
  Status done = for_each_item(weights, threads, keep, cancel);
  return done ? Result<std::vector<T>>(std::move(results)) : std::move(done).error();
}

/// What is inside where rings cross or overlap.
enum class RepairRule : std::uint8_t {
  none,        ///< nothing: such rings are an error
  make_valid,  ///< as the file says: its own fill rule, or even-odd for outer rings and holes
  even_odd,    ///< what an odd number of rings encloses
  non_zero,    ///< what the rings wind around a number of times that is not 0
};

struct LoadOptions {
  /// Splits edges that cross, and decides what is inside; straight rings are first tried unsplit.
  RepairRule repair = RepairRule::none;
  ArcOptions arcs;            ///< how free-form curves become arcs
  bool skip_invalid = false;  ///< leaves features out that make no shape, with a note each
  bool part = false;  ///< of a larger document: no note on how many are left out, perhaps all
  double fit = 0;     ///< boundaries become smooth within this (fit_smooth_contour()); 0: no
  bool keep_contours = false;  ///< fills ShapeItem::contours, from rings as well
  int threads = 0;             ///< see Options, as the next two
  std::function<void(double)> progress = {};
  const std::atomic<bool>* cancel = nullptr;
};

/// Summed over all features.
struct LoadReport {
  ShapeReport shapes;
  ArcReport arcs;
  std::uint64_t features = 0, left_out = 0;
  LoadReport& operator+=(const LoadReport& part);
};

/// The shape of each feature, in order: fill rules, curves to arcs, repair. Notes say what a repair
/// changed, and what `skip_invalid` left out and why. Errors: empty; cancelled; with place those
/// of approximate_by_arcs(), build_shape() and fit_smooth_contour().
Result<Document<ShapeItem>> load_shapes(Document<Feature> features, const LoadOptions& options = {},
                                        LoadReport* report = nullptr);

/// Points, lines and boundaries as they are.
struct LoosePieces {
  std::vector<Chain> chains;
  std::vector<std::uint32_t> feature;  ///< of each chain
  Document<Attributes> features;
};

/// All that features hold, in order, as chains. Errors: those of approximate_by_arcs().
Result<LoosePieces> load_loose(Document<Feature> features, const ArcOptions& options = {});

/// Errors: those of build_planar_graph(), with feature, ring in it, and vertex.
Result<PlanarGraph> planar_graph_of(const LoosePieces& pieces,
                                    const PlanarGraphOptions& options = {});

/// Calls use(graph) with planar_graph_of(pieces). After an error `unsupported` with ring and point,
/// for things that rounding cannot separate, again with graphs in which they touch. Returns their
/// PlanarGraphOptions::reach, or 0. Errors: those of planar_graph_of(), and the last one of `use`.
Result<double> with_planar_graph(const LoosePieces& pieces, bool node_crossings,
                                 const std::function<Status(PlanarGraph& graph)>& use);

/// Summed over all features.
struct AxesReport {
  Statistics statistics;
  std::uint64_t unresolved = 0;  ///< parts and holes too fine for the grid of an axis of pixels
};

/// The axis of every shape by compute(); threads, progress and cancel of the options hold for all
/// together. The default resolution of a method of pixels is Document::pixel. The items' statistics
/// have no times. Errors: those of compute(), with the feature.
Result<Document<AxisItem>> compute_axes(Document<ShapeItem> shapes, Options options = {},
                                        AxesReport* report = nullptr);

}  // namespace medial
