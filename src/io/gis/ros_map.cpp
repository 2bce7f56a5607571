// Occupancy grids of ROS's map server: a .yaml that names an image, its resolution and its origin.

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "io/format.h"
#include "io/gis/rasters.h"
#include "io/place.h"

namespace medial::io {

namespace {

std::string trimmed(std::string text) {
  const auto begin = text.find_first_not_of(" \t\r'\"");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r'\"") + 1 - begin);
}

/// The lines `key: value` of a text, without comments.
std::map<std::string, std::string> keys_of(const std::string& text) {
  std::map<std::string, std::string> keys;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find(" #"));
    const auto colon = line.find(':');
    if (line.starts_with('#') || colon == std::string::npos) continue;
    keys[trimmed(line.substr(0, colon))] = trimmed(line.substr(colon + 1));
  }
  return keys;
}

/// What the file says of its image.
struct RosMap {
  std::string image;
  double resolution = 0;
  std::array<double, 3> origin{};  ///< of the lower left corner: x, y, and the angle in radians
  bool negate = false;
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

std::optional<RosMap> map_of(const std::string& text) {
  auto keys = keys_of(text);
  RosMap map;
  map.image = keys["image"];
  if (map.image.empty() || read_numbers(keys["resolution"], std::span(&map.resolution, 1)) != 1 ||
      !(map.resolution > 0) || read_numbers(keys["origin"], map.origin) < 2)
    return std::nullopt;
  map.negate = keys["negate"] == "1" || keys["negate"] == "true";
  read_numbers(keys["free_thresh"], std::span(&map.free_threshold, 1));
  return map;
}

/// A cell is occupied with the probability (255 - value) / 255, or value / 255 if negated, and free
/// below the threshold; what is unknown is at or above it.
ImageOptions free_cells(const RosMap& map) {
  ImageOptions options;
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

Result<Document<Feature>> read_ros_map(const Input& input, const ReadOptions& options) {
  constexpr std::size_t longest = 1 << 20;
  std::string text;
  input.source->read_all(text, longest);
  if (input.source->failure()) return *input.source->failure();
  const auto map = map_of(text);
  if (!map)
    return Error{ErrorCode::malformed,
                 "this is not a ROS map: it needs the keys image, resolution and origin",
                 in_file(input.path)};
  const ImageOptions& given = options.image;
  if (given.threshold || given.invert || given.labels || options.repair != RepairRule::none)
    return Error{ErrorCode::invalid_option,
                 "a map says itself which cells are free: --threshold, --invert, --labels and "
                 "--repair are not for it",
                 in_file(input.path)};
  const auto beside = std::filesystem::path(input.path).replace_filename(map->image);
  auto file = read_image(beside.string(), free_cells(*map));
  if (!file) {
    file.error().text =
        fmt::format("its image {}: {}", beside.filename().string(), file.error().text);
    return std::move(file).error();
  }
  file->placement = placement_of(*map, file->image.height());
  file->notes.push_back("the shape is what is free; occupied and unknown cells lie outside");
  auto dataset = outline_document(std::move(*file), {}, options);
  if (dataset) dataset->unit = Unit::metre;
  return dataset;
}

}  // namespace

Format ros_map_format() {
  Format format;
  format.also_read = ".yaml .yml";
  format.read = read_ros_map;
  return format;
}

}  // namespace medial::io
