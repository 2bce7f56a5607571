#pragma once

#include <memory>

#include "io/format.h"

namespace medial::io {

/// By Format::write_parts, or as text by the writer of whole documents. `none` is a document
/// without items.
Result<std::unique_ptr<PartWriter>> writer_of_parts(Target& target, const Format& format,
                                                    const PartOutput& none);

/// Where nobody wants the items themselves.
std::unique_ptr<PartWriter> writer_of_nothing();

}  // namespace medial::io
