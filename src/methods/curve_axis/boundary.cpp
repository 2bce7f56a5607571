#include "methods/curve_axis/boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "base/arc.h"
#include "curve/spirals.h"

namespace medial::curve_axis {
namespace {

using curve::Bezier;
using curve::bezier_of;

/// Twice the area of the polygon of all control points. Its sign is the orientation of a smooth
/// curve that does not cross itself, unless it is so close to 0 that the samples below decide.
double doubled_area(const Contour& contour) {
  constexpr int samples = 8;
  double sum = 0;
  Vec2 before = contour.points[0];
  for (const CurvePiece& piece : contour.pieces) {
    const Bezier curve = bezier_of(contour, piece);
    for (int i = 1; i <= samples; ++i) {
      const Vec2 p = curve::evaluate(curve, static_cast<double>(i) / samples).point;
      sum += cross(before - contour.points[0], p - contour.points[0]);
      before = p;
    }
  }
  return sum;
}

/// The beginning or the end of a piece.
struct End {
  Vec2 point, tangent;
};
End end_of(const Bezier& curve, bool last) {
  const curve::Jet jet = curve::evaluate(curve, last ? 1 : 0);
  return {jet.point, (1 / norm(jet.first)) * jet.first};
}

/// The angle, in radians, below which two pieces join smoothly.
double smooth_turn(const Bezier& before, const Bezier& after) {
  return before.degree == 1 && after.degree == 1 ? 1e-7 : 1e-3;
}

}  // namespace

Contour normalized(const Contour& contour) {
  Box box = Box::nothing();
  for (const Vec2 p : contour.points) box.add(p);
  // Straight pieces this short are rounding errors where a curve should close.
  const double rounding = 1e-9 * diagonal(box);
  Contour out;
  out.role = contour.role;
  out.start_at(contour.points.at(0));
  for (const CurvePiece& piece : contour.pieces) {
    const Vec2 start = contour.points[piece.first];
    const Vec2 end = contour.points[piece.first + piece.degree];
    if (piece.degree == 1 && distance(start, end) <= rounding) continue;
    if (piece.bulge != 0) {
      // Halves are at most a half circle; the control point is where the tangents meet.
      std::vector<BulgeArc> parts{{start, end, piece.bulge}};
      while (std::abs(parts.front().bulge) > 0.5) {
        std::vector<BulgeArc> halves;
        for (const BulgeArc& part : parts) {
          const Vec2 middle = apex(part);
          halves.push_back({part.start, middle, half_bulge(part.bulge)});
          halves.push_back({middle, part.end, half_bulge(part.bulge)});
        }
        parts = std::move(halves);
      }
      for (const BulgeArc& part : parts) {
        const Vec2 half = half_angle(part.bulge);
        const Vec2 control = midpoint(part.start, part.end) -
                             (0.5 * half.y / half.x) * left_of(part.end - part.start);
        out.bezier_to(std::array{control, part.end}, std::array{half.x, 1.0});
      }
      continue;
    }
    const std::span<const Vec2> points(contour.points.data() + piece.first + 1, piece.degree);
    if (contour.weights.empty()) {
      out.bezier_to(points);
    } else {
      // bezier_to() expects weights relative to a first weight of 1.
      std::vector<double> weights(contour.weights.begin() + piece.first + 1,
                                  contour.weights.begin() + piece.first + 1 + piece.degree);
      for (double& weight : weights) weight /= contour.weights[piece.first];
      out.bezier_to(points, weights);
    }
  }
  if (distance(out.points.back(), out.points.front()) > rounding) {
    out.line_to(out.points.front());
  } else if (!out.pieces.empty()) {
    out.points.back() = out.points.front();
  }
  return doubled_area(out) < 0 ? reversed(out) : out;
}

Status find_cusp(const Contour& contour) {
  constexpr double sharpest = 1e-3;  // angle between the tangents of a cusp
  for (const Vec2 p : contour.points)
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      return Error{ErrorCode::not_finite, "a control point is not finite", {}};
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    const CurvePiece& next = contour.pieces[(i + 1) % contour.pieces.size()];
    const End before = end_of(bezier_of(contour, contour.pieces[i]), true);
    const End after = end_of(bezier_of(contour, next), false);
    const double cosine = dot(before.tangent, after.tangent);
    if (cosine > 0 || std::abs(cross(before.tangent, after.tangent)) > sharpest) continue;
    Place place;
    place.vertex = (i + 1) % contour.pieces.size();
    place.point = after.point;
    return Error{ErrorCode::unsupported,
                 "the boundary has a cusp, which the method curve-axis does not follow: use disks, "
                 "or fit a spline",
                 place};
  }
  return success();
}

BoundaryPoint point_of(const Piece& piece, double share, double fan_way) {
  BoundaryPoint out;
  const double part = piece.to - piece.from, at = piece.from + share * part;
  if (piece.kind == Piece::Kind::fan) {
    out.point = piece.point;
    out.tangent = turned(piece.tangent, std::cos(at), std::sin(at));
    out.speed = fan_way * std::abs(part);
    out.along = 0;
    out.turn = -1 / fan_way;
    return out;
  }
  const curve::Jet jet = curve::evaluate(piece.curve, at);
  const double speed = norm(jet.first);
  out.point = jet.point;
  out.tangent = (1 / speed) * jet.first;
  out.speed = speed * part;
  out.turn = cross(jet.first, jet.second) / (speed * speed * speed);
  return out;
}

std::vector<Piece> pieces_of(const Contour& contour) {
  std::vector<Piece> all;
  const std::size_t count = contour.pieces.size();
  for (std::size_t i = 0; i < count; ++i) {
    Piece piece;
    piece.curve = bezier_of(contour, contour.pieces[i]);
    piece.source = i;
    all.push_back(piece);
    const End end = end_of(piece.curve, true);
    const Bezier next = bezier_of(contour, contour.pieces[(i + 1) % count]);
    const double turn = signed_angle(end.tangent, end_of(next, false).tangent);
    if (turn >= -smooth_turn(piece.curve, next)) continue;
    Piece fan;
    fan.kind = Piece::Kind::fan;
    fan.point = end.point;
    fan.tangent = end.tangent;
    fan.to = turn;
    fan.source = (i + 1) % count;
    all.push_back(fan);
  }
  return all;
}

Boundary::Boundary(std::vector<Piece> pieces, std::uint64_t spent)
    : pieces_(std::move(pieces)), evaluations_(spent) {
  find_frame();
  way_ = 0.05 * size();
  find_jumps();
  find_tips();
  // Tips are between the samples.
  for (const Tip& tip : tips_) extend(at(tip.u).point);
}

void Boundary::find_frame() {
  constexpr int samples = 16;
  bool first = true;
  for (const Piece& piece : pieces_)
    for (int i = 0; i < samples && piece.kind == Piece::Kind::curve; ++i) {
      const Vec2 p = point_of(piece, static_cast<double>(i) / samples, 1).point;
      if (first) low_ = high_ = p;
      first = false;
      extend(p);
    }
}

void Boundary::find_jumps() {
  constexpr double largest_jump = 1e-2;  // relative to the curvature, or to 1 / size
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const std::size_t last = (i + pieces_.size() - 1) % pieces_.size();
    const BoundaryPoint before = evaluate(last, 1), after = evaluate(i, 0);
    const bool curves =
        pieces_[i].kind == Piece::Kind::curve && pieces_[last].kind == Piece::Kind::curve;
    corner_.push_back(curves && signed_angle(before.tangent, after.tangent) >
                                    smooth_turn(pieces_[last].curve, pieces_[i].curve));
    const double most = std::max({std::abs(before.turn), std::abs(after.turn), 1 / size()});
    jump_.push_back(before.along != after.along ||
                    std::abs(before.turn - after.turn) > largest_jump * most);
  }
}

void Boundary::extend(Vec2 p) {
  low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
  high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
}

std::size_t Boundary::index_of(double u) const {
  const double n = period();
  const double wrapped = u - n * std::floor(u / n);
  return wrapped >= n ? 0 : static_cast<std::size_t>(wrapped);
}

BoundaryPoint Boundary::evaluate(std::size_t piece, double share) const {
  ++evaluations_;
  if (pieces_[piece].kind != Piece::Kind::gap)
    return curve_axis::point_of(pieces_[piece], share, way_);
  // The boundary within about a step beyond a foot of a bridge shows on which side a branch is.
  const bool first = share < 0.5;
  const std::size_t n = pieces_.size(), other = (piece + (first ? n - 1 : 1)) % n;
  const double end = first ? 1 : 0, way = way_ * (share - (1 - end));
  const double speed = evaluate(other, end).speed;
  BoundaryPoint out = evaluate(other, end + way / speed);
  out.speed *= way_ / speed;
  return out;
}

BoundaryPoint Boundary::at(double u) const {
  const double n = period(), wrapped = u - n * std::floor(u / n);
  const std::size_t piece = index_of(u);
  BoundaryPoint out = evaluate(piece, wrapped >= n ? 0 : wrapped - static_cast<double>(piece));
  out.u = u;
  return out;
}

BoundaryPoint Boundary::before(double u) const {
  if (u != std::floor(u)) return at(u);
  BoundaryPoint out = evaluate(index_of(u - 1), 1);
  out.u = u;
  return out;
}

BoundaryPoint Boundary::sharper_at(double u) const {
  const BoundaryPoint here = at(u), last = before(u);
  return last.turn > here.turn ? last : here;
}

double Boundary::advanced(double u, double way) const {
  if (!std::isfinite(way)) return std::numeric_limits<double>::quiet_NaN();
  const bool forward = way > 0;
  double left = std::abs(way);
  for (std::size_t i = 0; i <= pieces_.size(); ++i) {
    const double joint = forward ? std::floor(u) + 1 : std::ceil(u) - 1;
    const double speed = (forward ? at(u) : before(u)).speed;
    const double room = std::abs(joint - u) * speed;
    if (left <= room) return forward ? u + left / speed : u - left / speed;
    left -= room;
    u = joint;
  }
  return std::numeric_limits<double>::quiet_NaN();  // more than once around
}

double Boundary::way_to_jump(double u, bool forward) const {
  const double joint = forward ? std::floor(u) + 1 : std::ceil(u) - 1;
  if (!jump_[index_of(joint)]) return std::numeric_limits<double>::infinity();
  return std::abs(joint - u) * (forward ? at(u) : before(u)).speed;
}

std::vector<Vec2> Boundary::samples(double spacing) const {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (pieces_[i].kind != Piece::Kind::curve) continue;
    double share = 0;
    while (share < 1) {
      const BoundaryPoint here = evaluate(i, share);
      points.push_back(here.point);
      share += std::max(spacing / here.speed, 1e-6);
    }
  }
  return points;
}

double Boundary::source_of(double u) const {
  const Piece& here = piece(u);
  if (here.kind != Piece::Kind::curve) return static_cast<double>(here.source);
  return static_cast<double>(here.source) + here.from + (u - std::floor(u)) * (here.to - here.from);
}

double Boundary::above(double u, double base) const {
  const double n = period();
  double moved = u + n * std::ceil((base - u) / n);
  if (moved < base) moved += n;
  if (moved >= base + n) moved -= n;
  return moved;
}

/// Finds the maxima of curvature. They are stationary points of the curvature inside a piece, or
/// joints of pieces. Between two consecutive candidates the curvature is monotone. Corners and
/// bridges rank above all maxima next to them, fans below.
void Boundary::find_tips() {
  struct Candidate {
    double u, sharpness;
    Tip::Kind kind = Tip::Kind::maximum;
  };
  constexpr double infinite = 1e100;
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const auto base = static_cast<double>(i);
    const Piece& piece = pieces_[i];
    if (corner_[i]) all.push_back({base, infinite, Tip::Kind::corner});
    if (piece.kind == Piece::Kind::gap) all.push_back({base, infinite, Tip::Kind::bridge});
    if (piece.kind == Piece::Kind::fan) all.push_back({base, -infinite});
    if (piece.kind != Piece::Kind::curve) continue;
    all.push_back({base, evaluate(i, 0).turn});
    const curve::Splits splits =
        piece.curve.degree > 1 ? curve::find_splits(piece.curve) : curve::Splits();
    for (int k = 0; k < splits.count; ++k) {
      const double share = (splits.at[k].t - piece.from) / (piece.to - piece.from);
      if (splits.at[k].kind == curve::Split::Kind::apex && share > 0 && share < 1)
        all.push_back({base + share, evaluate(i, share).turn});
    }
    all.push_back({base + 1, evaluate(i, 1).turn});
  }
  // Values that differ by rounding are equal. Equal neighbours form one plateau: an arc, or several
  // candidates of which the middle one counts.
  const auto is_less = [&](const Candidate& a, const Candidate& b) {
    const double amount = std::min(std::abs(a.sharpness), std::abs(b.sharpness));
    return a.sharpness + 1e-9 / size() + 1e-12 * amount < b.sharpness;
  };
  const std::size_t n = all.size();
  const auto u_of = [&](std::size_t i) {
    return all[i % n].u + period() * static_cast<double>(i / n);
  };
  std::size_t start =
      0;  // a candidate lower than its successor, so that no plateau continues across it
  while (start < n && !is_less(all[start], all[(start + 1) % n])) ++start;
  if (start == n) return;  // constant curvature
  bool rising = true;
  std::size_t plateau = start + 1;
  for (std::size_t i = start + 1; i <= start + n; ++i) {
    const Candidate here = all[i % n], next = all[(i + 1) % n];
    if (is_less(here, next)) {
      rising = true;
      plateau = i + 1;
    } else if (is_less(next, here)) {
      if (rising && here.sharpness > 0) {
        Tip tip{here.kind, u_of(plateau), u_of(i), 0};
        if (here.kind == Tip::Kind::bridge) ++tip.right;
        if (here.kind == Tip::Kind::maximum && tip.right - tip.left >= 1) tip.kind = Tip::Kind::arc;
        if (tip.kind == Tip::Kind::maximum) tip.left = tip.right = u_of((plateau + i) / 2);
        tip.u = above((tip.left + tip.right) / 2, 0);
        tips_.push_back(tip);
      }
      rising = false;
    }
  }
  std::sort(tips_.begin(), tips_.end(), [](const Tip& a, const Tip& b) { return a.u < b.u; });
}

}  // namespace medial::curve_axis
