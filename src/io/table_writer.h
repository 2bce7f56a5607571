#pragma once

#include "io/output.h"
#include "medial/io/write.h"
#include "medial/query.h"

namespace medial::io {

/// Writes `edge,x,y,r`, a row a sample; edges count through all items. Samples of an edge follow
/// each other, the nodes first and last; chords stay within options.chord of each item's diagonal.
/// Places of a local projection become longitudes and latitudes again; radii stay. Errors:
/// unsupported (a projection that cannot be undone).
Status write_csv(OutputStream& out, const Document<AxisItem>& file, const WriteOptions& options);

/// Writes a line of text for each item: a MULTILINESTRING of its branches. The
/// projection and errors as in write_csv().
Status write_wkt(OutputStream& out, const Document<AxisItem>& file, const WriteOptions& options);

/// The allowed deviation of chords for an item, in units of the input.
double chord_of(const AxisItem& item, const WriteOptions& options);

/// The samples of an edge with chords within `chord`, the nodes' own disks first and last. Into
/// `samples`, which spares an allocation for each edge.
void sample(const MedialAxis& axis, const Edge& edge, double chord, std::vector<Disk>& samples);

/// The samples of a branch, each node of it once.
std::vector<Disk> sample(const MedialAxis& axis, const Branch& branch, double chord);

}  // namespace medial::io
