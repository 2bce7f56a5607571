#pragma once

#include <string>

#include "io/output.h"
#include "medial/io/layers.h"
#include "medial/io/write.h"

namespace medial::io {

/// Draws shapes and axes through Cairo as svg, pdf, ps or png: y upwards, aspect kept, line widths
/// by the picture's size, edges coloured by radius (dark: thin, bright: thick). Edges are drawn as
/// what they are: straight lines, and cubic Bezier curves that equal the parabolas. Errors:
/// invalid_option (width), unwritable.
Status write_picture(OutputStream& out, const std::string& format, const Document<AxisItem>& file,
                     const WriteOptions& options);

/// The same with layers: polygons below the axes, lines and disks above them, a colour for each
/// layer.
Status write_layers_picture(OutputStream& out, const std::string& format, const LayerFile& file,
                            const Document<AxisItem>& background, const WriteOptions& options);

/// The same for Voronoi diagrams: every face filled with a colour, segments' faces in light colours
/// and reflex vertices' in greys; the spokes thin. The boundary is options.shape's.
Status write_voronoi_picture(OutputStream& out, const std::string& format,
                             const Document<VoronoiItem>& file, const WriteOptions& options);

}  // namespace medial::io
