// Ahuja and Chuang (1997): skeletons in a generalised potential field, their distance to the exact
// axis, and the paper's figures.

#include "papers/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/local_frame.h"
#include "cli/axis_distance.h"
#include "medial/compute.h"
#include "medial/io/write.h"
#include "medial/query.h"
#include "methods/potential/region.h"
#include "methods/potential/skeleton.h"
#include "methods/potential/successor.h"
#include "papers/ahuja_chuang_1997/smoothness.h"
#include "papers/figure.h"
#include "papers/table.h"

namespace medial::papers {
namespace {

using NamedShape = std::pair<std::string, Shape>;

/// 0 stands for the adaptive order.
constexpr std::array orders = {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 0.0};

// ---- Shapes -------------------------------------------------------------------------------------

Shape shape_of(std::vector<Vec2> points) {
  Ring ring;
  ring.points = std::move(points);
  return *build_shape(std::vector<Ring>{ring});
}

/// The paper's regions of Fig. 3: a rectangle, an L, and a shape like that of [20], Fig. 19.
std::vector<NamedShape> regions() {
  return {{"rectangle", shape_of({{0, 0}, {20, 0}, {20, 10}, {0, 10}})},
          {"L", shape_of({{0, 0}, {20, 0}, {20, 8}, {8, 8}, {8, 20}, {0, 20}})},
          {"hand", shape_of({{0, 0},
                             {10, 0},
                             {12, 5},
                             {20, 4},
                             {20, 7},
                             {13, 9},
                             {19, 15},
                             {17, 17},
                             {11, 12},
                             {8, 20},
                             {5, 20},
                             {6, 12},
                             {-1, 15},
                             {-3, 12},
                             {3, 8}})}};
}

/// Numbers in [0, 1), the same each time.
class Noise {
 public:
  explicit Noise(std::uint32_t seed) : state_(seed) {}
  double next() {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<double>(state_ >> 8U) / 16777216.0;
  }

 private:
  std::uint32_t state_;
};

/// A band with teeth of noise on its long sides, `edges` edges in all.
Shape noisy_band(int teeth, double height) {
  std::vector<Vec2> points;
  const double step = 10.0 / teeth;
  Noise source(7);
  const auto noise = [&] { return height * (source.next() - 0.5); };
  for (int i = 0; i <= teeth; ++i) points.push_back({i * step, -1 + noise()});
  for (int i = teeth; i >= 0; --i) points.push_back({i * step, 1 + noise()});
  return shape_of(points);
}

/// Polygons with 7 to 31 corners in even directions around their middle, at random distances.
std::vector<NamedShape> polygons(int count) {
  std::vector<NamedShape> shapes;
  for (int i = 0; i < count; ++i) {
    const int corners = 7 + 24 * i / std::max(count - 1, 1);
    Noise noise(static_cast<std::uint32_t>(i + 1));
    std::vector<Vec2> points;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / corners, radius = 4 + 6 * noise.next();
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    shapes.emplace_back(fmt::format("polygon {}", i + 1), shape_of(std::move(points)));
  }
  return shapes;
}

double size_of(const Shape& shape) {
  const Box box = bounding_box(shape);
  return std::max(box.high.x - box.low.x, box.high.y - box.low.y);
}

Options options_of(double order) {
  return {.method = method::Potential{.order = order}, .threads = 1};
}

std::string order_name(double order) {
  return order == 0 ? "adaptive" : fmt::format("n={:g}", order);
}

// ---- Tables -------------------------------------------------------------------------------------

/// Of each file the shape with the most vertices.
Result<std::vector<NamedShape>> largest_shapes(const std::vector<std::string>& files) {
  std::vector<NamedShape> shapes;
  for (const std::string& path : files) {
    const auto file = io::read_document(path);
    if (!file) return file.error();
    Shape largest;
    for (const Feature& feature : file->items) {
      auto shape = build_shape(feature.rings);
      if (!shape) return shape.error();
      if (shape->points.size() > largest.points.size()) largest = std::move(shape).value();
    }
    shapes.emplace_back(std::filesystem::path(path).stem().string(), std::move(largest));
  }
  return shapes;
}

std::vector<Table::Column> distance_columns(const char* format) {
  std::vector<Table::Column> columns{{"shape"}, {"edges"}};
  for (const double order : orders) columns.push_back({order_name(order), format});
  columns.push_back({"away from leaves", "{:.3f}"});
  columns.push_back({"falls"});
  columns.push_back({"falls from n=2 on"});
  return columns;
}

/// Largest and mean distances from a shape's skeletons to its exact axis, in hundredths of the
/// size. False if a skeleton is missing.
bool add_distances(const NamedShape& named, Table& largest, Table& mean) {
  const auto& [name, shape] = named;
  progress(name);
  const auto exact = compute(shape);
  if (!exact) return false;
  const double size = size_of(shape);
  std::vector<Table::Cell> largest_cells{name, shape.points.size()}, mean_cells = largest_cells;
  double away = 0, before = 1;
  bool falls = true, falls_later = true, complete = true;
  for (const double order : orders) {
    const auto axis = compute(shape, options_of(order));
    if (!axis) {
      largest_cells.emplace_back("-");
      mean_cells.emplace_back("-");
      complete = false;
      continue;
    }
    const cli::AxisDistance distance =
        cli::distance_between(*axis, *exact, 0.005 * size, 0.05 * size);
    largest_cells.emplace_back(100 * distance.largest / size);
    mean_cells.emplace_back(100 * distance.mean / size);
    const bool rises = order > 0 && distance.mean / size > before;
    if (rises) falls = false;
    if (rises && order > 2) falls_later = false;
    before = distance.mean / size;
    away = distance.away / size;
  }
  for (auto [cells, table] : {std::pair{&largest_cells, &largest}, {&mean_cells, &mean}}) {
    cells->insert(cells->end(), {100 * away, falls ? "yes" : "NO", falls_later ? "yes" : "NO"});
    table->add(std::move(*cells));
  }
  return complete;
}

/// The adaptive order at each point of the rectangle's Newtonian skeleton but its corners, for the
/// paper's theta_min of 2.56 degrees.
std::vector<std::pair<Vec2, int>> orders_in_rectangle() {
  const Shape shape = regions()[0].second;
  const LocalFrame frame = frame_of(bounding_box(shape));
  const auto regions = potential::regions_of(Problem(shape, Options{}), 1e-3);
  const potential::Charges charges(regions[0].pieces);
  potential::SkeletonOptions tracing;
  tracing.step = 0.01 * regions[0].size;
  const auto skeleton = potential::trace_valleys(regions[0], charges, tracing);
  potential::Evaluator evaluator(charges);
  std::vector<std::pair<Vec2, int>> orders_there;
  for (const auto& point : skeleton.points) {
    if (point.radius == 0) continue;
    evaluator.place(point.place);
    orders_there.emplace_back(
        frame.to_input(point.place),
        potential::adaptive_order(evaluator, std::acos(0.999), potential::most_searched_order));
  }
  return orders_there;
}

double exponent_of(int order) { return 0.5 * (order + 2); }

std::string orders_along_rectangle() {
  std::vector<std::pair<double, int>> along;
  for (const auto& [p, order] : orders_in_rectangle())
    if (p.x <= 10 && p.y <= 5.001) along.emplace_back(p.x, order);
  std::sort(along.begin(), along.end());
  Table table({{"x", "{:.2f}"}, {"N", "{:.0f}"}, {"p = (N + 2) / 2"}});
  double next = 0;
  for (const auto& [x, order] : along) {
    if (x < next) continue;
    table.add({x, static_cast<double>(order), exponent_of(order)});
    next = x + 0.5;
  }
  return table.markdown();
}

/// Fig. 8's kind: the time against the edges of a noisy band.
std::string times_table(const Request& request) {
  Table table(
      {{"edges"}, {"convex corners"}, {"points"}, {"axis, ms", "{:.2f}"}, {"ms / edge", "{:.4f}"}});
  for (const int teeth : {24, 49, 99, 199, 399}) {
    if (request.quick && teeth > 49) break;
    const Shape shape = noisy_band(teeth, 0.3);
    const auto exact = compute(shape);
    const auto corners = std::count_if(exact->nodes.begin(), exact->nodes.end(),
                                       [](const Node& node) { return node.disk.radius == 0; });
    double least = 0;
    const auto axis = timed(request.rounds, least, [&] { return compute(shape, options_of(0)); });
    table.add({shape.points.size(), static_cast<std::uint64_t>(corners),
               axis ? axis->nodes.size() : std::size_t{0}, 1e3 * least,
               1e3 * least / static_cast<double>(shape.points.size())});
  }
  return table.markdown();
}

std::uint64_t leaves_of(const MedialAxis& axis) {
  return static_cast<std::uint64_t>(
      std::count_if(axis.nodes.begin(), axis.nodes.end(),
                    [](const Node& node) { return node.kind == NodeKind::leaf; }));
}

/// Fig. 7: how much the spine turns, in steps of a hundredth of the size.
std::string noise_table() {
  Table table({{"axis"}, {"turning of the spine, degrees", "{:.0f}"}, {"leaves"}});
  const Shape shape = noisy_band(60, 0.2);
  const auto add = [&](const std::string& name, const Options& options) {
    if (const auto axis = compute(shape, options))
      table.add({name, turning(spine_of(*axis, 0.01 * size_of(shape))), leaves_of(*axis)});
  };
  add("exact", {.threads = 1});
  for (const double order : {1.0, 2.0, 4.0, 8.0, 16.0, 64.0})
    add(order_name(order), options_of(order));
  return table.markdown();
}

/// Of a picture of Fig. 14 and of its table.
constexpr double pixel_of_size = 1.0 / 200;

/// Fig. 14: skeletons and thinning of pixels, by how many ends their lines have.
std::string thinning_table() {
  Table table({{"shape"}, {"convex corners"}, {"ends, n=1"}, {"ends, n=8"}, {"ends, thinning"}});
  std::vector<NamedShape> shapes = regions();
  shapes.emplace_back("noisy band", noisy_band(60, 0.2));
  for (const auto& [name, shape] : shapes) {
    const auto one = compute(shape, options_of(1)), eight = compute(shape, options_of(8));
    const auto exact = compute(shape);
    if (!one || !eight || !exact) continue;
    const Image lines = thinned(pixels_of(shape, pixel_of_size * size_of(shape)));
    table.add({name, leaves_of(*exact), leaves_of(*one), leaves_of(*eight), ends_of(lines)});
  }
  return table.markdown();
}

// ---- Figures ------------------------------------------------------------------------------------

/// Fig. 13: the exponents that the adaptive order stands for, written along the rectangle's axis.
Status draw_orders(const Request& request) {
  const Shape shape = regions()[0].second;
  Figure figure(bounding_box(shape));
  figure.ink();
  figure.line(shape.points);
  figure.line({shape.points.back(), shape.points.front()});
  // As dense as the numbers can be read.
  constexpr double apart = 0.75, largest_shown = 9;
  std::vector<Vec2> shown = shape.points;
  for (const auto& [p, order] : orders_in_rectangle()) {
    if (std::any_of(shown.begin(), shown.end(),
                    [&, q = p](Vec2 other) { return distance(q, other) < apart; }))
      continue;
    shown.push_back(p);
    const double exponent = exponent_of(order);
    figure.mark(p, exponent > largest_shown ? "x" : fmt::format("{:g}", exponent).c_str());
  }
  return figure.write(request.to / "fig13.svg");
}

/// The potential of a region's border, or force lines in it, `lines` along the longer side.
Status draw_field(const Request& request, const char* name, const Shape& shape, double order,
                  int lines, double width) {
  std::vector<PotentialField> fields;
  auto field = PotentialField::make(shape, order);
  if (!field) return field.error();
  fields.push_back(std::move(field).value());
  return io::write_field((request.to / name).string(), {}, {&shape, 1}, fields,
                         {.width = width, .lines = lines, .brightness = lines == 0});
}

Status draw_axis(const Request& request, const std::string& name, const Shape& shape,
                 const Options& options, double width = 1024) {
  auto axis = compute(shape, options);
  if (!axis) return axis.error();
  Document<AxisItem> file;
  file.items.push_back({shape, std::move(axis).value(), {}});
  io::WriteOptions picture;
  picture.width = width;
  return io::write_axes((request.to / name).string(), {}, file, picture);
}

/// Figs. 6 and 12: skeletons of the regions by order.
Status draw_skeletons(const Request& request) {
  for (const auto& [name, shape] : regions())
    for (const double order : {1.0, 4.0, 8.0}) {
      const std::string file = fmt::format("fig{}-{}-{:g}.svg", order == 1 ? 6 : 12, name, order);
      if (Status drawn = draw_axis(request, file, shape, options_of(order)); !drawn) return drawn;
    }
  return success();
}

/// Fig. 14: the pixels that thinning leaves.
Status draw_thinning(const Request& request, const std::string& name, const Shape& shape) {
  Figure figure(bounding_box(shape));
  figure.thin();
  figure.line(shape.points);
  figure.line({shape.points.back(), shape.points.front()});
  figure.ink();
  const double side = pixel_of_size * size_of(shape);
  const Box box = bounding_box(shape);
  const Image lines = thinned(pixels_of(shape, side));
  for (std::uint32_t y = 0; y < lines.height(); ++y)
    for (std::uint32_t x = 0; x < lines.width(); ++x) {
      if (!lines.at(x, y)) continue;
      const Vec2 low{box.low.x + (x - 1) * side, box.low.y + (y - 1) * side};
      const Vec2 high{low.x + side, low.y + side};
      figure.line({low, {high.x, low.y}, high, {low.x, high.y}, low});
    }
  return figure.write(request.to / name);
}

Status draw_figures(const Request& request) {
  const std::vector<NamedShape> shapes = regions();
  const Shape &rectangle = shapes[0].second, &l = shapes[1].second, &hand = shapes[2].second;
  const Shape band = noisy_band(60, 0.2), noisy = noisy_band(49, 0.3);
  const Options coarse{.method = method::Potential{.coarse = 0.03}, .threads = 1};
  return in_order([&] { return draw_field(request, "fig3-rectangle.png", rectangle, 1, 0, 360); },
                  [&] { return draw_field(request, "fig3-L.png", l, 1, 0, 360); },
                  [&] { return draw_field(request, "fig4.png", hand, 1, 40, 400); },
                  [&] { return draw_skeletons(request); },
                  [&] { return draw_axis(request, "fig7a.png", band, {.threads = 1}, 900); },
                  [&] { return draw_axis(request, "fig7b.png", band, options_of(1), 900); },
                  [&] { return draw_axis(request, "fig8-all.png", noisy, options_of(0), 900); },
                  [&] { return draw_axis(request, "fig8-coarse.png", noisy, coarse, 900); },
                  [&] { return draw_field(request, "fig10-1.png", rectangle, 1, 30, 360); },
                  [&] { return draw_field(request, "fig10-2.png", rectangle, 2, 30, 360); },
                  [&] { return draw_field(request, "fig10-8.png", rectangle, 8, 30, 360); },
                  [&] { return draw_orders(request); },
                  [&] { return draw_thinning(request, "fig14-hand.svg", hand); },
                  [&] { return draw_thinning(request, "fig14-band.svg", band); });
}

}  // namespace

Result<bool> run_ahuja_chuang_1997(const Request& request) {
  const auto further = largest_shapes(request.files);
  if (!further) return further.error();
  std::vector<NamedShape> shapes = regions();
  for (const auto& more : {polygons(request.quick ? 2 : 20), *further})
    shapes.insert(shapes.end(), more.begin(), more.end());
  Table largest(distance_columns("{:.3f}")), mean(distance_columns("{:.4f}"));
  bool passed = true;
  for (const NamedShape& shape : shapes) passed = add_distances(shape, largest, mean) && passed;
  const std::string text = fmt::format(
      "Distances in hundredths of the size (the larger side of the bounding box).\n\n"
      "*falls*: whether the mean distance does from each order to the next.\n\n"
      "## Largest distance from the skeleton to the exact axis\n\n{}\n"
      "## Mean distance\n\n{}\n## Orders along half a rectangle (Fig. 13)\n\n{}\n"
      "## Time of a noisy band (Fig. 8's kind), processor time of one thread\n\n{}\n"
      "## Smoothness against a noisy border (Fig. 7)\n\n{}\n"
      "## Thinning by Zhang and Suen (Fig. 14)\n\n{}",
      largest.markdown(), mean.markdown(), orders_along_rectangle(), times_table(request),
      noise_table(), thinning_table());
  const Status written = in_order([&] { return write(request, "tables.md", text); },
                                  [&] { return write(request, "largest.csv", largest.csv()); },
                                  [&] { return write(request, "mean.csv", mean.csv()); },
                                  [&] { return draw_figures(request); });
  if (!written) return written.error();
  return passed;
}

}  // namespace medial::papers
