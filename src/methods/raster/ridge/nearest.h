#pragma once

#include <cstdint>
#include <memory>

#include "medial/compute.h"
#include "methods/raster/ridge/outline.h"

namespace medial::ridge {

constexpr std::uint32_t no_edge = ~std::uint32_t{0};

/// An edge and its distance from a pixel's centre.
struct Near {
  std::uint32_t edge = no_edge;
  double distance = 0;
};

/// The edges nearest to a point: which ones they are does not depend on how they are found. Of
/// edges at equal distance it is the lowest. All coordinates are local.
class NearestEdges {
 public:
  explicit NearestEdges(const EdgeOutline& outline) : outline_(outline) {}
  virtual ~NearestEdges() = default;

  /// The nearest edge; `hint` is any edge, better one that is near, or no_edge.
  virtual Near nearest(Vec2 c, std::uint32_t hint) = 0;
  /// The nearest among the edges nearer than `reach` that, after `first`, are another place of the
  /// boundary by the given rule, and with whose foot a disk that touches the nearest one too, on
  /// the same ray, has its centre no farther from c than `away`; no_edge where there is none.
  virtual Near second(Vec2 c, Near first, double reach, RidgeRule rule, double away) = 0;

  double distance_to(std::uint32_t edge, Vec2 c) const;
  std::uint64_t queries = 0;
  std::uint64_t distances = 0;  ///< computed by the sorted list

 protected:
  bool is_another(Vec2 c, Near first, std::uint32_t edge, RidgeRule rule) const;
  /// Whether the disk that touches both feet, the nearest one where c's disk does, has its centre
  /// within `away` of c: then some point of the axis is. Feet behind the nearest one have no such
  /// disk.
  bool is_seen(Vec2 c, Near first, Near other, double away) const;
  const EdgeOutline& outline_;
};

std::unique_ptr<NearestEdges> make_search(const EdgeOutline& outline, bool sorted_list);

}  // namespace medial::ridge
