#pragma once

// Tabs: where they stand, and tool paths that spare them.

#include "medial/carve.h"

namespace medial::ops {

/// Lifts the paths of a carving over its tabs, as far as its tool would cut into them. Exact to
/// 1e-8 of the tool's radius and a tab's width.
void spare_tabs(Carving& carving);

/// The distance from the nearest tab; infinite without tabs.
double distance_to(const Tabs& tabs, Vec2 p);

}  // namespace medial::ops
