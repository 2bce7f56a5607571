#include <array>
#include <cmath>

#include "axis/steps.h"
#include "io/pictures/pictures.h"
#include "medial/query.h"

namespace medial::io {

namespace {

constexpr Color disk_color{0.85, 0.45, 0.15};
constexpr Color foot_color{0.80, 0.20, 0.20};
constexpr std::array<Color, 3> node_colors{
    {{0.20, 0.55, 0.25}, {0.45, 0.45, 0.50}, {0.80, 0.15, 0.20}}};

constexpr int most_pieces = 32;  // of one edge

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
  Curve(const Disk& from, const Edge& edge, const Disk& to)
      : points_{lift(from, 1), lift(edge.control, edge.weight), lift(to, 1)} {}

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

bool runs_straight(const MedialAxis& axis, const Edge& edge) {
  if (axis.resolution > 0) return true;
  const SiteKind kind = axis.sites[edge.site[0]].kind();
  return kind == axis.sites[edge.site[1]].kind() && kind != SiteKind::arc;
}

/// Whether nobody can tell a piece from its chord.
bool is_flat(const Piece& piece, double detail) {
  const Vec2 chord = piece.to - piece.from, to = piece.control - piece.from;
  const double across = cross(chord, to), along = dot(chord, to), square = squared_norm(chord);
  const double slack = Thinning::slack(square, detail);
  return across * across <= slack * slack * square && along >= 0 && along <= square;
}

/// What is drawn in one shade.
class Shade {
 public:
  explicit Shade(const Canvas& canvas) : detail_(canvas.detail()), cells_(canvas.cell()) {}

  void add(const Piece& piece) {
    if (piece.straight && !pieces_.empty() && pieces_.back().straight &&
        pieces_.back().to == piece.from && line_.take(piece.to)) {
      pieces_.back().to = piece.to;
      return;
    }
    if (!cells_.add(piece)) return;
    pieces_.push_back(piece);
    line_.start(piece.from, detail_);
    line_.take(piece.to);
  }
  const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  double detail_;
  Cells cells_;
  std::vector<Piece> pieces_;
  Thinning line_;  ///< the last piece
};

/// Cuts an edge where its radius passes from shade to shade, about, into pieces not shorter than
/// a cell: take(shade, piece).
template <class Take>
void cut(const MedialAxis& axis, Step step, const Canvas& canvas, double largest, Take take) {
  const Viewport& viewport = canvas.viewport();
  const Edge& edge = axis.edges[step.edge];
  const Disk& from = axis.nodes[tail_of(axis, step)].disk;
  const Disk& to = axis.nodes[head_of(axis, step)].disk;
  const Curve curve(from, edge, to);
  const bool straight = runs_straight(axis, edge);
  const Vec2 control = straight ? to.center : edge.control.center;
  const double cells = viewport.scale *
                       (distance(from.center, control) + distance(control, to.center)) /
                       canvas.cell();
  int pieces = 1;
  if (cells > 1 && largest > 0) {
    const double ends = std::fabs(curve.radius(0) - curve.radius(1));
    const double dip = std::fabs(curve.radius(0.5) - 0.5 * (curve.radius(0) + curve.radius(1)));
    const double shades = (ends + 2 * dip) / largest * shade_count;
    pieces =
        static_cast<int>(std::clamp(std::min(std::ceil(shades), cells), 1.0, 1.0 * most_pieces));
  }
  const auto put = [&](double radius, Piece piece) {
    if (!straight && is_flat(piece, canvas.detail())) {
      piece.control = piece.to;
      piece.straight = true;
    }
    const double index = largest > 0 ? radius / largest * (shade_count - 1) + 0.5 : 0;
    take(static_cast<int>(std::clamp(index, 0.0, shade_count - 1.0)), piece);
  };
  if (pieces == 1)
    return put(curve.radius(0.5), {viewport(from.center), viewport(control), viewport(to.center),
                                   edge.weight, straight});
  for (int i = 0; i < pieces; ++i) {
    const double t0 = static_cast<double>(i) / pieces;
    const double t1 = static_cast<double>(i + 1) / pieces;
    const Homogeneous a = curve.blossom(t0, t0);
    const Homogeneous b = curve.blossom(t0, t1);
    const Homogeneous c = curve.blossom(t1, t1);
    const auto place = [&viewport](const Homogeneous& p) {
      return viewport({p.x / p.w, p.y / p.w});
    };
    put(curve.radius(0.5 * (t0 + t1)),
        {place(a), place(straight ? c : b), place(c), b.w / std::sqrt(a.w * c.w), straight});
  }
}

}  // namespace

void draw_axes(Canvas& canvas, const Document<AxisItem>& file, double largest) {
  canvas.line_width(1.6);
  // Few changes of colour: pieces are counted, then sorted by shade, then stroked in batches.
  std::vector<Shade> shades(shade_count, Shade(canvas));
  // Nobody sees where exactly a shade ends: it stays for some cells, so that lines are few and
  // long.
  std::size_t chosen = 0;
  double left = 0;
  Vec2 end;
  const auto add = [&](int index, const Piece& piece) {
    if (left <= 0 || !(piece.from == end)) {
      chosen = static_cast<std::size_t>(index);
      left = canvas.detail();
    }
    left -= distance(piece.from, piece.to);
    end = piece.to;
    shades[chosen].add(piece);
  };
  for (const AxisItem& item : file.items)
    walk_branches(item.axis, [&](Step step, bool) { cut(item.axis, step, canvas, largest, add); });
  for (int i = 0; i < shade_count; ++i) {
    canvas.color(shade(i));
    const Piece* last = nullptr;
    for (const Piece& piece : shades[static_cast<std::size_t>(i)].pieces()) {
      if (last == nullptr || !(piece.from == last->to)) canvas.move_to(piece.from);
      canvas.piece_to(piece);
      last = canvas.count_piece(false) ? nullptr : &piece;
    }
    canvas.stroke();
  }
}

void draw_disks(Canvas& canvas, const Document<AxisItem>& file, int count) {
  double total = 0;
  for (const AxisItem& item : file.items) total += total_length(item.axis);
  if (!(total > 0)) return;
  const double step = total / count;
  double next = 0.5 * step;
  double walked = 0;
  canvas.color(disk_color, 0.6);
  canvas.line_width(0.6);
  for (const AxisItem& item : file.items) {
    for (const Edge& edge : item.axis.edges) {
      const double along = length(item.axis, edge);
      for (; next <= walked + along && along > 0; next += step) {
        const Disk disk = disk_at(item.axis, edge, std::clamp((next - walked) / along, 0.0, 1.0));
        canvas.circle(disk.center, disk.radius);
        canvas.stroke();
      }
      walked += along;
    }
  }
}

void draw_feet(Canvas& canvas, const Document<AxisItem>& file) {
  const Viewport& viewport = canvas.viewport();
  canvas.line_width(0.35);
  for (const bool feet : {false, true}) {
    canvas.color(foot_color, feet ? 1.0 : 0.35);
    for (const AxisItem& item : file.items) {
      for (const Edge& edge : item.axis.edges) {
        for (const std::uint32_t node : edge.node) {
          const Disk& disk = item.axis.nodes[node].disk;
          if (!(disk.radius > 0)) continue;
          for (const std::uint32_t site : edge.site) {
            if (site == no_site) continue;
            const Vec2 touch = viewport(foot(item.axis.sites[site], disk.center));
            if (feet) {
              canvas.dot(touch, canvas.thickness(1.8));
            } else {
              canvas.move_to(viewport(disk.center));
              canvas.line_to(touch);
            }
            canvas.count_piece(feet);
          }
        }
      }
    }
    feet ? canvas.fill() : canvas.stroke();
  }
}

void draw_nodes(Canvas& canvas, const Document<AxisItem>& file) {
  for (const NodeKind kind : {NodeKind::site_change, NodeKind::leaf, NodeKind::branching}) {
    canvas.color(node_colors[static_cast<std::size_t>(kind)]);
    const double radius = canvas.thickness(kind == NodeKind::site_change ? 1.5 : 2.6);
    for (const AxisItem& item : file.items) {
      for (const Node& node : item.axis.nodes) {
        if (node.kind != kind) continue;
        canvas.dot(canvas.viewport()(node.disk.center), radius);
        canvas.count_piece(true);
      }
    }
    canvas.fill();
  }
}

void draw_titles(Canvas& canvas, const Document<AxisItem>& file) {
  constexpr double height = 12;  // thousandths of the longer side
  canvas.color(outline_color);
  for (const AxisItem& item : file.items) {
    Extent extent;
    extent.add(item.shape);
    for (const Node& node : item.axis.nodes) extent.add(node.disk.center);  // of exteriors
    const Box box = extent.box();
    const Vec2 low = canvas.viewport()(box.low), high = canvas.viewport()(box.high);
    const Vec2 below{midpoint(low, high).x,
                     std::max(low.y, high.y) + 1.3e-3 * height * canvas.longer_side()};
    for (const auto& [name, value] : item.attributes)
      if (name == "title") canvas.centred_text(below, height, value);
  }
}

}  // namespace medial::io
