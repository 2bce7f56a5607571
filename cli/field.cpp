// medial field: the potential of a charged border, and its force lines.

#include "medial/field.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>

#include "base/arc.h"
#include "cli/common.h"
#include "cli/costs.h"
#include "cli/pipeline.h"
#include "cli/plot.h"
#include "cli/terminal.h"

namespace medial::cli {
namespace {

constexpr char field_formats[] = ".png .svg .pdf";

struct FieldSwitches {
  InputSwitches input;
  CommonSwitches common;
  std::string output;
  double order = 1;
  double width = 800;
  int lines = 40;  ///< along the longer side
  bool brightness = true;
};

/// Where the plane lies in the picture.
struct View {
  double scale = 1, margin = 0;
  Box box;
  double width = 0, height = 0;
  double up = 1;
  Vec2 to_picture(Vec2 p) const {
    const double y = up > 0 ? box.high.y - p.y : p.y - box.low.y;
    return {margin + scale * (p.x - box.low.x), margin + scale * y};
  }
  Vec2 to_plane(Vec2 q) const {
    const double x = (q.x - margin) / scale + box.low.x, y = (q.y - margin) / scale;
    return {x, up > 0 ? box.high.y - y : box.low.y + y};
  }
};

View view_of(const ShapeFile& file, double width) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  View view;
  view.box = {{infinity, infinity}, {-infinity, -infinity}};
  for (const Shape& shape : file.shapes) {
    const Box own = bounding_box(shape);
    view.box.low = {std::min(view.box.low.x, own.low.x), std::min(view.box.low.y, own.low.y)};
    view.box.high = {std::max(view.box.high.x, own.high.x), std::max(view.box.high.y, own.high.y)};
  }
  view.up = file.y_down ? -1 : 1;
  const Vec2 size = view.box.high - view.box.low;
  view.margin = 0.02 * width;
  // A needle gets a picture of moderate height.
  view.scale = std::min((width - 2 * view.margin) / size.x, (4 * width - 2 * view.margin) / size.y);
  view.width = std::ceil(width);
  view.height = std::ceil(size.y * view.scale + 2 * view.margin);
  return view;
}

using Fields = std::vector<PotentialField>;

std::optional<PotentialField::Sample> sample(const Fields& fields, Vec2 p) {
  for (const PotentialField& field : fields)
    if (auto found = field.at(p)) return found;
  return std::nullopt;
}

/// The brighter the lower the potential, by its logarithm.
std::vector<std::uint32_t> brightness(const Fields& fields, const View& view) {
  const auto columns = static_cast<std::size_t>(view.width);
  const auto rows = static_cast<std::size_t>(view.height);
  std::vector<double> values(columns * rows, std::numeric_limits<double>::quiet_NaN());
  tbb::parallel_for(std::size_t{0}, rows, [&](std::size_t row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const Vec2 pixel{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
      if (const auto found = sample(fields, view.to_plane(pixel)))
        values[row * columns + column] = found->log_potential;
    }
  });
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // Next to the border the potential has no bound: what is above the 98th part of its range is
  // dark.
  std::vector<std::uint32_t> pixels(values.size(), 0xFFFFFFU);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    const double share = high > low ? (high - values[i]) / (high - low) : 0.5;
    const auto level = static_cast<std::uint32_t>(std::lround(40 + 215 * share * share));
    pixels[i] = level << 16U | level << 8U | level;
  }
  return pixels;
}

void draw(cairo_t* cairo, const ShapeFile& file, const Fields& fields, const View& view,
          const FieldSwitches& switches) {
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
  if (switches.brightness) {
    std::vector<std::uint32_t> pixels = brightness(fields, view);
    const int columns = static_cast<int>(view.width), rows = static_cast<int>(view.height);
    cairo_surface_t* image =
        cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()),
                                            CAIRO_FORMAT_RGB24, columns, rows, 4 * columns);
    cairo_set_source_surface(cairo, image, 0, 0);
    cairo_paint(cairo);
    // A vector picture keeps the image: it must not outlive the pixels.
    cairo_set_source_rgb(cairo, 0, 0, 0);
    cairo_surface_flush(cairo_get_target(cairo));
    cairo_surface_finish(image);
    cairo_surface_destroy(image);
  }
  cairo_set_line_width(cairo, view.width / 1200);
  cairo_set_source_rgb(cairo, 0.15, 0.35, 0.65);
  if (switches.lines > 0) {
    const Vec2 size = view.box.high - view.box.low;
    const double gap = std::max(size.x, size.y) / switches.lines;
    constexpr std::size_t most_steps = 400;
    for (double y = view.box.low.y + 0.5 * gap; y < view.box.high.y; y += gap) {
      for (double x = view.box.low.x + 0.5 * gap; x < view.box.high.x; x += gap) {
        for (const PotentialField& field : fields) {
          const std::vector<Vec2> line = field.streamline({x, y}, 0.25 * gap, most_steps);
          for (std::size_t i = 0; i < line.size(); ++i) {
            const Vec2 p = view.to_picture(line[i]);
            i == 0 ? cairo_move_to(cairo, p.x, p.y) : cairo_line_to(cairo, p.x, p.y);
          }
          cairo_stroke(cairo);
        }
      }
    }
  }
  cairo_set_source_rgb(cairo, 0.2, 0.2, 0.2);
  cairo_set_line_width(cairo, view.width / 600);
  for (const Shape& shape : file.shapes) {
    for (std::size_t l = 0; l < shape.loop_count(); ++l) {
      const std::span<const Vec2> loop = shape.loop(l);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const BulgeArc arc{loop[i], loop[i + 1 == loop.size() ? 0 : i + 1],
                           shape.bulge(shape.loop_begin[l] + i)};
        constexpr int chords = 16;
        for (int k = arc.bulge == 0 ? chords : 0; k <= chords; ++k) {
          const double half = 2 * std::atan(arc.bulge) * k / chords;
          Vec2 p = arc.end;
          if (k < chords)
            p = arc.start + (2 * std::sin(half) / curvature(arc)) *
                                turned(start_tangent(arc), std::cos(half), std::sin(half));
          const Vec2 q = view.to_picture(p);
          const Vec2 first = view.to_picture(arc.start);
          if (i == 0 && (k == 0 || arc.bulge == 0)) cairo_move_to(cairo, first.x, first.y);
          cairo_line_to(cairo, q.x, q.y);
        }
      }
      cairo_close_path(cairo);
      cairo_stroke(cairo);
    }
  }
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

Result<int> run_field(const FieldSwitches& switches) {
  Status writable =
      check_output(switches.output, {}, field_formats, switches.input.path, switches.common.json);
  if (!writable) return std::move(writable).error();
  auto file = load_shapes(switches.input, switches.common.threads);
  if (!file) return std::move(file).error();
  print_notes(*file, switches.input, switches.common);
  const Stopwatch drawing;
  Fields fields;
  for (std::size_t i = 0; i < file->shapes.size(); ++i) {
    auto field = PotentialField::make(file->shapes[i], switches.order);
    if (!field) return at_feature(std::move(field).error(), switches.input.path, i);
    fields.push_back(std::move(field).value());
  }
  const View view = view_of(*file, switches.width);
  std::string document;
  std::string extension = std::filesystem::path(switches.output).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      extension == ".svg"
          ? cairo_svg_surface_create_for_stream(append, &document, view.width, view.height)
      : extension == ".pdf"
          ? cairo_pdf_surface_create_for_stream(append, &document, view.width, view.height)
          : cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(view.width),
                                       static_cast<int>(view.height)),
      cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo(cairo_create(surface.get()),
                                                                 cairo_destroy);
  draw(cairo.get(), *file, fields, view, switches);
  if (extension == ".png") cairo_surface_write_to_png_stream(surface.get(), append, &document);
  cairo_surface_finish(surface.get());
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    return error_at(ErrorCode::unwritable, switches.output, "the picture cannot be drawn");
  Status written = write_text(switches.output, document);
  if (!written) return std::move(written).error();
  const Json costs = costs_of(
      switches.common,
      {{"read", file->seconds_read}, {"shape", file->seconds_shape}, {"draw", drawing.seconds()}});
  if (switches.common.json) {
    Json object = {{"input", switches.input.path}, {"output", switches.output}};
    if (switches.common.stats) object.update(costs);
    Status printed = print(object);
    if (!printed) return std::move(printed).error();
  }
  print_costs(switches.common, costs);
  return exit_success;
}

}  // namespace

Verb make_field_verb(CLI::App& program) {
  auto switches = std::make_shared<FieldSwitches>();
  CLI::App* verb = program.add_subcommand(
      "field", "Draw the potential of a charged border and its force lines.");
  add_input_switches(*verb, switches->input);
  verb->add_option("-o,--output", switches->output,
                   std::string("The picture; its extension tells the format: ") + field_formats)
      ->required()
      ->check(a_name())
      ->option_text("PICTURE REQUIRED");
  verb->add_option("--order", switches->order, "The n of the potential 1 / r^n (default: 1).")
      ->check(CLI::Range(1.0, 256.0).description(""))
      ->option_text("N");
  verb->add_option("--lines", switches->lines,
                   "Force lines begin on a grid, so many along the longer side (default: 40).")
      ->check(CLI::Range(0, 1000).description(""))
      ->option_text("N");
  verb->add_option("--width", switches->width, "Of the picture, in pixels (default: 800).")
      ->check(CLI::Range(16, 8000).description(""))
      ->option_text("PIXELS");
  verb->add_flag("!--no-brightness", switches->brightness, "Draw the lines only.");
  add_common_switches(*verb, switches->common);
  verb->footer(
      "The brighter a point, the lower is the potential, on a logarithmic scale. Force\n"
      "lines run along the force, into the valleys: `medial axis --method potential`\n"
      "follows these.\n"
      "\n"
      "Examples:\n"
      "  medial field plan.wkt -o field.png\n"
      "  medial field plan.wkt -o lines.svg --order 8 --no-brightness");
  return {verb, [switches] { return run_field(*switches); }};
}

}  // namespace medial::cli
