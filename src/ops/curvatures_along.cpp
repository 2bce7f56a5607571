// The curvature of the boundary and its derivative, from the axis: Shaked and Bruckstein, (4) to
// (8).

#include <algorithm>
#include <array>
#include <cmath>

#include "medial/sides.h"

namespace medial {
namespace {

/// The number of feet for a derivative: the middle one, and two on either side.
constexpr std::size_t window = 5;

/// The first derivative at 0 of the polynomial with these values at these places, one of which is
/// 0: Lagrange's weights.
double derivative_at_zero(const std::array<double, window>& places,
                          const std::array<double, window>& values, std::size_t zero) {
  double sum = 0;
  for (std::size_t i = 0; i < window; ++i) {
    if (i == zero) continue;
    double weight = 1 / places[i];
    for (std::size_t k = 0; k < window; ++k)
      if (k != i && k != zero) weight *= places[k] / (places[k] - places[i]);
    sum += weight * (values[i] - values[zero]);
  }
  return sum;
}

/// The length of a curve between two of its points with these curvatures, from their chord.
double length_between(const BoundaryJet& a, const BoundaryJet& b) {
  const double chord = distance(a.point, b.point);
  const double turn = 0.5 * (a.curvature + b.curvature) * chord;
  return chord * (1 + turn * turn / 24);
}

/// Adds curvatures at the jets of a sampled branch by (7), with their derivatives.
void add_samples(const std::vector<AxisJet>& jets, Side side, std::vector<FootCurvature>& out) {
  std::vector<BoundaryJet> feet;
  std::vector<double> places;
  for (const AxisJet& jet : jets) {
    feet.push_back(boundary_at(jet, side));
    const bool first = feet.size() == 1;
    places.push_back(first ? 0
                           : places.back() + length_between(feet[feet.size() - 2], feet.back()));
  }
  for (std::size_t i = 0; i < feet.size(); ++i) {
    if (feet.size() < window || !std::isfinite(feet[i].curvature)) continue;
    const std::size_t from = std::min(i > window / 2 ? i - window / 2 : 0, feet.size() - window);
    std::array<double, window> t{}, k{};
    for (std::size_t j = 0; j < window; ++j) {
      t[j] = places[from + j] - places[i];
      k[j] = feet[from + j].curvature;
    }
    const double slope = derivative_at_zero(t, k, i - from);
    if (!std::isfinite(slope)) continue;
    out.push_back({side, jets[i].disk, feet[i].point, feet[i].curvature,
                   (side == Side::left ? -slope : slope) + 0.0});
  }
}

/// Adds curvatures inside an exact edge.
void add_exact(const MedialAxis& axis, const Step& step, std::vector<FootCurvature>& out) {
  constexpr int samples = 8;
  const Edge& edge = axis.edges[step.edge];
  for (int i = 1; i <= samples; ++i) {
    const double share = static_cast<double>(i) / (samples + 1),
                 t = step.forward ? share : 1 - share;
    const AxisJet jet = jet_at(axis, edge, t);
    if (jet.tangent == Vec2{0, 0}) continue;
    for (const Side side : {Side::left, Side::right}) {
      const auto values = boundary_curvatures(axis, edge, t, side, 1);
      if (!std::isfinite(values[0]) || !std::isfinite(values[1])) continue;
      // + 0.0 avoids -0 in tables. If the branch traverses the edge backward, left and right are
      // swapped.
      const bool left = (side == Side::left) == step.forward;
      out.push_back({left ? Side::left : Side::right, jet.disk, boundary_at(jet, side).point,
                     values[0] + 0.0, (side == Side::left ? -values[1] : values[1]) + 0.0});
    }
  }
}

}  // namespace

std::vector<FootCurvature> curvatures_along(const MedialAxis& axis, const Branch& branch) {
  std::vector<FootCurvature> all;
  if (axis.resolution > 0) {
    const std::vector<AxisJet> jets = jets_along(axis, branch);
    for (const Side side : {Side::left, Side::right}) add_samples(jets, side, all);
  } else {
    for (const Step& step : branch.steps) add_exact(axis, step, all);
  }
  return all;
}

}  // namespace medial
