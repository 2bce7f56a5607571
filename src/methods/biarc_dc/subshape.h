#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "medial/axis.h"
#include "methods/biarc_dc/outline.h"

namespace medial::biarc_dc {

/// A non-artificial arc of a sub-shape, which is a part of one site, and its end: the joint of the
/// outline there, or the artificial arc of a dividing disk.
struct Element {
  std::uint32_t site = 0;
  std::uint32_t disk_after = none;  ///< dividing disk of the artificial arc; none: a joint
  double from = 0;                  ///< the part's parameters on the site
  double to = 0;

  bool is_joined() const { return disk_after == none; }
};

/// A sub-shape: its non-artificial arcs in boundary order, cyclically, with the artificial arcs in
/// between. A site occurs at most once, and the list begins with the lowest one, so the sites
/// increase.
struct Subshape {
  std::span<const Element> elements;
  std::uint32_t component = 0;

  std::size_t size() const { return elements.size(); }
  std::size_t next(std::size_t i) const { return i + 1 == elements.size() ? 0 : i + 1; }
  std::size_t before(std::size_t i) const { return i == 0 ? elements.size() - 1 : i - 1; }
  /// The number of elements from one to another, including both.
  std::size_t count(std::size_t first, std::size_t last) const {
    return (last >= first ? last - first : last + elements.size() - first) + 1;
  }
  /// The element that is a part of a site; size() if there is none. O(log n).
  std::size_t find(std::uint32_t site) const;
  /// Every division must reduce this: the number of non-artificial arcs and of the joints between
  /// them. Two contacts inside arcs add two arcs and no joint; so only a part of two arcs without a
  /// joint, the base cases b, h and i, leaves the other part as large as the whole
  /// (docs/biarc-dc.md).
  std::size_t measure() const;
};

/// Sub-shapes stored one after another in one array.
class Parts {
 public:
  bool empty() const { return parts_.empty(); }
  std::size_t size() const { return parts_.size(); }
  Subshape operator[](std::size_t i) const {
    const std::size_t end = i + 1 < parts_.size() ? parts_[i + 1].begin : elements_.size();
    return {std::span(elements_).subspan(parts_[i].begin, end - parts_[i].begin),
            parts_[i].component};
  }
  Subshape back() const { return (*this)[parts_.size() - 1]; }
  void pop_back() {
    elements_.resize(parts_.back().begin);
    parts_.pop_back();
  }
  void clear() {
    elements_.clear();
    parts_.clear();
  }
  /// Begins a part, to which add() then adds elements.
  void begin(std::uint32_t component) { parts_.push_back({elements_.size(), component}); }
  void add(const Element& element) { elements_.push_back(element); }
  void add(std::span<const Element> elements) {
    elements_.insert(elements_.end(), elements.begin(), elements.end());
  }
  void append(const Parts& others);
  /// The i-th element of the last part, in boundary order.
  Element& of_last(std::size_t i) { return elements_[parts_.back().begin + i]; }

 private:
  struct Part {
    std::size_t begin = 0;
    std::uint32_t component = 0;
  };
  std::vector<Element> elements_;
  std::vector<Part> parts_;
};

/// A place where a dividing disk touches the boundary of a sub-shape: one part ends there, with the
/// element `last` at parameter `to`, and another begins with `first` at `from`. Both are the same
/// element if the disk touches its inside, neighbours at a joint, and further apart if everything
/// between them is on the disk's circle.
struct Seam {
  std::size_t last = 0;
  std::size_t first = 0;
  double to = 0;
  double from = 0;
};

/// Appends the sub-shapes into which a dividing disk with these seams, in boundary order, divides a
/// shape.
void split(const Subshape& subshape, std::span<const Seam> seams, std::uint32_t disk, Parts& parts);

/// Whether element `i` is an arc of locally largest curvature, where the axis ends, and its centre
/// is not the disk's. A disk that touches nearly all of such an arc may still be far from its
/// centre.
bool ends_elsewhere(const Subshape& subshape, const SiteOutline& outline, std::size_t i,
                    const Disk& disk, double tolerance);

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
  cap,  ///< nothing: all of it is on its only dividing disk (the paper's footnote 3)
};
constexpr std::size_t base_case_count = 14;
/// "a" to "m", "cap".
const char* name_of(BaseCase base_case);

/// A base case, with its elements in the order of BaseCase.
struct BaseShape {
  BaseCase base_case = BaseCase::cap;
  std::uint32_t component = 0;
  std::array<Element, 3> element;
};

/// The dividing disks so far: those that precede a list, and the list's own.
struct DiskList {
  std::span<const Disk> earlier;
  std::vector<Disk> own;

  const Disk& operator[](std::uint32_t i) const {
    return i < earlier.size() ? earlier[i] : own[i - earlier.size()];
  }
  std::uint32_t add(const Disk& disk) {
    own.push_back(disk);
    return static_cast<std::uint32_t>(earlier.size() + own.size() - 1);
  }
};

/// The base case that a sub-shape is, or none. `disks` are the dividing disks.
std::optional<BaseShape> base_shape_of(const Subshape& subshape, const SiteOutline& outline,
                                       const DiskList& disks, double tolerance);

}  // namespace medial::biarc_dc
