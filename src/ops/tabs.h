#pragma once

// Tool paths that leave tabs standing.

#include <vector>

#include "base/box_tree.h"
#include "medial/carve.h"

namespace medial::ops {

/// Lifts the paths of a carving over its tabs, only where the tool would cut into them. Exact to
/// 1e-8 of the tool's radius and a tab's width.
void spare_tabs(Carving& carving);

/// A tree of tabs, for finding the places within `reach` of them.
class TabTree {
 public:
  /// O(tabs log(tabs)).
  TabTree(const Tabs& tabs, double reach);
  double reach() const { return reach_; }
  /// The tabs whose reach may meet a box. O(log(tabs)) per tab.
  std::vector<const TabLine*> near(const Box& box) const;
  /// Whether a tab is nearer than the reach.
  bool reaches(Vec2 p) const;

 private:
  Tabs tabs_;
  double reach_;
  BoxTree tree_;
};

}  // namespace medial::ops
