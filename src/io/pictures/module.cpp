#include <cairo.h>
#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#ifdef MEDIAL_MESH
#include <assimp/version.h>
#endif

#include "io/modules.h"

namespace medial::io {
namespace {

std::string freetype_version() {
  FT_Library library = nullptr;
  if (FT_Init_FreeType(&library) != 0) return "does not start";
  int major = 0, minor = 0, patch = 0;
  FT_Library_Version(library, &major, &minor, &patch);
  FT_Done_FreeType(library);
  return fmt::format("{}.{}.{}", major, minor, patch);
}

}  // namespace

Attributes drawing_libraries() {
  return {
      {"Cairo", cairo_version_string()},
      {"FreeType", freetype_version()},
#ifdef MEDIAL_MESH
      {"Assimp",
       fmt::format("{}.{}.{}", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch())},
#endif
  };
}

extern "C" {
extern const DrawModule medial_draw_table;
const DrawModule medial_draw_table{MEDIAL_STAMP, drawing_libraries, formats_at_hand, read_text};
}

}  // namespace medial::io
