#include "shape/sweep.h"

#include <algorithm>
#include <bit>
#include <boost/intrusive/rbtree.hpp>
#include <boost/sort/spreadsort/integer_sort.hpp>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/compat.h"
#include "base/predicates.h"
#include "shape/errors.h"

namespace medial {
namespace {

namespace intrusive = boost::intrusive;

/// A piece of an edge that meets the sweep line. left < right lexicographically. Of a split edge,
/// only the part from the last split on is here: it lies on the same line, so that decisions stay
/// exact.
struct ActiveEdge : intrusive::set_base_hook<intrusive::link_mode<intrusive::normal_link>,
                                             intrusive::optimize_size<true>> {
  Vec2 left;
  Vec2 right;
  std::uint32_t edge = 0;
  std::uint32_t piece = 0;
};
static_assert(sizeof(void*) != 8 || sizeof(ActiveEdge) == 64, "one cache line");

/// +1 if p lies above the edge, -1 below, 0 on it. Requires that p is in its range.
int side(const ActiveEdge& edge, Vec2 p) { return orientation(edge.left, edge.right, p); }

/// Whether the insides of two edges cross in one point.
bool cross_inside(const ActiveEdge& a, const ActiveEdge& b) {
  return side(a, b.left) * side(a, b.right) < 0 && side(b, a.left) * side(b, a.right) < 0;
}

/// The common point of two edges that cross, to the precision of a double.
Vec2 crossing_point(const ActiveEdge& a, const ActiveEdge& b) {
  // The longer type keeps large coordinates from overflowing.
  using Real = long double;
  const Real ax = Real{a.right.x} - a.left.x;
  const Real ay = Real{a.right.y} - a.left.y;
  const Real bx = Real{b.right.x} - b.left.x;
  const Real by = Real{b.right.y} - b.left.y;
  const Real cx = Real{b.left.x} - a.left.x;
  const Real cy = Real{b.left.y} - a.left.y;
  const Real area = ax * by - ay * bx;
  const Real t = area == 0 ? Real{0.5} : std::clamp((cx * by - cy * bx) / area, Real{0}, Real{1});
  return {static_cast<double>(a.left.x + t * ax), static_cast<double>(a.left.y + t * ay)};
}

/// An integer that grows with the number. Requires a finite number that is not -0.
std::uint64_t sort_key(double x) {
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  const auto bits = bit_cast<std::uint64_t>(x);
  return bits & sign ? ~bits : bits | sign;
}

}  // namespace

std::vector<std::uint32_t> order_of_events(const std::vector<Vec2>& points) {
  struct Event {
    double x;
    std::uint32_t vertex;
  };

  std::vector<Event> events(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    events[v] = {points[v].x, static_cast<std::uint32_t>(v)};
  }
  const auto bits = [](const Event& event, unsigned offset) { return sort_key(event.x) >> offset; };
  const auto less = [](const Event& a, const Event& b) { return a.x < b.x; };
  boost::sort::spreadsort::integer_sort(events.begin(), events.end(), bits, less);
  for (auto first = events.begin(); first != events.end();) {
    auto last = first + 1;
    while (last != events.end() && last->x == first->x) ++last;
    if (last - first > 1) {
      std::sort(first, last, [&](const Event& a, const Event& b) {
        const double ya = points[a.vertex].y;
        const double yb = points[b.vertex].y;
        return ya < yb || (ya == yb && a.vertex < b.vertex);
      });
    }
    first = last;
  }
  std::vector<std::uint32_t> order(events.size());
  std::transform(events.begin(), events.end(), order.begin(),
                 [](const Event& event) { return event.vertex; });
  return order;
}

namespace {

/// The edges on the sweep line from bottom to top, and what happens to them at each event.
///
/// Only vertices are compared with edges. This finds every crossing: two edges that cross are
/// neighbours before; no vertex can come to lie above the one and below the other behind their
/// crossing, so they stay neighbours until one of them ends, on the wrong side of the other.
class Sweeper {
 public:
  explicit Sweeper(const CleanRings& cleaned) : cleaned_(cleaned) {}

  Result<Sweep> run() {
    const std::vector<Vec2>& points = cleaned_.points;
    active_.resize(points.size());
    found_.interior_above.resize(points.size());
    const std::vector<std::uint32_t> order = order_of_events(points);
    for (std::size_t i = 0; i < order.size();) {
      const Vec2 point = points[order[i]];
      std::size_t j = i + 1;
      while (j < order.size() && points[order[j]] == point) ++j;
      if (j - i > 1 || !pass_through(order[i], point)) {
        if (auto error = meet(std::span(order).subspan(i, j - i), point)) return *error;
      }
      i = j;
    }
    return std::move(found_);
  }

 private:
  using Status = intrusive::rbtree<ActiveEdge, intrusive::constant_time_size<false>>;

  /// An edge that begins at the current event.
  struct Start {
    std::uint32_t edge;
    std::uint32_t piece;
    Vec2 right;
  };

  /// The common case: one edge ends where another begins, and nothing else is there. Replaces the
  /// one by the other; false, and nothing done, if the case is another.
  bool pass_through(std::uint32_t vertex, Vec2 point) {
    const std::uint32_t previous = cleaned_.previous(vertex), next = cleaned_.next(vertex);
    if (previous == no_index || next == no_index) return false;
    const Vec2 a = cleaned_.points[previous];
    const Vec2 b = cleaned_.points[next];
    const bool forward = lexicographic_less(a, point);
    if (forward == lexicographic_less(b, point)) return false;

    ActiveEdge& active = *active_[forward ? previous : vertex];
    const auto here = status_.iterator_to(active);
    if (here != status_.begin() && side(*std::prev(here), point) <= 0) return false;
    if (const auto above = std::next(here); above != status_.end() && side(*above, point) >= 0) {
      return false;
    }
    begin_edge(active, forward ? Start{vertex, vertex, b} : Start{previous, previous, a}, point,
               found_.interior_above[active.piece]);
    return true;
  }

  /// The general case: any number of edges end in, pass through and begin at the point.
  std::optional<Error> meet(std::span<const std::uint32_t> group, Vec2 point) {
    starts_.clear();
    std::size_t ends = 0;
    ActiveEdge* any_end = nullptr;
    const auto visit = [&](std::uint32_t edge, Vec2 other) {
      if (lexicographic_less(other, point)) {
        ++ends;
        any_end = active_[edge];
      } else {
        starts_.push_back({edge, edge, other});
      }
    };
    for (const std::uint32_t vertex : group) {
      const std::uint32_t previous = cleaned_.previous(vertex), next = cleaned_.next(vertex);
      if (previous != no_index) visit(previous, cleaned_.points[previous]);
      if (next != no_index) visit(vertex, cleaned_.points[next]);
    }

    // The edges that end in or pass through the point are neighbours, if none has crossed another.
    const auto meets = [&](const ActiveEdge& edge) {
      return edge.right == point || side(edge, point) == 0;
    };
    auto first = any_end ? status_.iterator_to(*any_end)
                         : status_.lower_bound(point, [](const ActiveEdge& edge, Vec2 p) {
                             return side(edge, p) > 0;
                           });
    while (first != status_.begin() && meets(*std::prev(first))) --first;
    block_.clear();
    passing_.clear();
    auto above = first;
    for (; above != status_.end() && meets(*above); ++above) {
      block_.push_back(&*above);
      if (above->right != point) passing_.push_back(&*above);
    }
    const ActiveEdge* below = first == status_.begin() ? nullptr : &*std::prev(first);
    if (block_.size() - passing_.size() != ends || (below && side(*below, point) <= 0) ||
        (above != status_.end() && side(*above, point) >= 0)) {
      return crossing_on_the_line();
    }
    if (passing_.size() > 1) return crossing(*passing_[0], *passing_[1], point);

    if (block_.empty()) {
      for (const std::uint32_t vertex : group) {
        found_.left_ends.push_back({vertex, below ? below->piece : no_index});
      }
    }
    if (group.size() > 1 || !passing_.empty()) note_touch(group);
    return replace_block(above, below && found_.interior_above[below->piece], point);
  }

  /// Notes a place where vertices meet each other or an edge, which is split there.
  void note_touch(std::span<const std::uint32_t> group) {
    for (const std::uint32_t vertex : group) found_.touches.push_back({found_.place_count, vertex});
    for (const ActiveEdge* edge : passing_) {
      const auto piece = static_cast<std::uint32_t>(found_.interior_above.size());
      found_.interior_above.push_back(false);
      found_.splits.push_back({edge->edge, group[0], found_.place_count});
      starts_.push_back({edge->edge, piece, edge->right});
    }
    ++found_.place_count;
  }

  /// Puts starts_ into the place of block_, which lies below `above`.
  std::optional<Error> replace_block(const Status::iterator& above, bool interior, Vec2 point) {
    std::sort(starts_.begin(), starts_.end(), [&](const Start& a, const Start& b) {
      return orientation(point, a.right, b.right) > 0;
    });
    for (std::size_t i = 1; i < starts_.size(); ++i) {
      if (orientation(point, starts_[i - 1].right, starts_[i].right) == 0) {
        return error_of_edges(ErrorCode::overlap, starts_[i - 1].edge, starts_[i].edge, point);
      }
    }
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      interior = !interior;
      ActiveEdge* active = i < block_.size() ? block_[i] : &*status_.insert_before(above, fresh());
      begin_edge(*active, starts_[i], point, interior);
    }
    for (std::size_t i = starts_.size(); i < block_.size(); ++i) {
      status_.erase(status_.iterator_to(*block_[i]));
      unused_.push_back(block_[i]);
    }
    return std::nullopt;
  }

  void begin_edge(ActiveEdge& active, const Start& start, Vec2 left, bool interior_above) {
    active.left = left;
    active.right = start.right;
    active.edge = start.edge;
    active.piece = start.piece;
    active_[start.edge] = &active;
    found_.interior_above[start.piece] = interior_above;
  }

  ActiveEdge& fresh() {
    if (unused_.empty()) return pool_.emplace_back();
    ActiveEdge* edge = unused_.back();
    unused_.pop_back();
    return *edge;
  }

  /// A vertex is on the wrong side of an edge, so two neighbours have crossed: the first such.
  Error crossing_on_the_line() {
    std::optional<Error> leftmost;
    for (auto upper = status_.begin(); upper != status_.end(); ++upper) {
      if (upper == status_.begin()) continue;
      const ActiveEdge& lower = *std::prev(upper);
      if (!cross_inside(lower, *upper)) continue;
      Error error = crossing(lower, *upper, crossing_point(lower, *upper));
      if (!leftmost || lexicographic_less(*error.place.point, *leftmost->place.point)) {
        leftmost = std::move(error);
      }
    }
    if (leftmost) return *leftmost;
    return error_without_place(ErrorCode::internal, "the sweep lost its order");
  }

  Error crossing(const ActiveEdge& a, const ActiveEdge& b, Vec2 point) const {
    return error_of_edges(ErrorCode::crossing, a.edge, b.edge, point);
  }

  /// Names the edge that comes first in the input in the place, the other in the text.
  Error error_of_edges(ErrorCode code, std::uint32_t a, std::uint32_t b, Vec2 point) const {
    return error_at(code, text_of_edges(code, cleaned_.sources[std::max(a, b)]),
                    cleaned_.sources[std::min(a, b)], point);
  }

  const CleanRings& cleaned_;
  Sweep found_;
  std::deque<ActiveEdge> pool_;
  std::vector<ActiveEdge*> unused_;
  std::vector<ActiveEdge*> active_;  ///< of each edge, valid while the edge meets the sweep line
  Status status_;
  // Of the current event; members so that their memory is kept.
  std::vector<Start> starts_;
  std::vector<ActiveEdge*> block_;
  std::vector<ActiveEdge*> passing_;
};

}  // namespace

Result<Sweep> sweep(const CleanRings& cleaned) { return Sweeper(cleaned).run(); }

}  // namespace medial
