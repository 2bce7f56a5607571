#pragma once

#include "medial/axis.h"
#include "medial/planar_graph.h"

namespace medial {

/// What verify() found of the disks of an axis or of a diagram. Lengths in units of the input.
struct DiskCertificate {
  double tolerance = 0;            ///< bound of the residuals
  double largest_residual = 0;     ///< max |distance to what is nearest - r|, samples of all edges
  double largest_contact_gap = 0;  ///< max |distance to an edge's own sites - r|
  Vec2 worst;                      ///< where the largest residual is
  std::uint64_t disks_checked = 0;
  bool passed = false;                ///< all demands hold
  std::vector<std::string> failures;  ///< one sentence for each demand that does not hold
};

/// Of an axis, whose nodes count as samples.
struct Certificate : DiskCertificate {
  double resolution = 0;         ///< of a sampled axis: MedialAxis::resolution
  double largest_intrusion = 0;  ///< max (r - distance to the nearest boundary point), >= 0
  double largest_uncovered = 0;  ///< max distance from a boundary sample to the union of disks
  double shape_area = 0, disks_area = 0;  ///< the latter of the union of the disks
  double worst_legality = 0;  ///< max excess over Shaked and Bruckstein's (9), (10); no unit
  std::uint64_t components = 0, holes = 0;    ///< of the shape
  std::uint64_t graph_parts = 0, cycles = 0;  ///< of the graph: connected parts, independent cycles
  std::uint64_t convex_corners = 0, corners_without_leaf = 0;
  std::uint64_t reflex_vertices = 0, reflex_without_contact = 0;
  std::uint64_t curvature_leaves = 0;  ///< at the centre of an arc of locally largest curvature
  std::uint64_t blunt_joints = 0;      ///< convex, with an arc, below the corner angle: no leaf
  double largest_blunt_angle = 0;      ///< among them, in degrees
  std::uint64_t unresolved = 0;  ///< failures of sampled axes, as if the shape's graph were another
};

struct VerifyOptions {
  /// Relative to the diagonal; 0: 1e-14. Never below four spacings of doubles at the largest
  /// coordinate, nor below the axis's own tolerance, up to 1e-3.
  double tolerance = 0;
  int samples_per_edge = 8;    ///< points inside every edge, in [0, 2^20]
  double corner_angle = 0.01;  ///< that the axis was computed with; see Options
  int threads = 0;             ///< see Options; more than 1024 count as 1024
  /// The axis is a part of the shape's: pruned, cut or smoothed. Checks what holds of every part:
  /// disks, contacts, sides, and no more cycles than holes; the other counts are only reported.
  bool part = false;
};

/// Checks an axis against its shape. Shares no code with the engines: it has its own distance
/// search, area and count of cycles. O(n log n) expected. What compute() refuses as unsupported
/// does not pass. At a blunt joint the boundary may be uncovered by the radius times its angle.
///
/// Of a sampled axis it checks indices, kinds, connected parts and cycles, and each radius within
/// half a pixel's diagonal; contacts, corners, coverage and area stay 0. Of an axis of the exterior
/// it checks disks, contacts and sides only, as the edges at the enclosure are missing.
Certificate verify(const Shape& shape, const MedialAxis& axis, const VerifyOptions& options = {});

struct VoronoiCertificate : DiskCertificate {
  std::uint64_t sites = 0, faces = 0;  ///< faces that are not empty
  std::uint64_t broken_faces = 0;  ///< not closed, not counter-clockwise, or of other sites' edges
  double enclosure_area = 0, faces_area = 0;  ///< the latter the sum of all
};

/// Checks the diagram of a planar graph: every sample of an edge is at its radius from the edge's
/// sites and no nearer to any other; each face is one closed counter-clockwise walk along edges of
/// its site; every edge is in the faces of both of its sites; the diagram is connected; the faces'
/// areas add up to the enclosure's. So the faces fill it without overlap, and each holds what is
/// nearest to its site. Without an enclosure (of a polygon) none passes. O(n log n) expected.
VoronoiCertificate verify(const PlanarGraph& planar_graph, const VoronoiDiagram& diagram,
                          const VerifyOptions& options = {});

struct ShapeDistance {
  double area = 0, other_area = 0;         ///< of the first shape and of the second
  double from_first = 0, from_second = 0;  ///< largest distance of a boundary from the other one
  Vec2 worst;                              ///< where on a boundary the larger of the two is
  /// The Hausdorff distance of the two boundaries.
  double hausdorff() const { return from_first > from_second ? from_first : from_second; }
};

/// Measures at the vertices and at `samples` points inside each edge: a lower bound, less than the
/// distance of two samples too small. 0 if both are empty, infinite if one is. O(n log n) expected.
ShapeDistance shape_distance(const Shape& first, const Shape& second, int samples = 7);

}  // namespace medial
