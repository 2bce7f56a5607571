#include "cli/plot.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "medial/io/write.h"

namespace medial::cli {
namespace {

// In points: one plot, and the margins for its labels.
constexpr double plot_width = 420, plot_height = 320;
constexpr double left_room = 64, right_room = 16, top_room = 30, bottom_room = 46;
constexpr double text_size = 10;

struct Color {
  double red, green, blue;
};
// Okabe and Ito's colours, which colour-blind readers can distinguish.
constexpr std::array<Color, 6> colors{{{0.00, 0.45, 0.70},
                                       {0.84, 0.37, 0.00},
                                       {0.00, 0.62, 0.45},
                                       {0.80, 0.47, 0.65},
                                       {0.34, 0.71, 0.91},
                                       {0.90, 0.62, 0.00}}};
constexpr Color gray{0.55, 0.55, 0.55}, ink{0.15, 0.15, 0.15}, grid{0.88, 0.88, 0.88};

/// An axis and its ticks: from 10^low to 10^high, or from low to high in even steps.
struct Scale {
  double low = 0, high = 1, step = 1;
  bool logarithmic = true;

  double share(double value) const {
    return ((logarithmic ? std::log10(value) : value) - low) / (high - low);
  }
  int ticks() const { return static_cast<int>(std::floor((high - low) / step + 1e-9)); }
  double tick(int i) const {
    const double at = low + i * step;
    return logarithmic ? std::pow(10, at) : at;
  }
  std::string label(int i) const {
    if (logarithmic) return fmt::format("1e{}", static_cast<int>(low) + i);
    const double value = low + i * step;
    return fmt::format("{:.10g}", std::abs(value) < 1e-9 * step ? 0.0 : value);
  }
};

/// Steps of 1, 2 or 5 times a power of ten, some five to ten of them.
Scale even_scale(double least, double most) {
  if (!(most > least)) most = least + 1;
  const double rough = (most - least) / 7;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (rough <= factor * power) step = factor * power;
  return {step * std::floor(least / step), step * std::ceil(most / step), step, false};
}

template <class Get>
Scale scale_of(const Plot& plot, const Get& get, bool from_zero) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Series& series : plot.series) {
    for (const auto& point : series.points) {
      least = std::min(least, get(point));
      most = std::max(most, get(point));
    }
  }
  if (!(least <= most)) return {};
  if (!plot.logarithmic) {
    Scale even = even_scale(from_zero ? std::min(least, 0.0) : least, most);
    if (!from_zero && most > least) even.high = most;
    return even;
  }
  if (!(most > 0)) return {};
  const double low = std::floor(std::log10(least));
  return {low, std::max(low + 1, std::ceil(std::log10(most))), 1, true};
}

enum class Align { left, center, right };

/// Draws one plot with its upper left corner at the origin.
class Painter {
 public:
  Painter(cairo_t* cairo, const Plot& plot)
      : cairo_(cairo),
        plot_(plot),
        x_(scale_of(
            plot, [](const auto& point) { return point.first; }, false)),
        y_(scale_of(
            plot, [](const auto& point) { return point.second; }, true)) {}

  void draw() {
    cairo_select_font_face(cairo_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, text_size);
    draw_axes();
    std::size_t color = 0;
    double legend = top_room + 14;
    for (const Series& series : plot_.series) {
      set(series.reference ? gray : colors[color++ % colors.size()]);
      draw_series(series);
      if (series.name.empty()) continue;
      draw_legend(series, legend);
      legend += 1.4 * text_size;
    }
  }

 private:
  double across(double value) const {
    return left_room + x_.share(value) * (plot_width - left_room - right_room);
  }
  double down(double value) const {
    return plot_height - bottom_room - y_.share(value) * (plot_height - top_room - bottom_room);
  }
  void set(const Color& color) { cairo_set_source_rgb(cairo_, color.red, color.green, color.blue); }
  void line(double x1, double y1, double x2, double y2) {
    cairo_move_to(cairo_, x1, y1);
    cairo_line_to(cairo_, x2, y2);
    cairo_stroke(cairo_);
  }
  void text(const std::string& words, double x, double y, Align align) {
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, words.c_str(), &extents);
    const double shift = align == Align::left ? 0 : align == Align::center ? 0.5 : 1.0;
    cairo_move_to(cairo_, x - shift * extents.x_advance, y);
    cairo_show_text(cairo_, words.c_str());
    cairo_new_path(cairo_);  // do not connect the text's end to the next path
  }

  void draw_axes() {
    cairo_set_line_width(cairo_, 0.7);
    for (int i = 0; i <= x_.ticks(); ++i) {
      const double x = across(x_.tick(i));
      set(grid);
      line(x, top_room, x, plot_height - bottom_room);
      set(ink);
      text(x_.label(i), x, plot_height - bottom_room + 1.4 * text_size, Align::center);
    }
    for (int i = 0; i <= y_.ticks(); ++i) {
      const double y = down(y_.tick(i));
      set(grid);
      line(left_room, y, plot_width - right_room, y);
      set(ink);
      text(y_.label(i), left_room - 5, y + 0.35 * text_size, Align::right);
    }
    cairo_rectangle(cairo_, left_room, top_room, plot_width - left_room - right_room,
                    plot_height - top_room - bottom_room);
    cairo_stroke(cairo_);
    const double middle = left_room + 0.5 * (plot_width - left_room - right_room);
    text(plot_.title, middle, 0.65 * top_room, Align::center);
    text(plot_.x_label, middle, plot_height - 12, Align::center);
    cairo_save(cairo_);
    cairo_translate(cairo_, 16, top_room + 0.5 * (plot_height - top_room - bottom_room));
    cairo_rotate(cairo_, -std::acos(0.0));
    text(plot_.y_label, 0, 0, Align::center);
    cairo_restore(cairo_);
  }

  void draw_series(const Series& series) {
    constexpr double dash = 4;
    cairo_set_line_width(cairo_, series.reference ? 0.8 : 1.3);
    if (series.reference) cairo_set_dash(cairo_, &dash, 1, 0);
    if (series.line) {
      for (const auto& [x, y] : series.points)
        cairo_line_to(cairo_, shortened(across(x)), shortened(down(y)));
      cairo_stroke(cairo_);
    }
    cairo_set_dash(cairo_, nullptr, 0, 0);
    constexpr std::size_t most_dots = 40;  // more would hide their line
    if (series.reference || !series.marks || (series.line && series.points.size() > most_dots))
      return;
    // Dots, as lines without length that have round ends: one short path for all.
    constexpr double diameter = 4.8;
    cairo_save(cairo_);
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(cairo_, diameter);
    for (const auto& [x, y] : series.points) {
      const double at_x = shortened(across(x)), at_y = shortened(down(y));
      cairo_move_to(cairo_, at_x, at_y);
      cairo_line_to(cairo_, at_x, at_y);
    }
    cairo_stroke(cairo_);
    cairo_restore(cairo_);
  }

  /// A coordinate with few digits, for short files: to a quarter of a point.
  static double shortened(double v) { return std::round(4 * v) / 4; }

  /// The legend, on the side where rising or falling curves leave room.
  void draw_legend(const Series& series, double y) {
    const bool falling =
        !plot_.series.empty() && !plot_.series[0].points.empty() &&
        plot_.series[0].points.front().second > plot_.series[0].points.back().second;
    const double x = falling ? plot_width - right_room - 130 : left_room + 10;
    line(x, y, x + 18, y);
    set(ink);
    text(series.name, x + 24, y + 0.35 * text_size, Align::left);
  }

  cairo_t* cairo_;
  const Plot& plot_;
  Scale x_, y_;
};

cairo_status_t append(void* text, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Status write_plots(const std::string& path, const std::vector<Plot>& plots) {
  constexpr std::size_t columns = 2;
  const auto rows = static_cast<double>((plots.size() + columns - 1) / columns);
  std::string document;
  const double width = static_cast<double>(std::min(columns, plots.size())) * plot_width;
  const double height = rows * plot_height;
  const bool png = path.ends_with(".png");
  constexpr double pixels_a_point = 2;
  cairo_surface_t* created = nullptr;
  if (png) {
    created =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(pixels_a_point * width),
                                   static_cast<int>(pixels_a_point * height));
  } else if (path.ends_with(".pdf")) {
    created = cairo_pdf_surface_create_for_stream(append, &document, width, height);
  } else {
    created = cairo_svg_surface_create_for_stream(append, &document, width, height);
  }
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      created, cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo(cairo_create(surface.get()),
                                                                 cairo_destroy);
  if (png) cairo_scale(cairo.get(), pixels_a_point, pixels_a_point);
  cairo_set_source_rgb(cairo.get(), 1, 1, 1);
  cairo_paint(cairo.get());
  for (std::size_t i = 0; i < plots.size(); ++i) {
    cairo_save(cairo.get());
    cairo_translate(cairo.get(), static_cast<double>(i % columns) * plot_width,
                    static_cast<double>(i / columns) * plot_height);
    Painter(cairo.get(), plots[i]).draw();
    cairo_restore(cairo.get());
  }
  if (png) cairo_surface_write_to_png_stream(surface.get(), append, &document);
  cairo_surface_finish(surface.get());
  const cairo_status_t status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS) {
    Error error{ErrorCode::unwritable, cairo_status_to_string(status), {}};
    error.place.file = path;
    return error;
  }
  return io::write_text(path, document);
}

#ifdef MEDIAL_STAMP
extern "C" {
extern const PlotModule medial_plot_table;
const PlotModule medial_plot_table{MEDIAL_STAMP, write_plots};
}
#endif

}  // namespace medial::cli
