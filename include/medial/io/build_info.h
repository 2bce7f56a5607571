#pragma once

// What medial::io is made of, for reports of problems.

#include <string>
#include <vector>

namespace medial::io {

struct Library {
  std::string name, version;
};

struct BuildInfo {
  std::vector<Library> libraries;  ///< as they are loaded, which may be newer than those built with
  std::string extensions;          ///< read without GDAL, as ".json .svg"
  std::vector<std::string> vectors;  ///< GDAL's names of the formats that it reads as features
  std::vector<std::string> rasters;  ///< ... and as images
  bool projections = false;          ///< whether PROJ finds its database, which --project needs
};

BuildInfo build_info();

}  // namespace medial::io
