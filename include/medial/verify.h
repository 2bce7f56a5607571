#pragma once

#include "medial/axis.h"
#include "medial/planar_graph.h"

namespace medial {

/// What verify() measured of the disks of an axis or diagram. Lengths in units of the input.
struct DiskCertificate {
  double tolerance = 0;            ///< bound on the residuals
  double largest_residual = 0;     ///< max |distance to the boundary - r|: a bound, else sampled
  double largest_contact_gap = 0;  ///< max |distance to an edge's own sites - r|, likewise
  Vec2 worst;                      ///< where the largest residual is
  std::uint64_t disks_checked = 0;
  bool passed = false;                ///< all requirements hold
  std::vector<std::string> failures;  ///< one sentence for each violated requirement
};

/// The certificate of an axis; nodes count as samples.
struct Certificate : DiskCertificate {
  double resolution = 0;         ///< of a sampled axis: MedialAxis::resolution
  double largest_intrusion = 0;  ///< max (r - distance to the nearest boundary point), >= 0
  double largest_uncovered = 0;  ///< max distance from a boundary sample to the union of disks
  double shape_area = 0, disks_area = 0;  ///< areas of the shape and of the union of the disks
  double worst_legality = 0;  ///< max excess over Shaked and Bruckstein's (9), (10); no unit
  std::uint64_t components = 0, holes = 0;    ///< of the shape
  std::uint64_t graph_parts = 0, cycles = 0;  ///< of the graph: connected parts, independent cycles
  std::uint64_t convex_corners = 0, corners_without_leaf = 0;
  std::uint64_t reflex_vertices = 0, reflex_without_contact = 0;
  std::uint64_t curvature_leaves = 0;  ///< at the centre of an arc of locally largest curvature
  std::uint64_t blunt_joints = 0;  ///< convex joints with an arc, below the corner angle: no leaf
  double largest_blunt_angle = 0;  ///< among them, in degrees
  std::uint64_t unresolved = 0;  ///< failures of sampled axes whose graph differs from the shape's
};

struct VerifyOptions {
  /// Relative to the diagonal; 0: 1e-14. Never below four spacings of doubles at the largest
  /// coordinate, nor below the axis's own tolerance (at most 1e-3).
  double tolerance = 0;
  int samples_per_edge = 8;    ///< in [0, 2^20]; of edges whose disks no bound settles at once
  double corner_angle = 0.01;  ///< that the axis was computed with; see Options
  int threads = 0;             ///< see Options; more than 1024 count as 1024
  /// The axis is only a part of the shape's: pruned, cut or smoothed. Checks what holds for every
  /// part: disks, contacts, sides, and no more cycles than holes; only reports other counts.
  bool part = false;
};

/// Checks an axis against its shape, by code that shares nothing with the engines: its own distance
/// search, area and count of cycles. O(n log n) expected. A shape that compute() refuses as
/// unsupported fails. At a blunt joint, the shorter edge times its angle may stay uncovered.
///
/// For a sampled axis, checks indices, kinds, connected parts, cycles, and radii within half a
/// pixel's diagonal; contacts, corners, coverage and area stay 0. For an axis of the exterior,
/// checks only disks, contacts and sides, as the edges at the enclosure are missing.
Certificate verify(const Shape& shape, const MedialAxis& axis, const VerifyOptions& options = {});

struct VoronoiCertificate : DiskCertificate {
  std::uint64_t sites = 0, faces = 0;  ///< faces that are not empty
  std::uint64_t broken_faces = 0;  ///< not closed, not counter-clockwise, or of other sites' edges
  double enclosure_area = 0, faces_area = 0;  ///< of the enclosure; sum over the faces
};

/// Checks the diagram of a planar graph: every sample of an edge is at its radius from the edge's
/// sites and no nearer to any other; each face is one closed counter-clockwise walk along edges of
/// its site; every edge is in the faces of both of its sites; the diagram is connected; the faces'
/// areas add up to the enclosure's. So the faces tile the enclosure, and each is the Voronoi cell
/// of its site. A diagram without an enclosure (of a polygon) fails. O(n log n) expected.
VoronoiCertificate verify(const PlanarGraph& planar_graph, const VoronoiDiagram& diagram,
                          const VerifyOptions& options = {});

struct ShapeDistance {
  double area = 0, other_area = 0;         ///< of the first and of the second shape
  double from_first = 0, from_second = 0;  ///< largest distance of each boundary from the other
  Vec2 worst;                              ///< where the larger of the two is
  /// The Hausdorff distance of the two boundaries.
  double hausdorff() const { return from_first > from_second ? from_first : from_second; }
};

/// Measures at the vertices and at `samples` points inside each edge. A lower bound, whose error is
/// below the distance of two samples. 0 if both are empty, infinite if one is. O(n log n) expected.
ShapeDistance shape_distance(const Shape& first, const Shape& second, int samples = 7);

}  // namespace medial
