#pragma once

#include <string>
#include <vector>

namespace medial::io {

struct Library {
  std::string name, version;
};
/// What medial::io is made of, for reports of problems.
struct BuildInfo {
  std::vector<Library> libraries;  ///< as they are loaded, which may be newer than those built with
  std::string extensions;          ///< read without GDAL, as ".json .svg"
  /// GDAL's names of the formats that it reads as features and as images.
  std::vector<std::string> vectors, rasters;
  bool projections = false;  ///< whether PROJ finds its database, which --project needs
};
BuildInfo build_info();

}  // namespace medial::io
