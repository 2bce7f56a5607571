#pragma once

// The whole core library in one include.
#include "medial/axis.h"
#include "medial/centreline.h"
#include "medial/compute.h"
#include "medial/contour.h"
#include "medial/error.h"
#include "medial/features.h"
#include "medial/match.h"
#include "medial/measure.h"
#include "medial/pack.h"
#include "medial/prune.h"
#include "medial/query.h"
#include "medial/rebuild.h"
#include "medial/shape.h"
#include "medial/shape_distance.h"
#include "medial/verify.h"
#include "medial/voronoi.h"
