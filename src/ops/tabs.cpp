#include "ops/tabs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/arc.h"
#include "base/box_tree.h"
#include "base/compat.h"
#include "base/disjoint_sets.h"
#include "base/numbers.h"
#include "medial/query.h"

namespace medial {
namespace {

/// From a bar with flat ends, so that none reaches through the walls that it stands between.
double distance_to_bar(Vec2 p, Vec2 a, Vec2 b, double width) {
  const double length = distance(a, b);
  if (!(length > 0)) return distance(p, a);
  const double along = dot(p - a, b - a) / length, aside = std::abs(cross(b - a, p - a)) / length;
  return std::hypot(std::max({-along, along - length, 0.0}), std::max(aside - width / 2, 0.0));
}
/// Of a tab: two bars, and around where they meet a disk that is no wider than what they cross.
double distance_to_tab(Vec2 p, const TabLine& line, double width) {
  const double round = std::min(width / 2, distance(line[0], line[1]));
  return std::min({distance_to_bar(p, line[0], line[1], width),
                   distance_to_bar(p, line[1], line[2], width),
                   std::max(distance(p, line[1]) - round, 0.0)});
}

/// A disk between two loops: a tab may stand there.
struct TabPlace {
  std::uint32_t loop = 0, across = 0;
  double along = 0;  ///< of its foot on `loop`
  double radius = 0;
  bool at_corner = false;  ///< that foot is a vertex
  TabLine line;
};

/// Where the sites of an axis lie on the boundary of its shape.
class SitePlaces {
 public:
  SitePlaces(const Shape& shape, const MedialAxis& axis) : axis_(axis) {
    loop_.resize(axis.sites.size());
    begin_.resize(axis.sites.size());
    std::uint32_t loop = 0, point = 0;
    lengths_.resize(shape.loop_count());
    for (std::size_t i = 0; i < axis.sites.size(); ++i) {
      while (loop + 1 < shape.loop_count() && point >= shape.loop_begin[loop + 1]) ++loop;
      const Site& site = axis.sites[i];
      loop_[i] = loop;
      begin_[i] = lengths_[loop];
      if (site.kind() == SiteKind::vertex) continue;  // it comes before the edge that begins there
      lengths_[loop] += arc_length(distance(site.start, site.end), site.bulge);
      ++point;
    }
  }
  std::uint32_t loop(std::uint32_t site) const { return loop_[site]; }
  double length(std::uint32_t loop) const { return lengths_[loop]; }
  /// Of a point of the site: the length of its loop up to there.
  double along(std::uint32_t site, Vec2 p) const {
    const Site& on = axis_.sites[site];
    if (on.kind() == SiteKind::vertex || p == on.start) return begin_[site];
    const BulgeArc edge{on.start, on.end, on.bulge};
    return begin_[site] + arc_length(distance(on.start, p), partial_bulge(edge, on.start, p));
  }

 private:
  const MedialAxis& axis_;
  std::vector<std::uint32_t> loop_;
  std::vector<double> begin_, lengths_;
};

/// Calls visit(place) for disks that touch a hole and another loop, seen from the hole.
template <class Visit>
void each_place(const Shape& shape, const MedialAxis& axis, const SitePlaces& sites,
                const Visit& visit) {
  constexpr int pieces = 16;  // of an edge
  for (const Edge& edge : axis.edges) {
    if (sites.loop(edge.site[0]) == sites.loop(edge.site[1])) continue;
    for (int k = 1; k < pieces; ++k) {
      const Disk disk = disk_at(axis, edge, static_cast<double>(k) / pieces);
      for (const std::size_t side : {0U, 1U}) {
        const std::uint32_t here = edge.site[side], there = edge.site[1 - side];
        if (!shape.hole[sites.loop(here)]) continue;
        const Vec2 from = foot(axis.sites[here], disk.center);
        visit(TabPlace{sites.loop(here),
                       sites.loop(there),
                       sites.along(here, from),
                       disk.radius,
                       axis.sites[here].kind() == SiteKind::vertex,
                       {from, disk.center, foot(axis.sites[there], disk.center)}});
      }
    }
  }
}

/// The best of many places.
class BestPlaces {
 public:
  BestPlaces(const SitePlaces& sites, const TabOptions& options)
      : sites_(sites), options_(options) {}

  void consider(const TabPlace& place) {
    const double length = sites_.length(place.loop);
    const double count =
        options_.count > 0 ? options_.count : std::max(1.0, std::ceil(length / options_.spacing));
    const double part = std::min(std::floor(count * place.along / length), count - 1);
    const double off = std::abs(place.along - (part + 0.5) * length / count);
    const double cost = off + place.radius + (place.at_corner ? length / count : 0);
    keep(in_part_[{place.loop, part}], cost, place);
    keep(between_[std::minmax(place.loop, place.across)], place.radius, place);
    ++seen_;
  }

  /// The best place in each equal part of each hole, near the part's middle, and short; then the
  /// shortest ones that tie loose loops to the rest.
  std::vector<TabLine> lines(std::size_t loops) const {
    std::vector<TabLine> lines;
    DisjointSets tied(loops);
    for (const auto& [key, best] : in_part_) {
      lines.push_back(best.place.line);
      tied.join(best.place.loop, best.place.across);
    }
    std::vector<const Best*> others;
    for (const auto& [key, best] : between_) others.push_back(&best);
    ranges::sort(others, std::less<>(),
                 [](const Best* best) { return std::pair(best->cost, best->seen); });
    for (const Best* best : others)
      if (tied.join(best->place.loop, best->place.across)) lines.push_back(best->place.line);
    return lines;
  }

 private:
  struct Best {
    double cost = infinity;
    std::size_t seen = 0;  ///< the first of equal ones counts
    TabPlace place;
  };
  void keep(Best& best, double cost, const TabPlace& place) const {
    if (cost < best.cost) best = {cost, seen_, place};
  }

  const SitePlaces& sites_;
  const TabOptions& options_;
  std::size_t seen_ = 0;
  std::map<std::pair<std::uint32_t, double>, Best> in_part_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Best> between_;
};

/// A move, and the parts of it that would cut into tabs.
class Crossing {
 public:
  /// `reach`: from a tab to the tool's centre beside it.
  Crossing(const BulgeArc& move, std::vector<const TabLine*> near, double width, double reach)
      : move_(move),
        near_(std::move(near)),
        width_(width),
        reach_(reach),
        length_(arc_length(norm(move.chord()), move.bulge)) {
    collect(0, 1);
  }
  /// Shares of the move, in its order.
  const std::vector<std::pair<double, double>>& inside() const { return inside_; }

 private:
  /// How far the place at a share is beyond the reach of all tabs, up to rounding.
  double excess(double share) const {
    double least = infinity;
    for (const TabLine* line : near_)
      least = std::min(least, distance_to_tab(point_at_share(move_, share), *line, width_));
    constexpr double rounding = 1 - 1e-9;
    return least - rounding * reach_;
  }
  /// The excess changes no faster than the way, so most parts are decided by their middle. What is
  /// as short as `finest` and enters and leaves a tab again goes no deeper into it than
  /// finest^2 / (8 reach), below 1e-8 of the reach.
  void collect(double from, double to) {
    constexpr double finest = 1.0 / 4096;
    const double middle = (from + to) / 2, half = (to - from) / 2 * length_;
    const double over = excess(middle);
    if (over >= half) return;
    if (over <= -half) return add(from, to);
    if (half > finest * reach_) {
      collect(from, middle);
      return collect(middle, to);
    }
    const bool begins = excess(from) < 0, ends = excess(to) < 0;
    if (begins && ends) return add(from, to);
    if (begins) return add(from, edge(from, to));
    if (ends) add(edge(to, from), to);
  }
  /// Where a tab's reach ends, between a share inside and one outside.
  double edge(double in, double out) const {
    constexpr int halvings = 60;
    for (int k = 0; k < halvings; ++k) {
      const double middle = (in + out) / 2;
      (excess(middle) < 0 ? in : out) = middle;
    }
    return out;
  }
  void add(double from, double to) {
    if (!inside_.empty() && inside_.back().second == from)
      inside_.back().second = to;
    else
      inside_.emplace_back(from, to);
  }

  BulgeArc move_;
  std::vector<const TabLine*> near_;
  double width_, reach_, length_;
  std::vector<std::pair<double, double>> inside_;
};

/// Lifts paths over tabs.
class Lift {
 public:
  explicit Lift(const Carving& carving)
      : tabs_(carving.tabs),
        tree_(tabs_, carving.tip_radius +
                         carving.slope * std::max(carving.deepest - carving.tabs.top, 0.0)) {}

  std::vector<ToolPoint> operator()(const std::vector<ToolPoint>& path) const {
    std::vector<ToolPoint> out;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) add_move(path[i], path[i + 1], out);
    return out;
  }

 private:
  std::vector<const TabLine*> near(const BulgeArc& move) const {
    Box box{move.start, move.start};
    box.add(move.end);
    for (const Vec2 side : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}})
      if (const auto point = parallel_point(move, side)) box.add(*point);
    return tree_.near(box);
  }
  static void put(Vec2 p, double z, std::vector<ToolPoint>& out) {
    if (out.empty() || !(out.back().point == p) || out.back().z != z) out.push_back({p, z, 0});
  }
  void add_move(const ToolPoint& from, const ToolPoint& to, std::vector<ToolPoint>& out) const {
    const BulgeArc move{from.point, to.point, from.bulge};
    const bool above = std::min(from.z, to.z) >= -tabs_.top;
    std::vector<double> ends{0};
    std::vector<std::pair<double, double>> inside;
    if (!above && !(move.start == move.end)) {
      if (auto lines = near(move); !lines.empty())
        inside = Crossing(move, std::move(lines), tabs_.width, tree_.reach()).inside();
    } else if (!above && tree_.reaches(from.point)) {
      inside = {{0, 1}};
    }
    const double level = (-tabs_.top - from.z) / (to.z - from.z);  // where a slope comes up to it
    for (const auto& [begin, end] : inside) {
      for (const double share : {begin, level, end})
        if (share > ends.back() && share < 1 && share <= end) ends.push_back(share);
    }
    ends.push_back(1);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const double middle = (ends[k] + ends[k + 1]) / 2;
      const bool lifted = ranges::any_of(
          inside, [&](const auto& part) { return part.first <= middle && middle <= part.second; });
      const auto z = [&](double share) {
        const double plain = share < 1 ? from.z + share * (to.z - from.z) : to.z;
        return lifted ? std::max(plain, -tabs_.top) : plain;
      };
      put(point_at_share(move, ends[k]), z(ends[k]), out);
      out.back().bulge = std::tan((ends[k + 1] - ends[k]) * std::atan(move.bulge));
      put(point_at_share(move, ends[k + 1]), z(ends[k + 1]), out);
    }
  }

  const Tabs& tabs_;
  ops::TabTree tree_;
};

std::vector<Box> boxes_around(const Tabs& tabs, double reach) {
  std::vector<Box> boxes;
  for (const TabLine& line : tabs.lines) {
    Box box{line[0], line[0]};
    box.add(line[1]);
    box.add(line[2]);
    const Vec2 by = (tabs.width / 2 + reach) * Vec2{1, 1};
    boxes.push_back({box.low - by, box.high + by});
  }
  return boxes;
}

}  // namespace

namespace ops {

TabTree::TabTree(const Tabs& tabs, double reach)
    : tabs_(tabs), reach_(reach), tree_(boxes_around(tabs, reach)) {}

std::vector<const TabLine*> TabTree::near(const Box& box) const {
  std::vector<const TabLine*> found;
  tree_.find(box, [&](std::uint32_t i) { found.push_back(&tabs_.lines[i]); });
  return found;
}

bool TabTree::reaches(Vec2 p) const {
  bool reached = false;
  tree_.find({p, p}, [&](std::uint32_t i) {
    reached = reached || distance_to_tab(p, tabs_.lines[i], tabs_.width) < reach_;
  });
  return reached;
}

void spare_tabs(Carving& carving) {
  if (carving.tabs.lines.empty() || carving.deepest <= carving.tabs.top) return;
  const Lift lift(carving);
  for (ToolPath& path : carving.paths) path.points = lift(path.points);
}

}  // namespace ops

Result<std::vector<TabLine>> place_tabs(const Shape& shape, const MedialAxis& axis,
                                        const TabOptions& options) {
  if (axis.resolution > 0 || axis.exterior > 0)
    return Error{ErrorCode::unsupported, "tabs need an exact axis of the shape itself", {}};
  if (options.count == 0 && !(options.spacing > 0 && std::isfinite(options.spacing)))
    return Error{ErrorCode::invalid_option, "tabs need a count or a spacing above 0", {}};
  const SitePlaces sites(shape, axis);
  BestPlaces best(sites, options);
  each_place(shape, axis, sites, [&best](const TabPlace& place) { best.consider(place); });
  return best.lines(shape.loop_count());
}

}  // namespace medial
