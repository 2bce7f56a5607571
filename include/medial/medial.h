#pragma once

// The whole core library in one include; these headers include the others.
#include "medial/carve.h"
#include "medial/editor.h"
#include "medial/features.h"
#include "medial/load.h"
#include "medial/measure.h"
#include "medial/offset.h"
#include "medial/pack.h"
#include "medial/prune.h"
#include "medial/sides.h"
#include "medial/threads.h"
#include "medial/tiles.h"
#include "medial/verify.h"
#include "medial/volume.h"
#include "medial/voronoi.h"
