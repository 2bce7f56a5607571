// Runs glyphs of fonts and features of drawings through the readers, approximate_by_arcs,
// build_shape, compute and verify, and prints a table.
//
//   medial_glyphs [--every N] [--save DIR] [--ends] PATH...
//
// PATH is a font (every character it has is a case), an .svg or .dxf drawing, packed or not (every
// feature is), or a folder of both. --every N takes each N-th glyph only. --save writes the rings
// of what fails and of what is refused (lines `x y bulge` at full precision). Exit status: 0; 1
// where a case failed; 2 for a wrong call; 77 (what ctest takes for a skipped test) where there is
// no font and no drawing.
//
// --ends compares the axes' ends with those a person would draw instead: one in each corner that
// turns by more than 15 degrees, none at other joints.

#include <ft2build.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/arc.h"
#include "medial/io/read.h"
#include "medial/medial.h"
#include "support/examine.h"
#include FT_FREETYPE_H

namespace medial::test {
namespace {

namespace fs = std::filesystem;

/// A slower glyph is a failure of its own.
constexpr double longest_seconds = 10;

struct Settings {
  std::vector<fs::path> paths;
  std::size_t every = 1;
  std::optional<fs::path> saved;
  bool ends = false;
};

/// Ends of axes at the boundary, by the corner angle that joints are smooth below.
struct Ends {
  double corner_angle = 0;
  std::size_t glyphs = 0, as_drawn = 0;
  std::size_t corners = 0;   ///< that a person would take for one
  std::size_t missed = 0;    ///< of these, without an end
  std::size_t whiskers = 0;  ///< ends elsewhere
};

struct Row {
  std::size_t cases = 0, verified = 0, refused = 0, failed = 0;
  std::map<std::string, std::size_t> codes;  ///< of the refused
  std::array<Ends, 5> ends{Ends{0.01}, Ends{1}, Ends{2}, Ends{4}, Ends{10}};
};

bool has_extension(const fs::path& path, std::initializer_list<const char*> extensions) {
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const char* extension) { return path.extension() == extension; });
}
bool is_font(const fs::path& path) { return has_extension(path, {".ttf", ".otf", ".ttc", ".pfb"}); }
bool is_drawing(const fs::path& path) {
  const bool packed = path.extension() == ".gz";
  return has_extension(packed ? path.stem() : path, {".svg", ".svgz", ".dxf", ".DXF"});
}

std::string utf8(unsigned long code) {
  const auto tail = [&](int shift) { return static_cast<char>(0x80 | ((code >> shift) & 0x3F)); };
  if (code < 0x80) return {static_cast<char>(code)};
  if (code < 0x800) return {static_cast<char>(0xC0 | (code >> 6)), tail(0)};
  if (code < 0x10000) return {static_cast<char>(0xE0 | (code >> 12)), tail(6), tail(0)};
  return {static_cast<char>(0xF0 | (code >> 18)), tail(12), tail(6), tail(0)};
}

/// One character for each glyph that the font's character map names.
std::vector<unsigned long> characters_of(const fs::path& font) {
  std::map<FT_UInt, unsigned long> by_glyph;
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  if (FT_Init_FreeType(&library) != 0) return {};
  if (FT_New_Face(library, font.c_str(), 0, &face) == 0) {
    FT_UInt glyph = 0;
    for (unsigned long code = FT_Get_First_Char(face, &glyph); glyph != 0;
         code = FT_Get_Next_Char(face, code, &glyph)) {
      if (code > ' ' && code != 0x7F) by_glyph.try_emplace(glyph, code);
    }
    FT_Done_Face(face);
  }
  FT_Done_FreeType(library);
  std::vector<unsigned long> codes;
  for (const auto& [glyph, code] : by_glyph) codes.push_back(code);
  return codes;
}

void save(const fs::path& folder, const std::string& name, const std::vector<Ring>& rings) {
  fs::create_directories(folder);
  std::FILE* file = std::fopen((folder / (name + ".txt")).c_str(), "w");
  if (file == nullptr) return;
  for (const Ring& ring : rings) {
    std::fprintf(file, "ring role %d\n", static_cast<int>(ring.role));
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      std::fprintf(file, "%.17g %.17g %.17g\n", ring.points[i].x, ring.points[i].y,
                   ring.bulges.empty() ? 0.0 : ring.bulges[i]);
    }
  }
  std::fclose(file);
}

Outcome refused_or_failed(const Error& error) {
  return {
      is_refusal(error.code) ? Verdict::refused : Verdict::failed, error.code, {to_string(error)}};
}

/// `arc_tolerance` in units of the input; 0: the default.
void examine_feature(const Feature& feature, double arc_tolerance, const std::string& name,
                     const Settings& settings, Row& row) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<Ring> rings = feature.rings;
  Outcome outcome;
  ArcOptions options{.threads = 1};
  if (arc_tolerance > 0) options = {.tolerance = arc_tolerance, .relative = false, .threads = 1};
  auto arcs = approximate_by_arcs(feature.contours, options);
  if (arcs) {
    rings.insert(rings.end(), arcs->begin(), arcs->end());
    outcome = examine(rings);
  } else {
    outcome = refused_or_failed(arcs.error());
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  if (spent.count() > longest_seconds) {
    outcome = {
        Verdict::failed, ErrorCode::internal, {"took " + std::to_string(spent.count()) + " s"}};
  }
  ++row.cases;
  const std::string reason = outcome.reasons.empty() ? "" : outcome.reasons[0];
  switch (outcome.verdict) {
    case Verdict::verified:
      ++row.verified;
      break;
    case Verdict::refused:
      ++row.refused;
      ++row.codes[name_of(outcome.code)];
      if (settings.saved) {
        std::printf("    refused %s: %s\n", name.c_str(), reason.c_str());
        save(*settings.saved, "refused_" + name, rings);
      }
      break;
    case Verdict::failed:
      ++row.failed;
      std::printf("    FAILED %s: %s\n", name.c_str(), reason.c_str());
      if (settings.saved) save(*settings.saved, name, rings);
      break;
  }
}

/// The convex corners that turn by more than 15 degrees.
std::vector<Vec2> drawn_corners(const Shape& shape) {
  const double sharp = 15 * std::numbers::pi / 180;
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const std::uint32_t begin = shape.loop_begin[i], end = shape.loop_begin[i + 1];
    for (std::uint32_t k = begin; k < end; ++k) {
      const std::uint32_t before = k == begin ? end - 1 : k - 1,
                          next = k + 1 == end ? begin : k + 1;
      const BulgeArc in{shape.points[before], shape.points[k], shape.bulge(before)};
      const BulgeArc out{shape.points[k], shape.points[next], shape.bulge(k)};
      if (signed_angle(end_tangent(in), start_tangent(out)) > sharp)
        corners.push_back(shape.points[k]);
    }
  }
  return corners;
}

/// Compares the ends of radius 0 with the corners. Leaves out glyphs that cannot be computed.
void compare_ends(Feature feature, Ends& ends) {
  Document<Feature> one;
  one.items.push_back(std::move(feature));
  const auto shapes = load_shapes(std::move(one));
  if (!shapes) return;
  const Shape& shape = shapes->items[0].shape;
  Options options;
  options.threads = 1;
  options.corner_angle = ends.corner_angle;
  const auto axis = compute(shape, options);
  if (!axis) return;
  const std::vector<Vec2> corners = drawn_corners(shape);
  const double near = 1e-6 * diagonal(bounding_box(shape));
  std::vector<Vec2> found;
  for (const Node& node : axis->nodes)
    if (node.kind == NodeKind::leaf && node.disk.radius < near) found.push_back(node.disk.center);
  const auto lacks = [near](const std::vector<Vec2>& places, Vec2 p) {
    return std::none_of(places.begin(), places.end(),
                        [&](Vec2 q) { return distance(p, q) < near; });
  };
  const auto count = [&lacks](const std::vector<Vec2>& of, const std::vector<Vec2>& in) {
    return static_cast<std::size_t>(
        std::count_if(of.begin(), of.end(), [&](Vec2 p) { return lacks(in, p); }));
  };
  const std::size_t missed = count(corners, found), whiskers = count(found, corners);
  ++ends.glyphs;
  ends.as_drawn += missed + whiskers == 0 ? 1 : 0;
  ends.corners += corners.size();
  ends.missed += missed;
  ends.whiskers += whiskers;
}

void examine_dataset(const Result<Document<Feature>>& dataset, const std::string& name,
                     const Settings& settings, Row& row) {
  if (dataset) {
    for (const Feature& feature : dataset->items)
      if (settings.ends) {
        ++row.cases;
        for (Ends& ends : row.ends) compare_ends(feature, ends);
      } else
        examine_feature(feature, dataset->arc_tolerance, name + "_" + std::to_string(feature.id),
                        settings, row);
    return;
  }
  ++row.cases;
  const Outcome outcome = refused_or_failed(dataset.error());
  ++(outcome.verdict == Verdict::refused ? row.refused : row.failed);
  if (outcome.verdict == Verdict::refused) ++row.codes[name_of(outcome.code)];
  if (outcome.verdict == Verdict::failed || settings.saved)
    std::printf("    %s %s: %s\n", outcome.verdict == Verdict::failed ? "FAILED" : "refused",
                name.c_str(), outcome.reasons[0].c_str());
}

Row examine_font(const fs::path& path, const Settings& settings) {
  Row row;
  const std::vector<unsigned long> characters = characters_of(path);
  for (std::size_t i = 0; i < characters.size(); i += settings.every) {
    char code[16];
    std::snprintf(code, sizeof code, "U+%04lX", characters[i]);
    const auto dataset = io::read_text(utf8(characters[i]), path.string());
    if (!dataset && dataset.error().code == ErrorCode::empty) continue;  // a space
    examine_dataset(dataset, path.stem().string() + "_" + code, settings, row);
  }
  return row;
}

/// The fonts and drawings at or below a path, in order.
std::vector<fs::path> files_at(const fs::path& path) {
  std::vector<fs::path> files;
  if (fs::is_regular_file(path)) files.push_back(path);
  if (fs::is_directory(path)) {
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.is_regular_file() && (is_font(entry.path()) || is_drawing(entry.path())))
        files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void print_ends(const std::string& name, const Row& row) {
  for (const Ends& ends : row.ends)
    std::printf("%-40s %6.2f %7zu %7.1f%% %8zu %7zu %9zu\n", name.c_str(), ends.corner_angle,
                ends.glyphs,
                100 * static_cast<double>(ends.as_drawn) /
                    static_cast<double>(std::max<std::size_t>(ends.glyphs, 1)),
                ends.corners, ends.missed, ends.whiskers);
  std::fflush(stdout);
}

void print(const std::string& name, const Row& row) {
  std::string codes;
  for (const auto& [code, count] : row.codes) codes += code + " " + std::to_string(count) + " ";
  std::printf("%-46s %8zu %8zu %8zu %7zu  %s\n", name.c_str(), row.cases, row.verified, row.refused,
              row.failed, codes.c_str());
  std::fflush(stdout);
}

int run(const Settings& settings) {
  if (settings.ends)
    std::printf("%-40s %6s %7s %8s %8s %7s %9s\n", "file", "angle", "glyphs", "as drawn", "corners",
                "missed", "whiskers");
  else
    std::printf("%-46s %8s %8s %8s %7s  %s\n", "file", "cases", "verified", "refused", "FAILED",
                "refused with");
  const auto print_row = settings.ends ? print_ends : print;
  Row all;
  for (const fs::path& path : settings.paths) {
    for (const fs::path& file : files_at(path)) {
      Row row;
      if (is_font(file))
        row = examine_font(file, settings);
      else
        examine_dataset(io::read_document(file.string()), file.stem().string(), settings, row);
      print_row(file.filename().string(), row);
      for (std::size_t i = 0; i < row.ends.size(); ++i) {
        Ends& sum = all.ends[i];
        const Ends& one = row.ends[i];
        for (const auto count :
             {&Ends::glyphs, &Ends::as_drawn, &Ends::corners, &Ends::missed, &Ends::whiskers})
          sum.*count += one.*count;
      }
      all.cases += row.cases;
      all.verified += row.verified;
      all.refused += row.refused;
      all.failed += row.failed;
      for (const auto& [code, count] : row.codes) all.codes[code] += count;
    }
  }
  if (all.cases == 0) {
    std::printf("no font and no drawing: skipped\n");
    return 77;
  }
  print_row("all", all);
  return all.failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace medial::test

int main(int count, char** arguments) {
  medial::test::Settings settings;
  bool understood = true;
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    if (argument == "--save" && i + 1 < count) {
      settings.saved = arguments[++i];
    } else if (argument == "--ends") {
      settings.ends = true;
    } else if (argument == "--every" && i + 1 < count) {
      const std::string value = arguments[++i];
      const auto [end, problem] =
          std::from_chars(value.data(), value.data() + value.size(), settings.every);
      understood &=
          problem == std::errc{} && end == value.data() + value.size() && settings.every > 0;
    } else {
      settings.paths.emplace_back(argument);
    }
  }
  if (!understood || settings.paths.empty()) {
    std::fprintf(stderr, "usage: medial_glyphs [--every N] [--save DIR] [--ends] PATH...\n");
    return 2;
  }
  return medial::test::run(settings);
}
