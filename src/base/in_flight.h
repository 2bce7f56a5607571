#pragma once

#include "medial/error.h"

namespace medial {

/// The error that the exception in flight becomes at the library's surface: out_of_memory, or
/// internal with the exception's words. Requires a handler: catch (...) { return error_in_flight();
/// }.
Error error_in_flight();

/// What work() returns, or the error that it throws.
template <class Work>
auto guarded(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
