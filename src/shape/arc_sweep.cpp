#include "shape/arc_sweep.h"

#include <algorithm>
#include <array>
#include <boost/intrusive/rbtree.hpp>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "shape/crossings.h"
#include "shape/errors.h"

namespace medial {
namespace {

namespace intrusive = boost::intrusive;

/// A piece that meets the sweep line.
struct ActivePiece : intrusive::set_base_hook<intrusive::link_mode<intrusive::normal_link>,
                                              intrusive::optimize_size<true>> {
  MonotoneArc arc;
  double low = 0;
  double high = 0;
  std::uint32_t left_vertex = 0;
  std::uint32_t right_vertex = 0;
  std::uint32_t piece = 0;
};

/// One sweep over the plane (Shamos and Hoey), which compares pieces that become neighbours.
/// Continues after contacts as if the pieces kept their order there, as long as an order exists.
class ArcSweeper {
 public:
  ArcSweeper(const Noding& noding, const NodedRings& noded)
      : noding_(noding), noded_(noded), cleaned_(noded.cleaned), tolerance_(noding.tolerance()) {}

  std::optional<Error> run() {
    const std::vector<Vec2>& points = cleaned_.points;
    active_.resize(points.size());
    found_.interior_above.resize(points.size());
    const std::vector<std::uint32_t> order = order_of_events(points);
    merge_near_vertices(order);
    for (std::size_t i = 0; i < order.size();) {
      const Vec2 point = points[order[i]];
      std::size_t j = i + 1;
      while (j < order.size() && points[order[j]] == point) ++j;
      if (auto error = meet(std::span(order).subspan(i, j - i), point)) return error;
      i = j;
    }
    return std::nullopt;
  }

  Sweep& found() { return found_; }
  std::vector<TouchedPoint>& contacts() { return contacts_; }
  std::vector<Merge>& merges() { return merges_; }

 private:
  using Status = intrusive::rbtree<ActivePiece, intrusive::constant_time_size<false>>;

  /// A piece that begins at the current event.
  struct Start {
    std::uint32_t piece;
    std::uint32_t left_vertex;
    std::uint32_t right_vertex;
    MonotoneArc arc;
  };

  /// Finds vertices that are equal within the tolerance, even if their pieces are never neighbours.
  void merge_near_vertices(const std::vector<std::uint32_t>& order) {
    // A longer search could be slow if many vertices lie above each other. The sweep finds most of
    // the others.
    constexpr std::size_t farthest = 8;
    const std::vector<Vec2>& points = cleaned_.points;
    for (std::size_t i = 0; i + 1 < order.size(); ++i) {
      const Vec2 p = points[order[i]];
      const std::size_t end = std::min(order.size(), i + 1 + farthest);
      for (std::size_t j = i + 1; j < end && points[order[j]].x - p.x <= tolerance_; ++j) {
        if (is_to_join(order[i], order[j])) join(order[i], order[j]);
      }
    }
  }

  /// Whether two vertices are equal within the tolerance but have different coordinates. Their
  /// input coordinates can differ even if the local ones are equal; an edge between them would have
  /// no direction.
  bool is_to_join(std::uint32_t v, std::uint32_t w) const {
    const Vec2 p = cleaned_.points[v];
    const Vec2 q = cleaned_.points[w];
    if (p != q) return distance(p, q) <= tolerance_;
    return !noded_.passing[v] && !noded_.passing[w] && noded_.originals[v] != noded_.originals[w];
  }

  /// Records that two vertices with different coordinates are to be merged.
  void join(std::uint32_t v, std::uint32_t w) {
    if (noded_.passing[v]) contacts_.push_back({noded_.edges[v], w, {}});
    if (noded_.passing[w]) contacts_.push_back({noded_.edges[w], v, {}});
    if (noded_.passing[v] && noded_.passing[w]) {
      // Both edges get the same vertex.
      contacts_.back() = {noded_.edges[v], v, {}};
      contacts_[contacts_.size() - 2] = {noded_.edges[w], v, {}};
    } else if (!noded_.passing[v] && !noded_.passing[w]) {
      merges_.push_back({v, w});
    }
  }

  /// The pieces that end at an event: any one of them (null: none) and their number.
  struct Ends {
    ActivePiece* any = nullptr;
    std::size_t count = 0;
  };

  /// Finds the pieces that end in a group of vertices, and those that begin: `starts_`.
  Ends pieces_at(std::span<const std::uint32_t> group, Vec2 point) {
    Ends ends;
    starts_.clear();
    const auto visit = [&](std::uint32_t piece, std::uint32_t here, std::uint32_t other) {
      if (lexicographic_less(cleaned_.points[other], point)) {
        ends = {active_[piece], ends.count + 1};
        return;
      }
      const double bulge = cleaned_.bulges[piece];
      starts_.push_back(
          {piece, here, other,
           monotone_arc(point, cleaned_.points[other], here == piece ? bulge : -bulge)});
    };
    for (const std::uint32_t vertex : group) {
      const std::uint32_t previous = cleaned_.previous(vertex), next = cleaned_.next(vertex);
      if (previous != no_index) visit(previous, vertex, previous);
      if (next != no_index) visit(vertex, vertex, next);
    }
    return ends;
  }

  std::optional<Error> meet(std::span<const std::uint32_t> group, Vec2 point) {
    const Ends ends = pieces_at(group, point);
    // The pieces that end here are neighbours, if none has crossed another.
    auto first = ends.any ? status_.iterator_to(*ends.any)
                          : status_.lower_bound(point, [](const ActivePiece& piece, Vec2 p) {
                              return piece.arc.above(p) > 0;
                            });
    while (first != status_.begin() && std::prev(first)->arc.right == point) --first;
    block_.clear();
    auto above = first;
    for (; above != status_.end() && above->arc.right == point; ++above) block_.push_back(&*above);
    ActivePiece* below = first == status_.begin() ? nullptr : &*std::prev(first);
    if (block_.size() != ends.count) return out_of_order(first, ends.count, group.front());

    if (block_.empty()) {
      for (const std::uint32_t vertex : group) {
        found_.left_ends.push_back({vertex, below ? below->piece : no_index});
      }
    }
    if (group.size() > 1) {
      for (const std::uint32_t vertex : group) {
        found_.touches.push_back({found_.place_count, vertex});
      }
      ++found_.place_count;
    }

    if (starts_.size() > 1) {
      std::stable_sort(starts_.begin(), starts_.end(),
                       [](const Start& a, const Start& b) { return is_below(a.arc, b.arc); });
    }
    bool interior = below && found_.interior_above[below->piece];
    ActivePiece* lower = below;
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      interior = !interior;
      ActivePiece* active = i < block_.size() ? block_[i] : &*status_.insert_before(above, fresh());
      begin_piece(*active, starts_[i], interior);
      if (lower) {
        if (auto error = compare(*lower, *active)) return error;
      }
      lower = active;
    }
    for (std::size_t i = starts_.size(); i < block_.size(); ++i) {
      status_.erase(status_.iterator_to(*block_[i]));
      unused_.push_back(block_[i]);
    }
    if (starts_.empty() && block_.empty()) {
      // Lone points have no piece that would be compared with its neighbours.
      for (const std::uint32_t vertex : group) {
        if (lower) touch(*lower, vertex);
        if (above != status_.end()) touch(*above, vertex);
      }
    }
    if (lower && above != status_.end()) return compare(*lower, *above);
    return std::nullopt;
  }

  void begin_piece(ActivePiece& active, const Start& start, bool interior_above) {
    active.arc = start.arc;
    active.low = start.arc.low();
    active.high = start.arc.high();
    active.left_vertex = start.left_vertex;
    active.right_vertex = start.right_vertex;
    active.piece = start.piece;
    active_[start.piece] = &active;
    found_.interior_above[start.piece] = interior_above;
  }

  ActivePiece& fresh() {
    if (unused_.empty()) return pool_.emplace_back();
    ActivePiece* piece = unused_.back();
    unused_.pop_back();
    return *piece;
  }

  /// The error if other pieces lie between those that end here. If contacts are not noded yet, this
  /// is no error.
  std::optional<Error> out_of_order(const Status::iterator& first, std::size_t ends,
                                    std::uint32_t vertex) {
    const Vec2 point = cleaned_.points[vertex];
    if (!contacts_.empty() || !merges_.empty()) return pending();
    const ActivePiece& end = *first;
    for (auto other = first; ends > 0 && other != status_.end(); ++other) {
      if (other->arc.right != point) return crossing(end, *other, point);
    }
    return error_at(
        ErrorCode::unsupported,
        "edges are too near to each other here for their order to be certain beyond rounding",
        noding_.edge_source(noded_.edges[vertex]), noding_.to_input(point));
  }

  struct Stop {
    Vec2 point;  ///< on the first piece
    double along;
  };
  /// The circles' meetings cut the common range of two pieces, from `begin` to `end`, into
  /// intervals. In each of them the gap has one sign, that at its middle; the first and the last
  /// may be widest at the range's end. Returns how many stops.
  static std::size_t stops_between(const MonotoneArc& a, const MonotoneArc& b, Vec2 begin, Vec2 end,
                                   std::array<Stop, 4>& stops) {
    std::size_t count = 0;
    const Vec2 chord = a.right - a.left;
    const auto add = [&](Vec2 p) { stops[count++] = {p, dot(chord, p - a.left)}; };
    add(begin == a.left ? begin : Vec2{begin.x, a.y_at(begin.x)});
    const Vec2 last = end == a.right ? end : Vec2{end.x, a.y_at(end.x)};
    const double last_along = dot(chord, last - a.left);
    const Meetings found = meetings(a, b);
    for (std::size_t i = 0; i < found.size; ++i) {
      // The intersections of circles that are equal up to rounding are meaningless.
      const std::optional<Vec2> p = on_arc(a, found.points[i]);
      if (!p) continue;
      const double along = dot(chord, *p - a.left);
      if (along > stops[0].along && along < last_along) add(*p);
    }
    if (count == 3 && stops[2].along < stops[1].along) std::swap(stops[1], stops[2]);
    add(last);
    return count;
  }

  /// Records where two neighbours touch to the right of their common left end. Error if they cross
  /// or overlap.
  std::optional<Error> compare(const ActivePiece& lower, const ActivePiece& upper) {
    if (lower.high + tolerance_ < upper.low) return std::nullopt;
    bool touches = touch(lower, upper.left_vertex);
    touches = touch(lower, upper.right_vertex) || touches;
    touches = touch(upper, lower.left_vertex) || touches;
    touches = touch(upper, lower.right_vertex) || touches;
    if (touches) return std::nullopt;  // noded first, then compared

    // Places on the longer one, which may be above or below: upside down it is the same.
    const auto length = [](const MonotoneArc& arc) {
      return std::pair(squared_norm(arc.right - arc.left), std::abs(arc.bulge));
    };
    const bool by_upper = length(upper.arc) > length(lower.arc);
    const MonotoneArc& a = by_upper ? upper.arc : lower.arc;
    const MonotoneArc& b = by_upper ? lower.arc : upper.arc;
    const Vec2 begin = lexicographic_less(a.left, b.left) ? b.left : a.left;
    const Vec2 end = lexicographic_less(a.right, b.right) ? a.right : b.right;
    if (!lexicographic_less(begin, end)) return std::nullopt;

    std::array<Stop, 4> stops;
    const std::size_t count = stops_between(a, b, begin, end, stops);
    const Vec2 last = stops[count - 1].point;

    const auto gap = [&](Vec2 on_a) { return by_upper ? b.above(on_a) : -b.above(on_a); };
    const double at_begin = a.left == b.left ? 0 : gap(stops[0].point);
    const double at_end = a.right == b.right ? 0 : gap(last);
    std::array<int, 3> signs{};
    bool any_positive = false;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      double value = gap(a.halfway(stops[i].point, stops[i + 1].point));
      if (i == 0 && std::abs(at_begin) > std::abs(value)) value = at_begin;
      if (i + 2 == count && std::abs(at_end) > std::abs(value)) value = at_end;
      signs[i] = value > tolerance_ ? 1 : value < -tolerance_ ? -1 : 0;
      if (signs[i] < 0) {
        return pending_or(crossing(lower, upper, stops[i].point));
      }
      any_positive = any_positive || signs[i] > 0;
    }
    if (!any_positive) {
      const bool together = std::abs(at_begin) <= tolerance_ && std::abs(at_end) <= tolerance_;
      if (together && distance(stops[0].point, last) > 4 * tolerance_) {
        if (cleaned_.open && note_overlap(lower, upper)) return std::nullopt;
        if (part_from_common_end(lower.piece, cleaned_.next(lower.piece), upper))
          return std::nullopt;
        return pending_or(error_of_pieces(ErrorCode::overlap, lower, upper, begin));
      }
      return std::nullopt;
    }
    note_tangency(lower, upper, a, std::span(stops.data(), count), signs, gap);
    return std::nullopt;
  }

  /// Records that the edges of two coincident pieces pass through each other's ends, unless these
  /// are equal. The ends that touch() tests are as near up to rounding.
  bool note_overlap(const ActivePiece& lower, const ActivePiece& upper) {
    const auto first_of = [&](std::uint32_t v) {
      while (noded_.passing[v]) --v;
      return v;
    };
    const auto pass_through = [&](std::uint32_t first, std::uint32_t end) {
      const Vec2 p = cleaned_.points[end];
      for (std::uint32_t v = first; v == first || noded_.passing[v]; ++v) {
        Vec2 from = cleaned_.points[v], to = cleaned_.points[v + 1];
        double bulge = cleaned_.bulges[v];
        if (p == from || p == to) return false;
        if (lexicographic_less(to, from)) std::swap(from, to), bulge = -bulge;
        if (!monotone_arc(from, to, bulge).is_near(p, 4 * tolerance_)) continue;
        contacts_.push_back({noded_.edges[v], end, {}});
        return true;
      }
      return false;
    };
    const std::array<std::uint32_t, 2> firsts{first_of(lower.piece), first_of(upper.piece)};
    bool any = false;
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
      std::uint32_t last = firsts[i] + 1;
      while (noded_.passing[last]) ++last;
      for (const std::uint32_t end : {firsts[i], last}) any |= pass_through(firsts[1 - i], end);
    }
    return any;
  }

  /// Records a contact in the interiors of both pieces. The stops are `on` one of them.
  template <class Stops, class Gap>
  void note_tangency(const ActivePiece& lower, const ActivePiece& upper, const MonotoneArc& on,
                     const Stops& stops, const std::array<int, 3>& signs, const Gap& gap) {
    for (std::size_t i = 1; i + 1 < stops.size(); ++i) {
      if (!(std::abs(gap(stops[i].point)) <= tolerance_)) continue;
      std::size_t j = i;
      while (j + 2 < stops.size() && signs[j] == 0) ++j;
      const bool reaches_begin = i == 1 && signs[0] == 0 && lower.arc.left == upper.arc.left;
      const bool reaches_end =
          j + 2 == stops.size() && signs[j] == 0 && lower.arc.right == upper.arc.right;
      if (!reaches_begin && !reaches_end) {
        const Vec2 point = on.halfway(stops[i].point, stops[j].point);
        const Vec2 contact = i == j ? stops[i].point : point;
        for (const ActivePiece* piece : {&lower, &upper}) {
          contacts_.push_back({noded_.edges[piece->piece], no_index, contact});
        }
      }
      i = j;
    }
  }

  /// Whether a piece's edge ends at this point.
  bool has_end(std::uint32_t piece, Vec2 p) const {
    std::uint32_t first = piece, last = cleaned_.next(piece);
    while (noded_.passing[first]) first = cleaned_.previous(first);
    while (noded_.passing[last]) last = cleaned_.next(last);
    return p == cleaned_.points[first] || p == cleaned_.points[last];
  }

  /// Whether an edge coincides with another one from one of its vertices to a common end.
  bool leads_to_common_end(std::uint32_t v, bool forward, const ActivePiece& other) const {
    const auto is_near = [&](Vec2 p) { return std::abs(other.arc.above_circle(p)) <= tolerance_; };
    while (noded_.passing[v]) {
      const std::uint32_t w = forward ? cleaned_.next(v) : cleaned_.previous(v);
      const std::uint32_t piece = forward ? v : w;
      const Vec2 from = cleaned_.points[v], to = cleaned_.points[w];
      const BulgeArc arc{from, to, forward ? cleaned_.bulges[piece] : -cleaned_.bulges[piece]};
      if (!is_near(apex(arc)) || (noded_.passing[w] && !is_near(to))) return false;
      v = w;
    }
    return has_end(other.piece, cleaned_.points[v]);
  }

  /// For two edges that coincide between two vertices of the first one, or at one vertex: whether
  /// they coincide from a common end and separate on the other side. Then they touch only at that
  /// end.
  bool part_from_common_end(std::uint32_t first, std::uint32_t last,
                            const ActivePiece& other) const {
    return leads_to_common_end(first, false, other) != leads_to_common_end(last, true, other);
  }

  /// Records that a vertex lies on a piece, if it does and is not one of its ends.
  bool touch(const ActivePiece& piece, std::uint32_t vertex) {
    const MonotoneArc& arc = piece.arc;
    const Vec2 p = cleaned_.points[vertex];
    if (!(std::abs(arc.above_circle(p)) <= 2 * tolerance_)) return false;
    if (p == arc.left || p == arc.right) return false;
    if (noded_.passing[vertex] && noded_.edges[vertex] != noded_.edges[piece.piece] &&
        part_from_common_end(vertex, vertex, piece))
      return false;
    for (const std::uint32_t end : {piece.left_vertex, piece.right_vertex}) {
      if (distance(p, cleaned_.points[end]) <= tolerance_) {
        join(vertex, end);
        return true;
      }
    }
    if (!arc.is_near(p, tolerance_)) return false;
    const std::uint32_t edge = noded_.edges[piece.piece];
    if (noded_.passing[vertex]) {
      if (noded_.edges[vertex] == edge) return false;
      contacts_.push_back({noded_.edges[vertex], vertex, {}});
    }
    contacts_.push_back({edge, vertex, {}});
    return true;
  }

  /// Ignores an error that follows a contact, because only the next round, after noding, can
  /// confirm it.
  std::optional<Error> pending_or(Error error) const {
    if (contacts_.empty() && merges_.empty()) return error;
    return pending();
  }
  std::optional<Error> pending() const { return error_without_place(ErrorCode::internal, ""); }

  Error crossing(const ActivePiece& a, const ActivePiece& b, Vec2 point) const {
    return error_of_pieces(ErrorCode::crossing, a, b, point);
  }

  /// Names the edge that comes first in the input in the place, the other in the text.
  Error error_of_pieces(ErrorCode code, const ActivePiece& a, const ActivePiece& b,
                        Vec2 point) const {
    VertexSource first = noding_.edge_source(noded_.edges[a.piece]);
    VertexSource second = noding_.edge_source(noded_.edges[b.piece]);
    if (std::pair(second.ring, second.vertex) < std::pair(first.ring, first.vertex)) {
      std::swap(first, second);
    }
    return error_at(code, text_of_edges(code, second), first, noding_.to_input(point));
  }

  const Noding& noding_;
  const NodedRings& noded_;
  const CleanRings& cleaned_;
  double tolerance_;
  Sweep found_;
  std::vector<TouchedPoint> contacts_;
  std::vector<Merge> merges_;
  std::deque<ActivePiece> pool_;
  std::vector<ActivePiece*> unused_;
  std::vector<ActivePiece*> active_;  ///< of each piece, valid while it meets the sweep line
  Status status_;
  // Of the current event; members so that their memory is kept.
  std::vector<Start> starts_;
  std::vector<ActivePiece*> block_;
};

}  // namespace

Result<SweptArcs> sweep_arcs(const CleanRings& cleaned, bool node_crossings, double reach) {
  // Nearly always, the number of rounds is one more than the depth of contacts that hide each
  // other.
  constexpr int most_rounds = 64;
  Noding noding(cleaned, reach);
  if (auto error = noding.too_small()) return std::move(*error);
  std::uint64_t crossings = 0, repeated = 0;
  for (int round = 0; round < most_rounds; ++round) {
    if (node_crossings && cleaned.open) repeated += noding.drop_repeated();
    NodedRings noded = noding.monotone();
    const auto node_all = [&]() -> Result<bool> {
      const Crossings found = crossings_of(noding, noded);
      crossings += found.count;
      if (found.contacts.empty()) return false;
      if (auto error = noding.apply(noded, found.contacts, {})) return std::move(*error);
      return true;
    };
    // After the first round, the sweep itself detects remaining crossings, which is faster.
    if (node_crossings && round == 0) {
      const Result<bool> any = node_all();
      if (!any) return any.error();
      if (*any) continue;
    }
    ArcSweeper sweeper(noding, noded);
    auto error = sweeper.run();
    if (sweeper.contacts().empty() && sweeper.merges().empty()) {
      if (error && node_crossings && round > 0) {
        const Result<bool> any = node_all();
        if (!any) return any.error();
        if (*any) continue;
      }
      if (error) return std::move(*error);
      Sweep found = std::move(sweeper.found());
      return SweptArcs{std::move(noded), std::move(found),     noding.tolerance_in_input(),
                       round > 0,        noding.split_edges(), crossings,
                       repeated};
    }
    error = noding.apply(noded, sweeper.contacts(), sweeper.merges());
    if (error) return std::move(*error);
  }
  return error_without_place(ErrorCode::overlap, "too many edges lie within the tolerance");
}

}  // namespace medial
