#pragma once

// The verbs that describe, compare and compress shapes.

#include "cli/common.h"

namespace medial::cli {

Verb make_features_verb(CLI::App& program);
Verb make_match_verb(CLI::App& program);
Verb make_pack_verb(CLI::App& program);
Verb make_unpack_verb(CLI::App& program);

}  // namespace medial::cli
