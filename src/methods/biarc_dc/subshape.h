#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "medial/axis.h"
#include "methods/biarc_dc/outline.h"

namespace medial::biarc_dc {

/// Names no disk, no site.
constexpr std::uint32_t none = ~std::uint32_t{0};

/// A non-artificial arc of a sub-shape, a part of one site, and what follows it: the joint that the
/// outline has there, or the artificial arc of a dividing disk.
struct Element {
  std::uint32_t site = 0;
  std::uint32_t disk_after = none;  ///< dividing disk of the artificial arc; none: a joint
  double from = 0;                  ///< the part's parameters on the site
  double to = 0;

  bool is_joined() const { return disk_after == none; }
};

/// A sub-shape: its non-artificial arcs in boundary order, cyclically, with the artificial arcs in
/// between. A site occurs at most once.
struct Subshape {
  std::vector<Element> elements;
  std::uint32_t component = 0;

  std::size_t size() const { return elements.size(); }
  std::size_t next(std::size_t i) const { return i + 1 == elements.size() ? 0 : i + 1; }
  std::size_t before(std::size_t i) const { return i == 0 ? elements.size() - 1 : i - 1; }
  /// What every division must make smaller: non-artificial arcs and the joints between them. Two
  /// contacts inside arcs add two arcs and no joint; so only a part of two arcs without a joint,
  /// the base cases b, h and i, leaves the other part as large as the whole (docs/biarc-dc.md).
  std::size_t measure() const;
};

/// A place where a dividing disk touches the boundary of a sub-shape: one part ends there, with the
/// element `last` at parameter `to`, and another begins with `first` at `from`. They are the same
/// element where the disk touches inside of one, neighbours at a joint, and further apart where all
/// that is in between lies on the disk's circle.
struct Seam {
  std::size_t last = 0;
  std::size_t first = 0;
  double to = 0;
  double from = 0;
};

/// The sub-shapes into which a dividing disk with these seams, in boundary order, divides a shape.
std::vector<Subshape> split(const Subshape& subshape, const std::vector<Seam>& seams,
                            std::uint32_t disk);

/// The base cases of Figs 5 and 6. S stands for an arc or segment, V for a reflex vertex, | for an
/// artificial arc, - for a smooth joint and ^ for a convex corner.
enum class BaseCase : std::uint8_t {
  a,    ///< S-S|S|    passes from one arc to the next
  b,    ///< S|S|      one bisector
  c,    ///< S|S|S|    a branching
  d,    ///< S-S-S|    ends in the centre of the arc in the middle
  e,    ///< S^S|S|    a branching, one branch of which ends in the corner
  f,    ///< S^S|V|
  g,    ///< S-S|V|
  h,    ///< S|V|
  i,    ///< V|V|
  j,    ///< S|S|V|
  k,    ///< S|V|V|
  l,    ///< V|V|V|
  m,    ///< S^S|      ends in a corner
  cap,  ///< nothing: all of it touches its only dividing disk (the paper's footnote 3)
};
constexpr std::size_t base_case_count = 14;
/// "a" to "m", "cap".
const char* name_of(BaseCase base_case);

/// A base case with its elements in the order in which BaseCase spells them.
struct BaseShape {
  BaseCase base_case = BaseCase::cap;
  std::uint8_t size = 0;
  std::uint32_t component = 0;
  std::array<Element, 3> element;
};

/// Which base case a sub-shape is, if it is one. `disks`: the dividing disks.
std::optional<BaseShape> base_shape_of(const Subshape& subshape, const SiteOutline& outline,
                                       const std::vector<Disk>& disks, double tolerance);

}  // namespace medial::biarc_dc
