#pragma once

#include "medial/document.h"

namespace medial {

/// The options, with the tolerance that suits the kind of input where they name none.
inline ArcOptions suited_arcs(ArcOptions options, const DocumentInfo& input) {
  if (!options.tolerance && input.arc_tolerance > 0) {
    options.tolerance = input.arc_tolerance;
    options.relative = false;
  }
  return options;
}

}  // namespace medial
