#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "medial/axis.h"
#include "medial/shape.h"
#include "support/generate.h"

namespace medial::test {

/// The combinatorics of an axis: nodes with the sites that their disks touch, in counter-clockwise
/// order, and links between them. Nodes that only divide an edge between two sites are left out.
struct SiteGraph {
  struct Link {
    std::array<std::uint32_t, 2> node;  ///< from, to
    std::array<std::uint32_t, 2> site;  ///< on the left and on the right
  };
  std::vector<Disk> disks = {};  ///< of the nodes
  /// Of each node; none where it has no link, but of the only node all.
  std::vector<std::vector<std::uint32_t>> contacts = {};
  std::vector<Link> links = {};
  std::string failure = {};  ///< why there is no such graph
};

SiteGraph graph_of(const Shape& shape, const MedialAxis& axis);

/// For each site of an axis the next one along the boundary.
std::vector<std::uint32_t> next_sites(const Shape& shape, std::span<const Site> sites);

/// How two graphs of the same sites differ; empty where they are the same.
///
/// A link is known by the sites on its two sides. Links that both graphs have correspond to each
/// other, of several with the same sites those that are nearest. Contracting all others must leave
/// the same graph, one-to-one on nodes and links; those that end in a corner must not be left. And
/// for each node of that graph, one disk must touch all that the disks contracted to it touch, in
/// both graphs, to within `tolerance`: one of these disks does.
std::string difference(std::span<const Site> sites, const SiteGraph& a, const SiteGraph& b,
                       double tolerance);
/// The same for two axes of one shape.
std::string difference(const Shape& shape, const MedialAxis& a, const MedialAxis& b,
                       double tolerance);

/// The axis of a shape's image under a symmetry that commits no rounding, as one of the shape:
/// moved back, its sites numbered like `sites`. Without sites where these are not the same; its
/// edges keep the image's then.
MedialAxis moved_back(const Shape& shape, std::span<const Site> sites, const Shape& image,
                      MedialAxis axis, const Symmetry& symmetry);

}  // namespace medial::test
