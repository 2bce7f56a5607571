#pragma once

// The way from a file of polygons or curves to shapes and on to their axes, feature by feature.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cli/common.h"
#include "medial/compute.h"
#include "medial/document.h"
#include "medial/io/read.h"
#include "medial/threads.h"

namespace medial::cli {

/// The error, told to be in this feature of the file.
Error at_feature(Error error, const std::string& path, std::size_t feature);

/// The shapes of a file, one for each feature, in the file's order.
struct ShapeFile {
  std::vector<Shape> shapes;
  std::vector<Attributes> attributes;
  std::vector<std::vector<Contour>>
      contours;        ///< as read, where load_shapes() is told to keep them
  ShapeReport report;  ///< summed over the features
  ArcReport arcs;      ///< of curves that became arcs, summed over the features
  std::string crs_wkt;
  bool geographic = false;         ///< coordinates are longitudes and latitudes
  bool y_down = false;             ///< the y axis points down
  double pixel = 0;                ///< of an image: the side of its pixels; otherwise 0
  std::vector<std::string> notes;  ///< what repair or reprojection changed
  double seconds_read = 0;
  double seconds_shape = 0;
  double processor_read = 0;  ///< seconds of processor time of the same phases
  double processor_shape = 0;
};

/// The axes of a file.
struct AxisFile {
  Document<AxisItem> native;
  Statistics statistics;  ///< summed over the features
  ShapeReport cleaned;    ///< of the input
  ArcReport arcs;         ///< of the input's curves
  double seconds_read = 0;
  double seconds_shape = 0;
  double seconds_axis = 0;
  double processor_read = 0;  ///< seconds of processor time of the same phases
  double processor_shape = 0;
  double processor_axis = 0;
  /// Components and holes of the shapes that axes of pixels do not tell apart.
  std::uint64_t unresolved = 0;
};

/// What axes look like, summed over the features of a file.
struct AxisSummary {
  std::uint64_t features = 0;
  std::uint64_t sites = 0;
  std::uint64_t leaves = 0;
  std::uint64_t site_changes = 0;
  std::uint64_t branchings = 0;
  std::uint64_t edges = 0;
  std::uint64_t branches = 0;
  double length = 0;
  Disk deepest;  ///< the largest disk of all
  std::uint64_t deepest_feature = 0;

  std::uint64_t nodes() const { return leaves + site_changes + branchings; }
};

/// Whether a native file holds contours, whose axes are still to be computed.
bool holds_contours(const Document<AxisItem>& file);

/// How much work each shape is, for for_each_feature().
std::vector<double> weights_of(std::span<const Shape> shapes);

/// Runs work(i, threads_of_its_own) for every feature i and returns the error of the lowest feature
/// that has one. `weights` tell how much work each feature is: a large one gets all threads, one
/// large feature after another; then the small ones run side by side with one thread each. What
/// work(i) does must depend on i alone; then so does the outcome.
Status for_each_feature(std::span<const double> weights, int threads,
                        const std::function<Status(std::size_t, int)>& work);

/// Reads polygons and curves and makes shapes of them. The shapes of medial's own JSON keep their
/// sources. Errors name the file and the feature; of several, the first one's is given.
/// With `keep_contours` the features' boundaries are kept as they were read, rings as contours too.
Result<ShapeFile> load_shapes(const InputOptions& input, int threads, bool keep_contours = false);

/// Replaces the boundaries of all features, whose contours were kept, by smooth curves within
/// `distance` of their corners.
Status smooth_boundaries(ShapeFile& file, double distance, const InputOptions& input);

/// Prints what a user should know of the input (geographic coordinates, repairs) on standard error,
/// unless told to be quiet.
void print_notes(const ShapeFile& file, const InputOptions& input, const CommonOptions& common);

/// Computes the axis of every shape, with a progress bar where that is wanted. `path` names the
/// input in errors. Of `options`, what the common arguments tell and progress are set here.
Result<AxisFile> compute_axes(ShapeFile shapes, const std::string& path,
                              const CommonOptions& common, Options options = {});

/// --exterior, with this help, and --margin. Gives the former.
CLI::Option* add_exterior_options(CLI::App& command, Options& options, const std::string& help);

/// What the common arguments tell the engines.
Options engine_options(const CommonOptions& common, int threads);

/// Runs work(i, options) for every shape of a file, as for_each_feature() does. Errors are told to
/// be in feature i of the input.
Status for_each_shape(std::span<const Shape> shapes, const std::string& path,
                      const CommonOptions& common,
                      const std::function<Status(std::size_t i, const Options& options)>& work);

AxisSummary summarize(const Document<AxisItem>& file);
/// "1 feature, 12 sites, 20 nodes, 19 edges, 7 branches; deepest disk: radius 3 at (1, 2)"
std::string describe(const AxisSummary& summary);
Json to_json(const AxisSummary& summary);

/// The end of a run that made axes: writes them, unless `output` is empty, and tells of them as the
/// arguments ask: a summary, statistics, or both as one object. Gives the exit status.
Result<int> write_and_tell(const AxisFile& file, const InputOptions& input,
                           const CommonOptions& common, const std::string& output,
                           const std::string& format, const io::WriteOptions& pictures);

}  // namespace medial::cli
