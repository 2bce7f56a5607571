#include "methods/potential/region.h"

#include <algorithm>
#include <cmath>

#include "axis/sites.h"
#include "base/arc.h"

namespace medial::potential {
namespace {

/// The number of chords of equal length that are within `chord` of an arc; at most 64.
int chords_of(const BulgeArc& arc, double chord) {
  if (arc.bulge == 0) return 1;
  const double sagitta = std::abs(arc.bulge) * distance(arc.start, arc.end) / 2;
  return static_cast<int>(std::clamp(std::ceil(std::sqrt(sagitta / chord)), 1.0, 64.0));
}

/// The point of an arc at the share t of its length.
Vec2 point_at(const BulgeArc& arc, double t) {
  const double angle = 4 * std::atan(arc.bulge) * t;
  const Vec2 tangent = start_tangent(arc);
  const double k = curvature(arc);
  const double reach = 2 * std::sin(angle / 2) / k;
  return arc.start + reach * turned(tangent, std::cos(angle / 2), std::sin(angle / 2));
}

/// The turn, in radians, of the boundary around a bend where it is at least half as curved as
/// there.
double turn_around(const site::LoopEdges& loop, std::uint32_t bend, double k) {
  const auto turn = [&](std::uint32_t i) {
    const BulgeArc arc{loop.local(i), loop.local(loop.next(i)), loop.bulge(i)};
    return arc.bulge > 0 && curvature(arc) >= 0.5 * k ? 4 * std::atan(arc.bulge) : 0;
  };
  double sum = turn(bend);
  for (std::uint32_t i = loop.next(bend); i != bend && turn(i) > 0; i = loop.next(i))
    sum += turn(i);
  for (std::uint32_t i = loop.before(bend); i != bend && turn(i) > 0; i = loop.before(i))
    sum += turn(i);
  return sum;
}

}  // namespace

std::size_t Region::edges() const {
  return static_cast<std::size_t>(
      std::count_if(pieces.begin(), pieces.end(), [](const Charge& piece) { return piece.first; }));
}

std::uint32_t Region::before(std::uint32_t piece) const {
  const auto loop =
      std::upper_bound(loops.begin(), loops.end(), piece,
                       [](std::uint32_t wanted, const PieceLoop& one) { return wanted < one.end; });
  return piece == loop->begin ? loop->end - 1 : piece - 1;
}

bool encloses(const Region& region, Vec2 p) {
  bool inside = false;
  for (const Charge& piece : region.pieces) {
    if ((piece.start.y > p.y) == (piece.end.y > p.y)) continue;
    const double along = (p.y - piece.start.y) / (piece.end.y - piece.start.y);
    if (piece.start.x + along * (piece.end.x - piece.start.x) > p.x) inside = !inside;
  }
  return inside;
}

std::vector<Region> regions_of(const Problem& problem, double chord) {
  const Shape& shape = problem.shape;
  const site::SiteNumbers& numbers = problem.numbers();
  std::vector<Region> regions(shape.component_count());
  // Outer loops first.
  for (const bool hole : {false, true}) {
    for (std::size_t l = 0; l < shape.loop_count(); ++l) {
      if (shape.hole[l] != hole) continue;
      Region& region = regions[shape.component[l]];
      const site::LoopEdges loop(shape, l, problem.frame);
      Region::PieceLoop range;
      range.begin = static_cast<std::uint32_t>(region.pieces.size());
      range.inside = loop.local(0);
      for (std::uint32_t i = 0; i < loop.size(); ++i) {
        const BulgeArc arc{loop.local(i), loop.local(loop.next(i)), loop.bulge(i)};
        const auto here = numbers.joints[loop.begin() + i];
        if (here == site::Joint::corner)
          region.corners.push_back(static_cast<std::uint32_t>(region.pieces.size()));
        if (here == site::Joint::reflex)
          region.reflex.push_back(static_cast<std::uint32_t>(region.pieces.size()));
        if (arc.bulge > 0) {
          const auto curvature_of = [&](std::uint32_t j) {
            return loop.bulge(j) == 0
                       ? 0
                       : curvature({loop.local(j), loop.local(loop.next(j)), loop.bulge(j)});
          };
          const auto next = numbers.joints[loop.begin() + loop.next(i)];
          const double k = curvature(arc);
          if (here == site::Joint::smooth && next == site::Joint::smooth &&
              curvature_of(loop.before(i)) < k && curvature_of(loop.next(i)) <= k) {
            const Vec2 t = start_tangent(arc);
            region.bends.push_back(
                {{arc.start + (1 / k) * left_of(t), 1 / k}, turn_around(loop, i, k)});
          }
        }
        const int chords = chords_of(arc, chord);
        if (chords > 1)
          region.bend = std::max(region.bend, 2 * std::atan(std::abs(arc.bulge)) / chords);
        Vec2 from = arc.start;
        for (int k = 1; k <= chords; ++k) {
          const Vec2 to = k == chords ? arc.end : point_at(arc, static_cast<double>(k) / chords);
          region.pieces.push_back({from, to, loop.begin() + i, k == 1, k == chords});
          from = to;
        }
      }
      range.end = static_cast<std::uint32_t>(region.pieces.size());
      region.loops.push_back(range);
    }
  }
  for (Region& region : regions) {
    region.chord = chord;
    Box box{region.pieces[0].start, region.pieces[0].start};
    for (const Charge& piece : region.pieces) {
      box.low = {std::min(box.low.x, piece.start.x), std::min(box.low.y, piece.start.y)};
      box.high = {std::max(box.high.x, piece.start.x), std::max(box.high.y, piece.start.y)};
    }
    region.size = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  }
  return regions;
}

}  // namespace medial::potential
