#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "axis/curve.h"
#include "verify/checks.h"
#include "verify/distance_tree.h"

namespace medial::verify_detail {

/// The measurements of the disks of nodes, or of the disks inside edges, against the boundary.
struct Measured {
  Worst residual, intrusion, negative;
  std::uint64_t disks = 0;

  /// Whether two disks are no worse than the current maxima.
  bool are_better(const Problem& problem, Pair radius, Pair distance) const {
    const auto within = [&](Pair amount, const Worst& worst) {
      return amount <= both(std::min(worst.value, problem.tolerance));
    };
    return all(within(size_of(distance - radius), residual) & within(radius - distance, intrusion) &
               within(-radius, negative));
  }
  void add(const Problem& problem, const Disk& disk, double distance, std::size_t index) {
    ++disks;
    residual.add(std::abs(distance - disk.radius), problem.tolerance, disk.center, index);
    intrusion.add(disk.radius - distance, problem.tolerance, disk.center, index);
    negative.add(-disk.radius, problem.tolerance, disk.center, index);
  }
  void add(const Measured& other) {
    residual.add(other.residual);
    intrusion.add(other.intrusion);
    negative.add(other.negative);
    disks += other.disks;
  }
};

struct Findings {
  Measured nodes, inside;
  Worst contact, legality, turned;

  void add(const Findings& other) {
    nodes.add(other.nodes);
    inside.add(other.inside);
    contact.add(other.contact);
    legality.add(other.legality);
    turned.add(other.turned);
  }
};

/// The arc of a site, if it is an arc of the boundary.
inline const Arc* arc_of(const Problem& problem, std::uint32_t site) {
  const std::uint32_t place = problem.place[site];
  const bool is_known = place != no_index && problem.axis.sites[site].kind() == SiteKind::arc;
  return is_known ? &problem.arcs[place] : nullptr;
}

/// Two parameters of a curve, with the Bernstein polynomials there for curves of weight 1 (most
/// edges).
struct Parameters {
  Pair t, s;
  std::array<Pair, 3> polynomial;
  std::size_t count;  ///< 1 if both are equal

  Parameters(Pair at, std::size_t the_count) : t(at), s(1 - at), count(the_count) {
    polynomial = weighted(1).first;
  }
  /// The weighted polynomials divided by their sum, and the sum.
  std::pair<std::array<Pair, 3>, Pair> weighted(double weight) const {
    const Pair sum = s * s + 2 * s * t * weight + t * t;
    return {{s * s / sum, 2 * s * t * weight / sum, t * t / sum}, sum};
  }
};

/// The parameters of `samples` disks inside an edge.
std::vector<Parameters> parameters_of(int samples);

/// Measures disks of an edge against its sites and the boundary, and its legality. `near`: all
/// boundary edges that may be nearer than the sites, if known. `counted`: the nodes at its ends
/// that are measured with it, or no_index.
void measure_samples(const Problem& problem, const DistanceTree& boundary, std::uint32_t edge,
                     std::span<const Parameters> samples, const NearEdges* near,
                     const std::array<std::uint32_t, 2>& counted, Findings& findings);

}  // namespace medial::verify_detail
