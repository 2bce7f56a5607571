#include <algorithm>
#include <array>
#include <cmath>

#include "io/features_tables.h"
#include "io/pictures/labels.h"
#include "io/pictures/pictures.h"
#include "medial/query.h"

namespace medial::io {

namespace {

constexpr Color shape_color{0.945, 0.945, 0.925};
constexpr Color edge_color{0.55, 0.55, 0.57};
constexpr Color text_color{0.10, 0.10, 0.12};
constexpr Color end_color{0.20, 0.55, 0.25};
constexpr Color branching{0.80, 0.15, 0.20};

/// By primitive: worm, wedges, cups, flares; the opening ones lighter.
constexpr std::array<Color, primitive_count> primitive_colors{{{0.30, 0.32, 0.36},
                                                               {0.35, 0.62, 0.85},
                                                               {0.08, 0.36, 0.66},
                                                               {0.93, 0.60, 0.24},
                                                               {0.77, 0.36, 0.02},
                                                               {0.72, 0.50, 0.80},
                                                               {0.47, 0.18, 0.58}}};

constexpr double legend_height = 0.025;  // height of the legend below, of the picture's width
constexpr double width_share = 1e-3;     // line widths, of the picture's larger side
constexpr double mark_radius = 3.2;      // radius of the marks, in line widths
constexpr int most_names = 60;

/// The words for a run: "closing wedge", "worm, left circular".
std::string words_for(const PrimitiveRun& run) {
  std::string words = name_of(run.primitive);
  if (run.variation != Variation::straight) {
    words += ", ";
    words += name_of(run.variation);
  }
  std::ranges::replace(words, '_', ' ');
  return words;
}

class FeaturesPicture {
 public:
  FeaturesPicture(Canvas& canvas, const FeaturesOutput& output)
      : canvas_(canvas),
        context_(canvas.context()),
        viewport_(canvas.viewport()),
        output_(output),
        line_(width_share * canvas.viewport().width),
        drawn_(primitive_count, Cells(cell())) {}

  void draw() {
    if (output_.options.shape) {
      std::vector<const Shape*> shapes;
      for (const AxisItem& item : items()) shapes.push_back(&item.shape);
      cairo_set_line_width(context_, 0.8 * line_);
      canvas_.draw_shapes(shapes, shape_color, edge_color);
      cairo_set_fill_rule(context_, CAIRO_FILL_RULE_EVEN_ODD);
    }
    cairo_set_line_cap(context_, CAIRO_LINE_CAP_BUTT);
    for (std::size_t i = 0; i < features().size(); ++i)
      collect_runs(items()[i].axis, features()[i]);
    draw_runs();
    for (std::size_t i = 0; i < features().size(); ++i)
      draw_points(items()[i].axis, features()[i], marked_[i]);
    if (output_.own.names) draw_names();
    draw_legend();
  }

 private:
  struct Label {
    double length;
    Vec2 at;  ///< in the picture
    std::string words;
  };

  /// A tenth of the width of a run's line.
  double cell() const { return 0.25 * line_; }

  const std::vector<AxisItem>& items() const { return output_.document.items; }
  std::span<const AxisFeatures> features() const { return output_.features; }

  /// What runs look like, and where their labels and cuts are.
  void collect_runs(const MedialAxis& axis, const AxisFeatures& features) {
    const std::vector<Branch> all = branches(axis);
    const double chord = 0.1 / viewport_.scale;  // a tenth of a pixel
    // What is shorter than the marks at its ends has none: they would hide everything.
    const double shortest = 2 * mark_radius * line_ / viewport_.scale;
    std::vector<bool>& marked = marked_.emplace_back(axis.nodes.size(), false);
    for (const BranchFeatures& branch : features.branches) {
      const Branch& chain = all[branch.branch];
      if (branch.length >= shortest) marked[chain.from] = marked[chain.to] = true;
      const auto lines = lines_of(axis, features, branch, chain, chord);
      for (std::size_t k = 0; k < lines.size(); ++k) {
        const PrimitiveRun& run = features.runs[branch.first_run + k];
        const auto primitive = static_cast<std::size_t>(run.primitive);
        used_[primitive] = true;
        if (k > 0 && run.length >= shortest &&
            features.runs[branch.first_run + k - 1].length >= shortest)
          cuts_.push_back(viewport_(lines[k].front().center));
        const Vec2 from = viewport_(lines[k].front().center),
                   to = viewport_(lines[k].back().center);
        if (lines[k].size() == 2 && !drawn_[primitive].add({from, from, to})) continue;
        std::vector<Vec2>& path = paths_[primitive].emplace_back();
        for (const Disk& disk : lines[k]) path.push_back(viewport_(disk.center));
        if (output_.own.names) add_label(run, lines[k]);
      }
    }
  }

  void draw_runs() {
    cairo_set_line_width(context_, 2.6 * line_);
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      canvas_.color(primitive_colors[i]);
      cairo_new_path(context_);
      int pieces = 0;
      for (const std::vector<Vec2>& path : paths_[i]) {
        canvas_.move_to(path[0]);
        for (std::size_t k = 1; k < path.size(); ++k) canvas_.line_to(path[k]);
        pieces += static_cast<int>(path.size());
        if (pieces < pieces_per_stroke) continue;
        canvas_.stroke();
        pieces = 0;
      }
      canvas_.stroke();
    }
  }

  /// A label at the middle of a run, if the run is longer in the picture than the words are high.
  void add_label(const PrimitiveRun& run, const std::vector<Disk>& line) {
    const double length = run.length * viewport_.scale;
    if (length < 2 * font_size()) return;
    double left = 0.5 * run.length;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const double step = distance(line[i].center, line[i + 1].center);
      if (left > step && i + 2 < line.size()) {
        left -= step;
        continue;
      }
      const double t = step > 0 ? std::min(left / step, 1.0) : 0;
      labels_.push_back({length,
                         viewport_(line[i].center + t * (line[i + 1].center - line[i].center)),
                         words_for(run)});
      return;
    }
  }

  /// Dots: ends of lines without length.
  void draw_dots(const std::vector<Vec2>& places, double radius, const Color& dot_color) {
    canvas_.color(dot_color);
    cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(context_, 2 * radius * line_);
    int pieces = 0;
    for (const Vec2 at : places) {
      canvas_.move_to(at);
      canvas_.line_to(at);
      if (++pieces % pieces_per_stroke == 0) canvas_.stroke();
    }
    canvas_.stroke();
    cairo_set_line_cap(context_, CAIRO_LINE_CAP_BUTT);
  }

  void draw_points(const MedialAxis& axis, const AxisFeatures& features,
                   const std::vector<bool>& marked) {
    // Nobody sees two dots in one cell, a tenth as wide as they are.
    const auto once = [this](std::vector<Vec2>& places) {
      Cells cells(0.6 * line_);
      std::erase_if(places, [&cells](Vec2 at) { return !cells.add({at, at, at}); });
    };
    for (const PointKind drawn : {PointKind::end, PointKind::branching}) {
      std::vector<Vec2> places;
      for (std::size_t i = 0; i < features.points.size(); ++i)
        if (features.points[i] == drawn && marked[i])
          places.push_back(viewport_(axis.nodes[i].disk.center));
      once(places);
      draw_dots(places, mark_radius, drawn == PointKind::end ? end_color : branching);
    }
    // Cuts inside of branches: rings.
    once(cuts_);
    draw_dots(cuts_, 3.5, text_color);
    draw_dots(cuts_, 2.5, paper_color);
    cuts_.clear();
  }

  double font_size() const { return 15 * line_; }

  /// The names of the longest runs, where they cover no other name, and no line if they can.
  void draw_names() {
    Labels names(canvas_, font_size());
    for (const auto& of_primitive : paths_)
      for (const std::vector<Vec2>& path : of_primitive)
        for (std::size_t k = 1; k < path.size(); ++k) names.avoid(path[k - 1], path[k]);
    std::ranges::stable_sort(labels_, std::greater{}, &Label::length);
    int count = 0;
    for (const Label& label : labels_)
      if (count < most_names && names.put(label.at, label.words, text_color)) ++count;
  }

  /// The colours of the primitives that occur, in a line below.
  void draw_legend() {
    canvas_.use_font(font_size());
    double x = font_size();
    const double y = viewport_.height + font_size();
    for (std::size_t i = 0; i < used_.size(); ++i) {
      if (!used_[i]) continue;
      std::string words = name_of(static_cast<Primitive>(i));
      std::ranges::replace(words, '_', ' ');
      canvas_.color(primitive_colors[i]);
      cairo_rectangle(context_, x, y - 0.5 * font_size(), 1.5 * font_size(), 0.35 * font_size());
      cairo_fill(context_);
      canvas_.color(text_color);
      cairo_move_to(context_, x + 1.8 * font_size(), y);
      cairo_show_text(context_, words.c_str());
      cairo_text_extents_t extents;
      cairo_text_extents(context_, words.c_str(), &extents);
      x += extents.width + 3 * font_size();
    }
  }

  Canvas& canvas_;
  cairo_t* context_;
  const Viewport& viewport_;
  const FeaturesOutput& output_;
  double line_;
  std::array<bool, primitive_count> used_{};
  std::array<std::vector<std::vector<Vec2>>, primitive_count> paths_;  ///< in the picture
  std::vector<Cells> drawn_;                                           ///< of each primitive
  std::vector<std::vector<bool>> marked_;  ///< nodes of each item that get a mark
  std::vector<Label> labels_;
  std::vector<Vec2> cuts_;
};

}  // namespace

Status write_picture(Target& target, const FeaturesOutput& output) {
  const Document<AxisItem>& axes = output.document;
  const Result<Viewport> viewport = viewport_for(box_of(axes), output.options.width, axes.y_down);
  if (!viewport) return viewport.error();
  const double height = viewport->height + std::ceil(legend_height * viewport->width);
  return write_surface(*target.out, target.format, viewport->width, height, [&](cairo_t* context) {
    Canvas canvas(context, *viewport);
    FeaturesPicture(canvas, output).draw();
    draw_scale_bar(canvas, target.unit);
  });
}

}  // namespace medial::io
