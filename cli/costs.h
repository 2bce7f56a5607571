#pragma once

#include "cli/common.h"

namespace medial::cli {

/// What --stats tells of every verb: its `seconds` by phase, `threads` and `peak_bytes`.
Json costs_of(const CommonSwitches& common, Json seconds);

/// Prints costs as a table on standard error where --stats asks for them and --json does not: then
/// they are members of its object.
void print_costs(const CommonSwitches& common, const Json& costs);

}  // namespace medial::cli
