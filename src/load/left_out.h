#pragma once

#include <string>

#include "medial/error.h"

namespace medial {

/// On a feature that an error names.
inline std::string note_of_left_out(const Error& error) { return "left out: " + to_string(error); }

}  // namespace medial
