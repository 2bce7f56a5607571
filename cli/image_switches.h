#pragma once

// What the verbs that take images share.

#include "cli/common.h"
#include "medial/io/image.h"

namespace medial::cli {

/// Adds --threshold and --invert; `options` must live as long as the verb.
void add_image_switches(CLI::App& verb, io::ImageOptions& options);

}  // namespace medial::cli
