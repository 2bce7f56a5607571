#include "cli/nearest.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "cli/pipeline.h"
#include "medial/voronoi.h"

namespace medial::cli {
namespace {

constexpr char answer_formats[] = ".csv .json";

/// A place and the site nearest to it.
struct Answer {
  Vec2 place;
  NearestSite nearest = {};
  SiteKind kind = SiteKind::vertex;
  std::uint32_t feature = 0;  ///< the first of those that share the site
};

/// All points of the file of queries, including vertices of lines.
Status add_places(const NearestArguments& asked, const InputOptions& input,
                  const CommonOptions& common, std::vector<Answer>& answers) {
  InputOptions from;
  from.path = asked.queries;
  from.source.load.arcs = input.source.load.arcs;
  CommonOptions quiet = common;
  quiet.quiet = true;
  auto pieces = load_loose(from, quiet);
  if (!pieces) return std::move(pieces).error();
  for (const Chain& chain : pieces->chains)
    for (const Vec2 place : chain.points) answers.push_back({place});
  for (const Answer& answer : answers)
    if (!std::isfinite(answer.place.x) || !std::isfinite(answer.place.y))
      return error_at(ErrorCode::not_finite, asked.queries, "a coordinate is not a finite number");
  return success();
}

const char* kind_name(SiteKind kind) {
  return kind == SiteKind::vertex ? "point" : kind == SiteKind::arc ? "arc" : "segment";
}

std::string csv_of(const std::vector<Answer>& answers, const DocumentInfo& file) {
  std::string text = "x,y,site,kind,feature,distance,foot_x,foot_y\n";
  for (const auto& [place, nearest, kind, feature] : answers)
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}\n", place.x, place.y,
                   nearest.site, kind_name(kind), file.index_of(feature), nearest.distance,
                   nearest.foot.x, nearest.foot.y);
  return text;
}

Json json_of(const std::vector<Answer>& answers, const LoosePieces& pieces) {
  Json all = Json::array();
  for (const auto& [place, nearest, kind, feature] : answers) {
    all.push_back({{"x", place.x},
                   {"y", place.y},
                   {"site", nearest.site},
                   {"kind", kind_name(kind)},
                   {"feature", pieces.features.index_of(feature)},
                   {"distance", nearest.distance},
                   {"foot", {{"x", nearest.foot.x}, {"y", nearest.foot.y}}},
                   {"attributes", to_json(pieces.features.items[feature])}});
  }
  return all;
}

}  // namespace

void add_nearest_options(CLI::App& command, NearestArguments& nearest) {
  const OptionGroup group(command, "The nearest site, instead of the diagram");
  add_list_option(
      command, "--nearest", 2,
      [&nearest](const std::vector<double>& xy) {
        nearest.places.push_back({xy[0], xy[1]});
      },
      "Find the site nearest to this place, its kind and feature, the distance and the\n"
      "nearest point. May be repeated. Writes .csv or .json to -o or standard output.")
      ->trigger_on_parse()
      ->option_text("X,Y");
  command
      .add_option("--queries", nearest.queries,
                  "The same for all points of this file, in the coordinates of INPUT.")
      ->check(a_name())
      ->option_text("FILE");
}

Result<int> run_nearest(const FileArguments& arguments, const NearestArguments& asked) {
  const auto& [input, common, output, format, write] = arguments;
  if (input.source.read.project)
    return invalid_option(
        "--project cannot be used with places, as the projection is not known in advance: project "
        "the file first (ogr2ogr -t_srs) and give its coordinates");
  Status writable = check_output(arguments, answer_formats);
  if (writable && !asked.queries.empty())
    writable = check_output(output, format, answer_formats, asked.queries, common.json);
  if (!writable) return std::move(writable).error();
  if (input.path == "-" && asked.queries == "-")
    return invalid_option("INPUT and --queries cannot both be standard input");
  Phases phases;
  auto pieces = load_loose(input, common);
  if (!pieces) return std::move(pieces).error();
  std::vector<Answer> answers;
  for (const Vec2 place : asked.places) answers.push_back({place});
  if (!asked.queries.empty()) {
    if (Status added = add_places(asked, input, common, answers); !added)
      return std::move(added).error();
  }
  phases.end("read");
  const bool repair = input.source.read.repair != RepairRule::none;
  const auto graph = planar_graph_of(*pieces, {.node_crossings = repair});
  if (!graph) return graph.error();
  phases.end("shape");
  const std::vector<Site> sites = sites_of(*graph);
  const SiteLocator locator(sites);
  for (Answer& answer : answers) {
    answer.nearest = locator.nearest(answer.place);
    const Site& site = sites[answer.nearest.site];
    answer.kind = site.kind();
    answer.feature = pieces->feature[site.ring];
  }
  phases.end("search");
  // .json or .csv: checked by check_output().
  const bool to_file = !output.empty() && output != "-";
  const bool as_json = to_file ? output.ends_with('n') || output.ends_with('N')
                               : common.json || (output == "-" && format != "csv");
  Json object = {{"input", input.path}};
  if (as_json) object["nearest"] = json_of(answers, *pieces);
  CommonOptions report = common;
  report.json = as_json;
  if (!to_file)
    return finish(report, std::move(object), phases,
                  as_json ? std::string() : csv_of(answers, pieces->features));
  Status written =
      io::write_text(output, as_json ? object.dump(2) + "\n" : csv_of(answers, pieces->features));
  if (!written) return std::move(written).error();
  report.stats = common.stats && !common.json;
  report.json = false;
  return finish(report, {}, phases, {});
}

}  // namespace medial::cli
