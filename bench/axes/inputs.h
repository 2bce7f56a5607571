#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "medial/error.h"
#include "medial/shape.h"

namespace medial::bench {

enum class Family { coast, smooth, regular, comb, maze, holes };

/// An input by name; its rings are made or read when they are asked for, in the child process that
/// measures.
struct Input {
  std::string name;
  Family family;
  std::size_t vertices = 0;  ///< nominal
  std::function<Result<std::vector<Ring>>()> rings;
};

/// The inputs in the order of the table: all, or the smallest few of each family.
std::vector<Input> inputs(bool quick);

}  // namespace medial::bench
