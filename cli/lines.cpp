#include "cli/lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "cli/pipeline.h"
#include "medial/query.h"

namespace medial::cli {
namespace {

/// The place where a line begins or ends: a point, or the middle of the side after a vertex.
struct NamedPlace {
  std::optional<Vec2> point;
  VertexSource side;
};

std::optional<NamedPlace> named(const std::string& text) {
  const std::size_t at = text.find_first_of(",/");
  if (at == std::string::npos) return std::nullopt;
  const char *begin = text.data(), *middle = begin + at, *end = begin + text.size();
  const auto all = [](const char* first, const char* last, auto& value) {
    const auto [stop, problem] = std::from_chars(first, last, value);
    return problem == std::errc() && stop == last;
  };
  NamedPlace place;
  if (*middle == '/') {
    const bool read =
        all(begin, middle, place.side.ring) && all(middle + 1, end, place.side.vertex);
    return read ? std::optional(place) : std::nullopt;
  }
  Vec2 p;
  if (!all(begin, middle, p.x) || !all(middle + 1, end, p.y)) return std::nullopt;
  if (!std::isfinite(p.x) || !std::isfinite(p.y)) return std::nullopt;
  place.point = p;
  return place;
}

CLI::Validator a_place() {
  return CLI::Validator(
      [](const std::string& text) {
        return named(text) ? std::string() : text + " is neither X,Y nor RING/VERTEX";
      },
      "");
}

/// The middle of a side of a shape, if it has that side.
std::optional<Vec2> middle_of(const Shape& shape, VertexSource side) {
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    for (std::uint32_t k = shape.loop_begin[i]; k < shape.loop_begin[i + 1]; ++k) {
      if (shape.sources[k].ring != side.ring || shape.sources[k].vertex != side.vertex) continue;
      const Vec2 end = shape.points[k + 1 < shape.loop_begin[i + 1] ? k + 1 : shape.loop_begin[i]];
      const Vec2 chord = end - shape.points[k];
      return midpoint(shape.points[k], end) - (shape.bulge(k) / 2) * left_of(chord);
    }
  }
  return std::nullopt;
}

std::optional<Vec2> point_in(const Shape& shape, const NamedPlace& place) {
  return place.point ? place.point : middle_of(shape, place.side);
}

/// The path between the two named places in one feature.
Result<AxisPath> path_between_named(const AxisItem& item, const NamedPlace& from,
                                    const NamedPlace& to, const PathOptions& arguments) {
  std::optional<EdgePlace> ends[2];
  const NamedPlace* names[2] = {&from, &to};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto point = point_in(item.shape, *names[i]);
    if (!point) {
      return invalid_option(
          fmt::format("there is no side {}/{}", names[i]->side.ring, names[i]->side.vertex));
    }
    ends[i] = place_on_axis(item.axis, *point);
    if (!ends[i]) return invalid_option("the shape's axis is a single point");
  }
  if (!arguments.widest.empty()) return widest_path(item.axis, *ends[0], *ends[1]);
  return path_between(item.axis, *ends[0], *ends[1], arguments.path.route);
}

/// The feature that contains a place, or else the nearest one.
std::size_t feature_of(const Document<AxisItem>& file, const NamedPlace& place) {
  std::size_t best = 0;
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    const auto point = point_in(file.items[i].shape, place);
    if (!point) continue;
    const double depth = place.point ? clearance(file.items[i].shape, *point) : 0;
    if (!(depth > deepest)) continue;
    deepest = depth;
    best = i;
  }
  return best;
}

/// The places as the user wrote them.
std::vector<std::string> places_of(const PathOptions& arguments) {
  std::vector<std::string> texts = arguments.widest;
  for (const std::string& text : {arguments.from, arguments.to})
    if (!text.empty()) texts.push_back(text);
  return texts;
}

}  // namespace

Status check_places(const PathOptions& arguments, const InputOptions& input) {
  if (!input.source.read.project) return success();
  for (const std::string& text : places_of(arguments)) {
    if (!named(text)->point) continue;
    return invalid_option(
        fmt::format("--project cannot be used with the place {}, as the projection is not known in "
                    "advance: name a side as RING/VERTEX, or project the file first (ogr2ogr "
                    "-t_srs) and give its coordinates",
                    text));
  }
  return success();
}

void note_places(const Document<AxisItem>& file, const PathOptions& arguments,
                 const FileArguments& files) {
  if (files.common.quiet || !arguments.between_places() || file.items.empty()) return;
  if (file.items.size() > 1) {
    const NamedPlace begin = *named(places_of(arguments)[0]);
    say("medial: {}: note: the line lies in feature {}, where it begins; other features have "
        "none\n",
        files.input.path, file.index_of(feature_of(file, begin)));
  }
  for (const std::string& text : places_of(arguments)) {
    const NamedPlace place = *named(text);
    if (!place.point || std::ranges::any_of(file.items, [&](const AxisItem& item) {
          return item.axis.exterior > 0 || clearance(item.shape, *place.point) >= 0;
        }))
      continue;
    say("medial: {}: note: the place {} lies in no shape: the line ends at the nearest place of "
        "the "
        "axis\n",
        files.input.path, text);
  }
}

void add_path_options(CLI::App& command, PathOptions& arguments) {
  CLI::Option* from = command.add_option(
      "--from", arguments.from,
      "Where the line begins: at a point X,Y, or in the middle of the side that starts\n"
      "at RING/VERTEX of the input (with --project only there). With --to, replaces the\n"
      "two ends that are farthest apart.");
  CLI::Option* to = command.add_option("--to", arguments.to, "Where the line ends.");
  CLI::Option* widest = command.add_option(
      "--widest", arguments.widest,
      "The path between two places that lets the largest disk pass; of several,\n"
      "the shortest.");
  for (CLI::Option* place : {from, to}) place->check(a_place())->option_text("PLACE");
  widest->check(a_place())->expected(2)->option_text("PLACE PLACE")->excludes(from)->excludes(to);
  add_choice<Route>(command, "--route", arguments.path.route,
                    {{"roomy", Route::roomy}, {"shortest", Route::shortest}},
                    "The path around holes: roomy (default), where a passage twice as wide may\n"
                    "be twice as long; or shortest.");
  add_value(command, "--trim", arguments.path.trim, "RADII", in_range(0, 1e6),
            "Keep ends out of corners: cut an end that protrudes from a disk by at most\n"
            "this many radii (default: 1, corners of 60 degrees and more; 0\n"
            "cuts nothing).");
}

Result<std::vector<std::vector<AxisPath>>> choose_paths(const Document<AxisItem>& file,
                                                        const PathOptions& arguments, int threads) {
  std::vector<std::vector<AxisPath>> paths(file.items.size());
  const bool widest = !arguments.widest.empty();
  const std::string& from = widest ? arguments.widest[0] : arguments.from;
  const std::string& to = widest ? arguments.widest[1] : arguments.to;
  if (from.empty() != to.empty()) return invalid_option("--from and --to must be given together");
  if (!from.empty()) {
    if (file.items.empty())
      return Error{ErrorCode::empty, "there is no shape for a line between places", {}};
    const NamedPlace begin = *named(from), end = *named(to);
    const std::size_t chosen = feature_of(file, begin);
    auto path = path_between_named(file.items[chosen], begin, end, arguments);
    if (path && !(path->length > 0))
      path = invalid_option("the two places are one place of the axis: no line joins them");
    if (!path) {
      path.error().place.feature = chosen;
      return std::move(path).error();
    }
    paths[chosen].push_back(std::move(path).value());
    return paths;
  }
  return map_items<std::vector<AxisPath>>(
      std::vector<double>(paths.size(), 1.0), threads,
      [&](std::size_t i, int) { return main_paths(file.items[i].axis, arguments.path); });
}

}  // namespace medial::cli
