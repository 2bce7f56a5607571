// medial match: ranks shapes by similarity.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/compute.h"
#include "medial/features.h"

namespace medial::cli {
namespace {

namespace fs = std::filesystem;

struct MatchArguments : FileArguments {
  std::string other;
  std::uint64_t best = 10;
  bool each = false;
};

/// A shape with its name: the file, or the file and the feature.
struct NamedSignature {
  std::string name;
  ShapeSignature signature;
};

/// Merges all items into the first: one shape with one axis.
void join_items(std::vector<AxisItem>& items) {
  for (std::size_t i = 1; i < items.size(); ++i) {
    MedialAxis& axis = items[0].axis;
    const auto nodes = static_cast<std::uint32_t>(axis.nodes.size());
    const auto sites = static_cast<std::uint32_t>(axis.sites.size());
    for (Edge edge : items[i].axis.edges) {
      for (std::uint32_t& node : edge.node) node += nodes;
      for (std::uint32_t& site : edge.site)
        if (site != no_site) site += sites;
      axis.edges.push_back(edge);
    }
    const auto append = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(axis.nodes, items[i].axis.nodes);
    append(axis.sites, items[i].axis.sites);
    Shape& shape = items[0].shape;
    const Shape& part = items[i].shape;
    const auto points = static_cast<std::uint32_t>(shape.points.size());
    const auto components = static_cast<std::uint32_t>(shape.component_count());
    if (!shape.bulges.empty() || !part.bulges.empty()) {
      shape.bulges.resize(shape.points.size(), 0);
      append(shape.bulges, part.bulges);
      shape.bulges.resize(shape.points.size() + part.points.size(), 0);
    }
    append(shape.points, part.points);
    append(shape.sources, part.sources);
    append(shape.hole, part.hole);
    for (std::size_t k = 1; k < part.loop_begin.size(); ++k)
      shape.loop_begin.push_back(points + part.loop_begin[k]);
    for (const std::uint32_t component : part.component)
      shape.component.push_back(components + component);
  }
}

/// The signature of a shape without its specks.
Result<ShapeSignature> signature_of(AxisItem& item) {
  MedialAxis& axis = item.axis;
  const Shape kept = without_specks(item.shape);
  // An exact axis of the interior is computed again where specks were left out.
  if (kept.loop_count() < item.shape.loop_count() && axis.resolution == 0 && axis.exterior == 0) {
    Options options;
    options.threads = 1;
    auto again = compute(kept, options);
    if (!again) return std::move(again).error();
    axis = std::move(again).value();
  }
  return medial::signature_of(axis, medial::describe(axis));
}

/// The signatures of a file's features, or of the whole file as one shape.
Result<std::vector<NamedSignature>> signatures_of(const InputOptions& input,
                                                  const CommonOptions& common, bool each) {
  auto axes = load_axes(input, common);
  if (!axes) return std::move(axes).error();
  std::vector<AxisItem>& items = axes->file.items;
  if (!each) {
    join_items(items);
    items.resize(std::min<std::size_t>(items.size(), 1));
  }
  const auto sign = [&](std::size_t i, int) -> Result<NamedSignature> {
    auto signature = signature_of(items[i]);
    if (!signature) return std::move(signature).error();
    return NamedSignature{
        each ? fmt::format("{}#{}", input.path, axes->file.index_of(i)) : input.path, *signature};
  };
  std::vector<std::string> left_out;
  auto signatures = map_features<NamedSignature>(axes->file, edge_weights_of(axes->file),
                                                 common.threads, sign, skips(input, left_out));
  if (!signatures) return std::move(signatures).error();
  note_left_out(left_out, input, common);
  return std::move(signatures->items);
}

/// The files in a folder and its subfolders, by name.
Result<std::vector<std::string>> files_of(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code problem;
  for (fs::recursive_directory_iterator it(folder, problem), end; !problem && it != end;
       it.increment(problem))
    if (it->is_regular_file(problem)) files.push_back(it->path().string());
  if (problem) return error_at(ErrorCode::unreadable, folder, problem.message());
  std::ranges::sort(files);
  return files;
}

/// The shapes to compare with.
struct Candidates {
  std::vector<NamedSignature> shapes;
  std::uint64_t refused = 0;  ///< files of a folder without shapes
};

Result<Candidates> candidates_of(const MatchArguments& arguments) {
  std::error_code ignored;
  const bool folder = fs::is_directory(arguments.other, ignored);
  Result<std::vector<std::string>> paths = std::vector{arguments.other};
  if (folder) paths = files_of(arguments.other);
  if (!paths) return std::move(paths).error();
  Candidates out;
  for (const std::string& path : *paths) {
    const InputOptions own = second_input(arguments.input, path);
    CommonOptions common = arguments.common;
    common.quiet = common.quiet || folder;
    auto found = signatures_of(own, common, arguments.each);
    if (found) {
      std::ranges::move(*found, std::back_inserter(out.shapes));
    } else if (folder) {  // a folder may hold other files
      ++out.refused;
    } else {
      return std::move(found).error();
    }
  }
  if (out.shapes.empty()) return no_shape(arguments.other);
  return out;
}

Result<int> run_match(const MatchArguments& arguments) {
  const std::string& path = arguments.input.path;
  Phases phases;
  auto asked =
      signatures_of(first_input(arguments.input, arguments.other), arguments.common, false);
  if (!asked) return std::move(asked).error();
  if (asked->empty()) return no_shape(path);
  const auto candidates = candidates_of(arguments);
  if (!candidates) return candidates.error();
  using Ranked = std::pair<double, const NamedSignature*>;
  std::vector<Ranked> ranked;
  for (const NamedSignature& named : candidates->shapes)
    ranked.emplace_back(dissimilarity(asked->front().signature, named.signature), &named);
  std::ranges::stable_sort(ranked, {}, &Ranked::first);
  if (arguments.best > 0) ranked.resize(std::min<std::size_t>(arguments.best, ranked.size()));
  phases.end("match");
  std::string text;
  Json list = Json::array();
  for (const auto& [value, named] : ranked) {
    list.push_back({{"shape", named->name}, {"dissimilarity", value}});
    text += fmt::format("{:8.4f}  {}\n", value, named->name);
  }
  if (candidates->refused > 0 && !arguments.common.json && !arguments.common.quiet)
    say("medial: {}: note: {} without a shape, left out\n", arguments.other,
        counted(candidates->refused, "file"));
  return finish(arguments.common,
                {{"input", path},
                 {"candidates", candidates->shapes.size()},
                 {"refused", candidates->refused},
                 {"matches", std::move(list)}},
                phases, text);
}

}  // namespace

Command make_match_command(CLI::App& program) {
  auto arguments = std::make_shared<MatchArguments>();
  CLI::App* command = program.add_subcommand(
      "match",
      "Rank shapes by their similarity to another one, whatever their rotation and scale.");
  add_input_options(*command, arguments->input, "OTHER",
                    "A second file of shapes or axes, or a folder of such files.",
                    arguments->other);
  command->add_flag("--each", arguments->each,
                    "Treat every feature of OTHER as a shape; otherwise each file is one.");
  add_value(*command, "--best", arguments->best, "N", a_whole_number(),
            "Print the N most similar (default: 10; 0: all).");
  add_common_options(*command, arguments->common);
  command->footer(
      "The numbers are dissimilarities: 0 for the same shape, about 1 for two random shapes.\n"
      "They compare distributions over the axis (thickness, distances, erosion), which do not\n"
      "change with rotation, scale and reflection, and hardly with noise in the outline.\n"
      "\n"
      "Examples:\n"
      "  medial match horse.png silhouettes/\n"
      "  medial match key.svg tools.geojson --each --best 3\n"
      "  medial match a.json b.json --json");
  return command_of(command, arguments, run_match);
}

}  // namespace medial::cli
