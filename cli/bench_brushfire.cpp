#include "cli/bench_brushfire.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>

#include "medial/brushfire.h"
#include "medial/compute.h"
#include "medial/query.h"

namespace medial::cli {
namespace {

constexpr std::array families = {Brushfire::sequential, Brushfire::sides, Brushfire::marking,
                                 Brushfire::simultaneous};

void count_differences(const Image& image, AccuracyCell& cell) {
  for (std::uint32_t y = 0; y < image.height(); ++y) {
    for (std::size_t w = 0; w < image.row(y).size(); ++w) {
      const std::uint64_t a = image.row(y)[w], b = cell.inverted.row(y)[w];
      cell.missing += static_cast<unsigned>(std::popcount(a & ~b));
      cell.extra += static_cast<unsigned>(std::popcount(b & ~a));
    }
  }
}

AccuracyCell of_pixels(std::string method, const Image& image, Image axis,
                       const DistanceMap& distances) {
  AccuracyCell cell{
      std::move(method), axis.count(), 0, 0, Image(), union_of_disks(axis, distances)};
  count_differences(image, cell);
  cell.axis = std::move(axis);
  return cell;
}

Image pixels_of(const MedialAxis& axis, const Image& image) {
  Image pixels(image.width(), image.height());
  for (const Node& node : axis.nodes) {
    const double x = std::floor(node.disk.center.x), y = std::floor(node.disk.center.y);
    if (x >= 0 && y >= 0 && x < image.width() && y < image.height())
      pixels.set(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
  }
  return pixels;
}

std::vector<Disk> disks_along(const MedialAxis& axis) {
  constexpr double apart = 0.125;
  std::vector<Disk> disks;
  for (const Node& node : axis.nodes) disks.push_back(node.disk);
  for (const Edge& edge : axis.edges) {
    const double count = std::ceil(length(axis, edge) / apart);
    for (double i = 1; i < count; ++i) disks.push_back(disk_at(axis, edge, i / count));
  }
  return disks;
}

/// The pixels of a drawing in squares of ten units, `inset` smaller all around, as one path; runs
/// of pixels in a row as one box where `inset` is 0.
void draw_pixels(std::string& svg, const Image& image, double left, double top, const char* color,
                 int inset) {
  svg += fmt::format("<path transform=\"translate({} {})\" fill=\"{}\" d=\"", left, top, color);
  for (std::uint32_t y = 0; y < image.height(); ++y) {
    for (std::uint32_t x = 0; x < image.width();) {
      std::uint32_t end = x + 1;
      if (!image.at(x, y)) {
        x = end;
        continue;
      }
      while (inset == 0 && image.at(end, y)) ++end;
      svg += fmt::format("M{} {}h{}v{}h-{}z", 10 * x + static_cast<std::uint32_t>(inset),
                         10 * y + static_cast<std::uint32_t>(inset),
                         10 * (end - x) - 2 * static_cast<std::uint32_t>(inset), 10 - 2 * inset,
                         10 * (end - x) - 2 * static_cast<std::uint32_t>(inset));
      x = end;
    }
  }
  svg += "\"/>\n";
}

/// White lines between the pixels.
void draw_grid(std::string& svg, const Image& image, double left, double top) {
  svg += fmt::format("<path transform=\"translate({} {})\" stroke=\"white\" d=\"", left, top);
  for (std::uint32_t x = 0; x <= image.width(); ++x)
    svg += fmt::format("M{} 0v{}", 10 * x, 10 * image.height());
  for (std::uint32_t y = 0; y <= image.height(); ++y)
    svg += fmt::format("M0 {}h{}", 10 * y, 10 * image.width());
  svg += "\"/>\n";
}

}  // namespace

Image figure_14() {
  constexpr std::array rows = {
      "..........................", "....#####.................", "...########...............",
      "..############............", "..##################......", ".#######################..",
      ".########################.", ".########################.", "..#######################.",
      "..######################..", "...##################.....", "...#############..........",
      "....##########............", "....########..............", ".....######...............",
      ".....#####................", "......####................", "..........................",
  };
  Image image(26, rows.size());
  for (std::uint32_t y = 0; y < rows.size(); ++y)
    for (std::uint32_t x = 0; x < 26; ++x) image.set(x, y, rows[y][x] == '#');
  return image;
}

Result<AccuracyRow> measure_accuracy(const std::string& name, const Image& image) {
  AccuracyRow row{name, image.count(), {}, image};
  const auto distances = distance_transform(image);
  if (!distances) return distances.error();
  for (const Brushfire family : families) {
    BrushfireOptions options;
    options.family = family;
    auto axis = thin(image, options);
    if (!axis) return std::move(axis).error();
    row.cells.push_back(of_pixels(fmt::format("brushfire {}", name_of(family)), image,
                                  std::move(axis).value(), *distances));
  }
  const auto rings = pixel_outline(image);
  if (!rings) return rings.error();
  const auto shape = build_shape(*rings);
  if (!shape) return shape.error();
  Options options;
  options.method = Method::ridge;
  options.resolution = 1;
  const auto ridge = compute(*shape, options);
  if (!ridge) return ridge.error();
  row.cells.push_back(of_pixels("ridge", image, pixels_of(*ridge, image), *distances));
  const auto exact = compute(*shape);
  if (!exact) return exact.error();
  AccuracyCell cell{"disks", exact->nodes.size(),
                    0,       0,
                    Image(), union_of_disks(image.width(), image.height(), disks_along(*exact))};
  count_differences(image, cell);
  row.cells.push_back(std::move(cell));
  return row;
}

std::string accuracy_drawing(const AccuracyRow& row) {
  const double width = 10 * row.image.width() + 10, height = 10 * row.image.height() + 34;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" "
      "font-size=\"14\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      3 * width + 10, static_cast<double>(row.cells.size()) * height + 10);
  double top = 0;
  for (const AccuracyCell& cell : row.cells) {
    svg += fmt::format("<text x=\"10\" y=\"{}\">{}: {} pixels missing, {} too many</text>\n",
                       top + 20, cell.method, cell.missing, cell.extra);
    for (int panel = 0; panel < 3; ++panel) {
      const double left = 10 + panel * width;
      const Image& shown = panel == 2 ? cell.inverted : row.image;
      if (panel == 2) draw_pixels(svg, row.image, left, top + 28, "#d4404a", 0);
      draw_pixels(svg, shown, left, top + 28, "#c9d6df", 0);
      draw_grid(svg, row.image, left, top + 28);
      if (panel == 1) draw_pixels(svg, cell.axis, left, top + 28, "#1f3c88", 2);
    }
    top += height;
  }
  return svg + "</svg>\n";
}

std::string accuracy_table(const std::vector<AccuracyRow>& rows) {
  if (rows.empty()) return {};
  std::string text = "| image | foreground |", rule = "\n| --- | ---: |";
  for (const AccuracyCell& cell : rows.front().cells) {
    text += fmt::format(" {} |", cell.method);
    rule += " ---: |";
  }
  text += rule + "\n";
  for (const AccuracyRow& row : rows) {
    text += fmt::format("| {} | {} |", row.name, row.foreground);
    for (const AccuracyCell& cell : row.cells) {
      const auto differing = static_cast<double>(cell.missing + cell.extra);
      text += fmt::format(" {} ({:.2g} %) |", cell.missing + cell.extra,
                          100 * differing / static_cast<double>(row.foreground));
    }
    text += "\n";
  }
  return text;
}

std::string accuracy_csv(const std::vector<AccuracyRow>& rows) {
  std::string text = "image,foreground,method,axis,missing,extra\n";
  for (const AccuracyRow& row : rows) {
    for (const AccuracyCell& cell : row.cells) {
      text += fmt::format("{},{},{},{},{},{}\n", row.name, row.foreground, cell.method, cell.pixels,
                          cell.missing, cell.extra);
    }
  }
  return text;
}

}  // namespace medial::cli
