#include "papers/figure.h"

#include <cairo-svg.h>

#include <array>
#include <cmath>
#include <numbers>
#include <system_error>

#include "medial/io/write.h"

namespace medial::papers {

namespace {

constexpr double width = 480, margin = 20;
constexpr std::array<std::array<double, 3>, 9> colors{{{0.80, 0.20, 0.20},
                                                       {0.15, 0.45, 0.75},
                                                       {0.20, 0.55, 0.25},
                                                       {0.75, 0.45, 0.10},
                                                       {0.50, 0.25, 0.60},
                                                       {0.10, 0.60, 0.60},
                                                       {0.15, 0.45, 0.75},
                                                       {0.85, 0.55, 0.15},
                                                       {0.15, 0.45, 0.75}}};

cairo_status_t append(void* text, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Figure::Figure(Box box) : box_(box) {
  scale_ = (width - 2 * margin) / (box.high.x - box.low.x);
  height_ = std::ceil((box.high.y - box.low.y) * scale_ + 2 * margin);
  surface_.reset(cairo_svg_surface_create_for_stream(append, &text_, width, height_));
  cairo_.reset(cairo_create(surface_.get()));
  cairo_set_source_rgb(cairo_.get(), 1, 1, 1);
  cairo_paint(cairo_.get());
  cairo_set_line_cap(cairo_.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_rectangle(cairo_.get(), 1, 1, width - 2, height_ - 2);
  cairo_clip(cairo_.get());
}

void Figure::pen(double red, double green, double blue, double line_width) {
  cairo_set_source_rgb(cairo_.get(), red, green, blue);
  cairo_set_line_width(cairo_.get(), line_width);
}

void Figure::color(std::size_t which, double line_width) {
  const auto& [red, green, blue] = colors[which % colors.size()];
  pen(red, green, blue, line_width);
}

void Figure::stroke(std::span<const Vec2> points, double dash) {
  cairo_set_dash(cairo_.get(), &dash, dash > 0 ? 1 : 0, 0);
  cairo_new_path(cairo_.get());
  for (const Vec2 p : points) {
    const Vec2 at = place(p);
    cairo_line_to(cairo_.get(), at.x, at.y);
  }
  cairo_stroke(cairo_.get());
  cairo_set_dash(cairo_.get(), nullptr, 0, 0);
}

void Figure::arrow_head(Vec2 at, Vec2 direction) {
  constexpr double length = 9, half_width = 3.5;
  const Vec2 tip = place(at);
  const Vec2 along = (1 / norm(direction)) * Vec2{direction.x, -direction.y};
  cairo_new_path(cairo_.get());
  cairo_move_to(cairo_.get(), tip.x, tip.y);
  for (const double side : {half_width, -half_width}) {
    const Vec2 p = tip - length * along + side * left_of(along);
    cairo_line_to(cairo_.get(), p.x, p.y);
  }
  cairo_fill(cairo_.get());
}

void Figure::dot(Vec2 p) {
  const Vec2 at = place(p);
  cairo_new_path(cairo_.get());
  cairo_arc(cairo_.get(), at.x, at.y, 2.8, 0, 2 * std::numbers::pi);
  cairo_fill(cairo_.get());
}

void Figure::circle(const Disk& disk) {
  const Vec2 at = place(disk.center);
  cairo_new_path(cairo_.get());
  cairo_arc(cairo_.get(), at.x, at.y, disk.radius * scale_, 0, 2 * std::numbers::pi);
  cairo_stroke(cairo_.get());
}

void Figure::label(Vec2 p, const char* text, Vec2 offset) {
  const Vec2 at = place(p);
  cairo_set_font_size(cairo_.get(), 13);
  cairo_move_to(cairo_.get(), at.x + offset.x, at.y - offset.y);
  cairo_show_text(cairo_.get(), text);
}

void Figure::mark(Vec2 p, const char* text) {
  const Vec2 at = place(p);
  cairo_set_font_size(cairo_.get(), 9);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_.get(), text, &extents);
  cairo_move_to(cairo_.get(), at.x - extents.x_bearing - extents.width / 2,
                at.y - extents.y_bearing - extents.height / 2);
  cairo_show_text(cairo_.get(), text);
}

Status Figure::write(const std::filesystem::path& path) {
  cairo_.reset();
  cairo_surface_finish(surface_.get());
  return io::write_text(path.string(), text_);
}

Vec2 Figure::place(Vec2 p) const {
  return {margin + (p.x - box_.low.x) * scale_, height_ - margin - (p.y - box_.low.y) * scale_};
}

}  // namespace medial::papers
