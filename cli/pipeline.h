#pragma once

// What most commands do before their own work: read shapes or axes, print notes, compute axes; and
// how axes are summarised.

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

/// How much work each item is, for for_each_item(): by its shape's points, or by its axis's edges.
template <class Item>
std::vector<double> weights_of(const Document<Item>& file) {
  std::vector<double> weights;
  for (const Item& item : file.items)
    weights.push_back(static_cast<double>(item.shape.points.size()));
  return weights;
}
std::vector<double> edge_weights_of(const Document<AxisItem>& file);

/// The options of INPUT and of a second file. Where one is of medial's own format or no image, what
/// does not apply to it is left to the other; what neither can follow is refused. A text is INPUT's
/// alone.
InputOptions first_input(InputOptions input, const std::string& second);
InputOptions second_input(InputOptions input, const std::string& second);

/// Reads shapes and prints notes on standard error. Errors name the file.
Result<LoadedShapes> load_shapes(const InputOptions& input, const CommonOptions& common);
/// Reads points, lines and boundaries, and prints notes. Errors name the file.
Result<LoosePieces> load_loose(const InputOptions& input, const CommonOptions& common);
/// with_planar_graph(), with --repair, and a note where things have been made to touch.
Status with_planar_graph(const LoosePieces& pieces, const FileArguments& arguments,
                         const std::function<Status(PlanarGraph&)>& use);

/// Where features with an error are left out with --skip-invalid: `left_out`; else null.
inline std::vector<std::string>* skips(const InputOptions& input,
                                       std::vector<std::string>& left_out) {
  return input.source.read.skip_invalid ? &left_out : nullptr;
}
/// Notes on features that were left out, and one that counts them.
void note_left_out(const std::vector<std::string>& left_out, const InputOptions& input,
                   const CommonOptions& common);
/// Keeps the results of work(i, threads), which has to stay.
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
/// With --skip-invalid, takes those shapes out of `shapes` whose features have none of the axes,
/// and puts the others in the axes' order, by number. Errors: malformed (an axis without its
/// shape).
Result<Document<ShapeItem>> without_axis(const Document<AxisItem>& axes, const InputOptions& input,
                                         Document<ShapeItem>& shapes);
/// The same for the axes of another file, with a note; returns the number of those shapes. Errors:
/// also malformed (one of them has an axis, which the file lacks).
Result<std::size_t> refused_without_axis(const Document<AxisItem>& axes,
                                         const std::string& axes_path, const InputOptions& input,
                                         const CommonOptions& common, Document<ShapeItem>& shapes);

/// Computes the axes of shapes, with a progress bar where that is wanted. Of `options`, this sets
/// what the common options hold, and progress. Errors name the file.
Result<LoadedAxes> compute_axes(LoadedShapes shapes, const InputOptions& input,
                                const CommonOptions& common, Options options = {});
/// The axes that a command works on: of medial's own .json as they stand there, of shapes computed
/// now. With `specks` above 0 computed of without_specks() of the shapes, stored axes or not; and
/// with the exterior asked for of what surrounds them, also of stored axes of the interior.
/// Errors: those of reading and computing.
Result<LoadedAxes> load_axes(const InputOptions& input, const CommonOptions& common,
                             double specks = 0, const Options& options = {});

/// --corner-angle, or what suits the kind of input: Document::corner_angle.
double corner_angle(const CommonOptions& common, double of_input);
/// The common options of all engines.
Options engine_options(const CommonOptions& common, int threads, double of_input,
                       Options options = {});

/// What axes look like, summed over the features of a file.
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
/// Takes further features into account.
void add_to(AxisSummary& summary, const Document<AxisItem>& more);

/// Sums up axes that come in parts, shape by shape.
class PartsSummary {
 public:
  void add(std::size_t shape, std::uint64_t number, const AxisPart& part);
  /// There are no more parts of so many shapes with so many sites.
  AxisSummary finish(std::size_t shapes, std::uint64_t sites);
  std::uint64_t points() const { return points_; }  ///< axes of one point, at the end

 private:
  void end_shape();

  AxisSummary summary_;
  std::uint64_t branch_ends_ = 0, points_ = 0;
  // What is known of the shape under way:
  std::uint64_t nodes_ = 0, edges_ = 0;
  std::vector<std::uint8_t> kinds_;  ///< of each component, of its nodes: bits
};
Json to_json(const AxisSummary& summary);

/// Writes a file by write(path, format), unless there is none, and ends the phase "write".
template <class Write>
Status write_output(const FileArguments& arguments, Phases& phases, Write&& write) {
  if (arguments.output.empty()) return success();
  const Activity shown("writing", arguments.output);
  Status written = write(arguments.output, arguments.format);
  phases.end("write");
  return written;
}

/// Axes of the same shapes, for a picture beside others, and what stands below them.
struct Panel {
  std::string title;
  std::vector<AxisItem> items;
};
/// A picture of panels in rows, `width` pixels wide, each in a place as large as `box`.
Status write_panels(const FileArguments& arguments, const DocumentInfo& info, const Box& box,
                    std::vector<Panel> panels, double width);

/// Reads, computes and writes a file in constant memory by io::stream(), where the file is large
/// and the formats allow it, and prints notes; otherwise nothing. Of `stream`, this sets what the
/// arguments hold. Returns no items. Errors name the file.
Result<std::optional<LoadedAxes>> stream(const FileArguments& arguments, const InputOptions& input,
                                         io::StreamOptions stream);
/// What load_shapes(), compute_axes(), `change` and finish_axes() do together, in constant memory,
/// where the file is large and the formats allow it; otherwise nothing. `change` is called for
/// several parts at once; `line` replaces the summary that is printed. Of `options`, this sets what
/// the common options hold. Nothing, too, where a feature has more than `most_points`. Errors:
/// theirs.
Result<std::optional<int>> stream_axes(
    const FileArguments& arguments, const InputOptions& input, Options options = {},
    const std::function<Status(Document<AxisItem>& part)>& change = nullptr,
    const std::function<std::string()>& line = nullptr,
    std::uint64_t most_points = ~std::uint64_t{0});

/// compute_axes() and finish_axes() in one, in parts: no axis is in memory as a whole. Nothing
/// where the output is not written so.
Result<std::optional<int>> finish_in_parts(LoadedShapes& shapes, const FileArguments& arguments,
                                           const InputOptions& input, Options options);

/// The end of a command that made axes: writes them, and prints a summary, statistics or both.
/// Returns the exit status.
Result<int> finish_axes(LoadedAxes& axes, const FileArguments& arguments);

}  // namespace medial::cli
