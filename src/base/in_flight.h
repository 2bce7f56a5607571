#pragma once

#include "medial/error.h"

namespace medial {

/// Turns the current exception into an error for the public functions: out_of_memory, or internal
/// with the exception's text. Call it in a handler: catch (...) { return error_in_flight(); }.
Error error_in_flight();

/// Returns the result of work(), or an error if it throws.
template <class Work>
auto guarded(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
