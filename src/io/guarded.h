#pragma once

#include <string>
#include <utility>

#include "base/in_flight.h"
#include "medial/error.h"

namespace medial::io {

/// Runs a reader or a writer of one file. What it throws becomes an error (out_of_memory,
/// internal), and every error names the file by the path that the caller gave: not by a name that
/// it has underway.
template <class Work>
auto guarded(const std::string& path, const Work& work) -> decltype(work()) {
  Error error;
  try {
    auto result = work();
    if (result) return result;
    error = std::move(result).error();
  } catch (...) {
    error = error_in_flight();
  }
  error.place.file = path;
  return error;
}

}  // namespace medial::io
