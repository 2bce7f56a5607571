#include <fmt/format.h>
#include <ft2build.h>
#include <libxml/xmlstring.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <set>

#include "io/guarded.h"
#include "io/path_builder.h"
#include "io/place.h"
#include "medial/io/read.h"
#include FT_FREETYPE_H
#include FT_OUTLINE_H

namespace medial::io {

namespace {

struct Character {
  FT_ULong code = 0;
  std::string text;  ///< in UTF-8
};

/// Whether a code is a character of Unicode, in as few bytes as UTF-8 takes for it.
bool is_character(int code, int length) {
  const int shortest = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code >= 0 && code <= 0x10FFFF && !surrogate && length == shortest;
}

Result<std::vector<Character>> characters_of(const std::string& text) {
  std::vector<Character> result;
  for (std::size_t at = 0; at < text.size();) {
    int length = static_cast<int>(std::min<std::size_t>(text.size() - at, 4));
    const auto* bytes = reinterpret_cast<const unsigned char*>(text.data() + at);
    const int code = xmlGetUTF8Char(bytes, &length);
    if (!is_character(code, length)) {
      return Error{ErrorCode::malformed, fmt::format("byte {} of the text is not UTF-8", at), {}};
    }
    if (code < ' ' || code == 0x7F) {
      return Error{ErrorCode::malformed,
                   fmt::format("byte {} of the text is a control character, such as the end of a "
                               "line: a text is one line",
                               at),
                   {}};
    }
    const auto count = static_cast<std::size_t>(length);
    result.push_back({static_cast<FT_ULong>(code), text.substr(at, count)});
    at += count;
  }
  return result;
}

/// Contours in the making. A glyph's outline is closed by definition.
struct GlyphPen {
  std::vector<Contour> contours;
  RingRole role = RingRole::winding;
  Vec2 origin;
  double unit = 1;  ///< of the font

  Vec2 at(const FT_Vector* point) const {
    return unit * (origin + Vec2{static_cast<double>(point->x), static_cast<double>(point->y)});
  }
  static GlyphPen& of(void* user) { return *static_cast<GlyphPen*>(user); }

  static int move_to(const FT_Vector* to, void* user) {
    GlyphPen& pen = of(user);
    pen.contours.emplace_back().role = pen.role;
    pen.contours.back().start_at(pen.at(to));
    return 0;
  }
  static int line_to(const FT_Vector* to, void* user) {
    GlyphPen& pen = of(user);
    pen.contours.back().line_to(pen.at(to));
    return 0;
  }
  static int conic_to(const FT_Vector* a, const FT_Vector* to, void* user) {
    GlyphPen& pen = of(user);
    pen.contours.back().bezier_to(std::array{pen.at(a), pen.at(to)});
    return 0;
  }
  static int cubic_to(const FT_Vector* a, const FT_Vector* b, const FT_Vector* to, void* user) {
    GlyphPen& pen = of(user);
    pen.contours.back().bezier_to(std::array{pen.at(a), pen.at(b), pen.at(to)});
    return 0;
  }
};

using FreeType = std::unique_ptr<FT_LibraryRec_, decltype(&FT_Done_FreeType)>;
using Face = std::unique_ptr<FT_FaceRec_, decltype(&FT_Done_Face)>;

Result<Face> open_face(FT_Library library, const std::string& path) {
  if (std::FILE* file = std::fopen(path.c_str(), "rb"); file != nullptr) {
    std::fclose(file);
  } else {
    return Error{ErrorCode::unreadable,
                 fmt::format("there is no such font ({}): --font takes the file of a font, such as "
                             "`fc-match -f %{{file}} NAME` prints",
                             std::strerror(errno)),
                 {}};
  }
  FT_Face face = nullptr;
  const FT_Error problem = FT_New_Face(library, path.c_str(), 0, &face);
  if (problem == FT_Err_Unknown_File_Format) {
    return Error{ErrorCode::unsupported, "this is not a font that FreeType can read", {}};
  }
  if (problem != 0) {
    return Error{
        ErrorCode::malformed, fmt::format("FreeType cannot read it (error {})", problem), {}};
  }
  Face result(face, &FT_Done_Face);
  if (!FT_IS_SCALABLE(face)) {
    return Error{ErrorCode::unsupported, "the font has bitmaps but no outlines", {}};
  }
  return result;
}

Result<Document<Feature>> set_text(const std::vector<Character>& characters, FT_Face face,
                                   double size) {
  static const FT_Outline_Funcs functions{
      &GlyphPen::move_to, &GlyphPen::line_to, &GlyphPen::conic_to, &GlyphPen::cubic_to, 0, 0};
  Document<Feature> dataset;
  dataset.corner_angle = font_corner_angle;
  dataset.text_attributes = {"character"};
  const double unit = size > 0 ? size / face->units_per_EM : 1;
  dataset.arc_tolerance = unit * font_arc_tolerance;
  std::set<std::string> missing;
  double x = 0;
  FT_UInt before = 0;
  for (std::size_t i = 0; i < characters.size(); ++i) {
    const FT_UInt glyph = FT_Get_Char_Index(face, characters[i].code);
    if (glyph == 0) missing.insert(characters[i].text);
    FT_Vector kerning{};
    if (before != 0 && FT_Get_Kerning(face, before, glyph, FT_KERNING_UNSCALED, &kerning) == 0) {
      x += static_cast<double>(kerning.x);
    }
    if (const FT_Error problem = FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE); problem != 0) {
      return Error{ErrorCode::malformed,
                   fmt::format("FreeType cannot load the glyph of '{}' (error {})",
                               characters[i].text, problem),
                   in_feature(i)};
    }
    FT_GlyphSlot slot = face->glyph;
    if (slot->format == FT_GLYPH_FORMAT_OUTLINE && slot->outline.n_contours > 0) {
      GlyphPen pen;
      pen.origin = {x, 0};
      pen.unit = unit;
      if ((slot->outline.flags & FT_OUTLINE_EVEN_ODD_FILL) != 0) pen.role = RingRole::any;
      if (FT_Outline_Decompose(&slot->outline, &functions, &pen) != 0) {
        return Error{ErrorCode::malformed,
                     fmt::format("the outline of '{}' is broken", characters[i].text),
                     in_feature(i)};
      }
      std::erase_if(pen.contours, is_degenerate);
      if (!pen.contours.empty()) {
        Feature& feature = dataset.items.emplace_back();
        feature.contours = std::move(pen.contours);
        feature.filled = true;
        feature.id = static_cast<std::int64_t>(i);
        feature.attributes = {{"character", characters[i].text},
                              {"position", fmt::format("{}", i)}};
      }
    }
    x += static_cast<double>(slot->advance.x);
    before = glyph;
  }
  for (const std::string& text : missing) {
    dataset.notes.push_back(fmt::format("the font has no '{}' and draws its replacement", text));
  }
  if (dataset.items.empty()) {
    return Error{ErrorCode::empty, "no character of the text has an outline", {}};
  }
  return dataset;
}

}  // namespace

Result<Document<Feature>> read_text(const std::string& text, const std::string& font, double size) {
  return guarded(font, [&]() -> Result<Document<Feature>> {
    Result<std::vector<Character>> characters = characters_of(text);
    if (!characters) return characters.error();
    FT_Library raw = nullptr;
    if (FT_Init_FreeType(&raw) != 0) {
      return Error{ErrorCode::internal, "FreeType cannot be started", {}};
    }
    const FreeType library(raw, &FT_Done_FreeType);
    Result<Face> face = open_face(raw, font);
    if (!face) return face.error();
    return set_text(*characters, face->get(), size);
  });
}

}  // namespace medial::io
