// Shape, axis, and the shape again: rebuild(compute(shape)) of every feature of every file below
// the paths given (polygons, drawings, images, fonts) must be the shape, and prints a table by
// kind.
//
//   medial_roundtrips [--every N] PATH...
//
// --every N: only each N-th file and glyph. What build_shape() or compute() refuses is counted, not
// judged: medial_corpus and medial_glyphs do that. Exit status: 0; 1 where a shape did not come
// back; 2 for a wrong call; 77 (what ctest takes for a skipped test) where there is no file.

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "medial/io/read.h"
#include "medial/medial.h"
#include "medial/sides.h"
#include "medial/verify.h"

namespace medial::test {
namespace {

namespace fs = std::filesystem;

struct Settings {
  std::size_t every = 1;
  std::vector<fs::path> paths;
};

struct Row {
  std::size_t files = 0, features = 0, came_back = 0, refused = 0, failed = 0, vertices = 0;
  double worst = 0;  ///< of those that came back: Hausdorff distance by the diagonal
};

/// Coordinates have 53 bits, and an axis is good to a few thousand times the last.
constexpr double bound = 1e-9;

void examine(const Feature& feature, const std::string& name, Row& row) {
  ++row.features;
  const auto fail = [&](const std::string& reason) {
    ++row.failed;
    std::printf("    FAILED %s: %s\n", name.c_str(), reason.c_str());
  };
  std::vector<Ring> rings = feature.rings;
  const auto arcs = approximate_by_arcs(feature.contours, {.threads = 1});
  if (arcs) rings.insert(rings.end(), arcs->begin(), arcs->end());
  auto shape = arcs ? build_shape(rings) : Result<Shape>(arcs.error());
  auto axis = shape ? compute(*shape) : Result<MedialAxis>(shape.error());
  if (!axis) {
    ++row.refused;
    return;
  }
  const auto again = rebuild(*axis);
  if (!again) return fail(to_string(again.error()));
  row.vertices += shape->points.size();
  const double size = diagonal(bounding_box(*shape));
  const ShapeDistance apart = shape_distance(*again, *shape);
  const double far = apart.hausdorff() / size;
  const double area = std::abs(apart.area - apart.other_area) / (size * size);
  if (!(far <= bound && area <= bound))
    return fail("distance " + std::to_string(far / bound) + ", area " +
                std::to_string(area / bound) + " times what may be");
  if (again->hole_count() != shape->hole_count() ||
      again->component_count() != shape->component_count())
    return fail(std::to_string(again->component_count()) + " parts and " +
                std::to_string(again->hole_count()) + " holes, not " +
                std::to_string(shape->component_count()) + " and " +
                std::to_string(shape->hole_count()));
  ++row.came_back;
  row.worst = std::max(row.worst, far);
}

std::string extension(const fs::path& path) {
  std::string name = path.filename().string();
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  return fs::path(name).extension().string();
}

bool is_font(const fs::path& path) {
  const std::string ending = extension(path);
  return ending == ".ttf" || ending == ".otf" || ending == ".ttc";
}

void examine_all(const Result<Document<Feature>>& dataset, const std::string& name, Row& row) {
  if (!dataset) {
    if (dataset.error().code != ErrorCode::unsupported) ++row.refused;
    return;
  }
  for (std::size_t i = 0; i < dataset->items.size(); ++i)
    examine(dataset->items[i], name + " " + std::to_string(i), row);
}

void examine_font(const fs::path& font, std::size_t every, Row& row) {
  // Printable characters of Latin, Greek and Cyrillic.
  std::size_t count = 0;
  for (unsigned code = 0x21; code < 0x530; ++code) {
    if ((code >= 0x7F && code <= 0xA0) || count++ % every != 0) continue;
    const std::string text = code < 0x80 ? std::string{static_cast<char>(code)}
                                         : std::string{static_cast<char>(0xC0U | (code >> 6U)),
                                                       static_cast<char>(0x80U | (code & 0x3FU))};
    const auto dataset = io::read_text(text, font.string());
    if (!dataset) continue;  // no such glyph, or an empty one
    examine_all(dataset, font.filename().string() + " " + std::to_string(code), row);
  }
}

int run(const Settings& settings) {
  std::vector<fs::path> files;
  for (const fs::path& path : settings.paths) {
    std::error_code ignored;
    if (fs::is_regular_file(path, ignored)) files.push_back(path);
    if (!fs::is_directory(path, ignored)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.is_regular_file()) files.push_back(entry.path());
  }
  constexpr std::array<const char*, 5> known{".wkt", ".geojson", ".svg", ".dxf", ".png"};
  std::erase_if(files, [&](const fs::path& file) {
    return !is_font(file) && std::ranges::find(known, extension(file)) == known.end();
  });
  std::ranges::sort(files);
  if (files.empty()) {
    std::printf("no file: skipped\n");
    return 77;
  }
  std::map<std::string, Row> rows;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const fs::path& file = files[i];
    const bool font = is_font(file);
    if (!font && i % settings.every != 0) continue;
    Row& row = rows[extension(file)];
    ++row.files;
    if (font)
      examine_font(file, settings.every, row);
    else
      examine_all(io::read_document(file.string()), file.filename().string(), row);
    std::fflush(stdout);
  }
  std::printf("%-10s %6s %9s %10s %10s %8s %7s %9s\n", "kind", "files", "features", "vertices",
              "came back", "refused", "FAILED", "worst");
  std::size_t failed = 0;
  for (const auto& [kind, row] : rows) {
    std::printf("%-10s %6zu %9zu %10zu %10zu %8zu %7zu %9.1e\n", kind.c_str(), row.files,
                row.features, row.vertices, row.came_back, row.refused, row.failed, row.worst);
    failed += row.failed;
  }
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace medial::test

int main(int count, char** arguments) {
  medial::test::Settings settings;
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    if (argument != "--every") {
      settings.paths.emplace_back(argument);
      continue;
    }
    const std::string value = i + 1 < count ? arguments[++i] : "";
    std::from_chars(value.data(), value.data() + value.size(), settings.every);
    if (value.empty() || settings.every == 0) settings.paths.clear();
  }
  if (settings.paths.empty() || settings.every == 0) {
    std::fprintf(stderr, "usage: medial_roundtrips [--every N] PATH...\n");
    return 2;
  }
  return medial::test::run(settings);
}
