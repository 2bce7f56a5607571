// Offsets every shape of a data folder (polygons, drawings, images, tables) inwards and outwards,
// and checks the curves: the distance of their points from the boundary, random points on both
// sides, nesting, and the number of rings against pixels.
//
//   medial_offsets [--fine] [--every N] FOLDER...
//
// With --every, each N-th feature of all files. With --fine, grids of up to 4800 pixels where 300
// do not tell the number of rings.
//
// Exit status: 0; 1 where a check failed; 2 for a wrong call; 77 (what ctest takes for a skipped
// test) where a folder does not exist.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "medial/compute.h"
#include "medial/query.h"
#include "support/corpus_cases.h"
#include "support/offset_check.h"

namespace medial::test {
namespace {

namespace fs = std::filesystem;

struct Row {
  std::size_t features = 0, curves = 0, rings = 0, points = 0, counted = 0, faults = 0;
  double largest_error = 0;  ///< by the size of the shape
};

/// Compares the number of rings of each level with pixels, by the first of these grids that can
/// tell how many there are.
template <class Fault>
void count_rings(const Shape& shape, const Offsets& offsets, std::vector<double> levels,
                 std::span<const std::size_t> grids, Row& row, const Fault& fault) {
  const Box box = bounding_box(shape);
  const double side = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  for (const std::size_t pixels : grids) {
    std::vector<double> slacks;
    for (const double level : levels)  // outwards the grid is larger
      slacks.push_back(3 * (side + 2 * std::max(-level, 0.0)) / static_cast<double>(pixels));
    const std::vector<bool> steady = are_steady(shape, levels, slacks);
    std::vector<double> left;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      if (!steady[i]) {
        left.push_back(levels[i]);
        continue;
      }
      const PixelCount found = count_by_pixels(shape, levels[i], pixels);
      std::size_t regions = 0, rings = 0;
      for (const OffsetRegion& region : offsets.regions) {
        if (region.clearance != levels[i]) continue;
        ++regions;
        rings += region.rings.size();
      }
      ++row.counted;
      if (found.regions != regions || found.rings != rings)
        fault(std::to_string(rings) + " rings, but " + std::to_string(found.rings) +
              " by pixels at " + std::to_string(levels[i]));
    }
    levels = std::move(left);
  }
}

/// Eight distances of a shape.
void examine(const Shape& shape, const std::string& name, std::span<const std::size_t> grids,
             Row& row) {
  const auto fault = [&](const std::string& text) {
    ++row.faults;
    std::printf("    FAULT %s: %s\n", name.c_str(), text.c_str());
  };
  const auto axis = compute(shape);
  if (!axis) return fault(to_string(axis.error()));
  const double deepest = deepest_disk(*axis).radius;
  std::vector<double> levels;
  for (const double share : {-1.0, -0.3, -0.05, 0.02, 0.1, 0.3, 0.6, 0.95})
    levels.push_back(share * deepest);
  const auto offsets = offset_curves(shape, levels);
  if (!offsets) return fault(to_string(offsets.error()));
  const Box box = bounding_box(shape);
  const double size = diagonal(box);
  const OffsetCheck check = check_offsets(shape, *offsets, 1, 20);
  ++row.features;
  row.curves += levels.size();
  row.points += check.points;
  row.largest_error = std::max(row.largest_error, check.largest_error / size);
  if (!check.fault.empty()) fault(check.fault);
  if (!(check.largest_error <= 1e-9 * size))
    fault("a point is " + std::to_string(check.largest_error / size) + " off");
  for (const OffsetRegion& region : offsets->regions) row.rings += region.rings.size();
  count_rings(shape, *offsets, levels, grids, row, fault);
}

int run(const std::vector<fs::path>& folders, std::size_t every, bool fine) {
  std::size_t number = 0;
  Row all;
  std::printf("%-58s %8s %7s %9s %10s %7s %9s %6s\n", "file", "features", "curves", "rings",
              "points", "counted", "error", "FAULTS");
  std::size_t faults = 0;
  for (const fs::path& folder : folders) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      for (const char* ending : {".wkt", ".wkt.gz", ".geojson", ".geojson.gz", ".dxf", ".dxf.gz",
                                 ".svg", ".png", ".tsv", ".txt"})
        if (entry.is_regular_file() && name.ends_with(ending) && name != "LIST.tsv")
          files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& path : files) {
      Row row;
      const std::vector<Case> cases = read_cases(path);
      for (const Case& one : cases) {
        if (number++ % every != 0 || one.error) continue;
        const auto shape = build_shape(one.rings);
        if (!shape) continue;
        constexpr std::array<std::size_t, 3> grids{300, 1200, 4800};
        examine(*shape, one.name, std::span(grids).first(fine ? grids.size() : 1), row);
      }
      if (row.features == 0) continue;
      std::printf("%-58s %8zu %7zu %9zu %10zu %7zu %9.1e %6zu\n",
                  fs::relative(path, folder).generic_string().c_str(), row.features, row.curves,
                  row.rings, row.points, row.counted, row.largest_error, row.faults);
      std::fflush(stdout);
      faults += row.faults;
      all.features += row.features;
      all.curves += row.curves;
      all.rings += row.rings;
      all.points += row.points;
      all.counted += row.counted;
      all.largest_error = std::max(all.largest_error, row.largest_error);
    }
  }
  std::printf("%-58s %8zu %7zu %9zu %10zu %7zu %9.1e %6zu\n", "all", all.features, all.curves,
              all.rings, all.points, all.counted, all.largest_error, faults);
  return faults == 0 ? 0 : 1;
}

}  // namespace
}  // namespace medial::test

int main(int count, char** arguments) {
  std::vector<std::filesystem::path> folders(arguments + 1, arguments + count);
  std::size_t every = 1;
  const auto given = std::find(folders.begin(), folders.end(), "--fine");
  const bool fine = given != folders.end();
  if (fine) folders.erase(given);
  if (folders.size() > 1 && folders[0] == "--every") {
    every = std::strtoull(folders[1].c_str(), nullptr, 10);
    folders.erase(folders.begin(), folders.begin() + 2);
  }
  if (folders.empty() || every == 0) {
    std::fprintf(stderr, "usage: medial_offsets [--fine] [--every N] FOLDER...\n");
    return 2;
  }
  for (const auto& folder : folders) {
    if (std::filesystem::is_directory(folder)) continue;
    std::printf("%s: no such folder: skipped\n", folder.c_str());
    return 77;
  }
  return medial::test::run(folders, every, fine);
}
