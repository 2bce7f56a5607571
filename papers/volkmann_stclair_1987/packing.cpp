// Nesting, the motive of Volkmann and St. Clair (1987, Section I): parts on a strip, laid as they
// are, and with bays and peninsulas paired.

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>

#include "base/convex_hull.h"
#include "io/ring_text.h"
#include "medial/features.h"
#include "medial/io/read.h"
#include "papers/figure.h"
#include "papers/table.h"
#include "papers/volkmann_stclair_1987/volkmann.h"

namespace medial::papers {
namespace {

constexpr double part_size = 60;  ///< the square root of a part's area, in cells
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
  return placed(shape, at).value();
}

/// Turned so that its box is smallest: along an edge of the convex hull, as Freeman and Shapira
/// have it (1975).
Body squared(const Body& body) {
  std::vector<Vec2> points;
  for (const Shape& shape : body.shapes)
    points.insert(points.end(), shape.points.begin(), shape.points.end());
  const std::vector<Vec2> hull = convex_hull(std::move(points));
  double least = std::numeric_limits<double>::infinity(), best = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 d = hull[(i + 1) % hull.size()] - hull[i];
    Box box = Box::nothing();
    for (const Vec2 p : hull) box.add(Vec2{dot(d, p) / norm(d), cross(d, p) / norm(d)});
    const double area = (box.high.x - box.low.x) * (box.high.y - box.low.y);
    if (area < least) least = area, best = -std::atan2(d.y, d.x);
  }
  Body result;
  for (const Shape& shape : body.shapes) result.shapes.push_back(moved(shape, best, {}));
  return result;
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

/// The drawings (.svg) among the files of a request, or else those of a folder, by name.
std::vector<std::filesystem::path> drawings_of(const Request& request) {
  std::vector<std::filesystem::path> paths;
  const auto add = [&](const std::filesystem::path& path) {
    if (path.extension() == ".svg") paths.push_back(path);
  };
  for (const std::string& file : request.files) add(file);
  const std::filesystem::path folder = "../shared/data/packaged/B_svg/mdi";
  if (paths.empty() && std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder)) add(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// The first parts of some drawings that fit the strip.
std::vector<Shape> parts_of(const std::vector<std::filesystem::path>& paths, std::size_t count) {
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

constexpr std::size_t strip_width = 512;  ///< in cells
using Cells = std::bitset<strip_width>;   ///< of a row; the first one on the left

/// Cells of a row, from `begin` up to before `end`.
struct Run {
  std::size_t begin, end;
};

/// Cells that a body covers, or its outline meets; the lowest row first.
struct Mask {
  std::vector<std::vector<Run>> rows;
  std::size_t width = 0;
  Vec2 low;  ///< the low corner of the first cell
};

/// Marks the cells that an edge meets, and adds where it crosses the middle lines of rows.
void add_edge(Vec2 a, Vec2 b, std::vector<Cells>& cells,
              std::vector<std::vector<double>>& crossings) {
  const std::size_t height = cells.size();
  const auto steps = static_cast<int>(std::ceil(8 * distance(a, b))) + 1;
  for (int k = 0; k <= steps; ++k) {
    const Vec2 p = a + static_cast<double>(k) / steps * (b - a);
    cells[std::min(height - 1, static_cast<std::size_t>(p.y))].set(static_cast<std::size_t>(p.x));
  }
  const double low = std::max(0.0, std::ceil(std::min(a.y, b.y) - 0.5));
  for (auto y = static_cast<std::size_t>(low);
       y < height && static_cast<double>(y) + 0.5 < std::max(a.y, b.y); ++y)
    crossings[y].push_back(a.x + (static_cast<double>(y) + 0.5 - a.y) / (b.y - a.y) * (b.x - a.x));
}

std::vector<Run> runs_of(const Cells& cells) {
  std::vector<Run> runs;
  for (std::size_t x = 0; x < strip_width; ++x) {
    if (!cells[x]) continue;
    if (runs.empty() || runs.back().end != x) runs.push_back({x, x});
    runs.back().end = x + 1;
  }
  return runs;
}

/// Of a body that is narrower than the strip; without rows, if it is not.
Mask mask_of(const Body& body) {
  const Box box = body.box();
  Mask mask;
  mask.low = {std::floor(box.low.x), std::floor(box.low.y)};
  mask.width = static_cast<std::size_t>(std::floor(box.high.x) - mask.low.x) + 1;
  if (mask.width > strip_width) return mask;
  const auto height = static_cast<std::size_t>(std::floor(box.high.y) - mask.low.y) + 1;
  std::vector<Cells> cells(height);
  for (const Shape& shape : body.shapes) {
    std::vector<std::vector<double>> crossings(height);
    for (const Ring& ring : rings_of(shape))
      for (std::size_t i = 0; i < ring.points.size(); ++i)
        add_edge(ring.points[i] - mask.low, ring.points[(i + 1) % ring.points.size()] - mask.low,
                 cells, crossings);
    for (std::size_t y = 0; y < height; ++y) {
      std::sort(crossings[y].begin(), crossings[y].end());
      for (std::size_t k = 0; k + 1 < crossings[y].size(); k += 2)
        for (auto x = static_cast<std::size_t>(crossings[y][k]);
             static_cast<double>(x) < crossings[y][k + 1]; ++x)
          cells[y].set(x);
    }
  }
  for (const Cells& row : cells) mask.rows.push_back(runs_of(row));
  return mask;
}

/// Where a run may not begin, so that it meets none of the cells: these, and as many to their left
/// as the run is longer than one.
Cells blocked_by(const Cells& cells, const Run& run) {
  Cells blocked = cells >> run.begin;
  for (std::size_t done = 1; done < run.end - run.begin;) {
    const std::size_t step = std::min(done, run.end - run.begin - done);
    blocked |= blocked >> step;
    done += step;
  }
  return blocked;
}

/// A strip of cells, filled from below.
class Strip {
 public:
  /// The lowest place, of those the leftmost.
  std::pair<std::size_t, std::size_t> place(const Mask& mask) const {
    Cells outside;
    for (std::size_t x = strip_width - mask.width + 1; x < strip_width; ++x) outside.set(x);
    for (std::size_t y = 0;; ++y) {
      Cells blocked = outside;
      for (std::size_t j = 0; j < mask.rows.size() && y + j < rows_.size() && !blocked.all(); ++j)
        for (const Run& run : mask.rows[j]) blocked |= blocked_by(rows_[y + j], run);
      for (std::size_t x = 0; x < strip_width; ++x)
        if (!blocked[x]) return {x, y};
    }
  }
  void add(const Mask& mask, std::size_t x, std::size_t y) {
    rows_.resize(std::max(rows_.size(), y + mask.rows.size()));
    for (std::size_t j = 0; j < mask.rows.size(); ++j)
      for (const Run& run : mask.rows[j])
        for (std::size_t i = run.begin; i < run.end; ++i) rows_[y + j].set(x + i);
  }
  double height() const { return static_cast<double>(rows_.size()); }

 private:
  std::vector<Cells> rows_;
};

struct Packing {
  std::vector<Shape> shapes;
  std::vector<bool> paired;  ///< of each shape: laid as one with another
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
      if (mask.rows.empty()) continue;
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
    for (const Shape& shape : chosen.shapes) {
      packing.shapes.push_back(moved(shape, 0, by));
      packing.paired.push_back(chosen.shapes.size() > 1);
    }
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

/// By how much a part is smaller than its convex hull.
double hollow_of(const Shape& part) {
  const std::vector<Vec2> hull = convex_hull({part.points.begin(), part.points.end()});
  double twice = 0;
  for (std::size_t i = 2; i < hull.size(); ++i)
    twice += cross(hull[i - 1] - hull[0], hull[i] - hull[0]);
  return twice / 2 - area(part);
}

struct Pairs {
  std::vector<Pair> found;  ///< those that save most first
  std::uint64_t tried = 0;
};

/// All pairs that save more than that. The hull of both is no smaller than both, so a pair saves at
/// most what both are smaller than their own hulls.
Pairs pairs_of(const std::vector<Shape>& parts, double least_saved) {
  std::vector<double> hollow;
  for (const Shape& part : parts) hollow.push_back(hollow_of(part));
  Pairs pairs;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    progress(fmt::format("nesting part {}", i));
    for (std::size_t j = i + 1; j < parts.size(); ++j) {
      if (hollow[i] + hollow[j] < least_saved) continue;
      ++pairs.tried;
      const auto best = nest(parts[i], parts[j], 0.5, true, 1);
      if (best && !best->empty() && best->front().saved > least_saved)
        pairs.found.push_back({i, j, best->front()});
    }
  }
  std::stable_sort(pairs.found.begin(), pairs.found.end(),
                   [](const Pair& a, const Pair& b) { return a.at.saved > b.at.saved; });
  return pairs;
}

/// The parts as bodies: each pair as one.
std::vector<Body> bodies_of(const std::vector<Shape>& parts, const std::vector<Pair>& pairs) {
  std::vector<bool> used(parts.size());
  std::vector<Body> bodies;
  for (const Pair& pair : pairs) {
    used[pair.first] = used[pair.second] = true;
    bodies.push_back(squared({{parts[pair.first], placed(parts[pair.second], pair.at).value()}}));
  }
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!used[i]) bodies.push_back({{parts[i]}});
  return bodies;
}

/// Those of some pairs that are laid as one: in turn, each that makes the packing lower.
std::vector<Pair> chosen(const std::vector<Shape>& parts, const std::vector<Pair>& pairs,
                         Packing& packing) {
  constexpr std::size_t most_tried = 64;
  std::vector<Pair> taken;
  std::size_t tried = 0;
  for (const Pair& pair : pairs) {
    const auto shares = [&](const Pair& other) {
      return pair.first == other.first || pair.first == other.second ||
             pair.second == other.first || pair.second == other.second;
    };
    if (std::any_of(taken.begin(), taken.end(), shares)) continue;
    if (++tried > most_tried) break;
    taken.push_back(pair);
    Packing with = bottom_left(bodies_of(parts, taken));
    if (with.height < packing.height)
      packing = std::move(with);
    else
      taken.pop_back();
  }
  return taken;
}

/// Whether no two parts meet: all of them are one shape.
Status check(const Packing& packing) {
  std::vector<Ring> rings;
  double sum = 0;
  for (const Shape& shape : packing.shapes) {
    sum += area(shape);
    for (Ring& ring : rings_of(shape)) rings.push_back(std::move(ring));
  }
  const auto all = build_shape(rings);
  if (!all) return all.error();
  if (std::abs(area(*all) - sum) > 1e-6 * sum)
    return Error{ErrorCode::internal, "parts of the packing lie in others", {}};
  return success();
}

Status draw(const Packing& left, const Packing& right, const std::filesystem::path& path) {
  const double gap = 40, height = std::max(left.height, right.height);
  Figure figure({{0, 0}, {2 * strip_width + gap, height}});
  for (const auto& [packing, x] : {std::pair{&left, 0.0}, std::pair{&right, strip_width + gap}}) {
    figure.thin();
    figure.line({{x, 0}, {x + strip_width, 0}, {x + strip_width, height}, {x, height}, {x, 0}});
    figure.line({{x, packing->height}, {x + strip_width, packing->height}});
    for (std::size_t i = 0; i < packing->shapes.size(); ++i) {
      packing->paired[i] ? figure.color(i, 1.2) : figure.thin();
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
  const std::vector<Shape> parts = parts_of(drawings_of(request), request.quick ? 4 : most_parts);
  if (parts.size() < 2)
    return write(request, "packing.md", "Not measured: the drawings are not here.\n");
  const Packing plain = bottom_left(bodies_of(parts, {}));
  const double begin = processor_seconds();
  const Pairs pairs = pairs_of(parts, 0.05 * part_size * part_size);
  const double seconds = processor_seconds() - begin;
  Packing nested = plain;
  const std::vector<Pair> taken = chosen(parts, pairs.found, nested);
  Table table({{"packing"},
               {"parts"},
               {"pairs tried"},
               {"that save"},
               {"taken"},
               {"height", "{:.0f}"},
               {"shorter, %", "{:.1f}"},
               {"density", "{:.3f}"},
               {"ms a pair", "{:.1f}"}});
  constexpr std::uint64_t none = 0;
  table.add({"bottom left", parts.size(), none, none, none, plain.height, 0.0, plain.density,
             std::nan("")});
  table.add({"with pairs that interlock", parts.size(), pairs.tried, pairs.found.size(),
             taken.size(), nested.height, 100 * (1 - nested.height / plain.height), nested.density,
             1000 * seconds / static_cast<double>(std::max(pairs.tried, std::uint64_t{1}))});
  return in_order([&] { return check(plain); }, [&] { return check(nested); },
                  [&] { return write(request, "packing.md", table.markdown()); },
                  [&] { return write(request, "packing.csv", table.csv()); },
                  [&] { return draw(plain, nested, request.to / "packing.svg"); });
}

}  // namespace medial::papers
