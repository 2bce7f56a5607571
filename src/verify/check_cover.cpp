#include <array>
#include <cmath>
#include <tuple>

#include "verify/arc_feet.h"
#include "verify/checks.h"

namespace medial::verify_detail {
namespace {

/// The part of a boundary edge that the disks of one axis edge touch. A vertex is a part of length
/// 0 at the start of the edge that begins there.
struct Stretch {
  /// Positions along the boundary edge; may be beyond the ends of a straight edge.
  double begin, end;
  std::uint32_t begin_node, end_node;  ///< whose disks touch there
  /// For disks around a vertex, which touch it one after the other: turn_of() the clockwise angle
  /// from the normal of the edge that ends there to the first disk. Parts of edges come after them.
  double turn = std::numeric_limits<double>::infinity();
  double last_turn = turn;  ///< of the last one

  bool is_of_vertex() const { return turn < std::numeric_limits<double>::infinity(); }
};

/// The part of a boundary edge that one disk touches. Next to the centre of an arc, where rounding
/// decides the foot, it is the part of the arc where the foot may be. Of disks that touch, or
/// almost touch, the end of a straight edge, the outermost comes last, because feet on its line may
/// lie beyond the end.
Stretch touched_by(const Problem& problem, const ArcFeet& feet, const Track& on, const Edge& edge,
                   std::size_t side, std::size_t end) {
  const std::uint32_t node = edge.node[end];
  const Vec2 center = problem.disk(node).center;
  if (on.is_straight()) {
    const double foot = on.way_on_line(center);
    return {foot, foot, node, node};
  }
  const double foot = feet.at(edge, side, end);
  const double slack = on.way_slack(center, problem.tolerance, foot);
  return {std::max(0.0, foot - slack), std::min(on.whole_way(), foot + slack), node, node};
}

/// A monotone function of the angle with this sine and cosine (both times one number), in [-1, 3):
/// 1 for a quarter. An angle that rounding makes slightly negative does not become a full turn.
double turn_of(double sine, double cosine) {
  const double size = std::abs(sine) + std::abs(cosine);
  const double beside = size > 0 ? cosine / size : 1;
  if (sine >= 0) return 1 - beside;
  return cosine >= 0 ? beside - 1 : beside + 3;
}

/// The part of a boundary edge, or of the vertex at which it begins, that an edge of the axis
/// touches with the site on one of its sides.
Stretch stretch_of(const Problem& problem, const ArcFeet& feet, std::uint32_t place,
                   const Edge& edge, std::size_t side) {
  const auto [from, to] = edge.node;
  if (problem.axis.sites[edge.site[side]].kind() == SiteKind::vertex) {
    const Vec2 arriving = problem.arriving(place);
    const auto turn = [&](std::uint32_t node) {
      const Vec2 off = problem.disk(node).center - problem.point(place);
      return turn_of(dot(arriving, off), cross(arriving, off));
    };
    const double first = turn(from), last = turn(to);
    return last < first ? Stretch{0, 0, to, from, last, first}
                        : Stretch{0, 0, from, to, first, last};
  }
  const Track on = problem.track(place);
  Stretch all = touched_by(problem, feet, on, edge, side, 0);
  const Stretch other = touched_by(problem, feet, on, edge, side, 1);
  if (other.begin < all.begin) {
    all.begin = other.begin;
    all.begin_node = to;
  }
  if (other.end >= all.end) {
    all.end = other.end;
    all.end_node = to;
  }
  return all;
}

/// The last contact before a gap in the boundary, or the first one after it: at position `at` along
/// boundary edge `edge`. The disk of `node` is one of the disks that touch there.
struct Foot {
  std::uint32_t edge;
  double at;
  std::uint32_t node;
};

/// The edges of the axis that touch each boundary edge, or the vertex at which it begins.
class Touching {
 public:
  Touching(const Problem& problem, const ArcFeet& feet) : problem_(problem), feet_(feet) {
    // Shifted by one: insertion positions, which are the begins when all edges are inserted.
    begin_.assign(problem.shape.points.size() + 2, 0);
    for_each_contact([&](std::uint32_t, std::uint32_t place) { ++begin_[place + 2]; });
    for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    edges_.resize(begin_.back());
    for_each_contact(
        [&](std::uint32_t edge, std::uint32_t place) { edges_[begin_[place + 1]++] = edge; });
  }

  /// The touched parts of one boundary edge, in order along it.
  void stretches(std::uint32_t place, std::vector<Stretch>& found) const {
    found.clear();
    for_each_edge(place, [&](const Edge& edge, std::size_t side) {
      found.push_back(stretch_of(problem_, feet_, place, edge, side));
    });
    if (found.size() < 2) return;
    const auto key = [](const Stretch& a) {
      return std::tuple(std::max(0.0, a.begin), a.turn, a.begin, a.end);
    };
    std::sort(found.begin(), found.end(),
              [&](const Stretch& a, const Stretch& b) { return key(a) < key(b); });
  }

  /// Adds the disks that touch the place of a foot, up to rounding.
  void add_disks(const Foot& foot, std::vector<std::uint32_t>& nodes) const {
    const Track on = problem_.track(foot.edge);
    for_each_edge(foot.edge, [&](const Edge& edge, std::size_t side) {
      for (std::size_t end = 0; end < 2; ++end) {
        const bool vertex = problem_.axis.sites[edge.site[side]].kind() == SiteKind::vertex;
        const Stretch here = vertex ? Stretch{0, 0, edge.node[end], edge.node[end]}
                                    : touched_by(problem_, feet_, on, edge, side, end);
        const double open = here.end - here.begin;
        if (here.begin - open <= foot.at && foot.at <= here.end + open)
          nodes.push_back(edge.node[end]);
      }
    });
  }

 private:
  /// Calls `visit` with each edge of the axis that touches a boundary edge, and with its side
  /// there.
  template <class Visitor>
  void for_each_edge(std::uint32_t place, const Visitor& visit) const {
    for (std::uint32_t k = begin_[place]; k < begin_[place + 1]; ++k) {
      const Edge& edge = problem_.axis.edges[edges_[k]];
      // An edge that touches it with both sites occurs twice.
      const bool again = k > begin_[place] && edges_[k - 1] == edges_[k];
      visit(edge, problem_.place[edge.site[0]] == place && !again ? 0 : 1);
    }
  }
  template <class Visitor>
  void for_each_contact(const Visitor& visit) const {
    for (std::uint32_t i = 0; i < problem_.axis.edges.size(); ++i)
      for (const std::uint32_t site : problem_.axis.edges[i].site)
        if (problem_.place[site] != no_index) visit(i, problem_.place[site]);
  }

  const Problem& problem_;
  const ArcFeet& feet_;
  std::vector<std::uint32_t> begin_;  ///< of each boundary edge, in edges_
  std::vector<std::uint32_t> edges_;
};

/// The distance of p from a disk; negative inside.
double outside(const Disk& disk, Vec2 p) { return distance(disk.center, p) - disk.radius; }

/// The largest distance of the points of an edge between two positions from the union of two disks.
///
/// Let f and g be the distances from the two disks. Along a line or a circle, each is monotone
/// between the point nearest to the disk's centre and the opposite one. Between two such points,
/// min(f, g) is largest at an end, or where f = g if one of them rises and the other falls.
double uncovered(const Disk& a, const Disk& b, const Track& edge, double from, double to) {
  struct Outside {
    double a, b;
    double least() const { return std::min(a, b); }
  };
  const auto outside_at = [&](double way) {
    const Vec2 p = edge.point_at(way);
    const double outside_a = outside(a, p);
    return Outside{outside_a, &a == &b ? outside_a : outside(b, p)};
  };
  if (!(from < to)) return std::max(0.0, outside_at(from).least());
  std::array<double, 6> bound;
  std::size_t bounds = 0;
  bound[bounds++] = from;
  const auto turns_at = [&](double way) {
    if (!(way > from && way < to)) return;
    std::size_t place = bounds++;
    for (; bound[place - 1] > way; --place) bound[place] = bound[place - 1];
    bound[place] = way;
  };
  const auto turns_beside = [&](const Disk& disk) {
    turns_at(edge.way_to_foot(disk.center));
    if (!edge.is_straight()) turns_at(edge.way_to_opposite(disk.center));
  };
  turns_beside(a);
  if (&a != &b) turns_beside(b);
  bound[bounds++] = to;
  double worst = 0;
  Outside before = outside_at(from);
  for (std::size_t i = 1; i < bounds; ++i) {
    const Outside after = outside_at(bound[i]);
    worst = std::max({worst, before.least(), after.least()});
    const bool a_first = before.a <= before.b;
    if (a_first != (after.a <= after.b)) {
      double low = bound[i - 1], high = bound[i];
      for (int halvings = 0; halvings < 60; ++halvings) {
        const double middle = 0.5 * (low + high);
        const Outside here = outside_at(middle);
        ((here.a <= here.b) == a_first ? low : high) = middle;
      }
      worst = std::max(worst, outside_at(low).least());
    }
    before = after;
  }
  return worst;
}

/// The largest distance of the boundary from the disks, beyond the allowance for blunt joints.
struct Uncovered {
  double value = 0;
  Vec2 where;
  double excess = 0;  ///< above the allowance
  double open = 0;    ///< area that blunt joints may leave uncovered

  /// Adds a measurement at a position along an edge.
  void add(double amount, double allowed, const Track& edge, double way) {
    if (std::isnan(amount)) amount = std::numeric_limits<double>::infinity();
    value = std::max(value, amount);
    if (amount - allowed <= excess) return;
    excess = amount - allowed;
    where = edge.point_at(way);
  }
};

/// A gap in the boundary from one foot to another, and its distance from the disks there.
class Gap {
 public:
  Gap(const Problem& problem, const Touching& touching, const Foot& from, const Foot& to)
      : problem_(problem), touching_(touching), from_(from), to_(to) {}

  /// The largest distance of a part of the gap from the disks that touch next to it. Usually, two
  /// of them cover it. If others touch at the same places, rounding decides which two are the
  /// outermost, so any of them may cover it.
  double uncovered(const Track& edge, double from, double to, double most) {
    const auto by = [&](std::uint32_t a, std::uint32_t b) {
      return verify_detail::uncovered(problem_.disk(a), problem_.disk(b), edge, from, to);
    };
    double least = by(from_.node, to_.node);
    if (least <= most) return least;
    if (others_.empty())
      for (const Foot& foot : {from_, to_}) touching_.add_disks(foot, others_);
    for (std::uint32_t& other : others_) {
      least = std::min({least, by(from_.node, other), by(other, to_.node)});
      if (least <= most) {
        std::swap(other, others_.front());  // try it first for the next part
        break;
      }
    }
    return least;
  }

 private:
  const Problem& problem_;
  const Touching& touching_;
  const Foot from_, to_;
  std::vector<std::uint32_t> others_;  ///< nodes whose disks touch at either end
};

/// The largest allowed distance from the disks. A foot may be outside its disk by the tolerance; a
/// gap of width g between the feet of different nodes, which rises by g^2 / (8 r) over their disks,
/// may add as much again.
double cover_limit(const Problem& problem) { return 2 * problem.tolerance; }

/// The allowance for blunt joints between two feet on different edges, or around a loop.
double open_between(const Problem& problem, const Foot& from, const Foot& to) {
  if (problem.blunt_angle.empty()) return 0;
  bool any = false;
  const auto for_each_joint = [&](const auto& visit) {
    std::uint32_t joint = from.edge;
    do {
      joint = problem.next[joint];
      visit(joint);
    } while (joint != to.edge);
  };
  for_each_joint([&](std::uint32_t joint) { any |= problem.is_blunt(joint); });
  if (!any) return 0;  // mostly
  OpenAtJoints open(problem,
                    std::max(problem.disk(from.node).radius, problem.disk(to.node).radius));
  for_each_joint([&](std::uint32_t joint) { open.add(joint); });
  return open.value();
}

/// Measures the boundary from one foot to another against the disks that touch there, with the
/// allowance for blunt joints in between.
void cross_gap(const Problem& problem, const Touching& touching, const Foot& from, const Foot& to,
               bool wrapped, Uncovered& worst) {
  const bool around = from.edge != to.edge || wrapped;
  const double allowed = around ? open_between(problem, from, to) : 0;
  Gap gap(problem, touching, from, to);
  const auto advance = [&](const Track& on, double begin, double end) {
    if (allowed > 0) worst.open += allowed * std::max(0.0, on.length_at(end) - on.length_at(begin));
    worst.add(gap.uncovered(on, begin, end, allowed + cover_limit(problem)), allowed, on,
              0.5 * (begin + end));
  };
  const Track first = problem.track(from.edge);
  if (!around) {
    advance(first, from.at, to.at);
    return;
  }
  // If nothing of the first edge remains, the next one begins at the same point.
  if (from.at < first.whole_way()) advance(first, from.at, first.whole_way());
  for (std::uint32_t edge = problem.next[from.edge]; edge != to.edge; edge = problem.next[edge]) {
    const Track whole = problem.track(edge);
    advance(whole, 0, whole.whole_way());
  }
  advance(problem.track(to.edge), 0, to.at);
}

/// The distance of a disk that touches a reflex vertex from the normal of the edge that ends or
/// begins there, in units of the uncertainty by rounding; 0 if the disk is behind the normal.
/// Rounding moves normals of short edges, and a disk that touches the line of an edge within the
/// tolerance counts as touching the edge. A disk that also touches the edge beyond, across a joint
/// without a leaf, need not pass the normals in between.
double beside_normal(const Problem& problem, std::uint32_t vertex, const Disk& disk, bool leaving) {
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t point = vertex;
  do {
    const Vec2 off = disk.center - problem.point(point);
    const Vec2 tangent = leaving ? problem.leaving(point) : problem.arriving(point);
    const double ahead = leaving ? -dot(tangent, off) : dot(tangent, off);
    if (ahead <= 0) return 0;
    const Vec2 chord = problem.edge(leaving ? point : problem.previous[point]).chord();
    const double open = problem.tolerance * (1 + disk.radius / norm(chord)) +
                        std::sqrt(2 * disk.radius * problem.tolerance);
    // Beyond a quarter turn, the whole distance to the vertex is missing.
    least = std::min(least, (cross(tangent, off) > 0 ? ahead : norm(off)) / open);
    point = leaving ? problem.next[point] : problem.previous[point];
  } while (least > 1 && point != vertex &&
           (problem.joint[point] == Joint::smooth || problem.is_blunt(point)) &&
           std::abs(distance(disk.center, problem.point(point)) - disk.radius) <=
               4 * problem.tolerance);
  return least;
}

/// The length of the axis that is missing around a reflex vertex, in units of the uncertainty by
/// rounding. In a correct axis, disks turn about the vertex from the normal of the edge that ends
/// there to the normal of the edge that begins there, and each edge of the axis begins where the
/// previous one ends. `before`: the last disk that touches the boundary before the vertex, or none.
double missing_around(const Problem& problem, std::uint32_t vertex, const Disk* before,
                      const std::vector<Stretch>& stretches) {
  const double tiny = 4 * problem.tolerance;  // smaller disks may lie anywhere around it
  const Stretch* last = nullptr;
  double missing = 0;
  for (const Stretch& stretch : stretches) {
    if (!stretch.is_of_vertex()) break;
    for (const std::uint32_t node : {stretch.begin_node, stretch.end_node})
      if (problem.disk(node).radius <= tiny) return 0;
    const Disk& disk = problem.disk(stretch.begin_node);
    if (last == nullptr)
      missing = beside_normal(problem, vertex, disk, false);
    else if (stretch.begin_node != last->end_node && stretch.turn > last->last_turn)
      missing = std::max(missing, distance(disk.center, problem.disk(last->end_node).center) /
                                      std::sqrt(2 * disk.radius * problem.tolerance));
    if (last == nullptr || stretch.last_turn >= last->last_turn) last = &stretch;
  }
  if (last != nullptr)
    return std::max(missing, beside_normal(problem, vertex, problem.disk(last->end_node), true));
  // No edge has the vertex as a site, so a single disk must touch it.
  double least = std::numeric_limits<double>::infinity();
  for (const Disk* disk :
       {before, stretches.empty() ? nullptr : &problem.disk(stretches[0].begin_node)})
    if (disk != nullptr && disk->radius > tiny)
      least = std::min(least, std::max(beside_normal(problem, vertex, *disk, false),
                                       beside_normal(problem, vertex, *disk, true)));
  return std::isinf(least) ? 0 : least;
}

/// Walks once around a loop, from one touched part to the next. `lone_node` is a node without edges
/// of each component, or no_index; `stretches` is working memory.
void walk_loop(const Problem& problem, const Touching& touching,
               const std::vector<std::uint32_t>& lone_node, std::size_t loop,
               std::vector<Stretch>& stretches, Uncovered& worst, Worst& turns) {
  constexpr double few = 2;  // a disk and the edge that it almost touches are off by one each
  const std::uint32_t begin = problem.shape.loop_begin[loop],
                      end = problem.shape.loop_begin[loop + 1];
  bool any = false;
  Foot first{}, reach{};
  for (std::uint32_t i = begin; i < end; ++i) {
    touching.stretches(i, stretches);
    if (problem.joint[i] == Joint::reflex)
      turns.add(missing_around(problem, i, any ? &problem.disk(reach.node) : nullptr, stretches),
                few, problem.point(i), i);
    for (const Stretch& stretch : stretches) {
      if (!any) {
        first = {i, stretch.begin, stretch.begin_node};
        any = true;
      } else if (reach.edge != i || stretch.begin > reach.at) {
        cross_gap(problem, touching, reach, {i, stretch.begin, stretch.begin_node}, false, worst);
      } else if (stretch.end < reach.at) {
        continue;
      }
      reach = {i, stretch.end, stretch.end_node};
    }
  }
  if (any) {
    cross_gap(problem, touching, reach, first, true, worst);
    return;
  }
  // No edge touches the loop: it is a circle that one disk fills.
  const std::uint32_t lone = lone_node[problem.component[begin]];
  if (lone == no_index)
    worst.add(diagonal(problem.box), 0, problem.track(begin), 0);
  else
    cross_gap(problem, touching, {begin, 0, lone}, {begin, 0, lone}, true, worst);
}

}  // namespace

double check_coverage(const Problem& problem, const ArcFeet& feet, Certificate& certificate) {
  const Touching touching(problem, feet);
  std::vector<std::uint32_t> lone_node(problem.shape.component_count(), no_index);
  for (std::uint32_t i = 0; i < problem.axis.nodes.size(); ++i)
    if (problem.degree[i] == 0) lone_node[problem.axis.nodes[i].component] = i;
  Uncovered worst;
  Worst turns;
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < problem.shape.loop_count(); ++i)
    walk_loop(problem, touching, lone_node, i, stretches, worst, turns);
  certificate.largest_uncovered = worst.value;
  if (turns.over > 0)
    certificate.failures.push_back(sentence(
        "%llu reflex vertices are touched from some directions only, not from all between the "
        "normals there; the worst is (%.17g, %.17g).",
        static_cast<unsigned long long>(turns.over), turns.where.x, turns.where.y));
  const double limit = cover_limit(problem);
  if (!(worst.excess <= limit))
    certificate.failures.push_back(sentence(
        "A stretch of the boundary is touched by no disk: near (%.17g, %.17g) it lies %.3g "
        "outside the union of the disks, over %.3g.",
        worst.where.x, worst.where.y, worst.excess, limit));
  return worst.open;
}

}  // namespace medial::verify_detail
