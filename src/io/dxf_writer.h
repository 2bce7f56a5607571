#pragma once

#include "io/output.h"
#include "medial/io/read.h"
#include "medial/io/write.h"

namespace medial::io {

/// Writes axes as a drawing in DXF (AutoCAD 2000) on the layer AXIS: of each branch, runs of
/// straight edges as polylines and every other edge as the rational spline of degree 2 that it is,
/// without loss. With options.radius_as_z every edge is a spline whose z is the radius.
/// Errors: internal (a number is not finite).
Status write_dxf(OutputStream& out, const Document<AxisItem>& file, const WriteOptions& options);

}  // namespace medial::io
