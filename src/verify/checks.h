#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <string>
#include <vector>

#include "base/threads.h"
#include "base/tolerance.h"
#include "medial/axis.h"
#include "medial/shape.h"
#include "medial/verify.h"
#include "site/joint.h"
#include "verify/boundary_edge.h"

namespace medial::verify_detail {

using site::Joint;

constexpr std::uint32_t no_index = 0xFFFFFFFF;

/// A shape and its axis, with data that all checks share.
struct Problem {
  const Shape& shape;
  const MedialAxis& axis;
  Box box;  ///< of the shape
  double tolerance = 0;

  EdgeArcs arcs;                         ///< of the boundary
  std::vector<std::uint32_t> next;       ///< of each point: the following one of its loop
  std::vector<std::uint32_t> previous;   ///< and the one before it
  std::vector<std::uint32_t> component;  ///< of each point
  std::vector<Joint> joint;              ///< at each point; smooth between collinear edges
  std::vector<double> blunt_angle;       ///< at each point where it is blunt, else 0; or empty
  /// Of each site: the point of the shape that it is, or at which its edge begins; or no_index.
  std::vector<std::uint32_t> place;
  std::vector<std::uint32_t> degree;  ///< of each node

  Problem(const Shape& the_shape, const MedialAxis& the_axis, const Box& the_box)
      : shape(the_shape), axis(the_axis), box(the_box) {}

  Vec2 point(std::uint32_t i) const { return shape.points[i]; }
  /// The boundary edge that begins at a point.
  BoundaryEdge edge(std::uint32_t i) const {
    return {shape.points[i], shape.points[next[i]], shape.bulge(i)};
  }
  Track track(std::uint32_t i) const {
    return Track(edge(i), shape.bulge(i) != 0 ? &arcs[i] : nullptr);
  }
  std::uint32_t before(std::uint32_t i) const { return previous[i]; }
  /// The directions in which the boundary arrives at a point, and leaves it.
  Vec2 arriving(std::uint32_t i) const {
    const BoundaryEdge on = edge(previous[i]);
    return on.bulge != 0 ? arcs[previous[i]].end_tangent() : end_tangent(on);
  }
  Vec2 leaving(std::uint32_t i) const {
    const BoundaryEdge on = edge(i);
    return on.bulge != 0 ? arcs[i].start_tangent() : start_tangent(on);
  }
  bool is_blunt(std::uint32_t i) const { return joint[i] == Joint::blunt; }
  const Disk& disk(std::uint32_t node) const { return axis.nodes[node].disk; }
};

/// The angle by which the boundary turns to the left between two edges.
inline double turn_between(const BoundaryEdge& before, const BoundaryEdge& after) {
  const Vec2 arriving = end_tangent(before), leaving = start_tangent(after);
  return std::atan2(cross(arriving, leaving), dot(arriving, leaving));
}

/// A bound for the distance of boundary points outside a disk that touches both edges next to blunt
/// joints, whose leaves are dropped. From the disk's foot on either edge of such a joint, the
/// boundary turns away from the disk by less than the joint's angle; at the end of an edge that
/// joins smoothly, it may turn at once, by the uncertainty of rounding there. At most the radius
/// times the sum of all angles, because the directions of the feet differ by at most that.
class OpenAtJoints {
 public:
  OpenAtJoints(const Problem& problem, double radius) : problem_(problem), radius_(radius) {}

  void add(std::uint32_t joint) {
    const bool blunt = problem_.is_blunt(joint);
    if (problem_.blunt_angle.empty() || !(blunt || problem_.joint[joint] == Joint::smooth)) return;
    const BoundaryEdge before = problem_.edge(problem_.previous[joint]),
                       after = problem_.edge(joint);
    const auto [shorter, longer] = std::minmax({length_of(before), length_of(after)});
    if (blunt) {
      angles_ += problem_.blunt_angle[joint];
      // The largest height of the joint above the chord between feet on both edges.
      const double height = shorter * longer / (shorter + longer);
      sum_ += problem_.blunt_angle[joint] * std::min(radius_, height);
    } else {
      sum_ += std::abs(turn_between(before, after)) * std::min(radius_, longer);
    }
  }
  double value() const { return std::min(angles_ * radius_, sum_); }

 private:
  const Problem& problem_;
  double radius_, angles_ = 0, sum_ = 0;
};

/// Returns work(arc) for a site's arc, using the precomputed arc if the site is on the boundary.
template <class Work>
auto with_arc(const Problem& problem, std::uint32_t site, const Work& work) {
  const std::uint32_t place = problem.place[site];
  return place != no_index ? work(problem.arcs[place])
                           : work(Arc(edge_of(problem.axis.sites[site])));
}

class ArcFeet;

/// The largest value of a measurement, and its place.
struct Worst {
  double value = 0;
  Vec2 where;
  std::size_t index = 0;   ///< of the node, edge ... there
  std::uint64_t over = 0;  ///< number of values over the tolerance

  void add(double amount, double tolerance, Vec2 point, std::size_t i = 0) {
    if (amount <= std::min(value, tolerance)) return;  // nearly always
    // A value that cannot be computed counts as infinitely wrong.
    if (std::isnan(amount)) amount = std::numeric_limits<double>::infinity();
    if (amount > tolerance) ++over;
    if (amount > value) {
      value = amount;
      where = point;
      index = i;
    }
  }
  void add(const Worst& other) {
    over += other.over;
    if (other.value > value) {
      const std::uint64_t all = over;
      *this = other;
      over = all;
    }
  }
};

/// Formats a sentence like printf.
std::string sentence(const char* format, ...) __attribute__((format(printf, 1, 2)));

/// The number of places per block of findings.
constexpr std::size_t block_size = 1024;

/// Runs a check on `threads` threads. An exception is a failure; a check without failures passes.
template <class Check>
void certify(int threads, DiskCertificate& certificate, const Check& check) {
  try {
    on_threads(threads, check);
  } catch (const std::exception& failure) {
    certificate.failures.push_back(
        sentence("The check could not be finished: %s.", failure.what()));
  }
  certificate.passed = certificate.failures.empty();
}

/// Whether the shape is well-formed: indices are in range and coordinates are finite.
bool check_shape(const Shape& shape, Certificate& certificate);
/// Whether the axis is well-formed: indices are in range, numbers finite, and radii not negative.
/// `box` is the shape's.
bool check_values(const Shape& shape, const Box& box, const MedialAxis& axis,
                  Certificate& certificate);

/// Computes the derived data of Problem, and reports sites that are not on the boundary.
/// `corner_angle` is in radians.
void prepare(Problem& problem, double corner_angle, Certificate& certificate);

/// Checks connected parts against components and cycles against holes (for a part of an axis, only
/// that there are no more cycles than holes), and the kinds of nodes against their degrees.
void check_graph(const Problem& problem, bool part, Certificate& certificate);
/// Checks that every convex corner has a leaf, that other leaves are at arcs of largest curvature,
/// and that every reflex vertex has a foot.
void check_vertices(const Problem& problem, Certificate& certificate);
/// Checks radii against distances, at nodes and inside edges; contacts; sides; legality.
void check_disks(const Problem& problem, int samples_per_edge, Certificate& certificate);
/// For a sampled axis, checks the nodes' radii against the distance to the boundary, within the
/// tolerance.
void check_sampled_disks(const Problem& problem, Certificate& certificate);
/// Checks that every boundary point is the foot of some disk. Returns the area that blunt joints
/// may leave uncovered.
double check_coverage(const Problem& problem, const ArcFeet& feet, Certificate& certificate);
/// Checks the area of the union of the disks.
void check_area(const Problem& problem, const ArcFeet& feet, double open, Certificate& certificate);

}  // namespace medial::verify_detail
