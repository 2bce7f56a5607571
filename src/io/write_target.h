#pragma once

#include "io/format.h"

namespace medial::io {

/// What a document is, and how its file is named where it has no name.
struct Written {
  DocumentKind kind;
  const char* format;
  const char* name = "medial";
  std::string crs_wkt = {};
  Unit unit = Unit::unknown;
  bool overwrite = false;
  std::string layer = {};
};

/// The one way from a document to a file: looks the format up, decides on the reference system,
/// opens, has `write` write, and puts the file in its place.
Status write_target(const Destination& destination, const std::string& asked,
                    const Written& written,
                    const std::function<Status(Target& target, const Format& format)>& write);

}  // namespace medial::io
