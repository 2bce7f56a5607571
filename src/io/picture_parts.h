#pragma once

// The parts of a picture of axes, each drawn by a file of its own.

#include "io/picture_pen.h"
#include "medial/io/layers.h"
#include "medial/io/write.h"

namespace medial::io {

/// The edges, coloured by radius as a share of `largest`; curves as what they are.
void draw_axes(Pen& pen, const Document<AxisItem>& file, double largest);
/// About as many disks as asked for, at even distances along all axes.
void draw_disks(Pen& pen, const Document<AxisItem>& file, int count);
/// The feet of every node's disk on the sites of its edges, and the radii to them.
void draw_contacts(Pen& pen, const Document<AxisItem>& file);
/// The nodes, coloured by kind.
void draw_nodes(Pen& pen, const Document<AxisItem>& file);
/// The attribute "title" of each item, below it.
void draw_titles(Pen& pen, const Document<AxisItem>& file);

/// Below the axes: polygons; above them: lines and disks, a colour for each layer.
void draw_polygons(Pen& pen, const LayerFile& file);
void draw_lines_and_disks(Pen& pen, const LayerFile& file);

/// Every face filled with a colour, and the spokes.
void draw_faces(Pen& pen, const Document<VoronoiItem>& file);
/// The sites of planar graphs.
void draw_sites(Pen& pen, const Document<VoronoiItem>& file);

}  // namespace medial::io
