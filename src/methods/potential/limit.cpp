#include "methods/potential/limit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/threads.h"
#include "medial/query.h"
#include "methods/potential/force_lines.h"

namespace medial::potential {
namespace {

using Neighbors = std::vector<std::vector<std::uint32_t>>;

Neighbors neighbors_of(const Skeleton& skeleton) {
  Neighbors around(skeleton.points.size());
  for (const auto& [from, to] : skeleton.links) {
    around[from].push_back(to);
    around[to].push_back(from);
  }
  return around;
}

/// The remaining points of a skeleton, and the links between them.
Skeleton kept(const Skeleton& skeleton, const std::vector<bool>& stays) {
  Skeleton result;
  result.order = skeleton.order;
  result.forces = skeleton.forces;
  std::vector<std::uint32_t> number(stays.size());
  for (std::uint32_t i = 0; i < stays.size(); ++i) {
    number[i] = static_cast<std::uint32_t>(result.points.size());
    if (stays[i]) result.points.push_back(skeleton.points[i]);
  }
  for (const auto& [from, to] : skeleton.links)
    if (stays[from] && stays[to]) result.links.push_back({number[from], number[to]});
  return result;
}

/// Disks along a branch, including both nodes, with steps of at most `step`.
std::vector<Disk> along(const MedialAxis& axis, const Branch& branch, double step) {
  std::vector<Disk> disks;
  for (const auto& [edge, forward] : branch.steps) {
    std::vector<Disk> piece = sample_by_step(axis, axis.edges[edge], step);
    if (!forward) std::reverse(piece.begin(), piece.end());
    disks.insert(disks.end(), piece.begin() + (disks.empty() ? 0 : 1), piece.end());
  }
  return disks;
}

/// The disks to keep along a branch, besides its ends: steps follow the radius where it is small,
/// as those of force lines do. Keeps at least two of a closed branch, so that it stays a cycle.
std::vector<Disk> thinned(const std::vector<Disk>& disks, double step, bool closed) {
  constexpr double least = 1.0 / 16;
  std::vector<Disk> result;
  Vec2 last = disks.front().center;
  for (std::size_t i = 1; i + 1 < disks.size(); ++i) {
    const double gap = std::clamp(disks[i].radius, least * step, step);
    if (distance(last, disks[i + 1].center) <= gap) continue;
    result.push_back(disks[i]);
    last = disks[i].center;
  }
  if (result.size() >= 2 || !closed || disks.size() < 4) return result;
  return {disks[disks.size() / 3], disks[2 * disks.size() / 3]};
}

class LimitMaker {
 public:
  LimitMaker(const MedialAxis& exact, std::span<const Region> regions, const LocalFrame& local,
             double step)
      : exact_(exact),
        regions_(regions),
        local_(local),
        step_(step),
        numbers_(exact.nodes.size(), no_point) {
    skeletons_.resize(regions.size());
    for (Skeleton& skeleton : skeletons_) skeleton.order = limit_order;
  }

  std::vector<Skeleton> make() {
    for (const Branch& branch : branches(exact_)) add(branch);
    // The axis of a circle is its centre.
    for (std::uint32_t i = 0; i < exact_.nodes.size(); ++i)
      if (skeletons_[exact_.nodes[i].component].points.empty()) node(i);
    return std::move(skeletons_);
  }

 private:
  std::uint32_t point(Skeleton& skeleton, const Disk& disk, ValleyPoint::Kind kind) {
    skeleton.points.push_back(
        {local_.to_local(disk.center), disk.radius * local_.scale, Vec2{}, kind});
    return static_cast<std::uint32_t>(skeleton.points.size() - 1);
  }

  std::uint32_t node(std::uint32_t index) {
    const Node& own = exact_.nodes[index];
    if (numbers_[index] == no_point)
      numbers_[index] = point(skeletons_[own.component], own.disk,
                              own.disk.radius > 4 * exact_.tolerance ? ValleyPoint::Kind::junction
                                                                     : ValleyPoint::Kind::corner);
    return numbers_[index];
  }

  void add(const Branch& branch) {
    const std::uint32_t component = exact_.nodes[branch.from].component;
    Skeleton& skeleton = skeletons_[component];
    const double step = step_ * regions_[component].size * local_.inverse;
    const std::vector<Disk> disks = along(exact_, branch, step / 2);
    std::vector<std::uint32_t> chain = {node(branch.from)};
    for (const Disk& disk : thinned(disks, step, branch.from == branch.to))
      chain.push_back(point(skeleton, disk, ValleyPoint::Kind::valley));
    chain.push_back(node(branch.to));
    for (std::size_t i = 1; i < chain.size(); ++i) {
      skeleton.links.push_back({chain[i - 1], chain[i]});
      if (i + 1 == chain.size()) continue;
      const Vec2 way = skeleton.points[chain[i + 1]].place - skeleton.points[chain[i - 1]].place;
      skeleton.points[chain[i]].tangent = unit(way);
    }
  }

  const MedialAxis& exact_;
  const std::span<const Region> regions_;
  const LocalFrame local_;
  const double step_;                   ///< relative to a region's size
  std::vector<std::uint32_t> numbers_;  ///< the point of each node
  std::vector<Skeleton> skeletons_;
};

/// Follows the force from a place to where it turns, on the floor of a valley or at a minimum.
Vec2 foot_of_force(const Charges& charges, Vec2 p, double order, double step) {
  constexpr int most_steps = 1000;
  Evaluator evaluator(charges);
  Vec2 before;
  for (int i = 0; i < most_steps; ++i) {
    const double radius = evaluator.place(p).distance;
    if (!(radius > 0)) break;
    const Vec2 way = unit(evaluator.force(order).force);
    if (way == Vec2{} || dot(way, before) < 0) break;
    p = p + 0.4 * std::min(step, radius) * way;
    before = way;
  }
  return p;
}

double link_distance(const Skeleton& skeleton, const std::array<std::uint32_t, 2>& link, Vec2 p) {
  const Vec2 a = skeleton.points[link[0]].place, b = skeleton.points[link[1]].place - a;
  const double square = squared_norm(b);
  const double t = square > 0 ? std::clamp(dot(p - a, b) / square, 0.0, 1.0) : 0;
  return distance(p, a + t * b);
}

/// Drops branches that extend less than `least` beyond the disk of their branching: no valley of
/// low order leads to such a small bump. Keeps parts and cycles.
Skeleton pruned(const Skeleton& skeleton, double least) {
  const Neighbors around = neighbors_of(skeleton);
  const std::size_t count = around.size();
  std::vector<std::size_t> degree(count);
  std::vector<double> reach(count);  // of the dropped part there
  std::vector<bool> stays(count, true);
  for (std::size_t i = 0; i < count; ++i) {
    reach[i] = skeleton.points[i].radius;
    degree[i] = around[i].size();
  }
  /// The way from a tip to the branching where its branch starts.
  const auto way_from = [&](std::uint32_t tip) {
    std::vector<std::uint32_t> way = {tip};
    for (std::uint32_t before = tip; degree[way.back()] == (way.size() == 1 ? 1U : 2U);) {
      const std::uint32_t here = way.back();
      way.push_back(*std::find_if(around[here].begin(), around[here].end(),
                                  [&](auto i) { return stays[i] && i != before; }));
      before = here;
    }
    return way;
  };
  const auto drop = [&](std::uint32_t tip) {
    std::vector<std::uint32_t> way = way_from(tip);
    const std::uint32_t base = way.back();
    double length = reach[tip];
    for (std::size_t k = 1; k < way.size(); ++k)
      length = std::max(reach[way[k]], length + distance(skeleton.points[way[k - 1]].place,
                                                         skeleton.points[way[k]].place));
    if (degree[base] < 3 || length - skeleton.points[base].radius > least) return false;
    way.pop_back();
    for (const std::uint32_t i : way) stays[i] = false;
    reach[base] = length;
    --degree[base];
    return true;
  };
  // If a branching has only two branches left, they become one branch, which may have to be
  // dropped, too.
  for (bool dropped = true; dropped;) {
    dropped = false;
    for (std::uint32_t i = 0; i < count; ++i)
      if (stays[i] && degree[i] == 1 && drop(i)) dropped = true;
  }
  Skeleton result = kept(skeleton, stays);
  const Neighbors left = neighbors_of(result);
  for (std::size_t i = 0; i < left.size(); ++i) {
    ValleyPoint& point = result.points[i];
    if (point.kind != ValleyPoint::Kind::junction || left[i].size() != 2) continue;
    point.kind = ValleyPoint::Kind::valley;
    point.tangent = unit(result.points[left[i][1]].place - result.points[left[i][0]].place);
  }
  return result;
}

/// One order's step of descended().
class Descent {
 public:
  Descent(Skeleton& skeleton, const Charges& charges, const SuccessorOptions& options)
      : skeleton_(skeleton),
        charges_(charges),
        options_(options),
        around_(neighbors_of(skeleton)),
        moves_(skeleton.points.size()),
        found_(skeleton.points.size()) {}

  void run() {
    search();
    drop_tips();
    for (int i = 0; i < spreading; ++i) spread();
    for (std::size_t i = 0; i < moves_.size(); ++i)
      skeleton_.points[i].place = skeleton_.points[i].place + moves_[i];
    if (std::find(stays_.begin(), stays_.end(), false) != stays_.end())
      skeleton_ = kept(skeleton_, stays_);
    measure();
  }

 private:
  static constexpr int spreading = 8;
  enum class Found : std::uint8_t { no, yes, fixed };

  void search() {
    constexpr std::size_t grain = 16;
    parallel_ranges(moves_.size(), grain, [&](std::size_t i, std::size_t end) {
      Evaluator evaluator(charges_);
      for (; i < end; ++i) search_at(evaluator, i);
    });
  }

  void search_at(Evaluator& evaluator, std::size_t i) {
    const ValleyPoint& point = skeleton_.points[i];
    if (point.kind == ValleyPoint::Kind::corner) found_[i] = Found::fixed;
    if (point.kind != ValleyPoint::Kind::valley) return;
    const auto place = valley_across(evaluator, point, options_.order, options_);
    if (!place) return;
    found_[i] = Found::yes;
    moves_[i] = *place - point.place;
  }

  /// Drops points without a valley, starting at each tip; the last point stays.
  void drop_tips() {
    stays_.assign(moves_.size(), true);
    std::vector<std::size_t> degree(moves_.size());
    std::vector<std::uint32_t> tips;
    for (std::uint32_t i = 0; i < degree.size(); ++i)
      if ((degree[i] = around_[i].size()) == 1) tips.push_back(i);
    while (!tips.empty()) {
      const std::uint32_t tip = tips.back();
      tips.pop_back();
      if (degree[tip] != 1) continue;
      const auto next = *std::find_if(around_[tip].begin(), around_[tip].end(),
                                      [&](std::uint32_t k) { return stays_[k]; });
      // The tip of the valley next to a corner is the corner.
      const bool is_end = skeleton_.points[tip].kind != ValleyPoint::Kind::valley;
      if (found_[is_end ? next : tip] == Found::yes) continue;
      if (is_end && skeleton_.points[next].kind != ValleyPoint::Kind::valley) continue;
      stays_[tip] = false;
      if (--degree[next] == 1) tips.push_back(next);
    }
  }

  /// Moves a point that has no move of its own by the mean of its neighbours' moves.
  void spread() {
    std::vector<Vec2> next = moves_;
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      if (found_[i] != Found::no || !stays_[i]) continue;
      Vec2 sum;
      double count = 0;
      for (const std::uint32_t k : around_[i])
        if (stays_[k]) sum = sum + moves_[k], ++count;
      if (count > 0) next[i] = (1 / count) * sum;
      // No further than valleys are searched for.
      const double size = norm(next[i]), furthest = widest_move * skeleton_.points[i].radius;
      if (size > furthest) next[i] = (furthest / size) * next[i];
    }
    moves_ = std::move(next);
  }

  /// Computes radii and tangents of the points at their new places.
  void measure() {
    const Neighbors around = neighbors_of(skeleton_);
    Evaluator evaluator(charges_);
    for (std::size_t i = 0; i < around.size(); ++i) {
      ValleyPoint& point = skeleton_.points[i];
      if (point.kind == ValleyPoint::Kind::corner) continue;
      point.radius = evaluator.place(point.place).distance;
      if (point.kind != ValleyPoint::Kind::valley || around[i].empty()) continue;
      const Vec2 way = skeleton_.points[around[i].back()].place -
                       (around[i].size() > 1 ? skeleton_.points[around[i][0]].place : point.place);
      if (norm(way) > 0) point.tangent = unit(way);
    }
  }

  Skeleton& skeleton_;
  const Charges& charges_;
  const SuccessorOptions& options_;
  const Neighbors around_;
  std::vector<Vec2> moves_;
  std::vector<Found> found_;
  std::vector<bool> stays_;
};

}  // namespace

std::vector<Skeleton> limits_of(const MedialAxis& exact, std::span<const Region> regions,
                                const LocalFrame& local, double step) {
  return LimitMaker(exact, regions, local, step).make();
}

Skeleton branch_at(const Skeleton& limit, const Charges& charges, Vec2 from, double order,
                   double step) {
  if (limit.links.empty()) return limit;
  const Vec2 foot = foot_of_force(charges, from, order, step);
  std::pair<double, std::uint32_t> nearest{std::numeric_limits<double>::infinity(), 0};
  for (std::uint32_t i = 0; i < limit.links.size(); ++i)
    nearest = std::min(nearest, {link_distance(limit, limit.links[i], foot), i});
  const Neighbors around = neighbors_of(limit);
  std::vector<bool> stays(limit.points.size());
  // Both ways along the branch, while points have two neighbours.
  std::vector<std::uint32_t> queue(limit.links[nearest.second].begin(),
                                   limit.links[nearest.second].end());
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const std::uint32_t here = queue[k];
    if (stays[here]) continue;
    stays[here] = true;
    if (around[here].size() != 2) continue;
    queue.insert(queue.end(), around[here].begin(), around[here].end());
  }
  return kept(limit, stays);
}

Skeleton part_within(const Skeleton& skeleton, const Box& box) {
  std::vector<bool> stays(skeleton.points.size());
  for (const auto& [from, to] : skeleton.links)
    if (contains(box, skeleton.points[from].place) || contains(box, skeleton.points[to].place))
      stays[from] = stays[to] = true;
  return kept(skeleton, stays);
}

Skeleton descended(Skeleton skeleton, const Charges& charges, const SuccessorOptions& options) {
  constexpr double ratio = 4, least = 0.25;
  skeleton = pruned(skeleton, least * options.step);
  SuccessorOptions search = options;
  search.furthest = 0.5 * options.step;  // per order
  for (double order = limit_order; order > options.order; order /= ratio) {
    search.order = order;
    Descent(skeleton, charges, search).run();
  }
  search.order = options.order;
  Descent(skeleton, charges, search).run();
  skeleton.order = options.order;
  return skeleton;
}

}  // namespace medial::potential
