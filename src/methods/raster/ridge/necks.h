#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"
#include "methods/raster/ridge/digitize.h"
#include "methods/raster/ridge/outline.h"

namespace medial::ridge {

/// Where the interior is too narrow for pixels of its own, as a graph.
///
/// The rows and columns of pixel centres cut the shape into cells: of each square between four
/// centres, the connected parts of the shape in it. Neighbouring cells share gates: pieces of a row
/// or column between two centres, or between a centre and the boundary. Around each centre inside
/// the shape four gates and four cells lie, a disk. So the shape is, up to homotopy, the complex
/// that has the cells as vertices, the gates as edges and the centres inside as faces, if no hole
/// lies within a cell. Faces of the boundary map's pixels are collapsed away together with gates
/// that nothing else holds, the shortest first. What is left are the sets of interior pixels,
/// and gates, edges without a face: necks between the sets, and channels that end blindly. Of
/// those, the branches longer than three pixels stay.
struct Necks {
  /// A piece of a row or column of pixel centres, in pixels.
  struct Gate {
    bool on_row = false;
    std::uint32_t line = 0;  ///< the row or column
    double low = 0, high = 0;
  };
  /// A cell in which gates and sets of interior pixels meet: two at least in all.
  struct Meeting {
    std::vector<std::uint32_t> gates;
    /// For each time that interior pixels come to the cell: the one to four at its corners, each
    /// beside the one before.
    std::vector<std::vector<raster::Pixel>> corners;
  };
  std::vector<Gate> gates;
  std::vector<Meeting> meetings;
  /// Pixels of the boundary map with no boundary on the ways to their four neighbours, from which
  /// nothing collapses: they belong to the interior.
  std::vector<raster::Pixel> undrawn;
  std::uint64_t hidden = 0;  ///< loops that lie within a cell: no pixel shows them
  std::uint64_t torn = 0;    ///< squares in which rounding, or chords for arcs, hide how loops lie
};

/// Finds the necks of the drawn boundary. Pixels that keep them from being found are taken from it,
/// until there are none: rarely more than a few times. O(b log b) time and O(b) memory, some 400
/// bytes each, for the b crossings of the boundary with rows and columns of pixels, and each time
/// O(b) and the scan of the bit maps.
Necks find_necks(const EdgeOutline& outline, const LocalGrid& local, raster::BitMap& boundary,
                 InteriorSets& sets);

}  // namespace medial::ridge
