// A solid and its axis from three sides. Cairo has no depth, so pixels are painted here, with a
// depth for each; Cairo holds the image and writes it.

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "base/vec3.h"
#include "io/pictures/pictures.h"
#include "medial/geometry.h"

namespace medial::io {

namespace {

/// A direction to look in, with what is right and up in the picture. Orthonormal.
struct View {
  Vec3 right, up, towards;  ///< `towards` points to the eye
};

/// Looks along an axis, turned a little to the side and down, so that sheets show their faces. The
/// y axis points up, as in most meshes; seen along it, the z axis points down.
View view_along(int axis) {
  constexpr double aside = 0.45, above = 0.35;
  Vec3 towards, up;
  towards[axis] = 1;
  towards[axis == 1 ? 2 : 1] = above;
  towards[axis == 0 ? 2 : 0] = aside;
  up[axis == 1 ? 2 : 1] = axis == 1 ? -1 : 1;
  towards = 1 / norm(towards) * towards;
  const Vec3 right = cross(up, towards);
  const Vec3 unit_right = 1 / norm(right) * right;
  return {unit_right, cross(towards, unit_right), towards};
}

/// An image of pixels with depths.
class DepthCanvas {
 public:
  DepthCanvas(int width, int height)
      : width_(width),
        height_(height),
        color_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), paper_color),
        depth_(color_.size(), -std::numeric_limits<float>::infinity()) {}

  void clear_depth() { std::ranges::fill(depth_, -std::numeric_limits<float>::infinity()); }

  void paint(int x, int y, double depth, const Color& color) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                           static_cast<std::size_t>(x);
    if (depth_[at] >= static_cast<float>(depth)) return;
    depth_[at] = static_cast<float>(depth);
    color_[at] = color;
  }
  int width() const { return width_; }
  int height() const { return height_; }

  /// The mean of a square of `factor` pixels on a side.
  Color mean(int x, int y, int factor) const {
    Color sum{0, 0, 0};
    for (int j = 0; j < factor; ++j) {
      for (int i = 0; i < factor; ++i) {
        const Color& c =
            color_[static_cast<std::size_t>(y * factor + j) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x * factor + i)];
        sum.red += c.red;
        sum.green += c.green;
        sum.blue += c.blue;
      }
    }
    const double share = 1.0 / (factor * factor);
    return {sum.red * share, sum.green * share, sum.blue * share};
  }

 private:
  int width_, height_;
  std::vector<Color> color_;
  std::vector<float> depth_;
};

struct Point {
  double x, y, depth;
};

/// Paints a triangle in one colour.
void paint_triangle(DepthCanvas& canvas, const std::array<Point, 3>& p, const Color& color) {
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
  if (area == 0 || !std::isfinite(area)) return;
  const auto pixel = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
  const int last_x = pixel(std::ceil(right), canvas.width() - 1);
  const int last_y = pixel(std::ceil(bottom), canvas.height() - 1);
  for (int y = pixel(std::floor(top), canvas.height() - 1); y <= last_y; ++y) {
    for (int x = pixel(std::floor(left), canvas.width() - 1); x <= last_x; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      std::array<double, 3> share;
      for (std::size_t i = 0; i < 3; ++i) {
        const Point& a = p[(i + 1) % 3];
        const Point& b = p[(i + 2) % 3];
        share[i] = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
      }
      if (share[0] < 0 || share[1] < 0 || share[2] < 0) continue;
      canvas.paint(x, y, share[0] * p[0].depth + share[1] * p[1].depth + share[2] * p[2].depth,
                   color);
    }
  }
}

class Scene {
 public:
  Scene(const VoxelAxis& axis, const Solid& solid) : axis_(axis), solid_(solid) {
    for (const Voxel& voxel : axis.voxels) largest_ = std::max(largest_, voxel.radius);
    for (const double radius : axis.surface.radii) largest_ = std::max(largest_, radius);
  }

  /// The corners of the smallest rectangle around the solid, in units of the input.
  Box extent(const View& view) const {
    Box box = Box::nothing();
    for (const Vec3 p : solid_.surface.vertices) box.add(Vec2{dot(p, view.right), dot(p, view.up)});
    return box;
  }

  /// Paints the scene as seen in one view, `scale` pixels for each unit.
  void paint(DepthCanvas& canvas, const View& view, double scale) const {
    const auto [low, high] = extent(view);
    const double x = 0.5 * (low.x + high.x), y = 0.5 * (low.y + high.y);
    const auto place = [&](Vec3 p) {
      return Point{0.5 * canvas.width() + scale * (dot(p, view.right) - x),
                   0.5 * canvas.height() - scale * (dot(p, view.up) - y), dot(p, view.towards)};
    };
    canvas.clear_depth();
    paint_solid(canvas, view, place);
    canvas.clear_depth();
    if (axis_.surface.vertices.empty()) {
      paint_voxels(canvas, view, place);
    } else {
      paint_surface(canvas, view, place);
    }
  }

 private:
  /// The far side of the surface, as a light shell in which the axis stands.
  template <class Place>
  void paint_solid(DepthCanvas& canvas, const View& view, Place place) const {
    const auto& vertices = solid_.surface.vertices;
    for (const auto& face : solid_.surface.faces) {
      const Vec3 a = vertices[face[0]], b = vertices[face[1]], c = vertices[face[2]];
      const Vec3 normal = cross(b - a, c - a);
      const double length = norm(normal);
      if (!(length > 0)) continue;
      const double facing = dot(normal, view.towards) / length;
      if (facing >= 0) continue;
      const double light = 0.78 + 0.18 * -facing;
      std::array<Point, 3> corners = {place(a), place(b), place(c)};
      paint_triangle(canvas, corners, {light, light, light * 0.985});
    }
  }

  Color color_of(double radius, double light) const {
    const double at = largest_ > 0 ? radius / largest_ : 0;
    const Color base = shade(static_cast<int>(std::lround(at * (shade_count - 1))));
    return {base.red * light, base.green * light, base.blue * light};
  }

  /// Triangles, lit from the eye, and lines a little in front of them, as long triangles.
  template <class Place>
  void paint_surface(DepthCanvas& canvas, const View& view, Place place) const {
    const auto& [vertices, radii, triangles, lines] = axis_.surface;
    for (const auto& [i, j, k] : triangles) {
      const Vec3 a = vertices[i], b = vertices[j], c = vertices[k];
      const Vec3 normal = cross(b - a, c - a);
      const double length = norm(normal);
      if (!(length > 0)) continue;
      const double light = 0.5 + 0.5 * std::fabs(dot(normal, view.towards)) / length;
      paint_triangle(canvas, {place(a), place(b), place(c)},
                     color_of((radii[i] + radii[j] + radii[k]) / 3, light));
    }
    for (const auto& [i, j] : lines) {
      const Vec3 a = vertices[i] + axis_.resolution * view.towards,
                 b = vertices[j] + axis_.resolution * view.towards;
      const Vec3 across = cross(b - a, view.towards);
      const double length = norm(across);
      const Vec3 side = length > 0 ? 0.35 * axis_.resolution / length * across : Vec3{};
      const Color color = color_of(0.5 * (radii[i] + radii[j]), 0.75);
      paint_triangle(canvas, {place(a - side), place(a + side), place(b + side)}, color);
      paint_triangle(canvas, {place(a - side), place(b + side), place(b - side)}, color);
    }
  }

  /// Each voxel as the three faces of its cube that can be seen.
  template <class Place>
  void paint_voxels(DepthCanvas& canvas, const View& view, Place place) const {
    const double half = 0.5 * axis_.resolution;
    for (const Voxel& voxel : axis_.voxels) {
      for (int k = 0; k < 3; ++k) {
        const double facing = view.towards[k];
        if (facing == 0) continue;
        Vec3 normal, u, v;
        normal[k] = facing > 0 ? half : -half;
        u[(k + 1) % 3] = half;
        v[(k + 2) % 3] = half;
        const Vec3 middle = voxel.center + normal;
        const Point a = place(middle - u - v), b = place(middle + u - v), c = place(middle + u + v),
                    d = place(middle - u + v);
        const double light = 0.62 + 0.38 * std::fabs(facing);
        const Color color = color_of(voxel.radius, light);
        paint_triangle(canvas, {a, b, c}, color);
        paint_triangle(canvas, {a, c, d}, color);
      }
    }
  }

  const VoxelAxis& axis_;
  const Solid& solid_;
  double largest_ = 0;  ///< radius
};

std::uint32_t packed(const Color& color) {
  const auto byte = [](double value) {
    return static_cast<std::uint32_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
  };
  return byte(color.red) << 16U | byte(color.green) << 8U | byte(color.blue);
}

/// A solid, faintly, and its axis, coloured by radius, from three sides.
Status write_voxel_picture(Target& target, const VoxelsOutput& output) {
  OutputStream& out = *target.out;
  const double width = output.width;
  constexpr double smallest_size = 48, largest_size = 8000;
  if (!(width >= smallest_size && width <= largest_size)) {
    return Error{ErrorCode::invalid_option,
                 fmt::format("the width of a picture of voxels lies between {} and {}",
                             smallest_size, largest_size),
                 {}};
  }
  constexpr int factor = 2;  // pixels painted for each one shown, along a side
  const int side = static_cast<int>(width) / 3;
  using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, 3 * side, side),
                        &cairo_surface_destroy);
  const cairo_status_t status = cairo_surface_status(surface.get());
  if (status == CAIRO_STATUS_SUCCESS) {
    cairo_surface_flush(surface.get());
    unsigned char* pixels = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    const Scene scene(output.axis, output.solid);
    double largest = 0;  // of the three views, which share one scale
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = scene.extent(view_along(k));
      largest = std::max({largest, high.x - low.x, high.y - low.y});
    }
    const double scale = largest > 0 ? 0.94 * side * factor / largest : 1;
    for (int k = 0; k < 3; ++k) {
      DepthCanvas canvas(side * factor, side * factor);
      scene.paint(canvas, view_along(k), scale);
      for (int y = 0; y < side; ++y) {
        auto* row =
            reinterpret_cast<std::uint32_t*>(pixels + static_cast<std::ptrdiff_t>(y) * stride);
        for (int x = 0; x < side; ++x) row[k * side + x] = packed(canvas.mean(x, y, factor));
      }
    }
    cairo_surface_mark_dirty(surface.get());
    return write_png(out, surface.get());
  }
  return Error{
      ErrorCode::unwritable, fmt::format("cannot draw: {}", cairo_status_to_string(status)), {}};
}

}  // namespace

Format png_format() {
  return with_pictures(Format{".png"}).writes<VoxelsOutput>(write_voxel_picture);
}

}  // namespace medial::io
