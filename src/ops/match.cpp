#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "axis/curve.h"
#include "axis/node_kinds.h"
#include "axis/steps.h"
#include "base/compat.h"
#include "medial/features.h"
#include "medial/geometry.h"
#include "medial/query.h"
#include "ops/burn.h"

namespace medial {
namespace {

/// What a signature holds. Lengths are over the root mean square distance from the axis's centre.
struct Measures {
  using Quantiles = std::array<double, 24>;
  Quantiles center{}, pairs{};       ///< distances from the centre; between two places of the axis
  Quantiles depth{}, radius{};       ///< ways from the axis's middle; radii, over their mean
  double thickness = 0, length = 0;  ///< logarithms of the mean radius and of the axis's length
  double ends = 0;                   ///< log(1 + ends), each counted as its branch is
  double cycles = 0;                 ///< log(1 + holes)
  double elongation = 0;             ///< logarithm of the quotient of the axes of inertia
};
using Values = decltype(ShapeSignature::values);

/// A piece of the axis.
struct WeightedPiece {
  double weight = 0;
  Vec2 at;
  double radius = 0;
  double depth = 0;  ///< time of burning until the last, about
};

/// A value that counts by a weight.
struct Weighted {
  double value = 0, weight = 0;
};

/// Erosion thickness over the square root of the area: noise below the first, shape above the
/// second.
constexpr double noise_weight = 0.03, shape_weight = 0.12;

/// How much a piece counts, from 0 to 1.
double significance(double erosion) {
  const double t = std::clamp((erosion - noise_weight) / (shape_weight - noise_weight), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// The mean of the values between k / n and (k + 1) / n of the weight, for each k: unlike single
/// values it does not jump.
Measures::Quantiles quantiles(std::vector<Weighted> values) {
  Measures::Quantiles out{};
  double total = 0;
  for (const Weighted& v : values) total += v.weight;
  if (!(total > 0)) return out;
  std::sort(values.begin(), values.end(),
            [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  const double share = total / static_cast<double>(out.size());
  std::size_t k = 0;
  double room = share;
  for (const Weighted& v : values) {
    double left = v.weight;
    while (left > room && k + 1 < out.size()) {
      out[k++] += v.value * (room / share);
      left -= room;
      room = share;
    }
    out[k] += v.value * (left / share);
    room -= left;
  }
  return out;
}

class Signer {
 public:
  Signer(const MedialAxis& axis, const AxisFeatures& features)
      : axis_(axis), features_(features), unit_(std::sqrt(std::max(features.area, 0.0))) {}

  Measures run() {
    Measures out;
    if (!(unit_ > 0)) return out;
    const std::vector<Branch> all = branches(axis_);
    double latest = 0;
    for (const BranchFeatures& branch : features_.branches) latest = std::max(latest, last(branch));
    for (const BranchFeatures& branch : features_.branches) add(branch, all[branch.branch], latest);
    // Little but disks: nothing reaches far beyond one.
    if (pieces_.empty() && !axis_.nodes.empty()) {
      const auto add_disk = [this](const Disk& disk) {
        pieces_.push_back({disk.radius, disk.center, disk.radius, 0});
      };
      const Incidence incidence(axis_);
      for (std::uint32_t i = 0; i < axis_.nodes.size(); ++i)
        if (incidence.degree(i) == 0) add_disk(axis_.nodes[i].disk);
      if (pieces_.empty()) add_disk(axis_.nodes[deepest_node(axis_)].disk);
    }
    double total = 0, mean_radius = 0;
    Vec2 center;
    for (const WeightedPiece& p : pieces_) {
      total += p.weight;
      center = center + p.weight * p.at;
      mean_radius += p.weight * p.radius;
    }
    if (!(total > 0)) return out;
    center = (1 / total) * center;
    mean_radius /= total;
    const auto [longer, shorter] = inertia(center, total);
    const double size = unit_ * std::sqrt(longer + shorter);
    out.elongation = 0.5 * std::log(longer / shorter);
    std::vector<Weighted> centers, depths, radii;
    for (const WeightedPiece& p : pieces_) {
      centers.push_back({distance(p.at, center) / size, p.weight});
      depths.push_back({p.depth / size, p.weight});
      radii.push_back({p.radius / mean_radius, p.weight});
    }
    out.center = quantiles(std::move(centers));
    out.depth = quantiles(std::move(depths));
    out.radius = quantiles(std::move(radii));
    out.pairs = quantiles(pairs(total, size));
    out.thickness = std::log(mean_radius / size);
    out.length = std::log(total / size);
    out.ends = std::log1p(ends_);
    out.cycles = std::log1p(static_cast<double>(features_.cycles));
    return out;
  }

 private:
  /// The mean squares of the distances from a centre, along the axis of inertia and across it, over
  /// the area; each place is as thick as its disk. Of a needle the one across is no difference of
  /// others, which would be rounding.
  std::array<double, 2> inertia(Vec2 center, double total) const {
    const auto mean = [&](const auto& of) {
      double sum = 0;
      for (const WeightedPiece& p : pieces_)
        sum += p.weight / total * of((1 / unit_) * (p.at - center));
      return sum;
    };
    const double xx = mean([](Vec2 d) { return d.x * d.x; });
    const double yy = mean([](Vec2 d) { return d.y * d.y; });
    const double angle = 0.5 * std::atan2(2 * mean([](Vec2 d) { return d.x * d.y; }), xx - yy);
    const Vec2 along{std::cos(angle), std::sin(angle)};
    double thickness = 0;
    for (const WeightedPiece& p : pieces_)
      thickness += p.weight / total * (p.radius / unit_) * (p.radius / unit_) / 4;
    const auto square = [](double value) { return value * value; };
    return {mean([&](Vec2 d) { return square(dot(along, d)); }) + thickness,
            mean([&](Vec2 d) { return square(cross(along, d)); }) + thickness};
  }

  /// When a branch has burnt.
  static double last(const BranchFeatures& branch) {
    const auto [from, to] = branch.burn;
    if (from == ops::not_burnt && to == ops::not_burnt) return 0;
    if (from == ops::not_burnt) return to + branch.length;
    if (to == ops::not_burnt) return from + branch.length;
    return 0.5 * (from + to + branch.length);
  }

  void add(const BranchFeatures& branch, const Branch& chain, double latest) {
    constexpr double longest = 1.0 / 64;  // pieces, over unit_
    constexpr double most = 4096;         // of one edge
    double along = branch.reversed ? branch.length : 0;
    const double sign = branch.reversed ? -1 : 1;
    const bool burns = last(branch) > 0;
    // Most branches of a rough outline are noise all along.
    if (burns && last(branch) - branch.smallest_radius <= noise_weight * unit_) return;
    double largest = 0;
    for (const Step& step : chain.steps) {
      const Curve curve = curve_of(axis_, axis_.edges[step.edge]);
      const double whole = curve.length();
      if (!(whole > 0)) continue;
      const double count = std::clamp(std::ceil(whole / (longest * unit_)), 1.0, most);
      for (double k = 0; k < count; ++k) {
        const double place = (k + 0.5) / count * whole;
        const double way = step.forward ? place : whole - place;
        const Disk disk = curve.at(curve.at_length(way));
        const double at = along + sign * place;
        const double time = std::min(branch.burn[0] + at, branch.burn[1] + branch.length - at);
        // On cycles the fire never comes: the middle of the shape.
        const double erosion = burns ? std::max(time - disk.radius, 0.0) : unit_;
        largest = std::max(largest, erosion);
        const double counts = significance(erosion / unit_);
        if (!(counts > 0)) continue;
        pieces_.push_back({counts * whole / count, disk.center, disk.radius,
                           burns ? std::max(latest - time, 0.0) : 0});
      }
      along += sign * whole;
    }
    if (branch.from_kind == PointKind::end || branch.to_kind == PointKind::end)
      ends_ += significance(largest / unit_);
  }

  /// Distances between two places, for some hundred places at even steps of the weight.
  std::vector<Weighted> pairs(double total, double size) const {
    constexpr std::size_t places = 192;
    std::vector<Vec2> chosen;
    const double step = total / places;
    double next = 0.5 * step, sum = 0;
    for (const WeightedPiece& p : pieces_) {
      sum += p.weight;
      for (; next <= sum && chosen.size() < places; next += step) chosen.push_back(p.at);
    }
    std::vector<Weighted> out;
    out.reserve(chosen.size() * chosen.size() / 2);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      for (std::size_t k = i + 1; k < chosen.size(); ++k)
        out.push_back({distance(chosen[i], chosen[k]) / size, 1});
    return out;
  }

  const MedialAxis& axis_;
  const AxisFeatures& features_;
  double unit_;
  std::vector<WeightedPiece> pieces_;
  double ends_ = 0;
};

double mean_difference(const Measures::Quantiles& a, const Measures::Quantiles& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

/// The diagonal of a loop's box: its arcs bulge by half of their chords at most.
double extent_of(const Shape& shape, std::size_t loop) {
  Box box = Box::nothing();
  for (const Vec2 p : shape.loop(loop)) box.add(p);
  return distance(box.low, box.high);
}

}  // namespace

Shape without_specks(const Shape& shape, double share) {
  const double least = share * std::sqrt(std::max(area(shape), 0.0));
  std::vector<bool> kept(shape.component_count(), false);
  for (std::size_t i = 0; i < shape.loop_count(); ++i)
    if (!shape.hole[i] && extent_of(shape, i) >= least) kept[shape.component[i]] = true;
  std::vector<std::uint32_t> number(kept.size(), 0);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) number[i] = count++;
  if (count == 0) return shape;
  Shape out;
  out.loop_begin.push_back(0);
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    if (!kept[shape.component[i]] || (shape.hole[i] && extent_of(shape, i) < least)) continue;
    for (std::size_t k = shape.loop_begin[i]; k < shape.loop_begin[i + 1]; ++k) {
      out.points.push_back(shape.points[k]);
      out.sources.push_back(shape.sources[k]);
      if (!shape.bulges.empty()) out.bulges.push_back(shape.bulges[k]);
    }
    out.loop_begin.push_back(static_cast<std::uint32_t>(out.points.size()));
    out.component.push_back(number[shape.component[i]]);
    out.hole.push_back(shape.hole[i]);
  }
  return out;
}

ShapeSignature signature_of(const MedialAxis& axis, const AxisFeatures& features) {
  return {bit_cast<Values>(Signer(axis, features).run())};
}

double dissimilarity(const ShapeSignature& first, const ShapeSignature& second) {
  const auto a = medial::bit_cast<Measures>(first.values);
  const auto b = medial::bit_cast<Measures>(second.values);
  // Each number over what it differs by between different silhouettes, about.
  double sum = mean_difference(a.center, b.center) / 0.15;
  sum += mean_difference(a.pairs, b.pairs) / 0.1;
  sum += mean_difference(a.depth, b.depth) / 0.3;
  sum += mean_difference(a.radius, b.radius) / 0.25;
  sum += std::abs(a.thickness - b.thickness) / 0.6;
  sum += std::abs(a.length - b.length) / 0.4;
  sum += std::abs(a.ends - b.ends) / 0.5;
  sum += std::abs(a.cycles - b.cycles) / 0.5;
  sum += std::abs(a.elongation - b.elongation) / 0.4;
  constexpr double terms = 9;
  return sum / terms;
}

}  // namespace medial
