#pragma once

#include <memory>

#include "medial/axis.h"
#include "medial/shape.h"

namespace medial {

/// The disk at parameter t in [0, 1] of an edge; at 0 and 1, exactly the node's disk.
Disk disk_at(const MedialAxis& axis, const Edge& edge, double t);

/// An edge of an exact axis with the conic that its sites and nodes determine. O(1).
Edge conic_of(const MedialAxis& axis, const Edge& edge);

Vec2 foot(const Site& site, Vec2 p);  ///< the point of the site nearest to p

/// The length of an edge in the plane, and of all edges. Closed forms; relative error < 1e-12.
double length(const MedialAxis& axis, const Edge& edge);
double total_length(const MedialAxis& axis);

/// Samples an edge in at most 100,000 pieces, both nodes included: by chords within `chord` of the
/// curve, in (x, y) and in r; or by steps of at most `step` along the curve. In units of the input.
std::vector<Disk> sample_by_chord(const MedialAxis& axis, const Edge& edge, double chord);
std::vector<Disk> sample_by_step(const MedialAxis& axis, const Edge& edge, double step);

/// One edge of a branch, and whether the branch runs from its node[0] to its node[1].
struct Step {
  std::uint32_t edge = 0;
  bool forward = true;
};

/// Blum's medial branch: a chain of edges between leaves and branchings, or a closed chain.
struct Branch {
  std::vector<Step> steps;
  std::uint32_t from = 0, to = 0;  ///< nodes; equal for a closed chain
};

/// All branches, ordered by lowest edge; each edge is in exactly one. And their number. O(edges).
std::vector<Branch> branches(const MedialAxis& axis);
std::uint64_t branch_count(const MedialAxis& axis);

/// A place on the axis: an edge and a parameter in [0, 1]; also with its disk; and a distance.
struct EdgePlace {
  std::uint32_t edge = 0;
  double t = 0;
};
struct AxisPlace : EdgePlace {
  Disk disk;
};
struct AxisPoint : AxisPlace {
  double distance = 0;
};

/// Finds nearest points in O(log n) expected, after O(n log n). Keeps a reference to the axis.
class AxisLocator {
 public:
  explicit AxisLocator(const MedialAxis& axis);
  /// The lowest edge if several are equally near. Without edges, the distance is infinite.
  AxisPoint nearest(Vec2 p) const;

 private:
  struct Index;
  std::shared_ptr<const Index> index_;
};

double clearance(const Shape& shape, Vec2 p);  ///< distance to the boundary, negative outside; O(n)

}  // namespace medial
