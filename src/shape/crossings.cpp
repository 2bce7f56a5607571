#include "shape/crossings.h"

#include <cmath>
#include <utility>

#include "base/box_tree.h"

namespace medial {

Meetings meetings(const MonotoneArc& a, const MonotoneArc& b) {
  Meetings result;
  if (a.half_curvature == 0 && b.half_curvature == 0) {
    const double begin = b.above_circle(a.left);
    const double end = b.above_circle(a.right);
    const double t = begin / (begin - end);
    if (t > 0 && t < 1) result.points[result.size++] = a.left + t * (a.right - a.left);
    return result;
  }
  // Relative to an end of the smaller circle, whose equation is up.q - K / 2 q^2 = 0. The other
  // one's less the multiple of it that has the same square is the radical line, normal.q + rest.
  const bool a_smaller = std::abs(a.half_curvature) >= std::abs(b.half_curvature);
  const MonotoneArc& small = a_smaller ? a : b;
  const MonotoneArc& large = a_smaller ? b : a;
  const Vec2 offset = small.left - large.left;
  const double ratio = large.half_curvature / small.half_curvature;
  const Vec2 normal = large.up - 2 * large.half_curvature * offset - ratio * small.up;
  const double rest = large.above_circle(small.left);
  const double length = norm(normal);
  if (!(length > 0)) return result;  // concentric, or the same
  const Vec2 unit = (1 / length) * normal;
  const Vec2 along = left_of(unit);
  const double distance_to_line = -rest / length;
  const double radius = 1 / (2 * small.half_curvature);  // with the sign of the turn
  // (t - radius up.along)^2 = radius^2 - (distance_to_line - radius up.unit)^2
  const double middle = radius * dot(small.up, along);
  const double product = distance_to_line * (distance_to_line - 2 * radius * dot(small.up, unit));
  const Vec2 foot = small.left + distance_to_line * unit;
  const double square = middle * middle - product;
  if (square <= 0) {
    result.points[result.size++] = foot + middle * along;
    return result;
  }
  const double far = middle + std::copysign(std::sqrt(square), middle);
  result.points[result.size++] = foot + far * along;
  result.points[result.size++] = foot + (far == 0 ? 0 : product / far) * along;
  return result;
}

std::optional<Vec2> on_arc(const MonotoneArc& arc, Vec2 p) {
  constexpr double small = 1e-6, rounding = 0x1p-50;
  const double offset = arc.above_circle(p), length = distance(arc.left, arc.right);
  if (!(std::abs(offset) <= small * length + rounding)) return std::nullopt;
  const Vec2 gradient = arc.up - 2 * arc.half_curvature * (p - arc.left);
  const Vec2 result = p - (offset / squared_norm(gradient)) * gradient;
  const double above_chord = cross(arc.right - arc.left, result - arc.left);
  if (arc.bulge * above_chord > 0 && std::abs(above_chord) > rounding * length) return std::nullopt;
  return result;
}

namespace {

class CrossingFinder {
 public:
  CrossingFinder(const Noding& noding, const NodedRings& noded)
      : noded_(noded), tolerance_(noding.tolerance()) {
    const CleanRings& cleaned = noded.cleaned;
    pieces_.reserve(cleaned.points.size());
    for (std::uint32_t v = 0; v < cleaned.points.size(); ++v) {
      const std::uint32_t w = cleaned.next(v);
      if (w == no_index) continue;
      const Vec2 p = cleaned.points[v], q = cleaned.points[w];
      const bool forward = lexicographic_less(p, q);
      const MonotoneArc arc =
          forward ? monotone_arc(p, q, cleaned.bulges[v]) : monotone_arc(q, p, -cleaned.bulges[v]);
      pieces_.push_back({arc,
                         arc.low() - tolerance_,
                         arc.high() + tolerance_,
                         noded.edges[v],
                         {forward ? v : w, forward ? w : v}});
    }
  }

  Crossings find() {
    std::vector<Box> boxes;
    boxes.reserve(pieces_.size());
    for (const Piece& piece : pieces_)
      boxes.push_back(
          {{piece.arc.left.x - tolerance_, piece.low}, {piece.arc.right.x, piece.high}});
    BoxTree(boxes).find_pairs([this](std::uint32_t i, std::uint32_t j) {
      const Piece &a = pieces_[i], &b = pieces_[j];
      if (a.edge == b.edge) return;
      // What is found does not depend on where rings begin.
      if (lexicographic_less(b.arc.left, a.arc.left)) {
        meet(b, a);
      } else {
        meet(a, b);
      }
    });
    return std::move(found_);
  }

 private:
  struct Piece {
    MonotoneArc arc;
    double low, high;
    std::uint32_t edge;
    std::array<std::uint32_t, 2> ends;
  };

  /// The end of a piece that a point is at; no_index in its inside.
  std::uint32_t end_at(const Piece& piece, Vec2 p) const {
    for (const std::uint32_t end : piece.ends)
      if (distance(noded_.cleaned.points[end], p) <= 2 * tolerance_) return end;
    return no_index;
  }

  void meet(const Piece& a, const Piece& b) {
    const Meetings places = meetings(a.arc, b.arc);
    for (std::size_t i = 0; i < places.size; ++i) {
      const auto point = on_arc(a.arc, places.points[i]);
      if (!point || !a.arc.is_near(*point, tolerance_) || !b.arc.is_near(*point, tolerance_))
        continue;
      const std::uint32_t end_of_a = end_at(a, *point), end_of_b = end_at(b, *point);
      if (end_of_a != no_index && end_of_b != no_index) continue;
      if (is_beside_common_end(a, b, *point)) continue;
      if (end_of_a != no_index) {
        add_end(a, end_of_a, b);
      } else if (end_of_b != no_index) {
        add_end(b, end_of_b, a);
      } else {
        found_.contacts.push_back({a.edge, no_index, *point});
        found_.contacts.push_back({b.edge, no_index, *point});
        ++found_.count;
      }
    }
  }

  /// Whether two pieces have an end in common and stay within the tolerance of each other from
  /// there to the point: nearly tangent there, they meet only in the end. (The order of pieces
  /// at an end follows from where they part, too.)
  bool is_beside_common_end(const Piece& a, const Piece& b, Vec2 point) const {
    for (const std::uint32_t end : a.ends) {
      const Vec2 p = noded_.cleaned.points[end];
      if (end_at(b, p) == no_index || p == point) continue;
      const bool left = lexicographic_less(p, point);
      const Vec2 between = a.arc.halfway(left ? p : point, left ? point : p);
      if (std::abs(b.arc.above(between)) <= tolerance_) return true;
    }
    return false;
  }

  /// One piece ends in the inside of the other.
  void add_end(const Piece& ending, std::uint32_t end, const Piece& other) {
    if (noded_.passing[end]) found_.contacts.push_back({ending.edge, end, {}});
    found_.contacts.push_back({other.edge, end, {}});
  }

  const NodedRings& noded_;
  double tolerance_;
  std::vector<Piece> pieces_;
  Crossings found_;
};

}  // namespace

Crossings crossings_of(const Noding& noding, const NodedRings& noded) {
  return CrossingFinder(noding, noded).find();
}

}  // namespace medial
