// Bytes to a file of every format that is read, for libFuzzer: `make fuzz-coverage`.
//
// The first byte chooses the extension, by a letter. Whatever a file holds, it is read or refused
// by a typed error; errors that are the library's own fault, crashes and leaks count.

#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "medial/io/read.h"
#include "medial/medial.h"

namespace {

namespace io = medial::io;

struct Extension {
  char letter;
  const char* text;
};
constexpr std::array extensions{
    Extension{'j', ".json"}, Extension{'g', ".geojson"},    Extension{'w', ".wkt"},
    Extension{'c', ".csv"},  Extension{'x', ".xy"},         Extension{'d', ".dxf"},
    Extension{'s', ".svg"},  Extension{'k', ".mpk"},        Extension{'b', ".pbm"},
    Extension{'m', ".pgm"},  Extension{'n', ".png"},        Extension{'o', ".obj"},
    Extension{'f', ".off"},  Extension{'l', ".stl"},        Extension{'y', ".ply"},
    Extension{'i', ".tif"},  Extension{'q', ".gpkg"},       Extension{'a', ".fgb"},
    Extension{'p', ".shp"},  Extension{'t', ".safetensors"}};

const char* extension_of(std::uint8_t byte) {
  for (const Extension& each : extensions)
    if (each.letter == static_cast<char>(byte)) return each.text;
  return extensions[byte % extensions.size()].text;
}

template <class Outcome>
void expect_typed(const Outcome& outcome) {
  if (outcome || outcome.error().code != medial::ErrorCode::internal) return;
  std::fprintf(stderr, "%s\n", to_string(outcome.error()).c_str());
  std::abort();
}

void read_all(const std::string& path, const std::string& extension) {
  if (extension == ".mpk") {
    const auto pack = io::read_pack(path);
    expect_typed(pack);
    if (pack) expect_typed(io::native_of(*pack));
    return;
  }
  if (extension == ".obj" || extension == ".off" || extension == ".stl" || extension == ".ply") {
    expect_typed(io::read_mesh(path));
    return;
  }
  if (io::is_image(path)) {
    expect_typed(io::read_image(path));
    return;
  }
  if (io::is_native(path)) {
    expect_typed(io::read_native(path));
    return;
  }
  if (io::is_voronoi(path)) {
    expect_typed(io::read_voronoi(path));
    return;
  }
  expect_typed(io::load_shapes(path));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string extension = extension_of(data[0]);
  static const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("medial_readers_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::filesystem::path path = folder / ("input" + extension);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
  read_all(path.string(), extension);
  std::filesystem::remove(path);
  return 0;
}
