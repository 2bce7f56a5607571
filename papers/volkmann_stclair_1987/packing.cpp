// Nesting, the motive of Volkmann and St. Clair (1987, Section I): parts on a strip, laid as they
// are, and with bays and peninsulas paired.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>

#include "io/ring_text.h"
#include "medial/features.h"
#include "medial/io/read.h"
#include "papers/figure.h"
#include "papers/table.h"
#include "papers/volkmann_stclair_1987/volkmann.h"

namespace medial::papers {
namespace {

constexpr double part_size = 60;     ///< the square root of a part's area, in cells
constexpr double strip_width = 512;  ///< in cells
constexpr std::size_t most_parts = 50;

/// Parts that are laid as one.
struct Body {
  std::vector<Shape> shapes;

  Box box() const {
    Box box = Box::nothing();
    for (const Shape& shape : shapes) {
      const Box own = bounding_box(shape);
      box.add(own.low);
      box.add(own.high);
    }
    return box;
  }
};

Shape moved(const Shape& shape, double angle, Vec2 by) {
  Placement at;
  at.angle = angle;
  at.move = by;
  return placed(shape, at);
}

/// The largest ring of a shape, arcs as chords, part_size in size, about the origin.
std::optional<Shape> part_of(const Shape& shape) {
  std::optional<Shape> largest;
  const Box whole = bounding_box(shape);
  for (const Ring& ring : rings_of(shape)) {
    const Ring chords{io::chords_of(ring, 1e-2 * (whole.high.x - whole.low.x))};
    const auto one = build_shape({&chords, 1});
    if (one && (!largest || area(*one) > area(*largest))) largest = *one;
  }
  if (!largest) return std::nullopt;
  const Box box = bounding_box(*largest);
  const Vec2 middle = 0.5 * (box.low + box.high);
  const double scale = part_size / std::sqrt(area(*largest));
  std::vector<Ring> rings = rings_of(*largest);
  for (Ring& ring : rings)
    for (Vec2& p : ring.points) p = scale * (p - middle);
  auto scaled = build_shape(rings);
  return scaled ? std::optional(std::move(*scaled)) : std::nullopt;
}

/// The first parts of a folder's drawings, by name, that fit the strip.
std::vector<Shape> parts_of(const std::filesystem::path& folder, std::size_t count) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".svg") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Shape> parts;
  for (const auto& path : paths) {
    if (parts.size() == count) break;
    const auto file = io::load_shapes(path.string());
    if (!file || file->items.empty()) continue;
    const auto part = part_of(file->items.front().shape);
    if (!part) continue;
    const Box box = bounding_box(*part);
    const double longest = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
    if (longest < 4 * part_size) parts.push_back(*part);
  }
  return parts;
}

// ---- Bottom left --------------------------------------------------------------------------------

/// Cells that a body covers, or its outline meets; the lowest row first.
struct Mask {
  std::vector<std::vector<bool>> rows;
  Vec2 low;  ///< the low corner of the first cell

  std::size_t width() const { return rows.empty() ? 0 : rows[0].size(); }
};

Mask mask_of(const Body& body) {
  const Box box = body.box();
  Mask mask;
  mask.low = {std::floor(box.low.x), std::floor(box.low.y)};
  const auto width = static_cast<std::size_t>(std::floor(box.high.x) - mask.low.x) + 1;
  const auto height = static_cast<std::size_t>(std::floor(box.high.y) - mask.low.y) + 1;
  mask.rows.assign(height, std::vector<bool>(width));
  for (const Shape& shape : body.shapes) {
    std::vector<std::vector<double>> crossings(height);  // of the middle line of each row
    for (const Ring& ring : rings_of(shape)) {
      for (std::size_t i = 0; i < ring.points.size(); ++i) {
        const Vec2 a = ring.points[i] - mask.low;
        const Vec2 b = ring.points[(i + 1) % ring.points.size()] - mask.low;
        const auto steps = static_cast<int>(std::ceil(8 * distance(a, b))) + 1;
        for (int k = 0; k <= steps; ++k) {
          const Vec2 p = a + static_cast<double>(k) / steps * (b - a);
          mask.rows[std::min(height - 1, static_cast<std::size_t>(p.y))]
                   [std::min(width - 1, static_cast<std::size_t>(p.x))] = true;
        }
        for (auto y = static_cast<std::size_t>(std::max(0.0, std::ceil(std::min(a.y, b.y) - 0.5)));
             y < height && static_cast<double>(y) + 0.5 < std::max(a.y, b.y); ++y)
          crossings[y].push_back(a.x +
                                 (static_cast<double>(y) + 0.5 - a.y) / (b.y - a.y) * (b.x - a.x));
      }
    }
    for (std::size_t y = 0; y < height; ++y) {
      std::sort(crossings[y].begin(), crossings[y].end());
      for (std::size_t k = 0; k + 1 < crossings[y].size(); k += 2)
        for (auto x = static_cast<std::size_t>(crossings[y][k]);
             x < width && static_cast<double>(x) < crossings[y][k + 1]; ++x)
          mask.rows[y][x] = true;
    }
  }
  return mask;
}

/// A strip of cells, filled from below.
class Strip {
 public:
  bool fits(const Mask& mask, std::size_t x, std::size_t y) const {
    for (std::size_t j = 0; j < mask.rows.size() && y + j < rows_.size(); ++j)
      for (std::size_t i = 0; i < mask.width(); ++i)
        if (mask.rows[j][i] && rows_[y + j][x + i]) return false;
    return true;
  }
  /// The lowest place, of those the leftmost.
  std::pair<std::size_t, std::size_t> place(const Mask& mask) const {
    const auto width = static_cast<std::size_t>(strip_width);
    for (std::size_t y = 0;; ++y)
      for (std::size_t x = 0; x + mask.width() <= width; ++x)
        if (fits(mask, x, y)) return {x, y};
  }
  void add(const Mask& mask, std::size_t x, std::size_t y) {
    if (rows_.size() < y + mask.rows.size())
      rows_.resize(y + mask.rows.size(), std::vector<bool>(static_cast<std::size_t>(strip_width)));
    for (std::size_t j = 0; j < mask.rows.size(); ++j)
      for (std::size_t i = 0; i < mask.width(); ++i)
        if (mask.rows[j][i]) rows_[y + j][x + i] = true;
  }
  double height() const { return static_cast<double>(rows_.size()); }

 private:
  std::vector<std::vector<bool>> rows_;
};

struct Packing {
  std::vector<Shape> shapes;
  double height = 0, density = 0;
};

Body turned(const Body& body, int quarters) {
  Body result;
  for (const Shape& shape : body.shapes)
    result.shapes.push_back(moved(shape, quarters * std::numbers::pi / 2, {}));
  return result;
}

double area_of(const Body& body) {
  double sum = 0;
  for (const Shape& shape : body.shapes) sum += area(shape);
  return sum;
}

/// Each body in turn, the longest first, by the quarter turn that keeps its top lowest.
Packing bottom_left(std::vector<Body> bodies) {
  const auto side = [](const Body& body) {
    const Box box = body.box();
    return std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  };
  std::stable_sort(bodies.begin(), bodies.end(),
                   [&](const Body& a, const Body& b) { return side(a) > side(b); });
  Strip strip;
  Packing packing;
  double covered = 0;
  for (const Body& body : bodies) {
    double lowest = std::numeric_limits<double>::infinity();
    Mask best;
    Body chosen;
    std::pair<std::size_t, std::size_t> at;
    for (int quarters = 0; quarters < 4; ++quarters) {
      Body one = turned(body, quarters);
      Mask mask = mask_of(one);
      if (static_cast<double>(mask.width()) > strip_width) continue;
      const auto place = strip.place(mask);
      const double top = static_cast<double>(place.second + mask.rows.size());
      if (top >= lowest) continue;
      lowest = top;
      at = place;
      best = std::move(mask);
      chosen = std::move(one);
    }
    strip.add(best, at.first, at.second);
    const Vec2 by = Vec2{static_cast<double>(at.first), static_cast<double>(at.second)} - best.low;
    for (const Shape& shape : chosen.shapes) packing.shapes.push_back(moved(shape, 0, by));
    covered += area_of(body);
  }
  packing.height = strip.height();
  packing.density = covered / (strip_width * packing.height);
  return packing;
}

// ---- Pairs --------------------------------------------------------------------------------------

struct Pair {
  std::size_t first, second;
  Placement at;
};

/// The pairs that save most, each part in one pair at most.
std::vector<Body> paired(const std::vector<Shape>& parts, double least_saved, std::size_t& pairs) {
  std::vector<Pair> found;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    progress(fmt::format("nesting part {}", i));
    for (std::size_t j = i + 1; j < parts.size(); ++j) {
      const auto best = nest(parts[i], parts[j], 0.5, true, 1);
      if (best && !best->empty() && best->front().saved > least_saved)
        found.push_back({i, j, best->front()});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Pair& a, const Pair& b) { return a.at.saved > b.at.saved; });
  std::vector<bool> used(parts.size());
  std::vector<Body> bodies;
  for (const Pair& pair : found) {
    if (used[pair.first] || used[pair.second]) continue;
    used[pair.first] = used[pair.second] = true;
    bodies.push_back({{parts[pair.first], placed(parts[pair.second], pair.at)}});
  }
  pairs = bodies.size();
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!used[i]) bodies.push_back({{parts[i]}});
  return bodies;
}

Status draw(const Packing& left, const Packing& right, const std::filesystem::path& path) {
  const double gap = 40, height = std::max(left.height, right.height);
  Figure figure({{0, 0}, {2 * strip_width + gap, height}});
  for (const auto& [packing, x] : {std::pair{&left, 0.0}, std::pair{&right, strip_width + gap}}) {
    figure.thin();
    figure.line({{x, 0}, {x + strip_width, 0}, {x + strip_width, height}, {x, height}, {x, 0}});
    figure.line({{x, packing->height}, {x + strip_width, packing->height}});
    for (std::size_t i = 0; i < packing->shapes.size(); ++i) {
      figure.color(i, 0.8);
      for (const Ring& ring : rings_of(packing->shapes[i])) {
        std::vector<Vec2> points = ring.points;
        points.push_back(points.front());
        for (Vec2& p : points) p.x += x;
        figure.line(points);
      }
    }
  }
  return figure.write(path);
}

}  // namespace

Status measure_packing(const Request& request) {
  const std::filesystem::path folder = "../shared/data/packaged/B_svg/mdi";
  if (!std::filesystem::is_directory(folder))
    return write(request, "packing.md", "Not measured: the drawings are not here.\n");
  const std::vector<Shape> parts = parts_of(folder, request.quick ? 4 : most_parts);
  std::size_t pairs = 0;
  std::vector<Body> singles;
  for (const Shape& part : parts) singles.push_back({{part}});
  const Packing plain = bottom_left(singles);
  const double least_saved = 0.05 * part_size * part_size;
  const double begin = processor_seconds();
  const std::vector<Body> bodies = paired(parts, least_saved, pairs);
  const double seconds = processor_seconds() - begin;
  const Packing nested = bottom_left(bodies);
  Table table({{"packing"},
               {"parts"},
               {"pairs"},
               {"height", "{:.0f}"},
               {"density", "{:.3f}"},
               {"s to pair", "{:.1f}"}});
  table.add({"bottom left", parts.size(), std::uint64_t{0}, plain.height, plain.density, 0.0});
  table.add({"bottom left of pairs", parts.size(), std::uint64_t{pairs}, nested.height,
             nested.density, seconds});
  return in_order([&] { return write(request, "packing.md", table.markdown()); },
                  [&] { return write(request, "packing.csv", table.csv()); },
                  [&] { return draw(plain, nested, request.to / "packing.svg"); });
}

}  // namespace medial::papers
