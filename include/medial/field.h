#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "medial/error.h"
#include "medial/shape.h"
#include "medial/vec2.h"

namespace medial {

/// The generalised potential of a charged border (docs/potential.md): every component of a shape
/// has the potential of its own border, the integral of 1 / r^order along it.
class PotentialField {
 public:
  /// Errors: invalid_option (order outside of [1, 4096]), empty, unsupported (coordinates beyond
  /// the limits of compute()). Arcs become chords within 1e-5 of the shape's larger side.
  static Result<PotentialField> make(const Shape& shape, double order);
  ~PotentialField();
  PotentialField(PotentialField&&) noexcept;

  /// The potential's logarithm at p, and the direction of the force there (a unit vector, or zero
  /// where there is no force). Nothing outside of the shape and on its border. Any threads may ask.
  struct Sample {
    double log_potential = 0;
    Vec2 direction;
    double clearance = 0;  ///< distance to the border
  };
  std::optional<Sample> at(Vec2 p) const;

  /// The force line from p, until it ends or has so many steps. A step is at most `step` long, in
  /// units of the input.
  std::vector<Vec2> streamline(Vec2 p, double step, std::size_t most_steps) const;

 private:
  struct Parts;
  explicit PotentialField(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace medial
