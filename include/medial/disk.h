#pragma once

#include "medial/vec2.h"

namespace medial {

/// A centre and a radius, in units of the input.
struct Disk {
  Vec2 center;
  double radius = 0;
};

}  // namespace medial
