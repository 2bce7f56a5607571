#pragma once

// Shapes and axes of rings that have them; a test fails where they do not.

#include <gtest/gtest.h>

#include <utility>

#include "medial/compute.h"
#include "support/generate.h"

namespace medial::test {

inline Shape shape_of(const Rings& rings) {
  auto shape = build_shape(rings);
  EXPECT_TRUE(shape.ok()) << to_string(shape.error());
  return std::move(shape).value();
}

struct Computed {
  Shape shape;
  MedialAxis axis;
};

inline Computed computed(const Rings& rings) {
  Shape shape = shape_of(rings);
  auto axis = compute(shape, {.threads = 1});  // it is small: threads would wait for work
  EXPECT_TRUE(axis.ok()) << to_string(axis.error());
  return {std::move(shape), std::move(axis).value()};
}

inline MedialAxis axis_of(const Rings& rings) { return computed(rings).axis; }

}  // namespace medial::test
