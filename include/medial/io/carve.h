#pragma once

#include <string>
#include <vector>

#include "medial/carve.h"
#include "medial/error.h"
#include "medial/io/write.h"
#include "medial/shape.h"

namespace medial::io {

/// A shape and the paths that carve it.
struct CarveItem {
  Shape shape;
  Carving carving;
};

/// What a machine is told besides the paths. Lengths in units of the input, taken for millimetres.
struct MachineOptions {
  double safe = 5;      ///< height of moves between paths, positive
  double feed = 1000;   ///< of cutting moves, mm/min
  double plunge = 300;  ///< downwards, mm/min
  double spindle = 0;   ///< turns a minute; 0: the program says nothing of it
  /// How far chords may be off arcs where a format has none (.csv), see without_arcs(); 0: 1e-6 of
  /// the tool's radius at the bottom.
  double chord = 0;
};

/// Writes paths by the extension of `path`: .nc .gcode .ngc (plain G-code: G0 G1 G2 G3, absolute,
/// millimetres, XY plane, arcs by I and J, six decimals), .csv (path, kind, x, y, z), .dxf (space
/// polylines on a layer for each kind; passes at one depth as polylines with bulges and elevation),
/// .svg .pdf .png .ps (the cut: walls and bottoms shaded by depth, and the paths). Errors:
/// unsupported, unwritable, invalid_option.
Status write_carving(const std::string& path, const std::string& format,
                     const Document<CarveItem>& file, const MachineOptions& machine = {},
                     const WriteOptions& options = {});

/// The extensions write_carving() takes, for help texts.
std::string known_carve_formats();

}  // namespace medial::io
