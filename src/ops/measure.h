#pragma once

#include "medial/measure.h"

namespace medial::ops {

/// The width at a place, with the feet as seen along the edge or against it.
LocalWidth width_at(const MedialAxis& axis, EdgePlace place, bool forward = true);

}  // namespace medial::ops
