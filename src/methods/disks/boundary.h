#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/memory.h"
#include "base/numbers.h"
#include "methods/problem.h"
#include "site/joint.h"
#include "site/site.h"
#include "site/smooth_place.h"

namespace medial::disks {

using site::SiteNumbers;

/// The direction in which the disks that connect holes reach out: that of the angle 0.6 + pi. An
/// angle of no meaning to anybody who draws, so that no such disk comes to lie where others are,
/// for instance on a node of the axis.
constexpr Vec2 outreach{-0.825335614909678297, -0.564642473395035357};

enum class Element : std::uint8_t {
  edge,    ///< a segment, or an arc of at most a quarter of a circle
  vertex,  ///< reflex, or a straight passage through a touching vertex
  bridge,  ///< the dividing disk between a hole and what it was connected to; touches nothing
};

/// A maximal disk that connects a hole to another loop: it touches the hole in its furthest point
/// in the direction `outreach`, a vertex or a place inside an arc, and the other loop further out.
struct Bridge {
  Disk disk;
  std::uint32_t hole = 0;  ///< loop
  std::uint32_t site = 0;  ///< touched site, in the loops' boundary
  /// In the order of the connected boundary: before and after the hole. Of a disk at which a part
  /// of a boundary ends, its one place twice.
  std::array<std::uint32_t, 2> places{none, none};
};

/// Which sides of its edges a boundary runs along: on a shape one, around a planar graph both.
enum class Sides : std::uint8_t { one, both };

/// Of each site of a boundary, what it is called among the result's sites; of a bridge, its number.
/// Where the boundary is one loop these are the numbers in turn, which take no memory.
class Originals {
 public:
  std::uint32_t operator[](std::size_t i) const {
    if (!stored_.empty()) return stored_[i];
    const std::size_t number = i + first_;
    return static_cast<std::uint32_t>(number < count_ ? number : number - count_);
  }
  std::size_t size() const { return stored_.empty() ? count_ : stored_.size(); }
  void reserve(std::size_t count) { stored_.reserve(count); }
  void resize(std::size_t count) { stored_.resize(count); }
  void set(std::size_t i, std::uint32_t original) { stored_[i] = original; }
  void push_back(std::uint32_t original) { stored_.push_back(original); }
  void assign(WorkVector<std::uint32_t> originals) { stored_ = std::move(originals); }
  /// Gives memory back where they are the numbers in turn.
  void compress();

 private:
  WorkVector<std::uint32_t> stored_;
  std::size_t first_ = 0, count_ = 0;
};

/// The boundary as sites in boundary order, in the local frame: what the walk goes along. Every
/// component is one run of sites that begins and ends at a convex corner of its outer loop, or at a
/// smooth place where it has none; its holes are spliced in where their connecting disks touch, so
/// the run is the boundary of a simply connected shape.
struct Boundary {
  struct SiteRange {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    bool at_corner = true;  ///< whether it begins and ends at a convex corner

    /// The next site, and the one before, of a run that is a loop.
    std::uint32_t after(std::uint32_t site) const { return site == last ? first : site + 1; }
    std::uint32_t before(std::uint32_t site) const { return site == first ? last : site - 1; }
  };

  WorkVector<site::Site> sites;
  WorkVector<Element> elements;    ///< of each site
  WorkVector<site::Joint> joints;  ///< of an edge with the next one; empty: all are corners
  Originals originals;
  std::vector<SiteRange> runs;  ///< of each component
  std::vector<Bridge> bridges;
  bool has_arcs = false;
  Sides sides = Sides::one;

  void reserve(std::size_t count) {
    sites.reserve(count);
    elements.reserve(count);
    originals.reserve(count);
    if (has_arcs) joints.reserve(count);
  }
  void add(const site::Site& site, Element element, std::uint32_t original,
           site::Joint joint = site::Joint::corner) {
    sites.push_back(site);
    elements.push_back(element);
    originals.push_back(original);
    if (has_arcs) joints.push_back(joint);
  }
  void resize(std::size_t count) {
    sites.resize(count);
    elements.resize(count);
    originals.resize(count);
  }
  /// Of a boundary without arcs, which may be set on several threads.
  void set(std::size_t i, const site::Site& site, Element element, std::uint32_t original) {
    sites[i] = site;
    elements[i] = element;
    originals.set(i, original);
  }
  std::size_t longest_run() const {  ///< in sites
    std::size_t longest = 0;
    for (const SiteRange& run : runs)
      longest = std::max(longest, std::size_t{run.last} - run.first + 1);
    return longest;
  }
  site::Joint joint(std::uint32_t i) const {  ///< between the edges i and i + 1
    return joints.empty() ? site::Joint::corner : joints[i];
  }
  bool is_corner(std::uint32_t i) const {  ///< whether i and i + 1 are edges at a convex corner
    return elements[i] == Element::edge && elements[i + 1] == Element::edge &&
           joint(i) == site::Joint::corner;
  }
  /// Whether two sites are one of the shape, or pieces of one.
  bool is_same(std::uint32_t i, std::uint32_t j) const {
    return elements[i] == elements[j] && originals[i] == originals[j];
  }
  /// Whether a disk can touch i and i + 1 in one point: an edge and a vertex, or a smooth joint.
  bool is_smooth(std::uint32_t i) const {
    const Element own = elements[i], next = elements[i + 1];
    if (own != next) return own != Element::bridge && next != Element::bridge;
    return own == Element::edge && joint(i) == site::Joint::smooth;
  }
  const Bridge& bridge_at(std::uint32_t place) const { return bridges[originals[place]]; }
  /// What stands on the other side of the bridge at a place, next to which a site stands: another
  /// piece of that site, or another copy of that vertex. The site itself where the boundary ends.
  std::uint32_t across(std::uint32_t bridge, std::uint32_t site) const {
    const auto [first, second] = bridge_at(bridge).places;
    if (first == second) return site;
    const bool on_hole = site > first && site < second;
    if (bridge == first) return on_hole ? second - 1 : second + 1;
    return on_hole ? first + 1 : first - 1;
  }
  site::SmoothPlace smooth_place(std::uint32_t before, std::uint32_t after) const {
    return site::smooth_place(sites[before], sites[after]);
  }
};

/// The boundary before holes are connected: every loop a run of its own in the order of the shape's
/// loops (so `runs` are per loop here). An outer loop begins at a convex corner if it has one, or
/// else at the joint where its curvature is smallest; a hole at its furthest point in the direction
/// `outreach`: a reflex vertex, a smooth joint, or a place inside an arc, which is divided there. A
/// loop of one point is a vertex with the shape all around it, and without a neighbour.
Boundary loops_boundary(const Problem& problem, const SiteNumbers& numbers, Sides sides);

/// The angle from one direction to another, clockwise, in [0, 2 pi).
double clockwise_turn(Vec2 from, Vec2 to);

/// Whether c lies on the left of an edge and over its inside, up to rounding.
bool faces_edge(const site::Site& edge, Vec2 c);

/// Whether a direction lies between two others, from the first one clockwise, up to rounding.
bool in_wedge(Vec2 first, Vec2 last, Vec2 to);

}  // namespace medial::disks
