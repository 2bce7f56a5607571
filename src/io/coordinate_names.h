#pragma once

#include <string_view>

namespace medial::io {

/// The names of columns that hold coordinates, with commas between them, in lower case.
constexpr std::string_view x_names = "x,lon,long,lng,longitude,easting";
constexpr std::string_view y_names = "y,lat,latitude,northing";

}  // namespace medial::io
