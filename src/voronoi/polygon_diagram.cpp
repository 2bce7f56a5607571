#include "base/in_flight.h"
#include "base/threads.h"
#include "medial/voronoi.h"
#include "methods/checks.h"
#include "methods/lee/lee.h"

namespace medial {

Result<VoronoiDiagram> voronoi_diagram(const Shape& shape, const Options& options) {
  try {
    Options own = options;
    own.method = method::Lee{};
    if (auto error = refuse(shape, own)) return std::move(*error);
    if (has_arcs(shape))
      return Error{
          ErrorCode::unsupported,
          "the diagrams of lee take no arcs: use the method disks, which computes one within "
          "an enclosure",
          {}};
    const Problem problem(shape, own);
    auto diagram = on_threads(own.threads, [&] { return lee::voronoi_diagram(problem); });
    if (!diagram) return diagram;
    diagram->statistics.threads = effective_threads(own.threads);
    if (problem.is_cancelled()) return Error{ErrorCode::cancelled, "cancelled", {}};
    if (own.progress) own.progress(1);
    return diagram;
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
