#include "io/join.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/disjoint_sets.h"
#include "io/path_builder.h"
#include "medial/geometry.h"

namespace medial::io {

namespace {

constexpr double default_gap = 1e-6;  // of the diagonal
constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

/// End 2 i is where curve i begins, end 2 i + 1 where it ends.
using End = std::uint32_t;

Vec2 place_of(const std::vector<Contour>& curves, End end) {
  const std::vector<Vec2>& points = curves[end / 2].points;
  return end % 2 == 0 ? points.front() : points.back();
}

/// The angle at which a curve leaves one of its ends.
double direction_of(const Contour& curve, bool at_end) {
  const std::size_t last = curve.points.size() - 1;
  const Vec2 from = curve.points[at_end ? last : 0];
  // Halfway along an arc is a good point as well, and differs for two arcs with one tangent.
  const CurvePiece& piece = at_end ? curve.pieces.back() : curve.pieces.front();
  if (piece.bulge != 0) {
    const Vec2 a = curve.points[piece.first];
    const Vec2 b = curve.points[piece.first + 1];
    const Vec2 to = midpoint(a, b) - 0.5 * piece.bulge * left_of(b - a) - from;
    return std::atan2(to.y, to.x);
  }
  for (std::size_t i = 1; i <= last; ++i) {
    const Vec2 to = curve.points[at_end ? last - i : i] - from;
    if (!(to == Vec2{})) return std::atan2(to.y, to.x);
  }
  return 0;
}

struct Cell {
  double x, y;
  bool operator==(const Cell&) const = default;
};
struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    constexpr std::size_t mixer = 0x9E3779B97F4A7C15U;  // 2^64 / golden ratio
    const std::hash<double> hash;
    return (hash(cell.x) * mixer) ^ hash(cell.y);
  }
};

/// The place of each end, named by its lowest end.
std::vector<End> places_of(const std::vector<Contour>& curves, double tolerance) {
  const auto count = static_cast<End>(2 * curves.size());
  DisjointSets sets(count);
  // In a square cell of this width all points are within the tolerance of each other.
  const double width = tolerance / std::sqrt(2.0);
  double extent = 0;
  for (End end = 0; end < count; ++end) {
    const Vec2 p = place_of(curves, end);
    extent = std::max({extent, std::fabs(p.x), std::fabs(p.y)});
  }
  constexpr double most_cells = 9e15;  // what a double counts
  const bool exact = !(width > 0) || extent / width > most_cells;
  const auto cell = [&](Vec2 p, int dx, int dy) {
    if (exact) return Cell{p.x + 0.0, p.y + 0.0};  // -0 becomes 0
    return Cell{std::floor(p.x / width) + dx, std::floor(p.y / width) + dy};
  };
  std::unordered_map<Cell, End, CellHash> first;
  for (End end = 0; end < count; ++end)
    sets.join(first.try_emplace(cell(place_of(curves, end), 0, 0), end).first->second, end);
  // A cell stands for its first end: ends hardly ever share a cell with another place.
  for (const auto& [own, end] : first) {
    const Vec2 p = place_of(curves, end);
    for (int i = 0; i < 25 && !exact; ++i) {
      const auto other = first.find(cell(p, i / 5 - 2, i % 5 - 2));
      if (other != first.end() && distance(p, place_of(curves, other->second)) <= tolerance)
        sets.join(end, other->second);
    }
  }
  std::vector<End> places(count);
  for (End end = 0; end < count; ++end) places[end] = sets.find(end);
  return places;
}

/// Takes away, again and again, curves with an end where no other curve is.
std::vector<bool> in_loops(const std::vector<End>& place) {
  std::vector<std::vector<End>> ends(place.size());
  for (End end = 0; end < place.size(); ++end) ends[place[end]].push_back(end);
  std::vector<std::uint32_t> degree(place.size(), 0);
  std::vector<End> loose;
  for (End p = 0; p < place.size(); ++p) {
    degree[p] = static_cast<std::uint32_t>(ends[p].size());
    if (degree[p] == 1) loose.push_back(p);
  }
  std::vector<bool> kept(place.size() / 2, true);
  while (!loose.empty()) {
    const End p = loose.back();
    loose.pop_back();
    if (degree[p] != 1) continue;
    const auto last = std::ranges::find_if(ends[p], [&](End end) { return kept[end / 2]; });
    kept[*last / 2] = false;
    --degree[p];
    const End other = place[*last ^ 1U];
    if (--degree[other] == 1) loose.push_back(other);
  }
  return kept;
}

struct Leaving {
  End place;
  double direction;
  End end;
};

/// The ends of the curves that are kept, by place, and counterclockwise around each.
std::vector<Leaving> ends_around_places(const std::vector<Contour>& curves,
                                        const std::vector<End>& place,
                                        const std::vector<bool>& kept) {
  std::vector<Leaving> leaving;
  for (End end = 0; end < place.size(); ++end) {
    if (!kept[end / 2]) continue;
    leaving.push_back({place[end], direction_of(curves[end / 2], end % 2 == 1), end});
  }
  std::ranges::sort(leaving, {}, [](const Leaving& one) {
    return std::tuple(one.place, one.direction, one.end);
  });
  return leaving;
}

/// The end that each end goes on at; no_index where a curve goes nowhere.
std::vector<End> partners(const std::vector<Leaving>& leaving, std::size_t ends) {
  std::vector<End> partner(ends, no_index);
  for (std::size_t i = 0; i + 1 < leaving.size(); ++i) {
    if (leaving[i].place != leaving[i + 1].place) continue;
    partner[leaving[i].end] = leaving[i + 1].end;
    partner[leaving[i + 1].end] = leaving[i].end;
    ++i;
  }
  return partner;
}

/// Appends a curve from one of its ends to the other; its first point is the contour's last.
void append(Contour& contour, const Contour& curve, bool backward) {
  const Contour reverse = backward ? reversed(curve) : Contour{};
  const Contour& next = backward ? reverse : curve;
  for (const CurvePiece& piece : next.pieces) {
    const auto points = std::span(next.points).subspan(piece.first + 1, piece.degree);
    if (piece.degree == 1) {
      contour.arc_to(points.front(), piece.bulge);
    } else {
      contour.bezier_to(points, next.weights_of(piece));
    }
  }
}

/// Twice the area on the left of a closed contour, with the area between arcs and chords.
double doubled_area(const Contour& contour) {
  double sum = 0;
  for (const CurvePiece& piece : contour.pieces) {
    const Vec2 origin = contour.points.front();
    for (std::uint32_t i = piece.first; i < piece.first + piece.degree; ++i)
      sum += cross(contour.points[i] - origin, contour.points[i + 1] - origin);
    if (piece.bulge == 0) continue;
    // Twice the area of a segment of angle a and radius r is r^2 (a - sin a).
    const double angle = 4 * std::atan(piece.bulge);
    const double chord = distance(contour.points[piece.first], contour.points[piece.first + 1]);
    const double radius = chord / (2 * std::sin(angle / 2));
    sum += radius * radius * (angle - std::sin(angle));
  }
  return sum;
}

/// The bounded faces of the curves that are kept, as a plane graph: walks that turn right as far as
/// possible at each place, with the face on their left.
void add_cells(const std::vector<Contour>& curves, const std::vector<Leaving>& leaving,
               std::size_t ends, JoinedCurves& result) {
  std::vector<End> next(ends, no_index);  // after arriving at an end
  for (std::size_t first = 0, i = 0; i < leaving.size(); ++i) {
    if (leaving[i].place != leaving[first].place) first = i;
    std::size_t last = i;
    if (i == first)
      while (last + 1 < leaving.size() && leaving[last + 1].place == leaving[i].place) ++last;
    next[leaving[i].end] = leaving[i == first ? last : i - 1].end;
  }
  std::vector<bool> done(ends, false), in_cell(curves.size(), false);
  for (const Leaving& begin : leaving) {
    if (done[begin.end]) continue;
    Contour cell;
    cell.start_at(place_of(curves, begin.end));
    std::vector<End> around;
    for (End at = begin.end; !done[at]; at = next[at ^ 1U]) {
      done[at] = true;
      around.push_back(at / 2);
      append(cell, curves[at / 2], at % 2 == 1);
    }
    cell.points.back() = cell.points.front();
    if (is_degenerate(cell) || !(doubled_area(cell) > 0)) continue;
    for (const std::uint32_t curve : around) in_cell[curve] = true;
    result.cells.push_back(std::move(cell));
  }
  result.in_cells = static_cast<std::uint64_t>(std::ranges::count(in_cell, true));
}

double diagonal_of(const std::vector<Contour>& curves) {
  Box box = Box::nothing();
  for (const Contour& curve : curves)
    for (const Vec2 p : curve.points) box.add(p);
  return curves.empty() ? 0 : distance(box.low, box.high);
}

}  // namespace

JoinedCurves join_curves(std::vector<Contour> curves, std::optional<double> gap) {
  std::erase_if(curves, [](const Contour& curve) { return curve.pieces.empty(); });
  JoinedCurves result;
  const bool close_all = gap && std::isinf(*gap);
  result.tolerance = gap && !close_all ? *gap : default_gap * diagonal_of(curves);
  const std::vector<End> place = places_of(curves, result.tolerance);
  // A curve that a tolerance swallows whole would close on itself and take the place of another.
  const std::vector<bool> kept =
      close_all ? std::vector<bool>(curves.size(), true) : in_loops(place);
  const std::vector<Leaving> leaving = ends_around_places(curves, place, kept);
  const std::vector<End> partner = partners(leaving, place.size());

  std::vector<bool> used(curves.size(), false);
  // Goes from curve to curve, entering `begin` first; true if the way comes back.
  const auto walk = [&](End begin, Contour& contour, std::uint64_t& count) {
    contour.start_at(place_of(curves, begin));
    for (End at = begin;;) {
      used[at / 2] = true;
      ++count;
      append(contour, curves[at / 2], at % 2 == 1);
      const End next = partner[at ^ 1U];
      if (next == begin) {
        contour.points.back() = contour.points.front();
        return true;
      }
      if (next == no_index || used[next / 2]) return false;
      at = next;
    }
  };
  result.smallest_gap = std::numeric_limits<double>::infinity();
  const auto gather = [&](End begin) {
    Contour contour;
    std::uint64_t count = 0;
    if (walk(begin, contour, count) || (close_all && !is_degenerate(contour))) {
      result.loops.push_back(std::move(contour));
    } else {
      result.open += count;
      result.smallest_gap =
          std::min(result.smallest_gap, distance(contour.points.front(), contour.points.back()));
    }
  };
  // Ways that end somewhere are walked from their ends, then what is left is closed.
  for (End end = 0; end < place.size(); ++end) {
    if (kept[end / 2] && !used[end / 2] && partner[end] == no_index) gather(end);
  }
  for (End end = 0; end < place.size(); end += 2) {
    if (kept[end / 2] && !used[end / 2]) gather(end);
  }
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (!kept[i]) ++result.open;
  }
  if (result.loops.empty()) add_cells(curves, leaving, place.size(), result);
  return result;
}

}  // namespace medial::io
