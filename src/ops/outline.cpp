#include <span>

#include "base/arc.h"
#include "medial/sides.h"
#include "ops/half_edges.h"

namespace medial {
namespace {

using ops::HalfEdge;

/// The walk around the axis, with the boundary on its right.
class Outliner {
 public:
  explicit Outliner(const MedialAxis& axis) : axis_(axis), halves_(axis) {}

  std::vector<Contour> run() {
    std::vector<Contour> contours;
    std::vector<bool> done(halves_.count(), false);
    std::vector<bool> has_edge(axis_.nodes.size(), false);
    for (HalfEdge start = 0; start < halves_.count(); ++start) {
      has_edge[halves_.from(start)] = true;
      if (done[start]) continue;
      Contour contour;
      HalfEdge half = start;
      do {
        done[half] = true;
        add_side(half, contour);
        add_gap(half, contour);
        half = halves_.next(half);
      } while (half != start);
      if (!contour.pieces.empty()) contours.push_back(std::move(contour));
    }
    for (std::uint32_t node = 0; node < axis_.nodes.size(); ++node)
      if (!has_edge[node]) contours.push_back(circle(axis_.nodes[node].disk));
    return contours;
  }

 private:
  void add_side(HalfEdge half, Contour& contour) const {
    const Vec2 begin = halves_.touch(half, false), end = halves_.touch(half, true);
    if (contour.points.empty()) contour.start_at(begin);
    if (begin == end) return;
    if (!halves_.exact(half)) return contour.line_to(end);
    const Site& site = axis_.sites[halves_.right_site(half)];
    if (site.kind != SiteKind::arc) return contour.line_to(end);
    contour.arc_to(end, partial_bulge({site.start, site.end, site.bulge}, begin, end));
  }

  /// The arc of the disk between a half edge and the next, counter-clockwise: the gap in (3).
  void add_gap(HalfEdge half, Contour& contour) const {
    const Vec2 begin = halves_.touch(half, true), end = halves_.touch(halves_.next(half), false);
    if (begin == end) return;
    const double angle = halves_.gap(half);
    if (angle == 0) return contour.line_to(end);
    ops::add_arc(halves_.disk(half, true), begin, end, angle, contour);
  }

  static Contour circle(const Disk& disk) {
    Contour contour;
    const Vec2 east{disk.radius, 0};
    contour.start_at(disk.center + east);
    contour.arc_to(disk.center - east, 1);
    contour.arc_to(disk.center + east, 1);
    return contour;
  }

  const MedialAxis& axis_;
  const ops::HalfEdges halves_;
};

}  // namespace

std::vector<Contour> boundary_of(const MedialAxis& axis) { return Outliner(axis).run(); }

}  // namespace medial
