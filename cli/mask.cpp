#include "cli/mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <queue>
#include <utility>

#include "medial/query.h"
#include "medial/raster.h"

namespace medial::cli {
namespace {

/// The pixels of an image that an axis passes through, or those of its nodes alone.
void draw_pixels(const MedialAxis& axis, const PixelPlacement& t, bool nodes_alone, Image& image) {
  const double side = std::hypot(t[1], t[4]), area = t[1] * t[5] - t[2] * t[4];
  const auto draw = [&](const Disk& disk) {
    const double x = disk.center.x - t[0], y = disk.center.y - t[3];
    const auto column = static_cast<std::int64_t>(std::floor((x * t[5] - y * t[2]) / area));
    const auto row = static_cast<std::int64_t>(std::floor((y * t[1] - x * t[4]) / area));
    if (column >= 0 && row >= 0 && column < image.width() && row < image.height())
      image.set(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
  };
  for (const Node& node : axis.nodes) draw(node.disk);  // one without edges is all of a part
  if (nodes_alone) return;
  for (const Edge& edge : axis.edges)
    for (const Disk& disk : sample_by_step(axis, edge, 0.25 * side)) draw(disk);
}

/// Removes foreground pixels, farthest from the lines first, without changing components or holes,
/// until only the lines and their connections remain (Pudney 1998).
class Peeling {
 public:
  Peeling(Image& image, const Image& lines, const DistanceMap& distances)
      : image_(image), lines_(lines), distances_(distances) {}

  void run() {
    for (std::uint32_t y = 0; y < image_.height(); ++y)
      for (std::uint32_t x = 0; x < image_.width(); ++x) offer(x, y);
    while (!border_.empty()) {
      const std::uint64_t pixel = border_.top().second;
      border_.pop();
      const auto x = static_cast<std::int64_t>(pixel % image_.width());
      const auto y = static_cast<std::int64_t>(pixel / image_.width());
      if (!can_go(x, y)) continue;
      image_.set(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), false);
      for (const auto& [dx, dy] : around) offer(x + dx, y + dy);
    }
  }

 private:
  static constexpr std::array<std::pair<int, int>, 8> around{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

  /// Whether the pixel is foreground off the lines, with exactly one run of background around it
  /// that shares a side with it.
  bool can_go(std::int64_t x, std::int64_t y) const {
    if (!image_.at(x, y) || lines_.at(x, y)) return false;
    std::array<bool, 8> empty{};
    for (std::size_t k = 0; k < 8; ++k)
      empty[k] = !image_.at(x + around[k].first, y + around[k].second);
    int runs = 0;
    for (std::size_t k = 0; k < 8; k += 2)
      runs += empty[k] && !(empty[(k + 1) % 8] && empty[(k + 2) % 8]) ? 1 : 0;
    return runs == 1;
  }
  void offer(std::int64_t x, std::int64_t y) {
    if (!can_go(x, y)) return;
    const std::uint32_t far =
        distances_.squared_at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    border_.emplace(far,
                    static_cast<std::uint64_t>(y) * image_.width() + static_cast<std::uint64_t>(x));
  }

  Image& image_;
  const Image& lines_;
  const DistanceMap& distances_;
  std::priority_queue<std::pair<std::uint32_t, std::uint64_t>> border_;
};

/// The pixels of lines in the image, and the pixels that connect them as the image is connected.
Result<Image> lines_in(Image image, const Image& drawn) {
  Image lines(image.width(), image.height()), beside = lines;
  for (std::uint32_t y = 0; y < image.height(); ++y)
    for (std::uint32_t x = 0; x < image.width(); ++x)
      (image.at(x, y) && drawn.at(x, y) ? lines : beside).set(x, y);
  const auto distances = distance_transform(beside, {.outside_is_background = false});
  if (!distances) return distances.error();
  Peeling(image, lines, *distances).run();
  return thin(image);
}

/// Whether an axis comes from a brushfire on the image's own pixels, so that it is thin already.
bool is_of_own_pixels(const MedialAxis& axis, double pixel) {
  constexpr double rounding = 1e-9;
  return axis.method == "brushfire" && std::abs(axis.resolution - pixel) < rounding * pixel;
}

}  // namespace

Status check_mask(const FileArguments& arguments) {
  const io::WriteOptions& write = arguments.write;
  if (!io::is_image(arguments.input.path)) return invalid_option("--mask is for images");
  // The image is read again at the end.
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(arguments.input.path, ignored))
    return invalid_option("--mask is for images in files, not in pipes");
  if (arguments.output.empty()) return invalid_option("--mask needs -o with the name of an image");
  if (write.disks > 0 || write.contacts || write.nodes || !write.shape ||
      write.width != io::WriteOptions{}.width)
    return invalid_option(
        "--mask writes the pixels of the image: --disks, --contacts, --nodes, --no-shape and "
        "--width are for pictures");
  return success();
}

Status write_mask(const Document<AxisItem>& axes, const FileArguments& arguments, bool exterior) {
  const io::SourceOptions& source = arguments.input.source;
  io::ImageOptions options = source.read.image;
  if (options.labels) options = {.threshold = 1};
  auto file = io::read_image(arguments.input.path, options);
  if (!file) return std::move(file).error();
  const UnitOptions& units = source.units;
  PixelPlacement placement = file->placement;
  if (axes.pixel > 0)
    for (double& t : placement)
      t *= axes.pixel / std::hypot(file->placement[1], file->placement[4]);
  else if (source.read.project || units.wanted != Unit::unknown || units.scale != 1)
    return invalid_option("--mask needs square pixels if lengths are converted");
  Image drawn(file->image.width(), file->image.height());
  const bool burnt = std::ranges::all_of(
      axes.items, [&](const AxisItem& item) { return is_of_own_pixels(item.axis, axes.pixel); });
  for (const AxisItem& item : axes.items) draw_pixels(item.axis, placement, burnt, drawn);
  Result<Image> lines = std::move(drawn);
  if (!burnt && (exterior || source.read.image.labels))
    lines = thin(*lines);
  else if (!burnt)
    lines = lines_in(std::move(file->image), *lines);
  if (!lines) return lines.error();
  return io::write_image(arguments.output, arguments.format, *lines, *file);
}

}  // namespace medial::cli
