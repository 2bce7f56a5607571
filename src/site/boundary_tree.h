#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/memory.h"
#include "site/chord_boxes.h"
#include "site/lanes.h"
#include "site/site.h"

namespace medial::site {

/// An implicit tree over sites in boundary order. A block holds eight consecutive sites. A node
/// holds the boxes of four consecutive blocks or nodes, in single precision, rounded outward: one
/// cache line. Because the sites are in boundary order, an index range is a sub-shape, and the tree
/// of the whole boundary serves every sub-shape.
///
/// If these boxes overlap, as around slots and needles, each node also has a box along its sites.
/// If those overlap as well, as in spirals, the tree orders the sites by their places in the plane;
/// a search then skips the sites of a visited block that are outside its range.
///
/// Sites must lie in the local frame (absolute coordinates below 2). Sites far away from it belong
/// to no box and are never found; cuts are stored as such sites.
class BoundaryTree {
 public:
  /// Which nodes of a smooth boundary get boxes along its chords. More boxes make searches faster.
  /// Boxes of 8 sites take 6 bytes per site. If there are few searches, neither chord boxes nor an
  /// order in the plane pay off.
  enum class Chords : std::uint8_t { all, beyond_8_sites, none };
  /// Searches among more than `longest_range` sites may take longer.
  explicit BoundaryTree(std::span<const site::Site> sites, Chords chords = Chords::all,
                        std::size_t longest_range = ~std::size_t{0});

  struct Hit {
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    std::uint32_t site = none;
    double squared_distance = 0;
    explicit operator bool() const { return site != none; }
  };

  /// The site nearest to c among the sites first..last (inclusive), if it is nearer than `reach`;
  /// of sites at equal distance, the first. O(log n) expected.
  Hit nearest(Vec2 c, double reach, std::uint32_t first, std::uint32_t last) const;
  /// The same among all sites.
  Hit nearest(Vec2 c, double reach) const { return nearest(c, reach, 0, last_of_all()); }

  /// The same for sites that may coincide. Of sites at equal distance up to rounding, prefers one
  /// that has c on its left and the foot of c in its interior; vertices count as such.
  Hit nearest_facing(Vec2 c, double reach, std::uint32_t first, std::uint32_t last) const;

  /// All sites among first..last nearer than `reach`, by increasing index.
  void within(Vec2 c, double reach, std::uint32_t first, std::uint32_t last,
              std::vector<std::uint32_t>& found) const;

  /// All sites nearer than `reach`, in any order. Returns false, and stops, if there are more than
  /// `most`.
  bool few_within(Vec2 c, double reach, std::size_t most, std::vector<std::uint32_t>& found) const;

 private:
  static constexpr std::uint32_t block_size = 8;
  static constexpr std::uint32_t fan = ChordBoxes::fan;
  /// Shorter ranges are tested site by site, because testing boxes costs as much as a few sites.
  static constexpr std::uint32_t short_range = 2 * block_size;

  /// The chord boxes of a level's nodes; empty if few lanes have one.
  struct ChordLevel {
    WorkVector<ChordBoxes> boxes;
    double least_reach = 0;
    bool pay(double reach) const { return !boxes.empty() && reach >= least_reach; }
  };
  struct Fitting {
    std::size_t lanes = 0;  ///< number of lanes with a box
    std::size_t flat = 0;   ///< number of those whose box is flat
  };

  void build_boxes();
  bool boxes_overlap(std::uint32_t lowest) const;
  bool boxes_overlap_on(std::size_t level) const;
  double areas_of(std::size_t level, std::size_t node) const;
  void build_boxes_along(std::uint32_t lowest);
  void set_boxes_along(std::uint32_t lowest);
  void build_chord_boxes(std::uint32_t lowest);  ///< from this level on
  void set_chord_boxes(std::size_t level, std::size_t node, ChordBoxes& boxes,
                       Fitting& fitting) const;

  /// The range, in the tree's order, of the sites below a node's lane.
  struct Positions {
    std::size_t begin, count;
  };
  Positions positions(std::size_t level, std::size_t node, std::size_t lane) const {
    const std::size_t span = span_of(level);
    const std::size_t begin = std::min((node * fan + lane) * span, sites_.size());
    return {begin, std::min(span, sites_.size() - begin)};
  }
  /// The number of sites below a lane of a level.
  static std::size_t span_of(std::size_t level) { return std::size_t{block_size} << (2 * level); }
  std::uint32_t last_of_all() const { return static_cast<std::uint32_t>(sites_.size() - 1); }

  /// Calls look_at(i, is_reached) for the sites first..last that may be no farther from c than the
  /// root of squared(). `is_reached`: this is certain. Without arcs, tests two sites at a time.
  template <class Squared, class LookAt>
  void look_at_each(Vec2 c, std::uint32_t first, std::uint32_t last, const Squared& squared,
                    const LookAt& look_at) const;
  /// The order in which nodes are visited.
  enum class Order : std::uint8_t { nearest_first, in_turn };
  /// The sites first..last of a block.
  template <class Visit>
  void visit_block(std::uint32_t index, std::uint32_t first, std::uint32_t last,
                   Visit&& visit) const;
  /// Whether a waiting node is out of reach by now. For nodes of many sites, the test pays off.
  bool is_beyond(std::uint32_t level, std::uint32_t index, Vec2 c, double reach) const;
  template <Order order, class Visit>
  void visit_blocks(Vec2 c, double& reach, std::uint32_t first, std::uint32_t last,
                    Visit&& visit) const;

  std::span<const site::Site> sites_;
  std::size_t longest_range_;
  bool has_arcs_ = false;
  WorkVector<std::uint32_t> in_plane_;     ///< sites, block by block; empty: boundary order
  std::vector<WorkVector<Boxes>> levels_;  ///< levels_[0]: of blocks; none of few sites
  std::vector<ChordLevel> chords_;         ///< of the lowest levels, or of all
};

}  // namespace medial::site
