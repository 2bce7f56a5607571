#include "methods/curve_axis/smooth_boundary.h"

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

Bezier bezier_of(const Contour& contour, const CurvePiece& piece) {
  const std::span<const Vec2> points(contour.points.data() + piece.first, piece.degree + 1);
  if (contour.weights.empty()) return curve::make_bezier(points);
  return curve::make_bezier(points, {contour.weights.data() + piece.first, piece.degree + 1});
}

/// Twice the area of the polygon of all control points: its sign is the curve's for smooth curves
/// that do not cross themselves, or so nearly that the samples below decide.
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

/// Where a piece begins, or ends.
struct End {
  Vec2 point, tangent;
  double curvature;
};
End end_of(const Bezier& curve, bool last) {
  const curve::Jet jet = curve::evaluate(curve, last ? 1 : 0);
  return {jet.point, (1 / norm(jet.first)) * jet.first, curve::curvature(jet)};
}

}  // namespace

Contour normalized(const Contour& contour) {
  Contour out;
  out.role = contour.role;
  out.start_at(contour.points.at(0));
  for (const CurvePiece& piece : contour.pieces) {
    const Vec2 start = contour.points[piece.first];
    const Vec2 end = contour.points[piece.first + piece.degree];
    if (piece.degree == 1 && start == end) continue;
    if (piece.bulge != 0) {
      // Halves of at most a half circle: control point where the tangents meet.
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
      // bezier_to() takes weights relative to a first one of 1.
      std::vector<double> weights(contour.weights.begin() + piece.first + 1,
                                  contour.weights.begin() + piece.first + 1 + piece.degree);
      for (double& weight : weights) weight /= contour.weights[piece.first];
      out.bezier_to(points, weights);
    }
  }
  if (!(out.points.back() == out.points.front())) out.line_to(out.points.front());
  return doubled_area(out) < 0 ? reversed(out) : out;
}

Status find_roughness(const Contour& contour) {
  constexpr double largest_turn = 1e-3;  // radians
  constexpr double largest_jump = 1e-2;  // of the curvature, or of 1 / size
  Vec2 low = contour.points[0], high = low;
  for (const Vec2 p : contour.points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      return Error{ErrorCode::not_finite, "a control point is not finite", {}};
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double size = distance(low, high);
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    const CurvePiece& next = contour.pieces[(i + 1) % contour.pieces.size()];
    const End before = end_of(bezier_of(contour, contour.pieces[i]), true);
    const End after = end_of(bezier_of(contour, next), false);
    const double jump = std::abs(before.curvature - after.curvature) * size;
    const double curvature = std::max(std::abs(before.curvature), std::abs(after.curvature)) * size;
    const char* fault = nullptr;
    if (!(std::abs(cross(before.tangent, after.tangent)) <= largest_turn &&
          dot(before.tangent, after.tangent) > 0)) {
      fault = "the boundary has a corner or a cusp";
    } else if (!(jump <= largest_jump * std::max(1.0, curvature))) {
      fault = "the boundary's curvature jumps";
    }
    if (fault == nullptr) continue;
    Place place;
    place.vertex = (i + 1) % contour.pieces.size();
    place.point = after.point;
    return Error{ErrorCode::unsupported,
                 std::string(fault) +
                     ": the method curve-axis takes smooth boundaries; use disks, or fit a spline",
                 place};
  }
  return success();
}

SmoothBoundary::SmoothBoundary(const Contour& contour) {
  for (const CurvePiece& piece : contour.pieces) pieces_.push_back(bezier_of(contour, piece));
  low_ = high_ = contour.points[0];
  for (const Vec2 p : contour.points) extend(p);
  find_maxima();
  // The frame proper: samples, and the tips that lie between them.
  low_ = high_ = contour.points[0];
  constexpr int samples = 16;
  for (const Bezier& piece : pieces_)
    for (int i = 0; i < samples; ++i)
      extend(curve::evaluate(piece, static_cast<double>(i) / samples).point);
  for (const double u : maxima_) extend(at(u).point);
}

void SmoothBoundary::extend(Vec2 p) {
  low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
  high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
}

BoundaryPoint SmoothBoundary::at(double u) const {
  const double n = period();
  double wrapped = u - n * std::floor(u / n);
  if (wrapped >= n) wrapped = 0;
  const auto piece = static_cast<std::size_t>(wrapped);
  ++evaluations_;
  const curve::Jet jet = curve::evaluate(pieces_[piece], wrapped - static_cast<double>(piece));
  BoundaryPoint out;
  out.u = u;
  out.point = jet.point;
  out.speed = norm(jet.first);
  out.tangent = (1 / out.speed) * jet.first;
  out.curvature = cross(jet.first, jet.second) / (out.speed * out.speed * out.speed);
  return out;
}

double SmoothBoundary::advanced(double u, double length) const {
  if (!std::isfinite(length)) return std::numeric_limits<double>::quiet_NaN();
  const bool forward = length > 0;
  const auto speed_at = [&](double at_u) {
    const double n = period();
    double joint = std::round(at_u);
    // At a joint, the piece that the way leads into.
    if (at_u != joint) return at(at_u).speed;
    const double index = forward ? joint : joint - 1;
    const auto piece = static_cast<std::size_t>(index - n * std::floor(index / n));
    ++evaluations_;
    return norm(curve::evaluate(pieces_[piece], forward ? 0 : 1).first);
  };
  double left = std::abs(length);
  for (std::size_t i = 0; i <= pieces_.size(); ++i) {
    const double joint = forward ? std::floor(u) + 1 : std::ceil(u) - 1;
    const double speed = speed_at(u);
    const double room = std::abs(joint - u) * speed;
    if (left <= room) return forward ? u + left / speed : u - left / speed;
    left -= room;
    u = joint;
  }
  return std::numeric_limits<double>::quiet_NaN();  // more than once around
}

double SmoothBoundary::above(double u, double base) const {
  const double n = period();
  double moved = u + n * std::ceil((base - u) / n);
  if (moved < base) moved += n;
  if (moved >= base + n) moved -= n;
  return moved;
}

/// Maxima lie where the curvature is stationary inside a piece, or at a knot of a spline, where its
/// slope may jump. Between two neighbouring candidates the curvature is monotone.
void SmoothBoundary::find_maxima() {
  struct Candidate {
    double u, curvature;
  };
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const auto base = static_cast<double>(i);
    all.push_back({base, at(base).curvature});
    const curve::Splits splits = curve::find_splits(pieces_[i]);
    for (int k = 0; k < splits.count; ++k)
      if (splits.at[k].kind == curve::Split::Kind::apex)
        all.push_back({base + splits.at[k].t, at(base + splits.at[k].t).curvature});
  }
  // Differences of rounding are none: equal neighbours count as one plateau, of which the middle
  // candidate stands for all.
  const double rounding = 1e-9 / size();
  const std::size_t n = all.size();
  std::size_t start = 0;  // a candidate that is lower than its successor: no plateau runs over it
  while (start < n && !(all[start].curvature + rounding < all[(start + 1) % n].curvature)) ++start;
  if (start == n) return;  // constant curvature
  bool rising = true;
  std::size_t plateau = start + 1;
  for (std::size_t i = start + 1; i <= start + n; ++i) {
    const Candidate here = all[i % n], next = all[(i + 1) % n];
    if (next.curvature > here.curvature + rounding) {
      rising = true;
      plateau = i + 1;
    } else if (next.curvature < here.curvature - rounding) {
      if (rising && here.curvature > 0) maxima_.push_back(all[(plateau + i) / 2 % n].u);
      rising = false;
    }
  }
  std::sort(maxima_.begin(), maxima_.end());
}

}  // namespace medial::curve_axis
