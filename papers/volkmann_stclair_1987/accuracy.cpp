// Fig. 14 of Volkmann and St. Clair (1987): an axis of pixels is inverted, and the pixels that
// differ are counted.

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>

#include "medial/compute.h"
#include "medial/io/read.h"
#include "medial/query.h"
#include "medial/raster.h"
#include "methods/raster/disks.h"
#include "papers/table.h"
#include "papers/volkmann_stclair_1987/volkmann.h"

namespace medial::papers {
namespace {

/// One way to an axis of one image.
struct Inversion {
  std::string method;    ///< "brushfire simultaneous", "ridge", "disks"
  std::uint64_t pixels;  ///< of the axis; of the exact one its nodes
  Image axis;            ///< its pixels; empty for the exact axis
  Image inverted;
};

struct Differences {
  std::uint64_t missing = 0;  ///< foreground that no disk covers
  std::uint64_t extra = 0;    ///< background that a disk covers
};

Differences count_differences(const Image& image, const Image& inverted) {
  Differences found;
  for (std::uint32_t y = 0; y < image.height(); ++y) {
    for (std::size_t w = 0; w < image.row(y).size(); ++w) {
      const std::uint64_t a = image.row(y)[w], b = inverted.row(y)[w];
      found.missing += static_cast<unsigned>(std::popcount(a & ~b));
      found.extra += static_cast<unsigned>(std::popcount(b & ~a));
    }
  }
  return found;
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
  const auto gap = static_cast<std::uint32_t>(inset);
  for (std::uint32_t y = 0; y < image.height(); ++y) {
    for (std::uint32_t x = 0; x < image.width();) {
      std::uint32_t end = x + 1;
      if (!image.at(x, y)) {
        x = end;
        continue;
      }
      while (inset == 0 && image.at(end, y)) ++end;
      svg += fmt::format("M{} {}h{}v{}h-{}z", 10 * x + gap, 10 * y + gap, 10 * (end - x) - 2 * gap,
                         10 - 2 * inset, 10 * (end - x) - 2 * gap);
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

/// A shape of the kind of the report's Fig. 14: a few pixels, slanting sides, an arm.
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

/// Inverts the axes of an image by all families of brushfire, by ridge following on the same
/// pixels, and by the exact method, whose disks are taken at every eighth of a pixel along its
/// edges.
Result<std::vector<Inversion>> inversions_of(const Image& image) {
  std::vector<Inversion> all;
  const auto distances = distance_transform(image);
  if (!distances) return distances.error();
  const auto add_pixels = [&](std::string method, Image axis) {
    Image inverted = union_of_disks(axis, *distances);
    all.push_back({std::move(method), axis.count(), std::move(axis), std::move(inverted)});
  };
  for (const Brushfire family :
       {Brushfire::sequential, Brushfire::sides, Brushfire::marking, Brushfire::simultaneous}) {
    BrushfireOptions options;
    options.family = family;
    auto axis = thin(image, options);
    if (!axis) return std::move(axis).error();
    add_pixels(fmt::format("brushfire {}", name_of(family)), std::move(axis).value());
  }
  const auto rings = pixel_outline(image);
  if (!rings) return rings.error();
  const auto shape = build_shape(*rings);
  if (!shape) return shape.error();
  const auto ridge = compute(*shape, {.method = method::Ridge{{.resolution = 1}}});
  if (!ridge) return ridge.error();
  add_pixels("ridge", pixels_of(*ridge, image));
  const auto exact = compute(*shape);
  if (!exact) return exact.error();
  all.push_back({"disks", exact->nodes.size(), Image(),
                 union_of_disks(image.width(), image.height(), disks_along(*exact))});
  return all;
}

/// The image, each axis, and what it becomes: missing pixels marked. One row of drawings a method.
std::string drawing(const Image& image, const std::vector<Inversion>& inversions) {
  const double width = 10 * image.width() + 10, height = 10 * image.height() + 34;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" "
      "font-size=\"14\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      3 * width + 10, static_cast<double>(inversions.size()) * height + 10);
  double top = 0;
  for (const Inversion& inversion : inversions) {
    const Differences found = count_differences(image, inversion.inverted);
    svg += fmt::format("<text x=\"10\" y=\"{}\">{}: {} pixels missing, {} too many</text>\n",
                       top + 20, inversion.method, found.missing, found.extra);
    for (int panel = 0; panel < 3; ++panel) {
      const double left = 10 + panel * width;
      const Image& shown = panel == 2 ? inversion.inverted : image;
      if (panel == 2) draw_pixels(svg, image, left, top + 28, "#d4404a", 0);
      draw_pixels(svg, shown, left, top + 28, "#c9d6df", 0);
      draw_grid(svg, image, left, top + 28);
      if (panel == 1) draw_pixels(svg, inversion.axis, left, top + 28, "#1f3c88", 2);
    }
    top += height;
  }
  return svg + "</svg>\n";
}

/// Adds an image to both tables: a line in the one for readers, a line a method in the other.
void add_rows(const std::string& name, const Image& image, const std::vector<Inversion>& inversions,
              Table& shares, Table& counts) {
  std::vector<Table::Cell> cells{name, image.count()};
  for (const Inversion& inversion : inversions) {
    const auto [missing, extra] = count_differences(image, inversion.inverted);
    const double share =
        100 * static_cast<double>(missing + extra) / static_cast<double>(image.count());
    cells.emplace_back(fmt::format("{} ({:.2g} %)", missing + extra, share));
    counts.add({name, image.count(), inversion.method, inversion.pixels, missing, extra});
  }
  shares.add(std::move(cells));
}

}  // namespace

Status measure_accuracy(const Request& request) {
  std::vector<std::pair<std::string, Image>> images{{"a shape like Fig. 14", figure_14()}};
  for (const std::string& path : request.files) {
    if (path.ends_with(".svg")) continue;  // a part for the packing
    auto file = io::read_image(path, {});
    if (!file) return file.error();
    images.emplace_back(std::filesystem::path(path).stem().string(), std::move(file->image));
  }
  Table shares({{"image"},
                {"foreground"},
                {"brushfire sequential"},
                {"brushfire sides"},
                {"brushfire marking"},
                {"brushfire simultaneous"},
                {"ridge"},
                {"disks"}});
  Table counts({{"image"}, {"foreground"}, {"method"}, {"axis"}, {"missing"}, {"extra"}});
  std::string figure;
  for (const auto& [name, image] : images) {
    progress(name);
    const auto inversions = inversions_of(image);
    if (!inversions) return inversions.error();
    if (figure.empty()) figure = drawing(image, *inversions);
    add_rows(name, image, *inversions, shares, counts);
  }
  return in_order([&] { return write(request, "accuracy.md", shares.markdown()); },
                  [&] { return write(request, "accuracy.csv", counts.csv()); },
                  [&] { return write(request, "fig14.svg", figure); });
}

Result<bool> run_volkmann_stclair_1987(const Request& request) {
  const Status measured =
      in_order([&] { return measure_accuracy(request); }, [&] { return measure_packing(request); });
  if (!measured) return measured.error();
  return measure_ridge_following(request);
}

}  // namespace medial::papers
