#pragma once

// What holds for the axis of every polygon: the checks behind the property tests and `make fuzz`.

#include <string>
#include <vector>

#include "medial/axis.h"
#include "medial/verify.h"
#include "support/generate.h"

namespace medial::test {

/// What a certificate found, a line each.
inline std::string joined(const Certificate& certificate) {
  std::string text;
  for (const std::string& failure : certificate.failures) text += failure + "\n";
  return text;
}

/// Whether all arrays of sites, nodes and edges agree bit for bit.
bool identical(const MedialAxis& a, const MedialAxis& b);

/// What does not change when the shape is moved, mirrored or written down in another order. Nodes
/// nearer to each other than a fraction of the diagonal count as one: a tie may be one node of
/// degree four or two of degree three, by the last digit.
struct Invariants {
  std::size_t leaves = 0;
  std::size_t branching = 0;
  double length = 0;
  double deepest = 0;
};
Invariants invariants_of(const MedialAxis& axis, double diagonal);

/// build_shape() and compute() succeed and verify() is content. Empty, or a sentence each for what
/// does not hold.
std::vector<std::string> check_axis(const Rings& rings);

/// The axis is the same, byte for byte, for 1, 2 and 8 threads.
std::vector<std::string> check_threads(const Rings& rings);

/// Under every symmetry: the same deepest radius; under exact ones the same number of leaves; where
/// nothing about the shape depends on the last digits (`rigid`) the same graph and length.
std::vector<std::string> check_symmetries(const RandomShape& shape);

}  // namespace medial::test
