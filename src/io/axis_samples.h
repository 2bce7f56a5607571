#pragma once

#include <vector>

#include "medial/io/write.h"
#include "medial/query.h"

namespace medial::io {

/// The allowed deviation of chords for an item, in units of the input.
double chord_of(const AxisItem& item, const WriteOptions& options);

/// The samples of an edge with chords within `chord`, the nodes' own disks first and last. Into
/// `samples`, which spares an allocation for each edge.
void sample(const MedialAxis& axis, const Edge& edge, double chord, std::vector<Disk>& samples);

/// The line of a branch as tables have it, its chords within `chord`; simplified within `simplify`
/// of the curve if that is positive (WriteOptions). Into `points`, to spare allocations.
void line_of(const MedialAxis& axis, const Branch& branch, double chord, double simplify,
             std::vector<Vec2>& points);

/// The samples of a branch, each node of it once.
std::vector<Disk> sample(const MedialAxis& axis, const Branch& branch, double chord);

}  // namespace medial::io
