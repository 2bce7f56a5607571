#pragma once

// Pictures through Cairo: y upwards unless the document says otherwise, aspect kept, line widths by
// the picture's size.

#include "io/format.h"
#include "io/pictures/canvas.h"

namespace medial::io {

/// Shapes and axes: edges are drawn as what they are, straight lines and cubic Bezier curves that
/// equal the parabolas, coloured by radius (dark: thin, bright: thick). Errors: invalid_option
/// (width).
Status write_picture(Target& target, const AxesOutput& output);
Status write_picture(Target& target, const ShapesOutput& output);
/// The same with every face filled with a colour: segments' faces in light colours and reflex
/// vertices' in greys; the spokes thin.
Status write_picture(Target& target, const VoronoiOutput& output);
/// The same with polygons below the axes, lines and disks above them, a colour for each layer.
Status write_picture(Target& target, const LayersOutput& output);
Status write_picture(Target& target, const OffsetsOutput& output);
/// The cut from above, the deeper the darker, and the paths.
Status write_picture(Target& target, const CarvingOutput& output);
/// Shapes with their runs coloured by primitive, and their names.
Status write_picture(Target& target, const FeaturesOutput& output);
Status write_picture(Target& target, const FieldOutput& output);

// The parts of a picture of axes.

/// The edges, coloured by radius as a share of `largest`; curves as what they are.
void draw_axes(Canvas& canvas, const Document<AxisItem>& file, double largest);
/// About as many disks as asked for, at even distances along all axes.
void draw_disks(Canvas& canvas, const Document<AxisItem>& file, int count);
/// The feet of every node's disk on the sites of its edges, and the radii to them.
void draw_feet(Canvas& canvas, const Document<AxisItem>& file);
/// The nodes, coloured by kind.
void draw_nodes(Canvas& canvas, const Document<AxisItem>& file);
/// The attribute "title" of each item, below it.
void draw_titles(Canvas& canvas, const Document<AxisItem>& file);
void draw_polygons(Canvas& canvas, const Document<Layer>& layers);
void draw_lines_and_disks(Canvas& canvas, const Document<Layer>& layers);
/// Every face filled with a colour, and the spokes.
void draw_faces(Canvas& canvas, const Document<VoronoiItem>& file);
/// The sites of planar graphs.
void draw_sites(Canvas& canvas, const Document<VoronoiItem>& file);

}  // namespace medial::io
