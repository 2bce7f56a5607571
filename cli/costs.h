#pragma once

#include "cli/common.h"

namespace medial::cli {

/// What --stats tells of every command: its `seconds` by phase, `threads` and `peak_bytes`.
Json costs_of(const CommonOptions& common, Json seconds);

/// Prints costs as a table on standard error where --stats asks for them and --json does not: then
/// they are members of its object.
void print_costs(const CommonOptions& common, const Json& costs);

/// The end of a run of a command that writes one file: tells what it made, as the arguments ask.
/// With
/// --json that is `object`, with the costs; otherwise `line`, on standard output where nothing else
/// was written, or for who sits at a terminal.
Status tell(const CommonOptions& common, const std::string& output, Json object, const Json& costs,
            const std::string& line);

}  // namespace medial::cli
