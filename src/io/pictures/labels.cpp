#include "io/pictures/labels.h"

#include <algorithm>
#include <cmath>

namespace medial::io {

Labels::Labels(Canvas& canvas, double size) : canvas_(canvas), size_(size), cell_(0.25 * size) {
  columns_ = static_cast<std::size_t>(canvas.viewport().width / cell_) + 1;
  rows_ = static_cast<std::size_t>(canvas.viewport().height / cell_) + 1;
  lines_.resize(columns_ * rows_);
}

std::size_t Labels::cell_at(Vec2 p) const {
  const auto index = [this](double place, std::size_t count) {
    const double last = static_cast<double>(count) - 1;
    return static_cast<std::size_t>(std::clamp(std::floor(place / cell_), 0.0, last));
  };
  return index(p.y, rows_) * columns_ + index(p.x, columns_);
}

void Labels::avoid(Vec2 from, Vec2 to) {
  const double steps = std::ceil(distance(from, to) / cell_);
  for (double k = 0; k <= steps; k += 1)
    lines_[cell_at(from + (k / std::max(steps, 1.0)) * (to - from))] = true;
}

std::uint32_t Labels::covered(const Box& box) const {
  const std::size_t first = cell_at(box.low), last = cell_at(box.high);
  std::uint32_t count = 0;
  for (std::size_t y = first / columns_; y <= last / columns_; ++y)
    for (std::size_t x = first % columns_; x <= last % columns_; ++x)
      count += lines_[y * columns_ + x] ? 1 : 0;
  return count;
}

bool Labels::is_free(const Box& box) const {
  const Viewport& all = canvas_.viewport();
  if (box.low.x < 0 || box.low.y < 0 || box.high.x > all.width || box.high.y > all.height)
    return false;
  return std::ranges::none_of(taken_, [&box](const Box& other) {
    return box.low.x < other.high.x && other.low.x < box.high.x && box.low.y < other.high.y &&
           other.low.y < box.high.y;
  });
}

bool Labels::put(Vec2 at, const std::string& words, const Color& color) {
  canvas_.use_font(size_);
  cairo_text_extents_t extents;
  cairo_text_extents(canvas_.context(), words.c_str(), &extents);
  const Vec2 half{0.5 * extents.width + 0.2 * size_, 0.5 * size_};
  const Box* best = nullptr;
  std::uint32_t fewest = 0;
  std::vector<Box> boxes;
  for (const double far : {1.0, 2.0})
    for (const Vec2 way : {Vec2{0, -1}, Vec2{0, 1}, Vec2{1, 0}, Vec2{-1, 0}, Vec2{1, -1},
                           Vec2{1, 1}, Vec2{-1, -1}, Vec2{-1, 1}}) {
      const Vec2 middle =
          at + Vec2{way.x * (half.x + 0.4 * far * size_), way.y * (half.y + 0.4 * far * size_)};
      boxes.push_back({middle - half, middle + half});
    }
  boxes.push_back({at - half, at + half});
  for (const Box& box : boxes) {
    if (!is_free(box)) continue;
    const std::uint32_t count = covered(box);
    if (best != nullptr && count >= fewest) continue;
    best = &box;
    fewest = count;
  }
  if (best == nullptr) return false;
  taken_.push_back(*best);
  const Vec2 middle = midpoint(best->low, best->high);
  constexpr double base_line = 0.35;  // below the middle of the letters
  canvas_.move_to(
      {middle.x - 0.5 * extents.width - extents.x_bearing, middle.y + base_line * size_});
  cairo_text_path(canvas_.context(), words.c_str());
  cairo_set_line_width(canvas_.context(), 0.25 * size_);
  canvas_.color(paper_color, 0.8);
  cairo_stroke_preserve(canvas_.context());
  canvas_.color(color);
  canvas_.fill();
  return true;
}

}  // namespace medial::io
