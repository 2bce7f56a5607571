#pragma once

// One question for any input: a right result, a right refusal, or a fault? Behind the corpus and
// the fuzz program.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "medial/error.h"
#include "medial/shape.h"

namespace medial::test {

enum class Verdict {
  verified,  ///< the axis was computed and verify() is content
  refused,   ///< a typed error of the input's: see is_refusal()
  failed,    ///< anything else
};

struct Outcome {
  Verdict verdict = Verdict::verified;
  ErrorCode code = ErrorCode::internal;  ///< where it was refused
  std::vector<std::string> reasons;      ///< a sentence each, where it was refused or failed
};

/// Whether an error says that the input is at fault (or beyond what the library takes), rather than
/// that the library or the machine is.
bool is_refusal(ErrorCode code);

/// build_shape(), compute() and verify(), each with `threads` (0: all of the machine).
Outcome examine(std::span<const Ring> rings, int threads = 1);

/// What kind of failure an outcome is: the first reason's opening words without its numbers, so
/// that the same fault elsewhere is the same kind. Empty unless it failed.
std::string kind_of_failure(const Outcome& outcome);

/// A part of the rings that still fails: rings and points are left out, and digits dropped, as long
/// as `fails` holds and `budget` calls of it last. Requires fails(rings).
std::vector<Ring> reduced(std::vector<Ring> rings,
                          const std::function<bool(const std::vector<Ring>&)>& fails,
                          std::size_t budget);

}  // namespace medial::test
