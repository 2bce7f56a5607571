#pragma once

// What the command line says about itself: help pages, what is wrong with a line, completion.

#include <string>
#include <vector>

#include "cli/common.h"

namespace medial::cli {

/// Names the program and gives it help pages, which the commands added after that inherit: examples
/// first, options that many commands share by name only; --help-all describes these as well.
void describe_program(CLI::App& program);
/// Has the help options of the commands count wherever they stand, whatever else is wrong.
void heed_help_anywhere(CLI::App& program);

/// The command of a name or an alias; null: none.
CLI::App* find_command(CLI::App& program, const std::string& name);

/// The one of `known` that a mistyped word most likely stands for; empty if none is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

/// What is wrong with a command line, in words for whoever typed it, and where to read more.
struct Complaint {
  std::string text, hint;
};
Complaint explain(const CLI::ParseError& error, const CLI::App& program);

}  // namespace medial::cli
