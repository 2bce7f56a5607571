// medial match: how like shapes are.

#include "medial/match.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "cli/stored_axes.h"
#include "cli/terminal.h"
#include "medial/compute.h"

namespace medial::cli {
namespace {

namespace fs = std::filesystem;

struct MatchArguments {
  InputOptions input;
  CommonOptions common;
  std::string other;
  std::uint64_t best = 10;
  bool each = false;
};

/// A shape with its name: the file, or the file and the feature.
struct NamedSignature {
  std::string name;
  ShapeSignature signature;
};

/// Makes one shape with one axis of all items, in the first.
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

/// The signatures of a file's features, or of all of it as one shape.
Result<std::vector<NamedSignature>> signatures_of(const InputOptions& input,
                                                  const CommonOptions& common, bool each) {
  auto axes = load_axes(input, common);
  if (!axes) return std::move(axes).error();
  std::vector<AxisItem>& items = axes->native.items;
  std::vector<NamedSignature> out(each ? items.size() : std::min<std::size_t>(items.size(), 1));
  if (!each) join_items(items);
  std::vector<double> weights;
  for (std::size_t i = 0; i < out.size(); ++i)
    weights.push_back(static_cast<double>(items[i].axis.edges.size()) + 1);
  Status signed_all = for_each_feature(weights, common.threads, [&](std::size_t i, int) -> Status {
    MedialAxis& axis = items[i].axis;
    const Shape kept = without_specks(items[i].shape);
    // An exact axis of the interior is computed again where specks were left out.
    if (kept.loop_count() < items[i].shape.loop_count() && axis.resolution == 0 &&
        axis.exterior == 0) {
      Options options;
      options.threads = 1;
      auto again = compute(kept, options);
      if (!again) return std::move(again).error();
      axis = std::move(again).value();
    }
    out[i].signature = signature_of(axis, describe(axis));
    return success();
  });
  if (!signed_all) return std::move(signed_all).error();
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i].name = each ? fmt::format("{}#{}", input.path, i) : input.path;
  return out;
}

/// The files of a folder, those below it included, by name.
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

Result<int> run_match(const MatchArguments& arguments) {
  const auto& [input, common, other, best, each] = arguments;
  const Stopwatch watch;
  auto asked = signatures_of(input, common, false);
  if (!asked) return std::move(asked).error();
  const bool folder = fs::is_directory(other);
  std::vector<std::string> paths{other};
  if (folder) {
    auto files = files_of(other);
    if (!files) return std::move(files).error();
    paths = std::move(files).value();
  }
  std::vector<NamedSignature> candidates;
  std::uint64_t refused = 0;
  for (const std::string& path : paths) {
    InputOptions own = input;
    own.path = path;
    CommonOptions quiet = common;
    quiet.quiet = quiet.quiet || folder;
    auto found = signatures_of(own, quiet, each);
    if (!found) {
      // In a folder, other files are not at fault.
      if (!folder) return std::move(found).error();
      ++refused;
      continue;
    }
    std::ranges::move(*found, std::back_inserter(candidates));
  }
  if (candidates.empty()) return error_at(ErrorCode::empty, other, "holds no shape");

  struct Ranked {
    double value;
    const NamedSignature* named;
  };
  std::vector<Ranked> ranked;
  for (const NamedSignature& named : candidates)
    ranked.push_back({dissimilarity(asked->front().signature, named.signature), &named});
  std::ranges::stable_sort(ranked, {}, &Ranked::value);
  const std::size_t shown = best == 0 ? ranked.size() : std::min<std::size_t>(best, ranked.size());
  if (common.json) {
    Json list = Json::array();
    for (std::size_t i = 0; i < shown; ++i)
      list.push_back({{"shape", ranked[i].named->name}, {"dissimilarity", ranked[i].value}});
    Json object = {{"input", input.path},
                   {"candidates", candidates.size()},
                   {"refused", refused},
                   {"matches", std::move(list)}};
    if (common.stats) object.update({{"seconds", watch.seconds()}, {"peak_bytes", peak_bytes()}});
    Status printed = print(object);
    if (!printed) return std::move(printed).error();
    return exit_success;
  }
  std::string text;
  for (std::size_t i = 0; i < shown; ++i)
    text += fmt::format("{:8.4f}  {}\n", ranked[i].value, ranked[i].named->name);
  if (common.stats) say_text(table({{"seconds", watch.seconds()}, {"peak_bytes", peak_bytes()}}));
  if (refused > 0 && !common.quiet)
    say("medial: {}: {} without a shape\n", other, counted(refused, "file"));
  Status printed = print(text);
  if (!printed) return std::move(printed).error();
  return exit_success;
}

}  // namespace

Command make_match_command(CLI::App& program) {
  auto arguments = std::make_shared<MatchArguments>();
  CLI::App* command = program.add_subcommand(
      "match", "Rank shapes by how like another one they are, however turned or scaled.");
  add_input_options(*command, arguments->input, "OTHER",
                    "A second file of shapes or axes, or a folder of such files.",
                    arguments->other);
  command->add_flag("--each", arguments->each,
                    "Every feature of OTHER is a shape; otherwise each file is one.");
  command
      ->add_option("--best", arguments->best,
                   "Tell so many, the most like first (default: 10; 0: all).")
      ->check(a_whole_number())
      ->option_text("N");
  add_common_options(*command, arguments->common);
  command->footer(
      "The numbers are dissimilarities: 0 the same, about 1 two shapes at random. They come\n"
      "from distributions over the axis (thickness, distances, erosion) that rotation,\n"
      "scale and reflection leave alone, and that noise of the outline hardly moves.\n"
      "\n"
      "Examples:\n"
      "  medial match horse.png silhouettes/\n"
      "  medial match key.svg tools.geojson --each --best 3\n"
      "  medial match a.json b.json --json");
  return {command, [arguments] { return run_match(*arguments); }};
}

}  // namespace medial::cli
