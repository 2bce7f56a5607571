#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/threads.h"
#include "io/pictures/pictures.h"

namespace medial::io {

namespace {

constexpr int most_lines = 1000;

/// The brighter the lower the potential, by its logarithm; white outside. One a pixel, in rows.
std::vector<std::uint32_t> brightness(std::span<const PotentialField> fields,
                                      const Canvas& canvas) {
  const auto columns = static_cast<std::size_t>(canvas.viewport().width);
  const auto rows = static_cast<std::size_t>(canvas.viewport().height);
  std::vector<double> values(columns * rows, std::numeric_limits<double>::quiet_NaN());
  parallel_for(rows, [&](std::size_t row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const Vec2 p = canvas.viewport().plane_at(
          {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5});
      for (const PotentialField& field : fields) {
        const auto found = field.at(p);
        if (!found) continue;
        values[row * columns + column] = found->log_potential;
        break;
      }
    }
  });
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  std::vector<std::uint32_t> pixels(values.size(), 0xFFFFFFU);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    const double share = high > low ? (high - values[i]) / (high - low) : 0.5;
    const auto level = static_cast<std::uint32_t>(std::lround(40 + 215 * share * share));
    pixels[i] = level << 16U | level << 8U | level;
  }
  return pixels;
}

void draw_lines(Canvas& canvas, std::span<const PotentialField> fields, const Box& box, int count) {
  const Vec2 size = box.high - box.low;
  const double gap = std::max(size.x, size.y) / count;
  constexpr std::size_t most_steps = 400;
  // Counted, as far from the origin a sum of small steps may not grow.
  const auto starts = [&](double extent) {
    return static_cast<int>(std::ceil(extent / gap - 0.5));
  };
  for (int row = 0; row < starts(size.y); ++row) {
    for (int column = 0; column < starts(size.x); ++column) {
      const Vec2 start = box.low + gap * Vec2{column + 0.5, row + 0.5};
      for (const PotentialField& field : fields) {
        canvas.trace(std::span<const Vec2>(field.streamline(start, 0.25 * gap, most_steps)));
        canvas.stroke();
      }
    }
  }
}

}  // namespace

Status write_picture(Target& target, const FieldOutput& output) {
  const FieldPictureOptions& options = output.options;
  if (options.lines < 0 || options.lines > most_lines)
    return Error{
        ErrorCode::invalid_option, "the number of force lines lies between 0 and 1000", {}};
  Extent extent;
  for (const Shape& shape : output.shapes) extent.add(shape);
  const Box box = extent.box();
  const auto draw = [&output, &box](Canvas& canvas) {
    if (output.options.brightness) canvas.image(brightness(output.fields, canvas));
    canvas.color({0.15, 0.35, 0.65});
    canvas.line_width(0.8);
    if (output.options.lines > 0) draw_lines(canvas, output.fields, box, output.options.lines);
    canvas.color({0.2, 0.2, 0.2});
    canvas.line_width(1.6);
    for (const Shape& shape : output.shapes) {
      canvas.trace(shape);
      canvas.stroke();
    }
  };
  return write_canvas(target, box, options.width, options.y_down, draw);
}

}  // namespace medial::io
