#include "medial/match.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "axis/curve.h"
#include "medial/query.h"
#include "ops/burn.h"

namespace medial {
namespace {

/// A piece of the axis.
struct Piece {
  double weight = 0;
  Disk disk;
  double depth = 0;    ///< burning time to the middle of its part, about
  double erosion = 0;  ///< how far the fire is ahead of the radius
  double angle = 0;
};

/// Erosion thickness over the square root of the area: noise below the first, shape above the
/// second.
constexpr double kNoise = 0.02, kShape = 0.08;

/// How much a piece counts, from 0 to 1.
double significance(double erosion) {
  const double t = std::clamp((erosion - kNoise) / (kShape - kNoise), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// The value at each quantile (k + 1 / 2) / n of the weight.
template <class Value>
ShapeSignature::Quantiles quantiles(std::vector<Piece>& pieces, double total, const Value& value) {
  ShapeSignature::Quantiles out{};
  if (!(total > 0)) return out;
  std::sort(pieces.begin(), pieces.end(),
            [&](const Piece& a, const Piece& b) { return value(a) < value(b); });
  double sum = 0;
  std::size_t k = 0;
  for (const Piece& piece : pieces) {
    sum += piece.weight;
    while (k < out.size() && sum >= total * ((static_cast<double>(k) + 0.5) / out.size()))
      out[k++] = value(piece);
  }
  while (k < out.size()) out[k++] = value(pieces.back());
  return out;
}

/// Places along an edge, and their shares of its length.
constexpr std::array<double, 4> kPlaces{0.125, 0.375, 0.625, 0.875};

class Signer {
 public:
  Signer(const MedialAxis& axis, const AxisFeatures& features)
      : axis_(axis), features_(features), unit_(std::sqrt(std::max(features.area, 0.0))) {}

  ShapeSignature run() {
    ShapeSignature out;
    if (!(unit_ > 0)) return out;
    const std::vector<Branch> all = branches(axis_);
    double latest = 0;
    for (const BranchFeatures& branch : features_.branches)
      for (const double start : branch.burn)
        if (start < ops::kUnburnt) latest = std::max(latest, start + branch.length);
    for (const BranchFeatures& branch : features_.branches) add(branch, all[branch.branch], latest);
    add_disks();
    double total = 0;
    Vec2 center;
    for (const Piece& piece : pieces_) {
      total += piece.weight;
      center = center + piece.weight * piece.disk.center;
    }
    if (!(total > 0)) return out;
    center = (1 / total) * center;
    // Inertia of the disks.
    double xx = 0, xy = 0, yy = 0;
    for (const Piece& piece : pieces_) {
      const Vec2 d = piece.disk.center - center;
      const double own = piece.disk.radius * piece.disk.radius / 4;
      xx += piece.weight * (d.x * d.x + own);
      xy += piece.weight * d.x * d.y;
      yy += piece.weight * (d.y * d.y + own);
    }
    const double mean = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
    out.elongation = 0.5 * std::log((mean + half) / std::max(mean - half, 1e-6 * mean));
    out.radius = quantiles(pieces_, total, [&](const Piece& p) { return p.disk.radius / unit_; });
    out.center = quantiles(pieces_, total,
                           [&](const Piece& p) { return distance(p.disk.center, center) / unit_; });
    out.depth = quantiles(pieces_, total, [&](const Piece& p) { return p.depth / unit_; });
    out.erosion = quantiles(pieces_, total, [&](const Piece& p) { return p.erosion / unit_; });
    out.angle = quantiles(pieces_, total, [](const Piece& p) { return p.angle; });
    out.length = std::log1p(length_ / unit_);
    out.ends = std::log1p(ends_);
    out.cycles = std::log1p(static_cast<double>(features_.cycles));
    return out;
  }

 private:
  void add(const BranchFeatures& branch, const Branch& chain, double latest) {
    double along = branch.reversed ? branch.length : 0;  // of branches(axis), in branch's direction
    const double sign = branch.reversed ? -1 : 1;
    const bool burns = std::min(branch.burn[0], branch.burn[1]) < ops::kUnburnt;
    double largest = 0;
    for (const Step& step : chain.steps) {
      const Edge& edge = axis_.edges[step.edge];
      const Curve curve = curve_of(axis_, edge);
      const double whole = curve.length();
      if (!(whole > 0)) continue;
      for (const double place : kPlaces) {
        const double t = step.forward ? place : 1 - place;
        const Disk disk = curve.at(t);
        const Curve::Derivatives d = curve.derivatives(t);
        const double speed = norm(d.first);
        const double rate = speed > 0 ? std::clamp(d.radius_first / speed, -1.0, 1.0) : 0;
        const double at = along + sign * place * whole;
        const double time = std::min(branch.burn[0] + at, branch.burn[1] + branch.length - at);
        // On cycles the fire never comes: the middle.
        const double erosion = burns ? std::max(time - disk.radius, 0.0) : unit_;
        largest = std::max(largest, erosion);
        const double counts = significance(erosion / unit_);
        if (!(counts > 0)) continue;
        const double length = whole / kPlaces.size();
        length_ += counts * length;
        pieces_.push_back({counts * length * disk.radius, disk, burns ? latest - time : 0,
                           std::min(erosion, unit_), std::sqrt((1 - rate) * (1 + rate))});
      }
      along += sign * whole;
    }
    if (branch.from_kind == PointKind::end || branch.to_kind == PointKind::end)
      ends_ += significance(largest / unit_);
  }

  /// Shapes that are one disk.
  void add_disks() {
    if (!axis_.edges.empty() && !pieces_.empty()) return;
    for (const Node& node : axis_.nodes)
      pieces_.push_back({node.disk.radius * node.disk.radius, node.disk, 0, 0, 1});
  }

  const MedialAxis& axis_;
  const AxisFeatures& features_;
  double unit_;
  std::vector<Piece> pieces_;
  double length_ = 0, ends_ = 0;
};

double mean_difference(const ShapeSignature::Quantiles& a, const ShapeSignature::Quantiles& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

}  // namespace

ShapeSignature signature_of(const MedialAxis& axis, const AxisFeatures& features) {
  return Signer(axis, features).run();
}

double dissimilarity(const ShapeSignature& a, const ShapeSignature& b) {
  // Each number over what it differs by between shapes of different kinds, about.
  double sum = mean_difference(a.radius, b.radius) / 0.08;
  sum += mean_difference(a.center, b.center) / 0.15;
  sum += mean_difference(a.depth, b.depth) / 0.25;
  sum += mean_difference(a.erosion, b.erosion) / 0.2;
  sum += mean_difference(a.angle, b.angle) / 0.1;
  sum += std::abs(a.length - b.length) / 0.3;
  sum += std::abs(a.ends - b.ends) / 0.5;
  sum += std::abs(a.cycles - b.cycles) / 0.5;
  sum += std::abs(a.elongation - b.elongation) / 0.3;
  constexpr double terms = 9;
  return sum / terms;
}

}  // namespace medial
