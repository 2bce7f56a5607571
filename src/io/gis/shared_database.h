#pragma once

#include <memory>
#include <string>

#include "io/format.h"

namespace medial::io {

/// Copies an SQLite database as its last commit left it, whatever other programs do with it.
/// commit() then puts the copy's content back as one change of SQLite's own, which readers in other
/// programs see as any other. Errors: unwritable.
Result<std::unique_ptr<Addition>> begin_addition_to_database(const std::string& path,
                                                             const std::string& copy);

}  // namespace medial::io
