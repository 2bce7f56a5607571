// Occupancy grids of ROS's map server: a .yaml that names an image, its resolution and its origin.

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "io/format.h"
#include "io/gis/rasters.h"
#include "io/place.h"
#include "io/ros_map_keys.h"

namespace medial::io {

namespace {

/// What the file says of its image.
struct RosMap {
  std::string image;
  double resolution = 0;
  std::array<double, 3> origin{};  ///< of the lower left corner: x, y, and the angle in radians
  bool negate = false;
  bool raw = false;  ///< pixels are probabilities in per cent; 255: unknown
  double free_threshold = 0.196;
};

/// Numbers between brackets and commas; how many there were.
std::size_t read_numbers(const std::string& text, std::span<double> numbers) {
  std::string plain = text;
  std::ranges::replace_if(
      plain, [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
  std::istringstream words(plain);
  std::size_t count = 0;
  while (count < numbers.size() && words >> numbers[count]) ++count;
  return count;
}

Result<RosMap> map_of(const std::string& text) {
  auto keys = ros_map_keys(text);
  RosMap map;
  map.image = keys["image"];
  if (map.image.empty() || !keys.contains("resolution") || !keys.contains("origin"))
    return Error{ErrorCode::malformed,
                 "this is not a ROS map: it needs the keys image, resolution and origin",
                 {}};
  if (read_numbers(keys["resolution"], std::span(&map.resolution, 1)) != 1 ||
      !(map.resolution > 0) || !std::isfinite(map.resolution))
    return Error{ErrorCode::malformed, "the resolution of a ROS map must be above 0", {}};
  if (read_numbers(keys["origin"], map.origin) < 2 ||
      !std::ranges::all_of(map.origin, [](double v) { return std::isfinite(v); }))
    return Error{ErrorCode::malformed, "the origin of a ROS map is x, y and an angle", {}};
  map.negate = keys["negate"] == "1" || keys["negate"] == "true";
  map.raw = keys["mode"] == "raw";
  if (keys.contains("free_thresh") &&
      (read_numbers(keys["free_thresh"], std::span(&map.free_threshold, 1)) != 1 ||
       !(map.free_threshold >= 0 && map.free_threshold <= 1)))
    return Error{ErrorCode::malformed, "free_thresh of a ROS map must be between 0 and 1", {}};
  return map;
}

/// A cell is occupied with the probability (255 - value) / 255, or value / 255 if negated, and free
/// below the threshold; what is unknown is at or above it.
ImageOptions free_cells(const RosMap& map) {
  ImageOptions options;
  if (map.raw) return {std::ceil(100 * map.free_threshold), true};
  options.invert = map.negate;
  options.threshold = map.negate ? std::ceil(255 * map.free_threshold)
                                 : std::floor(255 * (1 - map.free_threshold)) + 1;
  return options;
}

/// Rows run downwards from the upper left corner, which lies a height above the origin.
PixelPlacement placement_of(const RosMap& map, std::uint32_t height) {
  const auto [x, y, angle] = map.origin;
  const Vec2 right{map.resolution * std::cos(angle), map.resolution * std::sin(angle)};
  const Vec2 down = -1.0 * left_of(right);
  const Vec2 corner = Vec2{x, y} - static_cast<double>(height) * down;
  return {corner.x, right.x, down.x, corner.y, right.y, down.y};
}

/// The outline of what is free.
Result<Document<Feature>> read_ros_map(const Input& input, const ReadOptions& options) {
  if (options.image.labels || options.repair != RepairRule::none)
    return Error{ErrorCode::invalid_option, "--labels and --repair are not for ROS maps",
                 in_file(input.path)};
  auto file = read_ros_image(input.path, *input.source, options.image);
  if (!file) return std::move(file).error();
  if (options.smooth_contour)
    file->notes.push_back(
        "the outline is smoothed, within half a cell; --pixel-outline keeps the cells' edges");
  auto dataset = outline_document(std::move(*file), {}, options);
  if (dataset) dataset->unit = Unit::metre;
  return dataset;
}

}  // namespace

Result<ImageFile> read_ros_image(const std::string& path, TextSource& source,
                                 const ImageOptions& given) {
  std::string text;
  source.read_all(text, longest_ros_map);
  if (source.failure()) return *source.failure();
  auto map = map_of(text);
  if (!map) {
    map.error().place = in_file(path);
    return std::move(map).error();
  }
  if (given.threshold || given.invert)
    return Error{ErrorCode::invalid_option,
                 "a map says itself which cells are free: --threshold and --invert are not for it",
                 in_file(path)};
  const auto beside = std::filesystem::path(path).replace_filename(map->image).string();
  auto file = is_ros_map(beside)
                  ? Error{ErrorCode::unsupported, "the image of a map cannot be a map", {}}
                  : read_image(beside, free_cells(*map));
  if (!file) {
    file.error().text = fmt::format(
        "its image {}: {}", std::filesystem::path(beside).filename().string(), file.error().text);
    return std::move(file).error();
  }
  file->placement = placement_of(*map, file->image.height());
  file->unit = Unit::metre;
  file->notes.push_back("the shape is what is free; occupied and unknown cells lie outside");
  return file;
}

Format ros_map_format() {
  Format format;
  format.also_read = ".yaml .yml";
  format.read = read_ros_map;
  return format;
}

}  // namespace medial::io
