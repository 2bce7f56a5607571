#pragma once

// Steps that most commands share: reading shapes or axes, printing notes, computing axes, and
// summarising them.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/common.h"
#include "medial/compute.h"
#include "medial/document.h"
#include "medial/load.h"

namespace medial::cli {

/// The shapes of a file.
struct LoadedShapes {
  Document<ShapeItem> file;
  bool of_image = false;  ///< the file is an image
  LoadReport report;
  Phases phases;  ///< read, shape
};

/// The axes of a file.
struct LoadedAxes {
  Document<AxisItem> file;
  AxesReport axes;
  LoadReport report;
  Phases phases;  ///< read, shape, axis
};

/// The weight of each item for for_each_item(): the points of its shape, or the edges of its axis.
template <class Item>
std::vector<double> weights_of(const Document<Item>& file) {
  std::vector<double> weights;
  for (const Item& item : file.items)
    weights.push_back(static_cast<double>(item.shape.points.size()));
  return weights;
}
std::vector<double> edge_weights_of(const Document<AxisItem>& file);

/// The options of INPUT and of a second file. An option that does not apply to one of them (a file
/// in medial's own format, or one that is no image) applies to the other only; an option that
/// applies to neither is refused. --text applies to INPUT only.
InputOptions first_input(InputOptions input, const std::string& second);
InputOptions second_input(InputOptions input, const std::string& second);

/// Reads shapes and prints notes on standard error. Errors name the file.
Result<LoadedShapes> load_shapes(const InputOptions& input, const CommonOptions& common);
/// Reads points, lines and boundaries, and prints notes. Errors name the file.
Result<LoosePieces> load_loose(const InputOptions& input, const CommonOptions& common);
/// with_planar_graph(), with --repair. Prints a note if pieces were made to touch.
Status with_planar_graph(const LoosePieces& pieces, const FileArguments& arguments,
                         const std::function<Status(PlanarGraph&)>& use);

/// `left_out` with --skip-invalid, which leaves out features with an error; else null.
inline std::vector<std::string>* skips(const InputOptions& input,
                                       std::vector<std::string>& left_out) {
  return input.source.read.skip_invalid ? &left_out : nullptr;
}
/// Prints notes on features that were left out, and their number.
void note_left_out(const std::vector<std::string>& left_out, const InputOptions& input,
                   const CommonOptions& common);
/// Stores the results of work(i, threads). `work` and `results` must outlive the returned function.
template <class T>
ItemWork keeping(const std::function<Result<T>(std::size_t i, int threads)>& work,
                 std::vector<T>& results) {
  return [&](std::size_t i, int threads) -> Status {
    auto result = work(i, threads);
    if (!result) return std::move(result).error();
    results[i] = std::move(result).value();
    return success();
  };
}
/// The results of for_each_item().
template <class T>
Result<std::vector<T>> map_items(std::span<const double> weights, int threads,
                                 const std::function<Result<T>(std::size_t i, int threads)>& work) {
  std::vector<T> results(weights.size());
  Status done = for_each_item(weights, threads, keeping(work, results));
  return done ? Result<std::vector<T>>(std::move(results)) : std::move(done).error();
}
/// The results of for_each_feature(), in a document with the information of `of`.
template <class T>
Result<Document<T>> map_features(const DocumentInfo& of, std::span<const double> weights,
                                 int threads,
                                 const std::function<Result<T>(std::size_t i, int threads)>& work,
                                 std::vector<std::string>* left_out) {
  Document<T> made{of, std::vector<T>(weights.size())};
  const auto kept = for_each_feature(of, weights, threads, keeping(work, made.items), left_out);
  if (!kept) return kept.error();
  made.keep(*kept);
  return made;
}
/// With --skip-invalid, removes the shapes without an axis from `shapes` and returns them, and puts
/// the others in the order of the axes, by feature number. Errors: malformed (an axis without its
/// shape).
Result<Document<ShapeItem>> without_axis(const Document<AxisItem>& axes, const InputOptions& input,
                                         Document<ShapeItem>& shapes);
/// The same for the axes of another file, with a note. Returns the number of removed shapes.
/// Errors: also malformed (the axis of a removed shape can be computed, but the file lacks it).
Result<std::size_t> refused_without_axis(const Document<AxisItem>& axes,
                                         const std::string& axes_path, const InputOptions& input,
                                         const CommonOptions& common, Document<ShapeItem>& shapes);

/// Computes the axes of shapes, with a progress bar on a terminal. Sets the fields of `options`
/// that the common options determine, and `progress`. Errors name the file.
Result<LoadedAxes> compute_axes(LoadedShapes shapes, const InputOptions& input,
                                const CommonOptions& common, Options options = {});
/// The axes that a command works on: stored axes as they are, or else computed from the shapes. If
/// `specks` is above 0, computes them for without_specks() of the shapes even if there are stored
/// axes; with Options::exterior, also if the stored axes are of the interior. Errors: those of
/// reading and computing.
Result<LoadedAxes> load_axes(const InputOptions& input, const CommonOptions& common,
                             double specks = 0, const Options& options = {});

/// --corner-angle, or else the default for the kind of input: Document::corner_angle.
double corner_angle(const CommonOptions& common, double of_input);
/// The common options of all engines.
Options engine_options(const CommonOptions& common, int threads, double of_input,
                       Options options = {});

/// Counts and lengths of axes, summed over the features of a file.
struct AxisSummary {
  std::uint64_t features = 0;
  std::uint64_t sites = 0;
  std::uint64_t leaves = 0, site_changes = 0, branchings = 0;
  std::uint64_t edges = 0;
  std::uint64_t branches = 0;
  double length = 0;
  Disk deepest{{}, -1};  ///< the largest disk of all
  std::uint64_t deepest_feature = 0;

  std::uint64_t nodes() const { return leaves + site_changes + branchings; }
};
AxisSummary summarize(const Document<AxisItem>& file);
/// Adds further features.
void add_to(AxisSummary& summary, const Document<AxisItem>& more);

/// Sums up axes that come in parts, shape by shape.
class PartsSummary {
 public:
  void add(std::size_t shape, std::uint64_t number, const AxisPart& part);
  /// Ends the sums after the last part of `shapes` shapes with `sites` sites.
  AxisSummary finish(std::size_t shapes, std::uint64_t sites);
  std::uint64_t points() const { return points_; }  ///< axes of one point, at the end

 private:
  void end_shape();

  AxisSummary summary_;
  std::uint64_t branch_ends_ = 0, points_ = 0;
  // Of the current shape:
  std::uint64_t nodes_ = 0, edges_ = 0;
  std::vector<std::uint8_t> kinds_;  ///< of each component, of its nodes: bits
};
Json to_json(const AxisSummary& summary);

/// If there is an output, writes it by write(path, format) and ends the phase "write".
template <class Write>
Status write_output(const FileArguments& arguments, Phases& phases, Write&& write) {
  if (arguments.output.empty()) return success();
  const Activity shown("writing", arguments.output);
  Status written = write(arguments.output, arguments.format);
  phases.end("write");
  return written;
}

/// Axes for one picture in a row of pictures of the same shapes, with the title below it.
struct Panel {
  std::string title;
  std::vector<AxisItem> items;
};
/// A picture of panels in rows, `width` pixels wide, each in a place as large as `box`.
Status write_panels(const FileArguments& arguments, const DocumentInfo& info, const Box& box,
                    std::vector<Panel> panels, double width);

/// Reads, computes and writes a file in constant memory by io::stream(), and prints notes. Returns
/// nothing if the file is not large or the formats do not allow it. Sets the fields of `stream`
/// that the arguments determine. Returns no items. Errors name the file.
Result<std::optional<LoadedAxes>> stream(const FileArguments& arguments, const InputOptions& input,
                                         io::StreamOptions stream);
/// load_shapes(), compute_axes(), `change` and finish_axes() in constant memory. Returns nothing if
/// the file is not large, the formats do not allow it, or a feature has more than `most_points`.
/// Calls `change` for several parts at once; `line` replaces the printed summary. Sets the fields
/// of `options` that the common options determine. Errors: those of the four functions.
Result<std::optional<int>> stream_axes(
    const FileArguments& arguments, const InputOptions& input, Options options = {},
    const std::function<Status(Document<AxisItem>& part)>& change = nullptr,
    const std::function<std::string()>& line = nullptr,
    std::uint64_t most_points = ~std::uint64_t{0});

/// compute_axes() and finish_axes() in parts, so that no whole axis is in memory. Returns nothing
/// if the output cannot be written in parts.
Result<std::optional<int>> finish_in_parts(LoadedShapes& shapes, const FileArguments& arguments,
                                           const InputOptions& input, Options options);

/// Ends a command that made axes: writes them, and prints a summary, statistics or both. Returns
/// the exit status.
Result<int> finish_axes(LoadedAxes& axes, const FileArguments& arguments);

}  // namespace medial::cli
