#include "methods/refusal.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "medial/verify.h"

namespace medial {
namespace {

Error unsupported_at(const std::optional<Vec2>& point, const char* text) {
  Error error{ErrorCode::unsupported, text, {}};
  error.place.point = point;
  return error;
}

}  // namespace

std::optional<Error> error_if_refused(const Problem& problem, const MedialAxis& axis) {
  constexpr std::size_t most = 1 << 13;
  VerifyOptions demands;
  const auto samples = static_cast<int>(most / (axis.edges.size() + 1));
  demands.samples_per_edge = std::clamp(samples, 1, demands.samples_per_edge);
  demands.corner_angle = problem.options.corner_angle;
  demands.threads = problem.options.threads;
  const Certificate certificate = verify(problem.shape, axis, demands);
  if (certificate.passed) return std::nullopt;
  return unsupported_at(
      certificate.worst,
      "rounding alone decides what a disk touches here: move the vertices near it apart");
}

Error error_of_wrong_axis(const Shape& shape, const MedialAxis& axis, const char* text) {
  // In tolerances: disks that are smaller cannot always be distinguished from rounding.
  constexpr double narrow = 16;
  const Node* narrowest = nullptr;
  for (const Node& node : axis.nodes)
    if (node.kind != NodeKind::leaf &&
        (narrowest == nullptr || node.disk.radius < narrowest->disk.radius))
      narrowest = &node;
  if (narrowest != nullptr && narrowest->disk.radius <= narrow * axis.tolerance)
    return unsupported_at(narrowest->disk.center,
                          "the shape is too narrow here for its sides to differ by more than "
                          "rounding");
  // Of the size: 256 bits hold, beside 1, the product of two lengths of 2^-100 with 56 bits of it.
  constexpr double shortest = 0x1p-100;
  const double size = diagonal(bounding_box(shape));
  const auto is_lost = [&](double apart) {
    return apart != 0 && std::abs(apart) < shortest * size;
  };
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const std::span<const Vec2> loop = shape.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2 apart = loop[(k + 1) % loop.size()] - loop[k];
      if (is_lost(apart.x) || is_lost(apart.y))
        return unsupported_at(loop[k],
                              "two neighbouring vertices differ by too little here beside the size "
                              "of the shape: make their x or y equal, or bring what is far away "
                              "nearer");
    }
  }
  return {ErrorCode::internal, text, {}};
}

}  // namespace medial
