#include "io/picture.h"

#include <cairo-pdf.h>
#include <cairo-ps.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <unordered_set>

#include "base/arc.h"
#include "io/color.h"
#include "medial/query.h"

namespace medial::io {

namespace {

constexpr Color inside_color{0.945, 0.945, 0.925};
constexpr Color outline_color{0.25, 0.25, 0.27};
constexpr Color disk_color{0.85, 0.45, 0.15};
constexpr Color contact_color{0.80, 0.20, 0.20};
constexpr std::array<Color, 3> node_colors{
    {{0.20, 0.55, 0.25}, {0.45, 0.45, 0.50}, {0.80, 0.15, 0.20}}};

// Of layers, one after another: polygons have the first.
constexpr std::array<Color, 4> layer_colors{
    {{0.00, 0.45, 0.70}, {0.84, 0.37, 0.00}, {0.80, 0.15, 0.20}, {0.00, 0.62, 0.45}}};

constexpr double hue_step = 0.618033988749895;  // the golden section: neighbours differ

constexpr int pieces_per_stroke =
    2000;                        // pieces of a path between strokes: long paths are slow to stroke
constexpr int most_pieces = 32;  // of one edge

/// A piece of an edge, in units of the picture: a rational quadratic curve with weights 1, w, 1.
struct Piece {
  Vec2 from, control, to;
  double weight = 1;
  bool straight = true;
};

struct Homogeneous {
  double x, y, r, w;
};

Homogeneous mix(const Homogeneous& a, const Homogeneous& b, double t) {
  const double s = 1 - t;
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.r + t * b.r, s * a.w + t * b.w};
}

/// An edge's curve in homogeneous coordinates, which can be cut exactly.
class Curve {
 public:
  Curve(const MedialAxis& axis, const Edge& edge)
      : points_{lift(axis.nodes[edge.node[0]].disk, 1), lift(edge.control, edge.weight),
                lift(axis.nodes[edge.node[1]].disk, 1)} {}

  Homogeneous blossom(double s, double t) const {
    return mix(mix(points_[0], points_[1], s), mix(points_[1], points_[2], s), t);
  }
  double radius(double t) const {
    const Homogeneous p = blossom(t, t);
    return p.r / p.w;
  }

 private:
  static Homogeneous lift(const Disk& disk, double w) {
    return {disk.center.x * w, disk.center.y * w, disk.radius * w, w};
  }
  std::array<Homogeneous, 3> points_;
};

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

cairo_status_t write_bytes(void* out, const unsigned char* bytes, unsigned count) {
  auto* stream = static_cast<OutputStream*>(out);
  stream->put(std::string_view(reinterpret_cast<const char*>(bytes), count));
  return stream->failed() ? CAIRO_STATUS_WRITE_ERROR : CAIRO_STATUS_SUCCESS;
}

/// Tells which pieces smaller than a fraction of a pixel add nothing to a picture of pixels: those
/// in a cell where one of the same shade is drawn already.
class Cells {
 public:
  bool add(const Piece& piece) {
    const double extent =
        std::max(std::fabs(piece.to.x - piece.from.x), std::fabs(piece.to.y - piece.from.y));
    if (!(extent <= cell)) return true;
    // A file may hold curves that leave the picture.
    const auto index = [](double place) {
      return static_cast<std::uint64_t>(std::clamp(place, 0.0, farthest) / cell);
    };
    return drawn_.insert(index(piece.from.y) << 32U | index(piece.from.x)).second;
  }
  /// The distance below which points of an outline are not told apart, either.
  static constexpr double cell = 0.25;  // pixels

 private:
  static constexpr double farthest = 1e6;  // pixels, more than any picture has
  std::unordered_set<std::uint64_t> drawn_;
};

/// How the plane lies in the picture.
struct Frame {
  double width = 0;
  double height = 0;
  double scale = 1;
  double up = 1;  ///< -1 where the shapes' y axis points down, as the picture's does
  Vec2 center;    ///< of the shapes' bounding box

  Vec2 operator()(Vec2 p) const {
    return {0.5 * width + (p.x - center.x) * scale, 0.5 * height - (p.y - center.y) * (up * scale)};
  }
  /// The bulge of an edge in the picture.
  double bulge(double of_shape) const { return -up * of_shape; }
};

Frame frame_of(const NativeFile& file, double width) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  Box box{{endless, endless}, {-endless, -endless}};
  const auto include = [&box](Vec2 p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  };
  for (const NativeItem& item : file.items) {
    if (!item.shape.points.empty()) {
      const Box extent = bounding_box(item.shape);
      include(extent.low);
      include(extent.high);
    }
    for (const Node& node : item.axis.nodes) include(node.disk.center);
    for (const Site& site : item.axis.sites) include(site.start);
  }
  if (!(box.low.x <= box.high.x)) box = {{0, 0}, {1, 1}};
  const Vec2 size = box.high - box.low;
  const double margin = 0.03 * width;
  Frame frame;
  frame.up = file.y_down ? -1 : 1;
  frame.width = width;
  frame.center = midpoint(box.low, box.high);
  frame.scale = size.x > 0 ? (width - 2 * margin) / size.x : 1;
  // A needle gets a picture of moderate height: its width gives way.
  const double height = size.x > 0 ? size.y * frame.scale : 4 * width;
  frame.height = std::clamp(height + 2 * margin, width / 8, 4 * width);
  if (size.y > 0 && size.y * frame.scale + 2 * margin > frame.height) {
    frame.scale = (frame.height - 2 * margin) / size.y;
  }
  frame.height = std::ceil(frame.height);
  return frame;
}

/// A light colour of this hue in [0, 1).
Color pastel(double hue) {
  constexpr double darkest = 0.72;
  const auto part = [&](double shift) {
    const double wave = 0.5 + 0.5 * std::cos(2 * std::numbers::pi * (hue - shift));
    return darkest + (1 - darkest) * wave;
  };
  return {part(0), part(1.0 / 3), part(2.0 / 3)};
}

class Picture {
 public:
  /// `diagrams`: where Voronoi diagrams are drawn, those of the file's items; or null. `layers`:
  /// what is drawn around and above the axes; or null.
  Picture(cairo_t* context, const Frame& frame, const NativeFile& file, const WriteOptions& options,
          const VoronoiFile* diagrams = nullptr, const LayerFile* layers = nullptr)
      : context_(context),
        frame_(frame),
        file_(file),
        options_(options),
        diagrams_(diagrams),
        layers_(layers),
        pixels_(cairo_surface_get_type(cairo_get_target(context)) == CAIRO_SURFACE_TYPE_IMAGE) {
    double edges = 0;
    for (const NativeItem& item : file.items) {
      for (const Node& node : item.axis.nodes) largest_ = std::max(largest_, node.disk.radius);
      edges += static_cast<double>(item.axis.edges.size());
    }
    // The more there is to see, the finer the lines: down to a third.
    constexpr double many_edges = 5000;
    fineness_ = std::clamp(std::pow(many_edges / std::max(edges, 1.0), 0.2), 1.0 / 3, 1.0);
  }

  void draw() {
    cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
    color(paper_color);
    cairo_paint(context_);
    if (options_.shape) draw_shapes();
    if (layers_ != nullptr) draw_polygons();
    if (diagrams_ != nullptr) draw_faces();
    if (options_.disks > 0) draw_disks();
    if (options_.contacts) draw_contacts();
    draw_axes();
    if (layers_ != nullptr) draw_lines_and_disks();
    if (options_.nodes) draw_nodes();
  }

 private:
  double thickness(double share) const {
    return share * 1e-3 * fineness_ * std::max(frame_.width, frame_.height);
  }
  void color(const Color& c, double alpha = 1) {
    cairo_set_source_rgba(context_, c.red, c.green, c.blue, alpha);
  }
  void move_to(Vec2 p) { cairo_move_to(context_, p.x, p.y); }
  void line_to(Vec2 p) { cairo_line_to(context_, p.x, p.y); }

  /// Adds a full circle, in units of the picture.
  void circle(Vec2 center, double radius) {
    cairo_new_sub_path(context_);
    cairo_arc(context_, center.x, center.y, radius, 0, 2 * std::numbers::pi);
  }

  /// Goes on along an arc. Pieces of a 16th turn or less become cubic curves: they stay within 7e-8
  /// radii.
  void arc_to(const BulgeArc& arc) {
    const double longest = 0.0985;  // tangent of a quarter of a 16th turn
    const double bulge = arc.bulge;
    if (std::fabs(bulge) > longest) {
      const Vec2 middle = apex(arc);
      arc_to({arc.start, middle, half_bulge(bulge)});
      arc_to({middle, arc.end, half_bulge(bulge)});
      return;
    }
    const Vec2 along = (1 - bulge * bulge) / 3 * arc.chord();
    const Vec2 aside = -2 * bulge / 3 * left_of(arc.chord());
    const Vec2 a = arc.start + along + aside;
    const Vec2 b = arc.end - along + aside;
    cairo_curve_to(context_, a.x, a.y, b.x, b.y, arc.end.x, arc.end.y);
  }

  /// Goes along all edges of a loop, as one path; `each` is told the end of every edge drawn.
  template <class Each>
  void trace_loop(const Shape& shape, std::size_t loop, Each each) {
    const std::size_t begin = shape.loop_begin[loop];
    const std::size_t end = shape.loop_begin[loop + 1];
    Vec2 last = frame_(shape.points[begin]);
    move_to(last);
    for (std::size_t k = begin; k < end; ++k) {
      const Vec2 p = frame_(shape.points[k + 1 == end ? begin : k + 1]);
      const double bulge = shape.bulge(k);
      if (pixels_ && distance(p, last) < Cells::cell) continue;
      if (bulge == 0) {
        line_to(p);
      } else {
        arc_to({frame_(shape.points[k]), p, frame_.bulge(bulge)});
      }
      last = p;
      each(p);
    }
  }

  void trace_shape(const Shape& shape) {
    for (std::size_t i = 0; i < shape.loop_count(); ++i) {
      trace_loop(shape, i, [](Vec2) {});
      cairo_close_path(context_);
    }
  }

  void draw_shapes() {
    cairo_set_fill_rule(context_, CAIRO_FILL_RULE_EVEN_ODD);
    for (const NativeItem& item : file_.items) {
      color(inside_color);
      trace_shape(item.shape);
      cairo_fill(context_);
    }
    stroke_shapes();
  }

  void stroke_shapes() {
    color(outline_color);
    cairo_set_line_width(context_, thickness(0.8));
    int batch = 0;
    for (const NativeItem& item : file_.items) {
      for (std::size_t i = 0; i < item.shape.loop_count(); ++i) {
        trace_loop(item.shape, i, [&](Vec2 p) {
          if (++batch % pieces_per_stroke != 0) return;
          cairo_stroke(context_);
          move_to(p);
        });
      }
    }
    cairo_stroke(context_);
  }

  /// Goes along an edge of a diagram, from its node[0] or from its node[1].
  void trace_edge(const VoronoiDiagram& diagram, const VoronoiEdge& edge, bool forward) {
    const auto place = [&](std::uint32_t node) { return frame_(diagram.nodes[node].disk.center); };
    Piece piece{place(edge.node[0]), frame_(edge.control.center), place(edge.node[1]), edge.weight,
                runs_straight(diagram, edge)};
    if (!forward) std::swap(piece.from, piece.to);
    if (piece.straight) {
      line_to(piece.to);
    } else {
      conic_to(piece);
    }
  }

  void trace(const std::vector<Vec2>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      i == 0 ? move_to(frame_(points[i])) : line_to(frame_(points[i]));
  }

  void draw_polygons() {
    cairo_set_fill_rule(context_, CAIRO_FILL_RULE_EVEN_ODD);
    for (const Layer& layer : layers_->layers) {
      if (layer.kind != LayerKind::polygons) continue;
      for (const LayerFeature& feature : layer.features) {
        for (const auto& ring : feature.parts) {
          trace(ring);
          cairo_close_path(context_);
        }
        color(layer_colors[0], 0.35);
        cairo_fill_preserve(context_);
        color(layer_colors[0]);
        cairo_set_line_width(context_, thickness(0.8));
        cairo_stroke(context_);
      }
    }
  }

  void draw_lines_and_disks() {
    std::size_t kind = 0;
    for (const Layer& layer : layers_->layers) {
      if (layer.kind == LayerKind::polygons) continue;
      color(layer_colors[++kind % layer_colors.size()]);
      for (const LayerFeature& feature : layer.features) {
        cairo_set_line_width(context_, thickness(1.2));
        if (layer.kind == LayerKind::lines) {
          trace(feature.parts[0]);
        } else {
          circle(frame_(feature.parts[0][0]), feature.values[0] * frame_.scale);
        }
        cairo_stroke(context_);
      }
    }
  }

  void draw_faces() {
    for (const VoronoiItem& item : diagrams_->items) {
      const VoronoiDiagram& diagram = item.diagram;
      for (std::uint32_t site = 0; site < diagram.sites.size(); ++site) {
        const bool vertex = diagram.sites[site].kind == SiteKind::vertex;
        const double hue = std::fmod(hue_step * site, 1.0);
        constexpr Color grey{0.82, 0.82, 0.84};
        color(vertex ? grey : pastel(hue));
        if (diagram.face(site).empty()) continue;
        const VoronoiEdge& first = diagram.edges[diagram.face(site).front()];
        move_to(frame_(diagram.frame
                           ? diagram.nodes[first.node[first.site[1] == site ? 0 : 1]].disk.center
                           : diagram.sites[site].start));
        for (const std::uint32_t e : diagram.face(site))
          trace_edge(diagram, diagram.edges[e], diagram.edges[e].site[1] == site);
        cairo_close_path(context_);
        cairo_fill(context_);
      }
    }
    color(outline_color, 0.5);
    cairo_set_line_width(context_, thickness(0.5));
    int batch = 0;
    for (const VoronoiItem& item : diagrams_->items) {
      for (const VoronoiEdge& edge : item.diagram.edges) {
        if (!edge.spoke) continue;
        move_to(frame_(item.diagram.nodes[edge.node[0]].disk.center));
        line_to(frame_(item.diagram.nodes[edge.node[1]].disk.center));
        if (++batch % pieces_per_stroke == 0) cairo_stroke(context_);
      }
    }
    cairo_stroke(context_);
    if (options_.shape) stroke_shapes();
    if (options_.shape) draw_sites();
  }

  /// The sites of soups.
  void draw_sites() {
    color(outline_color);
    cairo_set_line_width(context_, thickness(1.6));
    int batch = 0;
    const auto draw = [&](bool points) {
      for (const VoronoiItem& item : diagrams_->items) {
        if (!item.diagram.frame) continue;
        for (const Site& site : item.diagram.sites) {
          if ((site.kind == SiteKind::vertex) != points) continue;
          if (points) {
            circle(frame_(site.start), thickness(2));
          } else {
            move_to(frame_(site.start));
            if (site.bulge == 0)
              line_to(frame_(site.end));
            else
              arc_to({frame_(site.start), frame_(site.end), frame_.bulge(site.bulge)});
          }
          if (++batch % pieces_per_stroke == 0)
            points ? cairo_fill(context_) : cairo_stroke(context_);
        }
      }
      points ? cairo_fill(context_) : cairo_stroke(context_);
    };
    draw(false);
    cairo_set_fill_rule(context_, CAIRO_FILL_RULE_WINDING);
    draw(true);
  }

  /// About as many disks as asked for, at even distances along all axes.
  void draw_disks() {
    double total = 0;
    for (const NativeItem& item : file_.items) total += total_length(item.axis);
    if (!(total > 0)) return;
    const double step = total / options_.disks;
    double next = 0.5 * step;
    double walked = 0;
    color(disk_color, 0.6);
    cairo_set_line_width(context_, thickness(0.6));
    for (const NativeItem& item : file_.items) {
      for (const Edge& edge : item.axis.edges) {
        const double along = length(item.axis, edge);
        for (; next <= walked + along && along > 0; next += step) {
          const Disk disk = disk_at(item.axis, edge, std::clamp((next - walked) / along, 0.0, 1.0));
          circle(frame_(disk.center), disk.radius * frame_.scale);
          cairo_stroke(context_);
        }
        walked += along;
      }
    }
  }

  /// The feet of every node's disk on the sites of its edges, and the radii to them.
  void draw_contacts() {
    cairo_set_line_width(context_, thickness(0.35));
    int batch = 0;
    const auto radii_or_feet = [&](bool feet) {
      color(contact_color, feet ? 1.0 : 0.35);
      for (const NativeItem& item : file_.items) {
        for (const Edge& edge : item.axis.edges) {
          for (const std::uint32_t node : edge.node) {
            const Disk& disk = item.axis.nodes[node].disk;
            if (!(disk.radius > 0)) continue;
            for (const std::uint32_t site : edge.site) {
              if (site == no_site) continue;
              const Vec2 touch = frame_(foot(item.axis.sites[site], disk.center));
              if (feet) {
                circle(touch, thickness(1.8));
              } else {
                move_to(frame_(disk.center));
                line_to(touch);
              }
              if (++batch % pieces_per_stroke == 0)
                feet ? cairo_fill(context_) : cairo_stroke(context_);
            }
          }
        }
      }
      feet ? cairo_fill(context_) : cairo_stroke(context_);
    };
    cairo_set_fill_rule(context_, CAIRO_FILL_RULE_WINDING);
    radii_or_feet(false);
    radii_or_feet(true);
  }

  static bool runs_straight(const VoronoiDiagram& diagram, const VoronoiEdge& edge) {
    if (edge.spoke || edge.frame) return true;
    const SiteKind kind = diagram.sites[edge.site[0]].kind;
    return kind == diagram.sites[edge.site[1]].kind && kind != SiteKind::arc;
  }
  static bool runs_straight(const MedialAxis& axis, const Edge& edge) {
    if (axis.resolution > 0) return true;
    const SiteKind kind = axis.sites[edge.site[0]].kind;
    return kind == axis.sites[edge.site[1]].kind && kind != SiteKind::arc;
  }

  /// Cuts an edge where its radius passes from shade to shade, about.
  template <class Take>
  void cut(const MedialAxis& axis, const Edge& edge, Take take) const {
    const Curve curve(axis, edge);
    const bool straight = runs_straight(axis, edge);
    const double ends = std::fabs(curve.radius(0) - curve.radius(1));
    const double dip = std::fabs(curve.radius(0.5) - 0.5 * (curve.radius(0) + curve.radius(1)));
    const double shades = largest_ > 0 ? (ends + 2 * dip) / largest_ * shade_count : 0;
    const int pieces = std::clamp(static_cast<int>(std::ceil(shades)), 1, most_pieces);
    for (int i = 0; i < pieces; ++i) {
      const double t0 = static_cast<double>(i) / pieces;
      const double t1 = static_cast<double>(i + 1) / pieces;
      const Homogeneous a = curve.blossom(t0, t0);
      const Homogeneous b = curve.blossom(t0, t1);
      const Homogeneous c = curve.blossom(t1, t1);
      const auto place = [this](const Homogeneous& p) { return frame_({p.x / p.w, p.y / p.w}); };
      const double radius = std::max(curve.radius(0.5 * (t0 + t1)), 0.0);
      const int index =
          largest_ > 0 ? static_cast<int>(std::lround(radius / largest_ * (shade_count - 1))) : 0;
      take(std::clamp(index, 0, shade_count - 1),
           Piece{place(a), place(b), place(c), b.w / std::sqrt(a.w * c.w), straight});
    }
  }

  void trace(const Piece& piece) {
    move_to(piece.from);
    if (piece.straight) {
      line_to(piece.to);
    } else {
      conic_to(piece);
    }
  }

  /// A quadratic Bezier curve (weight 1) is one cubic exactly; other conics come very near to one
  /// once they are cut so often that their weights are nearly 1, which each cut in halves makes
  /// them four times as nearly: a circle's 16th turn stays within 7e-8 radii.
  void conic_to(const Piece& piece) {
    const double nearly_one = 0.0192;  // 1 - cos(turn / 2) of a 16th turn
    const double w = piece.weight;
    if (std::fabs(1 - w) > nearly_one) {
      const Vec2 left = 1 / (1 + w) * (piece.from + w * piece.control);
      const Vec2 right = 1 / (1 + w) * (piece.to + w * piece.control);
      const Vec2 middle = midpoint(left, right);
      const double half = std::sqrt(0.5 * (1 + w));
      conic_to({piece.from, left, middle, half, false});
      conic_to({middle, right, piece.to, half, false});
      return;
    }
    const double share = 4 * w / (3 * (1 + w));
    const Vec2 a = piece.from + share * (piece.control - piece.from);
    const Vec2 b = piece.to + share * (piece.control - piece.to);
    cairo_curve_to(context_, a.x, a.y, b.x, b.y, piece.to.x, piece.to.y);
  }

  void draw_axes() {
    // Few changes of colour: pieces are counted, then sorted by shade, then stroked in batches.
    std::array<std::vector<Piece>, shade_count> pieces;
    std::array<Cells, shade_count> cells;
    for (const NativeItem& item : file_.items) {
      for (const Edge& edge : item.axis.edges) {
        cut(item.axis, edge, [&](int index, const Piece& piece) {
          const auto i = static_cast<std::size_t>(index);
          if (!pixels_ || cells[i].add(piece)) pieces[i].push_back(piece);
        });
      }
    }
    cairo_set_line_width(context_, thickness(1.6));
    for (int i = 0; i < shade_count; ++i) {
      color(shade(i));
      int batch = 0;
      for (const Piece& piece : pieces[static_cast<std::size_t>(i)]) {
        trace(piece);
        if (++batch % pieces_per_stroke == 0) cairo_stroke(context_);
      }
      cairo_stroke(context_);
    }
  }

  void draw_nodes() {
    cairo_set_fill_rule(context_, CAIRO_FILL_RULE_WINDING);
    for (const NodeKind kind : {NodeKind::site_change, NodeKind::leaf, NodeKind::branching}) {
      color(node_colors[static_cast<std::size_t>(kind)]);
      const double radius = thickness(kind == NodeKind::site_change ? 1.5 : 2.6);
      int batch = 0;
      for (const NativeItem& item : file_.items) {
        for (const Node& node : item.axis.nodes) {
          if (node.kind != kind) continue;
          circle(frame_(node.disk.center), radius);
          if (++batch % pieces_per_stroke == 0) cairo_fill(context_);
        }
      }
      cairo_fill(context_);
    }
  }

  cairo_t* context_;
  const Frame& frame_;
  const NativeFile& file_;
  const WriteOptions& options_;
  const VoronoiFile* diagrams_;
  const LayerFile* layers_;
  bool pixels_ = false;  ///< a picture of pixels, in which nobody can look closer
  double largest_ = 0;   ///< radius
  double fineness_ = 1;  ///< factor of all line widths
};

cairo_surface_t* create_surface(OutputStream& out, const std::string& format, const Frame& frame) {
  if (format == "svg") {
    return cairo_svg_surface_create_for_stream(write_bytes, &out, frame.width, frame.height);
  }
  if (format == "pdf") {
    return cairo_pdf_surface_create_for_stream(write_bytes, &out, frame.width, frame.height);
  }
  if (format == "ps") {
    return cairo_ps_surface_create_for_stream(write_bytes, &out, frame.width, frame.height);
  }
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(frame.width),
                                    static_cast<int>(frame.height));
}

Status draw_picture(OutputStream& out, const std::string& format, const NativeFile& file,
                    const WriteOptions& options, const VoronoiFile* diagrams,
                    const LayerFile* layers = nullptr) {
  constexpr double smallest_size = 16;
  constexpr double largest_size = 8000;  // four times as high stays below Cairo's 32767
  if (!(options.width >= smallest_size && options.width <= largest_size)) {
    return Error{
        ErrorCode::invalid_option,
        fmt::format("the width of a picture lies between {} and {}", smallest_size, largest_size),
        {}};
  }
  const Frame frame = frame_of(file, std::floor(options.width));
  if (!(frame.scale > 0) || !std::isfinite(frame.scale) || !std::isfinite(frame.height)) {
    return Error{ErrorCode::unsupported, "the coordinates are too large or too small to draw", {}};
  }
  const Surface surface(create_surface(out, format, frame), &cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface.get()),
                                                                   &cairo_destroy);
  Picture(context.get(), frame, file, options, diagrams, layers).draw();
  cairo_status_t status = cairo_status(context.get());
  if (status == CAIRO_STATUS_SUCCESS && format == "png") {
    status = cairo_surface_write_to_png_stream(surface.get(), write_bytes, &out);
  }
  cairo_surface_finish(surface.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS && !out.failed()) {
    return Error{
        ErrorCode::unwritable, fmt::format("cannot draw: {}", cairo_status_to_string(status)), {}};
  }
  return success();
}

}  // namespace

Status write_picture(OutputStream& out, const std::string& format, const NativeFile& file,
                     const WriteOptions& options) {
  return draw_picture(out, format, file, options, nullptr);
}

Status write_layers_picture(OutputStream& out, const std::string& format, const LayerFile& file,
                            const NativeFile& background, const WriteOptions& options) {
  return draw_picture(out, format, background, options, nullptr, &file);
}

Status write_voronoi_picture(OutputStream& out, const std::string& format, const VoronoiFile& file,
                             const WriteOptions& options) {
  // Less its spokes, the diagram is the axis.
  NativeFile axes;
  axes.y_down = file.y_down;
  for (const VoronoiItem& item : file.items) {
    NativeItem& own = axes.items.emplace_back();
    own.shape = item.shape;
    own.axis.sites = item.diagram.sites;
    own.axis.nodes = item.diagram.nodes;
    for (const VoronoiEdge& edge : item.diagram.edges)
      if (!edge.spoke && !edge.frame) own.axis.edges.push_back(edge);
  }
  return draw_picture(out, format, axes, options, &file);
}

}  // namespace medial::io
