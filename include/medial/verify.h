#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "medial/axis.h"
#include "medial/diagram.h"
#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial {

/// What verify() measured. Lengths and areas in units of the input.
struct Certificate {
  double tolerance = 0;            ///< what the residuals are judged against
  double resolution = 0;           ///< of a sampled axis: the side of its pixels; see verify()
  double largest_residual = 0;     ///< max |distance to the boundary - r|, nodes and edge samples
  double largest_intrusion = 0;    ///< max (r - distance to the nearest boundary point), >= 0
  double largest_contact_gap = 0;  ///< max |distance to an edge's own two sites - r|
  double largest_uncovered = 0;    ///< max distance from a boundary sample to the union of disks
  double shape_area = 0;
  double disks_area = 0;      ///< area of the union of the disks
  double worst_legality = 0;  ///< max excess over Shaked and Bruckstein's (9), (10); no unit
  std::uint64_t disks_checked = 0;
  std::uint64_t components = 0;   ///< of the shape
  std::uint64_t graph_parts = 0;  ///< connected parts of the graph
  std::uint64_t holes = 0;
  std::uint64_t cycles = 0;  ///< independent cycles of the graph
  std::uint64_t convex_corners = 0;
  std::uint64_t corners_without_leaf = 0;
  std::uint64_t curvature_leaves = 0;  ///< at the centre of an arc of locally largest curvature
  std::uint64_t blunt_joints = 0;      ///< convex, with an arc, below the corner angle: no leaf
  double largest_blunt_angle = 0;      ///< among them, in degrees
  std::uint64_t reflex_vertices = 0;
  std::uint64_t reflex_without_contact = 0;
  double worst_x = 0;  ///< where the largest residual is
  double worst_y = 0;
  bool passed = false;                ///< all demands hold
  std::vector<std::string> failures;  ///< one sentence for each demand that does not hold
  /// How many of them tell no more than that a sampled axis has other parts or cycles than the
  /// shape, which what is narrower than a pixel brings about.
  std::uint64_t unresolved = 0;
};

struct VerifyOptions {
  /// Relative to the diagonal; 0: 1e-14. Nothing is judged by less than four spacings of doubles at
  /// the largest coordinate, nor by less than the axis's own tolerance, at most 1e-3.
  double tolerance = 0;
  int samples_per_edge = 8;    ///< points inside every edge, in [0, 2^20]
  double corner_angle = 0.01;  ///< what the axis was computed with; see Options
  int threads = 0;             ///< at most 1024 are used; 0: all of the machine
};

/// Checks an axis against its shape, independently of the engine that made it: its own distance
/// search, its own area, its own count of cycles. O(n log n) expected. A shape that compute()
/// refuses as unsupported cannot be checked and does not pass.
///
/// A sampled axis (resolution > 0) is judged by what its pixels can know: indices and kinds, the
/// radius of every node within half a pixel's diagonal of the distance to the boundary, one
/// connected part for each component and one cycle for each hole. What is narrower than a pixel can
/// make it fail; the certificate has its resolution, and the failures say at which resolution they
/// hold. Its contacts, corners, coverage and area are not judged and stay 0.
///
/// An axis of the exterior is judged against the exterior in its enclosure: disks, contacts and
/// sides as ever; parts, cycles, corners, coverage and area are not, as the edges at the enclosure
/// are left out.
///
/// A blunt joint has no leaf, so the disks leave a little of the boundary there untouched: at most
/// the radius times the joint's angle, which is allowed for.
Certificate verify(const Shape& shape, const MedialAxis& axis, const VerifyOptions& options = {});

/// What verify() measured of a Voronoi diagram. Lengths and areas in units of the input.
struct VoronoiCertificate {
  double tolerance = 0;            ///< what the residuals are judged against
  double largest_residual = 0;     ///< max |distance to the nearest site - r|, samples of all edges
  double largest_contact_gap = 0;  ///< max |distance to an edge's own sites - r|
  double worst_x = 0;              ///< where the largest residual is
  double worst_y = 0;
  std::uint64_t disks_checked = 0;
  std::uint64_t sites = 0;
  std::uint64_t faces = 0;         ///< that are not empty
  std::uint64_t broken_faces = 0;  ///< not closed, not counter-clockwise, or of other sites' edges
  double frame_area = 0;
  double faces_area = 0;  ///< the sum of all
  bool passed = false;
  std::vector<std::string> failures;
};

/// Checks a planar graph's diagram against the planar graph, by the distance search of the
/// certificate above, which the engines do not share: its sites are the planar graph's; every
/// sample of an edge is at its radius from the edge's sites and no nearer to any other; edges of
/// the enclosure lie on it; every face is one closed walk along edges of its site,
/// counter-clockwise; every edge is in the faces of both of its sites; the graph is connected; and
/// the areas of the faces add up to the enclosure's. So the faces fill the enclosure without
/// overlap and each holds what is nearest to its site. O(n log n) expected. Of the options
/// tolerance, samples_per_edge and threads count. A diagram without an enclosure (of a polygon
/// alone) does not pass.
VoronoiCertificate verify(const PlanarGraph& planar_graph, const VoronoiDiagram& diagram,
                          const VerifyOptions& options = {});

}  // namespace medial
