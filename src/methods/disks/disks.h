#pragma once

#include <optional>
#include <vector>

#include "medial/axis.h"
#include "methods/problem.h"

namespace medial::disks {

/// The method `disks` (docs/disks.md). Requires what compute() has checked. The graph has one part
/// for each component and one cycle for each hole. Cut short, with any content, where the caller
/// cancels. Errors: error_of_wrong_axis() where a disk misses one of its
/// sites by far more than rounding explains; unsupported, with the place, where no way to decide
/// finds an axis that verify() passes. With Options::exact nodes that are not the same are kept
/// apart, however near; next to arcs such an axis is one that verify() passes.
/// `attempts`: so many have been made before, by other methods.
Result<MedialAxis> run(const Problem& problem, int attempts = 0);

/// run() in parts of about so many nodes, see compute_in_parts(), of straight edges. Returns the
/// axis without sites, nodes and edges; nothing where the first way to decide fails, and run() has
/// to look for another one.
Result<std::optional<MedialAxis>> run_in_parts(const Problem& problem, const AxisSink& sink,
                                               std::size_t part_nodes = 1 << 14);

/// An axis, and whether the decisions about its graph were made with certainty, not in double.
struct AxisAround {
  MedialAxis axis;
  bool is_certain = false;
};
/// run() for what lies around a planar graph (shape/around.h): a shape whose edges may stand there
/// twice, once for each side, and with loops of one point. The axis' edges, Edge or VoronoiEdge,
/// stand in `edges`; they and the nodes leave room for a diagram's spokes and the planar graph's
/// points. It has no sites yet.
template <class E>
AxisAround run_around(const Problem& problem, std::vector<E>& edges);

}  // namespace medial::disks
