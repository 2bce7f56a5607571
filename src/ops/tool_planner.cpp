#include "ops/tool_planner.h"

#include <algorithm>
#include <cmath>

#include "base/arc.h"

namespace medial::ops {
namespace {

/// The points of a path as far as `most` along it, in the plane, without arcs.
std::vector<ToolPoint> beginning_of(const std::vector<ToolPoint>& path, double most, double chord) {
  std::vector<ToolPoint> points;
  double length = 0;
  for (const ToolPoint& to : without_arcs({ToolPathKind::groove, path}, chord)) {
    if (!points.empty()) {
      const ToolPoint& from = points.back();
      const double way = distance(from.point, to.point), left = most - length;
      if (way > left) {
        const double share = left / way;
        points.push_back(
            {from.point + share * (to.point - from.point), from.z + share * (to.z - from.z), 0});
        return points;
      }
      length += way;
    }
    points.push_back(to);
  }
  return points;
}

double length_of(const std::vector<ToolPoint>& points) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    length += arc_length(distance(points[i].point, points[i + 1].point), points[i].bulge);
  return length;
}

/// The way down from `level` to the first point of a path: along its beginning and back, as often
/// as it takes, nowhere below the path; or straight, where that would be too often.
ToolPath way_down(const std::vector<ToolPoint>& path, double level, double slope, double chord) {
  const double drop = level - path.front().z, way = drop / slope;
  const double round_trip = 2 * length_of(path);
  constexpr double rounding = 1e-9;
  if (!(way > rounding * round_trip)) return {ToolPathKind::ramp, {}};
  constexpr double most_trips = 1e4;
  const double trips = std::ceil(way / round_trip);
  if (!(trips <= most_trips))
    return {ToolPathKind::plunge,
            {{path.front().point, level, 0}, {path.front().point, path.front().z, 0}}};
  const std::vector<ToolPoint> there = beginning_of(path, 0.5 * way / trips, chord);
  const double share = drop / (2 * trips * length_of(there));
  std::vector<ToolPoint> points{{path.front().point, level, 0}};
  double z = level;
  const auto go = [&](const ToolPoint& from, const ToolPoint& to) {
    z -= share * distance(from.point, to.point);
    points.push_back({to.point, std::max(z, to.z), 0});
  };
  for (double trip = 0; trip < trips; trip += 1) {
    for (std::size_t k = 1; k < there.size(); ++k) go(there[k - 1], there[k]);
    for (std::size_t k = there.size() - 1; k-- > 0;) go(there[k + 1], there[k]);
  }
  return {ToolPathKind::ramp, std::move(points)};
}

}  // namespace

void Planner::add(ToolPathKind kind, std::vector<ToolPoint> points, double reach) {
  if (points.size() < 2) return;
  // A groove is entered at its upper end, where it may reach up to what is cut already.
  if (kind == ToolPathKind::groove && std::isfinite(slope_) && points.front().z < level_ &&
      points.back().z > points.front().z)
    std::reverse(points.begin(), points.end());
  const double length = length_of(points);
  carving_.own_length += length;
  carving_.cut_length += length;
  if (started()) {
    const double way = distance(at(), points.front().point);
    if (way <= reach) {
      carving_.cut_length += way;
      append(kind, std::move(points));
      return;
    }
    carving_.travel_length += way;
  }
  if (std::isfinite(slope_) && points.front().z < level_) {
    ToolPath down = way_down(points, level_, slope_, chord_);
    down.pass = pass_;
    carving_.cut_length += length_of(down.points);
    if (!down.points.empty()) carving_.paths.push_back(std::move(down));
  }
  carving_.paths.push_back({kind, std::move(points), pass_});
}

void Planner::append(ToolPathKind kind, std::vector<ToolPoint> points) {
  auto& last = carving_.paths.back();
  if (kind == last.kind) {
    last.points.insert(last.points.end(), points.begin(), points.end());
    return;
  }
  points.insert(points.begin(), last.points.back());
  points.front().bulge = 0;
  carving_.paths.push_back({kind, std::move(points), pass_});
}

}  // namespace medial::ops
