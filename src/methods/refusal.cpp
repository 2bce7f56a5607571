#include "methods/refusal.h"

#include <algorithm>

#include "medial/verify.h"
#include "methods/checks.h"
#include "methods/exact/crossing.h"
#include "shape/errors.h"

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

Error crossing_or(const Problem& problem, Error error) {
  if (!has_arcs(problem.shape)) return error;
  const auto crossing = exact::find_crossing(problem);
  if (!crossing) return error;
  const std::vector<VertexSource>& sources = problem.shape.sources;
  return error_at(ErrorCode::crossing,
                  text_of_edges(ErrorCode::crossing, sources[crossing->second]) +
                      ", by less than rounding: move them apart",
                  sources[crossing->first], crossing->point);
}

Error error_of_wrong_axis(const MedialAxis& axis, const char* text) {
  // In tolerances. Smaller disks cannot always be distinguished from rounding.
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
  return {ErrorCode::internal, text, {}};
}

}  // namespace medial
