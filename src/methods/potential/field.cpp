#include <algorithm>
#include <cmath>
#include <utility>

#include "medial/methods.h"
#include "methods/potential/force.h"
#include "methods/potential/region.h"
#include "shape/limits.h"

namespace medial {

struct PotentialField::Parts {
  LocalFrame frame;
  double order = 1;
  std::vector<potential::Region> regions;
  std::vector<potential::Charges> charges;

  /// The charges of the region that contains a point of the frame.
  const potential::Charges* around(Vec2 p) const {
    for (std::size_t i = 0; i < regions.size(); ++i)
      if (encloses(regions[i], p)) return &charges[i];
    return nullptr;
  }
};

Result<PotentialField> PotentialField::make(const Shape& shape, double order) {
  if (!(order >= 1 && order <= potential::largest_order))
    return Error{ErrorCode::invalid_option, "the order of the potential must be in [1, 4096]", {}};
  if (shape.points.empty()) return Error{ErrorCode::empty, "the shape is empty", {}};
  if (auto error = beyond_limits(shape)) return std::move(*error);
  auto parts = std::make_shared<Parts>();
  const Options options;
  const Problem problem(shape, options);
  parts->frame = problem.frame;
  parts->order = order;
  const Vec2 extent = problem.box.high - problem.box.low;
  const double size = std::max(extent.x, extent.y);
  parts->regions = potential::regions_of(problem, 1e-5 * size * parts->frame.scale);
  for (const potential::Region& region : parts->regions) parts->charges.emplace_back(region.pieces);
  return PotentialField(std::move(parts));
}

std::optional<PotentialField::Sample> PotentialField::at(Vec2 p) const {
  const Vec2 local = parts_->frame.to_local(p);
  const potential::Charges* charges = parts_->around(local);
  if (charges == nullptr) return std::nullopt;
  potential::Evaluator evaluator(*charges);
  const double distance = evaluator.place(local).distance;
  if (!(distance > 0)) return std::nullopt;
  const auto [force, log_potential] = evaluator.field(parts_->order);
  Sample sample;
  sample.clearance = distance * parts_->frame.inverse;
  // A length of the frame is `inverse` lengths of the input, and the potential's unit is a length
  // to the power of 1 - order.
  sample.log_potential = log_potential + (1 - parts_->order) * std::log(parts_->frame.inverse);
  const double size = norm(force.force);
  if (size > 0) sample.direction = (1 / size) * force.force;
  return sample;
}

std::vector<Vec2> PotentialField::streamline(Vec2 p, double step, std::size_t most_steps) const {
  std::vector<Vec2> line;
  Vec2 here = parts_->frame.to_local(p);
  const potential::Charges* charges = parts_->around(here);
  if (charges == nullptr) return line;
  potential::Evaluator evaluator(*charges);
  const double longest = step * parts_->frame.scale;
  Vec2 before;
  line.push_back(p);
  for (std::size_t i = 0; i < most_steps; ++i) {
    const double distance = evaluator.place(here).distance;
    if (!(distance > 0)) break;
    const Vec2 first = evaluator.force(parts_->order).force;
    if (!(norm(first) > 0)) break;
    const double length = std::min(longest, 0.4 * distance);
    // The midpoint rule.
    if (!(evaluator.place(here + (0.5 * length / norm(first)) * first).distance > 0)) break;
    const Vec2 second = evaluator.force(parts_->order).force;
    if (!(norm(second) > 0)) break;
    const Vec2 direction = (1 / norm(second)) * second;
    if (i > 0 && dot(direction, before) < 0) break;  // past the floor of a valley, or at a minimum
    here = here + length * direction;
    before = direction;
    line.push_back(parts_->frame.to_input(here));
  }
  return line;
}

}  // namespace medial
