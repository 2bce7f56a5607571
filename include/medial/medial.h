#pragma once

// The whole core library in one include.
#include "medial/axis.h"
#include "medial/brushfire.h"
#include "medial/compute.h"
#include "medial/contour.h"
#include "medial/curve_axis.h"
#include "medial/error.h"
#include "medial/field.h"
#include "medial/image.h"
#include "medial/prune.h"
#include "medial/query.h"
#include "medial/shape.h"
#include "medial/sides.h"
#include "medial/verify.h"
#include "medial/volume.h"
#include "medial/voronoi.h"
