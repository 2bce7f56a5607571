#include "io/pictures/cut_surface.h"

#include <algorithm>
#include <cmath>

#include "io/tool_paths.h"

namespace medial::io {
namespace {

/// A move of a tool, straight through space.
struct Move {
  Vec2 from, way;
  double deep = 0, deeper = 0;  ///< at the start; and how much more at the end
  double tip = 0, slope = 0;

  double depth_at(Vec2 p, double share) const {
    const double beyond = distance(p, from + share * way) - tip;
    if (beyond > 0 && slope == 0) return 0;
    return deep + share * deeper - (beyond > 0 ? beyond / slope : 0);
  }
  /// How deep the move cuts at p. On a steady way down the cone reaches furthest from a place
  /// further on than the nearest one.
  double depth_at(Vec2 p) const {
    const double length = norm(way);
    if (length == 0) return depth_at(p, 0);
    const double along = dot(p - from, way) / length;
    const double aside = std::abs(cross(way, p - from)) / length, k = slope * deeper / length;
    double most = 0;
    for (const double on : {0.0, aside * k / std::sqrt(std::max(1 - k * k, 1e-9))})
      most = std::max(most, depth_at(p, std::clamp((along + on) / length, 0.0, 1.0)));
    return most;
  }
};

class Surface {
 public:
  explicit Surface(const Viewport& viewport)
      : viewport_(viewport),
        columns_(static_cast<std::int64_t>(viewport.width)),
        rows_(static_cast<std::int64_t>(viewport.height)),
        heights_(static_cast<std::size_t>(columns_ * rows_), 0.0) {}

  void cut(const Carving& carving, const ToolPath& path) {
    const std::vector<ToolPoint> points = without_arcs(path, 0.1 / viewport_.scale);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      cut(Move{points[i].point, points[i + 1].point - points[i].point, -points[i].z,
               points[i].z - points[i + 1].z, carving.tip_radius, carving.slope});
  }
  std::vector<double> take() { return std::move(heights_); }

 private:
  void cut(const Move& move) {
    const double radius = move.tip + move.slope * std::max(move.deep, move.deep + move.deeper);
    if (!(radius > 0)) return;
    const Vec2 a = viewport_(move.from), b = viewport_(move.from + move.way);
    const double wide = radius * viewport_.scale;
    const auto index = [](double place, std::int64_t count) {
      return std::clamp(static_cast<std::int64_t>(std::floor(place)), std::int64_t{0}, count);
    };
    const std::int64_t left = index(std::min(a.x, b.x) - wide, columns_);
    const std::int64_t right = index(std::max(a.x, b.x) + wide + 1, columns_);
    const std::int64_t bottom = index(std::max(a.y, b.y) + wide + 1, rows_);
    for (std::int64_t y = index(std::min(a.y, b.y) - wide, rows_); y < bottom; ++y) {
      for (std::int64_t x = left; x < right; ++x) {
        double& height = heights_[static_cast<std::size_t>(y * columns_ + x)];
        height = std::min(height, -move.depth_at(place(x, y)));
      }
    }
  }
  /// The middle of a pixel in the plane.
  Vec2 place(std::int64_t x, std::int64_t y) const {
    return viewport_.plane_at({static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5});
  }

  const Viewport& viewport_;
  std::int64_t columns_, rows_;
  std::vector<double> heights_;
};

}  // namespace

std::vector<double> surface_after(const Document<CarveItem>& file, const Viewport& viewport) {
  Surface surface(viewport);
  for (const CarveItem& item : file.items)
    for_each_path(item, [&](const Carving& carving, const ToolPath& path, const char*) {
      surface.cut(carving, path);
    });
  return surface.take();
}

std::vector<std::uint32_t> shaded(const std::vector<double>& heights, const Viewport& viewport) {
  const auto columns = static_cast<std::size_t>(viewport.width);
  const auto rows = static_cast<std::size_t>(viewport.height);
  const double deepest = std::min(*std::ranges::min_element(heights), -1e-300);
  constexpr Color wood{0.93, 0.86, 0.74}, bottom{0.62, 0.45, 0.28};
  const double light_across = -0.45, light_down = -0.45;  // where light comes from, in the picture
  const double light_up = std::sqrt(1 - light_across * light_across - light_down * light_down);
  std::vector<std::uint32_t> pixels(heights.size());
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const auto at = [&](std::size_t c, std::size_t r) { return heights[r * columns + c]; };
      const double across = viewport.scale * (at(std::min(x + 1, columns - 1), y) - at(x, y));
      const double down = viewport.scale * (at(x, std::min(y + 1, rows - 1)) - at(x, y));
      const double facing = (light_up - across * light_across - down * light_down) /
                            std::sqrt(1 + across * across + down * down);
      const double share = at(x, y) / deepest;
      const double light = std::clamp(0.35 + 0.65 * facing / light_up, 0.0, 1.2);
      const auto channel = [&](double high, double low) {
        const double value = light * (high + share * (low - high));
        return static_cast<std::uint32_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
      };
      pixels[y * columns + x] = channel(wood.red, bottom.red) << 16U |
                                channel(wood.green, bottom.green) << 8U |
                                channel(wood.blue, bottom.blue);
    }
  }
  return pixels;
}

}  // namespace medial::io
