#pragma once

// The shapes in the files of a data folder, for the programs that run all of them.

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "medial/io/read.h"
#include "medial/medial.h"
#include "support/wkt.h"

namespace medial::test {

/// One input shape, or the error that reading it gave.
struct Case {
  std::string name;
  std::vector<Ring> rings;
  std::optional<Error> error;
  std::optional<bool> valid;  ///< from its file, if stated there
};

inline std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, separator);) cells.push_back(cell);
  return cells;
}

/// Rows of a table with a header; polygons are in column `wkt`, GEOS's opinion in column `geos`.
inline std::vector<Case> read_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> header = split(line, '\t');
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  const std::size_t wkt = column("wkt"), geos = column("geos");
  std::vector<Case> cases;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = split(line, '\t');
    if (wkt >= cells.size()) continue;
    auto rings = rings_of_wkt(cells[wkt]);
    if (!rings) continue;  // lines and points
    Case one{cells[0], std::move(*rings), {}, {}};
    if (geos < cells.size()) one.valid = cells[geos] == "Valid Geometry";
    cases.push_back(std::move(one));
  }
  return cases;
}

/// Boost.Polygon's Voronoi inputs: the number of points, points, the number of segments, segments.
/// Segments that form closed outlines make one case; anything else makes none.
inline std::vector<Case> read_segments(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::size_t points = 0, segments = 0;
  if (!(file >> points)) return {};
  for (std::size_t i = 0; i < 2 * points; ++i) {
    double skipped = 0;
    file >> skipped;
  }
  if (points > 0 || !(file >> segments)) return {};
  using Point = std::array<double, 2>;
  std::map<Point, std::vector<Point>> neighbours;
  for (std::size_t i = 0; i < segments; ++i) {
    Point a{}, b{};
    file >> a[0] >> a[1] >> b[0] >> b[1];
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  if (!file || neighbours.empty()) return {};
  for (const auto& [point, others] : neighbours)
    if (others.size() != 2) return {};
  Case one{"outlines", {}, {}, {}};
  while (!neighbours.empty()) {
    Ring ring;
    Point at = neighbours.begin()->first, before = at;
    for (auto found = neighbours.find(at); found != neighbours.end(); found = neighbours.find(at)) {
      ring.points.push_back({at[0], at[1]});
      const Point next = found->second[0] != before ? found->second[0] : found->second[1];
      neighbours.erase(found);
      before = at;
      at = next;
    }
    one.rings.push_back(std::move(ring));
  }
  return {one};
}

/// The content of any file, with curves as arcs.
inline std::vector<Case> read_cases(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  if (name.ends_with(".tsv")) return read_table(path);
  if (name.ends_with(".txt")) return read_segments(path);
  auto dataset = io::read_document(path.string());
  // Lines and points are no input; a file of them makes no case.
  if (!dataset && dataset.error().code == ErrorCode::unsupported) return {};
  if (!dataset) return {{"file", {}, dataset.error(), {}}};
  std::vector<Case> cases;
  for (std::size_t i = 0; i < dataset->items.size(); ++i) {
    Case& one = cases.emplace_back();
    one.name = std::to_string(i);
    one.rings = std::move(dataset->items[i].rings);
    const auto arcs = approximate_by_arcs(dataset->items[i].contours, {.threads = 1});
    if (arcs)
      one.rings.insert(one.rings.end(), arcs->begin(), arcs->end());
    else
      one.error = arcs.error();
  }
  return cases;
}

}  // namespace medial::test
