#include "cli/nearest.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "cli/costs.h"
#include "cli/loose.h"
#include "cli/terminal.h"
#include "medial/io/write.h"
#include "medial/voronoi.h"

namespace medial::cli {
namespace {

constexpr char answer_formats[] = ".csv .json";

/// A place and what is nearest to it.
struct Answer {
  Vec2 place;
  NearestSite nearest = {};
  SiteKind kind = SiteKind::vertex;
  std::uint32_t feature = 0;  ///< of those that share the site the first
};

/// All points of the file of queries, vertices of lines as well.
Status add_places(const NearestArguments& asked, const InputOptions& input, int threads,
                  std::vector<Answer>& answers) {
  InputOptions from;
  from.path = asked.queries;
  from.arcs = input.arcs;
  auto file = load_chains(from, threads);
  if (!file) return std::move(file).error();
  for (const Chain& chain : file->chains)
    for (const Vec2 place : chain.points) answers.push_back({place});
  for (const Answer& answer : answers)
    if (!std::isfinite(answer.place.x) || !std::isfinite(answer.place.y))
      return error_at(ErrorCode::not_finite, asked.queries, "a coordinate is not a finite number");
  return success();
}

const char* kind_name(SiteKind kind) {
  return kind == SiteKind::vertex ? "point" : kind == SiteKind::arc ? "arc" : "segment";
}

std::string csv_of(const std::vector<Answer>& answers) {
  std::string text = "x,y,site,kind,feature,distance,foot_x,foot_y\n";
  for (const auto& [place, nearest, kind, feature] : answers)
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}\n", place.x, place.y,
                   nearest.site, kind_name(kind), feature, nearest.distance, nearest.foot.x,
                   nearest.foot.y);
  return text;
}

Json json_of(const std::vector<Answer>& answers, const LooseFile& file) {
  Json all = Json::array();
  for (const auto& [place, nearest, kind, feature] : answers) {
    Json attributes = Json::object();
    for (const auto& [name, value] : file.attributes[feature]) attributes[name] = value;
    all.push_back({{"x", place.x},
                   {"y", place.y},
                   {"site", nearest.site},
                   {"kind", kind_name(kind)},
                   {"feature", feature},
                   {"distance", nearest.distance},
                   {"foot", {{"x", nearest.foot.x}, {"y", nearest.foot.y}}},
                   {"attributes", std::move(attributes)}});
  }
  return all;
}

}  // namespace

void add_nearest_options(CLI::App& command, NearestArguments& nearest) {
  constexpr char group[] = "The nearest site, instead of the diagram";
  add_list_option(
      command, "--nearest", 2,
      [&nearest](const std::vector<double>& xy) {
        nearest.places.push_back({xy[0], xy[1]});
      },
      "What is nearest to this place: the site, its kind and feature, the distance and\n"
      "the nearest point. May be repeated. As .csv or .json to -o or standard output.")
      ->trigger_on_parse()
      ->option_text("X,Y")
      ->group(group);
  command
      .add_option("--queries", nearest.queries,
                  "The same for all points of this file, in the coordinates of INPUT.")
      ->check(a_name())
      ->option_text("FILE")
      ->group(group);
}

Result<int> run_nearest(const InputOptions& input, const CommonOptions& common,
                        const NearestArguments& asked, const std::string& output,
                        const std::string& format) {
  if (input.read.project)
    return invalid_option("--project makes coordinates that no place can be told in beforehand");
  Status writable = check_output(output, format, answer_formats, input.path, common.json);
  if (writable && !asked.queries.empty())
    writable = check_output(output, format, answer_formats, asked.queries, common.json);
  if (!writable) return std::move(writable).error();
  const Stopwatch reading;
  auto file = load_chains(input, common.threads);
  if (!file) return std::move(file).error();
  print_notes(*file, input, common);
  std::vector<Answer> answers;
  for (const Vec2 place : asked.places) answers.push_back({place});
  if (!asked.queries.empty()) {
    if (Status added = add_places(asked, input, common.threads, answers); !added)
      return std::move(added).error();
  }
  const double seconds_read = reading.seconds();
  const Stopwatch shaping;
  const auto planar_graph = planar_graph_of(*file, input);
  if (!planar_graph) return planar_graph.error();
  const double seconds_shape = shaping.seconds();
  const Stopwatch searching;
  const std::vector<Site> sites = sites_of(*planar_graph);
  const SiteLocator locator(sites);
  for (Answer& answer : answers) {
    answer.nearest = locator.nearest(answer.place);
    const Site& site = sites[answer.nearest.site];
    answer.kind = site.kind;
    answer.feature = file->feature[site.ring];
  }
  const Json costs = costs_of(
      common, {{"read", seconds_read}, {"shape", seconds_shape}, {"search", searching.seconds()}});
  const auto object = [&] {
    return Json{{"input", input.path}, {"nearest", json_of(answers, *file)}};
  };
  Status told = success();
  if (!output.empty() && output != "-") {
    // .json or .csv, as check_output() has seen to.
    const bool as_json = output.back() == 'n' || output.back() == 'N';
    told = io::write_text(output, as_json ? object().dump(2) + "\n" : csv_of(answers));
  } else if (common.json || (output == "-" && format != "csv")) {
    Json all = object();
    if (common.json && common.stats) all.update(costs);
    told = print(all);
  } else {
    told = print(csv_of(answers));
  }
  if (!told) return std::move(told).error();
  print_costs(common, costs);
  return exit_success;
}

}  // namespace medial::cli
