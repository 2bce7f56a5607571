#include "methods/raster/ridge/necks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <span>

#include "base/numbers.h"
#include "base/runs.h"

namespace medial::ridge {
namespace {

using raster::BitMap;
using raster::Pixel;

/// Where the boundary crosses a row or column of pixel centres.
struct Crossing {
  double at = 0;           ///< along the line
  std::uint32_t line = 0;  ///< the row or column
  std::uint32_t side = 0;  ///< the whole number below `at`: which side of a square it lies on
  std::uint32_t next = 0;  ///< the crossing after it along the boundary
  Pixel square;            ///< into which the boundary goes from here, by its lowest corner
  bool on_row = false;
  bool enters = false;  ///< whether the line goes into the shape here
};

/// All crossings, and their order along the lines: columns first, each line's by increasing place.
struct Crossings {
  std::vector<Crossing> all;
  std::vector<std::uint32_t> order, rank;
  std::vector<std::uint32_t> by_square;  ///< into which the boundary goes from them
  std::vector<std::uint32_t> row_begin;  ///< in `order`
  std::uint64_t hidden = 0;
};

/// The crossings of the edge from a to b, appended in their order along it. A point on a line
/// counts as beyond it; every crossing lies on the side that the squares before and after it share,
/// whatever rounding makes of its place.
void cross_edge(Vec2 a, Vec2 b, std::vector<Crossing>& all) {
  auto x = static_cast<std::int64_t>(std::floor(a.x)),
       y = static_cast<std::int64_t>(std::floor(a.y));
  const auto end_x = static_cast<std::int64_t>(std::floor(b.x));
  const auto end_y = static_cast<std::int64_t>(std::floor(b.y));
  const Vec2 d = b - a;
  while (x != end_x || y != end_y) {
    const auto column = static_cast<double>(x < end_x ? x + 1 : x);
    const auto row = static_cast<double>(y < end_y ? y + 1 : y);
    const bool on_row =
        x == end_x || (y != end_y && std::abs((row - a.y) * d.x) < std::abs((column - a.x) * d.y));
    Crossing crossing;
    crossing.on_row = on_row;
    const std::int64_t side = on_row ? x : y;
    const double at = on_row ? a.x + (row - a.y) * (d.x / d.y) : a.y + (column - a.x) * (d.y / d.x);
    crossing.at = std::clamp(at, static_cast<double>(side), static_cast<double>(side + 1));
    crossing.side = static_cast<std::uint32_t>(side);
    crossing.line = static_cast<std::uint32_t>(on_row ? row : column);
    // The interior lies on the left of the boundary's way.
    crossing.enters = on_row ? y > end_y : x < end_x;
    if (on_row)
      y += y < end_y ? 1 : -1;
    else
      x += x < end_x ? 1 : -1;
    crossing.square = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
    all.push_back(crossing);
  }
}

/// Along each line crossings enter and leave in turn; where rounding has exchanged two that nearly
/// coincide, they are exchanged again.
void alternate(const std::vector<Crossing>& all, std::vector<std::uint32_t>& order) {
  constexpr double nearly = 1e-6;  // pixels
  bool inside = false;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Crossing& here = all[order[i]];
    if (i == 0 || all[order[i - 1]].line != here.line || all[order[i - 1]].on_row != here.on_row)
      inside = false;
    if (here.enters == inside)
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        const Crossing& there = all[order[j]];
        if (there.on_row != here.on_row || there.line != here.line || there.side != here.side ||
            there.at > here.at + nearly)
          break;
        if (there.enters == inside) continue;
        std::swap(order[i], order[j]);
        break;
      }
    inside = all[order[i]].enters;
  }
}

Crossings find_crossings(const EdgeOutline& outline, const LocalGrid& local) {
  Crossings crossings;
  std::vector<Crossing>& all = crossings.all;
  for (std::size_t e = 0, loop = 0; e < outline.edges.size(); ++e) {
    cross_edge(local.in_pixels(outline.edges[e].point),
               local.in_pixels(outline.edges[outline.next[e]].point), all);
    if (outline.next[e] > e) continue;
    if (loop == all.size()) ++crossings.hidden;
    for (std::size_t i = loop; i < all.size(); ++i)
      all[i].next = static_cast<std::uint32_t>(i + 1 < all.size() ? i + 1 : loop);
    loop = all.size();
  }
  std::vector<std::uint32_t>& order = crossings.order;
  order.resize(all.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Crossing &a = all[i], &b = all[j];
    if (a.on_row != b.on_row) return b.on_row;
    if (a.line != b.line) return a.line < b.line;
    if (a.side != b.side) return a.side < b.side;
    return a.at != b.at ? a.at < b.at : i < j;
  });
  alternate(all, order);
  crossings.rank.resize(order.size());
  crossings.row_begin.assign(std::size_t{local.grid.rows} + 1, 0);
  for (std::uint32_t i = 0; i < order.size(); ++i) crossings.rank[order[i]] = i;
  std::vector<std::uint32_t>& chains = crossings.by_square;
  chains.resize(all.size());
  for (std::uint32_t i = 0; i < chains.size(); ++i) chains[i] = i;
  std::sort(chains.begin(), chains.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Pixel a = all[i].square, b = all[j].square;
    return a != b ? a < b : i < j;
  });
  std::size_t at = 0;
  for (std::uint32_t row = 0; row <= local.grid.rows; ++row) {
    while (at < order.size() && (!all[order[at]].on_row || all[order[at]].line < row)) ++at;
    crossings.row_begin[row] = static_cast<std::uint32_t>(at);
  }
  return crossings;
}

/// A gate as one of its two cells sees it.
struct Half {
  std::uint64_t key;   ///< the same for both
  std::uint32_t cell;  ///< the number of the cell
  std::uint32_t line, side;
  float low, high;  ///< beyond `side`
  bool on_row, low_pixel, high_pixel;
};

/// Interior pixels at consecutive corners of a cell.
struct Corners {
  std::uint32_t cell;
  Pixel square;
  std::uint8_t first, count;
};

/// A corner of a square, counted as its sides are: corner s ends side s.
Pixel corner_of(Pixel square, int s) {
  return {square.column + (s < 2 ? 1u : 0u), square.row + (s == 1 || s == 2 ? 1u : 0u)};
}

/// The cells at the boundary and their gates.
class Cells {
 public:
  Cells(const LocalGrid& local, const BitMap& boundary, const InteriorSets& sets,
        const Crossings& crossings)
      : local_(local), boundary_(boundary), sets_(sets), crossings_(crossings) {}

  void build();

  std::vector<Half> halves;
  std::vector<Corners> corners;
  std::vector<Pixel> surrounded;  ///< as often as a cell sees drawn pixels between interior ones
  std::uint32_t count = 0;
  std::uint64_t torn = 0;

 private:
  /// An end of a gate: a pixel's centre or a crossing.
  struct End {
    bool pixel = false;
    std::uint32_t crossing = none;
    double at = 0;
  };
  struct Point {
    int side;
    std::int64_t place;
    std::uint32_t chain;  ///< the crossing at which the boundary comes in
    bool leaves;          ///< whether the boundary leaves the square here
  };

  void chains_of(Pixel square, const std::uint32_t* first, const std::uint32_t* last);
  void whole(Pixel square);
  Point point_at(Pixel square, std::uint32_t crossing, std::uint32_t chain, bool leaves) const;
  void between(Pixel square, const Point& from, const Point& to, bool around);
  void gate(Pixel square, int side, End from, End to);
  bool is_interior(Pixel square, int corner) const {
    return sets_.inside.at(corner_of(square, corner));
  }
  End end_at(std::uint32_t crossing) const {
    return {false, crossing, crossings_.all[crossing].at};
  }
  /// A cell ends: without gates, and if interior pixels come to it only once, it has no part.
  void finish_cell() {
    if (halves.size() == halves_before_ && corners.size() <= corners_before_ + 1)
      corners.resize(corners_before_);
    else
      ++count;
    halves_before_ = halves.size();
    corners_before_ = corners.size();
  }
  void add_corner(Pixel square, int corner, bool goes_on) {
    if (goes_on)
      ++corners.back().count;
    else
      corners.push_back({count, square, static_cast<std::uint8_t>(corner), 1});
  }

  const LocalGrid& local_;
  const BitMap& boundary_;
  const InteriorSets& sets_;
  const Crossings& crossings_;
  std::size_t halves_before_ = 0, corners_before_ = 0;
  std::vector<Point> points_;
  std::vector<std::size_t> exit_;
};

void Cells::gate(Pixel square, int side, End from, End to) {
  if (side >= 2) std::swap(from, to);
  const bool on_row = side % 2 == 0;
  const std::uint32_t line =
      on_row ? square.row + (side == 2 ? 1 : 0) : square.column + (side == 1 ? 1 : 0);
  const std::uint32_t start = on_row ? square.column : square.row;
  const Pixel low = on_row ? Pixel{start, line} : Pixel{line, start};
  const std::uint64_t key = from.pixel ? 4 * local_.grid.index(low) + (on_row ? 3 : 1)
                                       : 2 * std::uint64_t{crossings_.rank[from.crossing]};
  halves.push_back({key, count, line, start, from.pixel ? 0 : static_cast<float>(from.at - start),
                    to.pixel ? 1 : static_cast<float>(to.at - start), on_row, from.pixel,
                    to.pixel});
}

Cells::Point Cells::point_at(Pixel square, std::uint32_t crossing, std::uint32_t chain,
                             bool leaves) const {
  const Crossing& c = crossings_.all[crossing];
  const int side = c.on_row ? (c.line == square.row ? 0 : 2) : (c.line == square.column ? 3 : 1);
  const auto rank = static_cast<std::int64_t>(crossings_.rank[crossing]);
  return {side, side < 2 ? rank : -rank, chain, leaves};
}

/// The part of a square's border from where the boundary leaves it to where it comes in again.
void Cells::between(Pixel square, const Point& from, const Point& to, bool around) {
  const int steps = around ? 4 : (to.side - from.side + 4) % 4;
  End start = end_at(crossings_.all[from.chain].next);
  bool interior = false, drawn_after_interior = false;
  for (int i = 0; i <= steps; ++i) {
    const int side = (from.side + i) % 4;
    const bool last = i == steps;
    const bool was = interior;
    interior = !last && is_interior(square, side);
    const End end = last ? end_at(to.chain) : End{true, none, 0};
    if (!was && !interior) gate(square, side, start, end);
    if (interior) {
      add_corner(square, side, was);
      if (drawn_after_interior) surrounded.push_back(corner_of(square, (side + 3) % 4));
    }
    drawn_after_interior = was && !interior && !last;
    start = {true, none, 0};
  }
}

void Cells::chains_of(Pixel square, const std::uint32_t* first, const std::uint32_t* last) {
  points_.clear();
  for (const std::uint32_t* chain = first; chain != last; ++chain) {
    points_.push_back(point_at(square, *chain, *chain, false));
    points_.push_back(point_at(square, crossings_.all[*chain].next, *chain, true));
  }
  std::sort(points_.begin(), points_.end(), [](const Point& a, const Point& b) {
    return a.side != b.side ? a.side < b.side : a.place < b.place;
  });
  const std::size_t n = points_.size();
  for (std::size_t i = 0; i < n; ++i)
    if (points_[i].leaves == points_[(i + 1) % n].leaves) {
      ++torn;
      return;
    }
  exit_.assign(n, n);
  for (std::size_t i = 0; i < n; ++i)
    if (!points_[i].leaves)
      for (std::size_t j = 0; j < n; ++j)
        if (points_[j].leaves && points_[j].chain == points_[i].chain) exit_[i] = j;
  for (std::size_t start = 0; start < n; ++start) {
    if (!points_[start].leaves) continue;
    bool any = false;
    for (std::size_t i = start; points_[i].leaves;) {
      const std::size_t to = (i + 1) % n;
      between(square, points_[i], points_[to], to < i && points_[to].side == points_[i].side);
      points_[i].leaves = false;
      any = true;
      i = exit_[to];
    }
    if (any) finish_cell();
  }
}

void Cells::whole(Pixel square) {
  int first = 0;  // a corner that begins a run of interior ones, if any does
  while (first < 4 && !(is_interior(square, first) && !is_interior(square, (first + 3) % 4)))
    ++first;
  if (first == 4) first = 0;
  for (int i = 0; i < 4; ++i) {
    const int corner = (first + i) % 4, before = (corner + 3) % 4;
    const bool here = is_interior(square, corner), was = is_interior(square, before);
    if (here) add_corner(square, corner, was && i > 0);
    if (!here && was && is_interior(square, (corner + 1) % 4))
      surrounded.push_back(corner_of(square, corner));
    if (!here && !was) gate(square, corner, {true, none, 0}, {true, none, 0});
  }
  finish_cell();
}

void Cells::build() {
  const std::vector<Crossing>& all = crossings_.all;
  const std::vector<std::uint32_t>& chains = crossings_.by_square;
  // The pixels of the boundary map that lie inside, of a row of squares' lower and upper pixels.
  const std::uint32_t words = boundary_.words_per_row();
  std::vector<std::uint64_t> lower(words), upper(words), square(words);
  const auto drawn_inside = [&](std::uint32_t row, std::vector<std::uint64_t>& bits) {
    BitMap inside(local_.grid.columns, 1);
    const std::uint32_t end = crossings_.row_begin[row + 1];
    for (std::uint32_t i = crossings_.row_begin[row]; i + 1 < end; ++i) {
      const Crossing &from = all[crossings_.order[i]], &to = all[crossings_.order[i + 1]];
      if (from.enters && !to.enters && from.side < to.side)
        set_bits(inside.row(0), from.side + 1, to.side);
    }
    for (std::uint32_t w = 0; w < words; ++w)
      bits[w] = inside.row(0)[w] & ~sets_.inside.row(row)[w];
  };
  std::size_t next = 0;
  drawn_inside(0, lower);
  for (std::uint32_t row = 0; row + 1 < local_.grid.rows; ++row) {
    drawn_inside(row + 1, upper);
    for (std::uint32_t w = 0; w < words; ++w) {
      const std::uint64_t here = lower[w] | upper[w];
      const std::uint64_t after = w + 1 < words ? lower[w + 1] | upper[w + 1] : 0;
      square[w] = here | (here >> 1) | (after << 63);
    }
    while (next < chains.size() && all[chains[next]].square.row == row) {
      const Pixel p = all[chains[next]].square;
      const std::size_t begin = next;
      while (next < chains.size() && all[chains[next]].square == p) ++next;
      square[p.column >> 6] &= ~(std::uint64_t{1} << (p.column & 63));
      chains_of(p, chains.data() + begin, chains.data() + next);
    }
    for (std::uint32_t w = 0; w < words; ++w)
      for (std::uint64_t rest = square[w]; rest != 0; rest &= rest - 1)
        whole({64 * w + static_cast<std::uint32_t>(std::countr_zero(rest)), row});
    std::swap(lower, upper);
  }
}

/// The complex: gates with their cells and the drawn pixels at their ends.
class Complex {
 public:
  Complex(Cells& cells, const raster::Grid& grid);
  void collapse();
  void prune(double shortest);
  void result(const std::vector<Corners>& corners, Necks& necks) const;

 private:
  struct Gate {
    Half half;
    std::array<std::uint32_t, 2> cell{none, none}, face{none, none};
    bool there = true;
  };
  struct GatesByCell {
    std::vector<std::uint32_t> all, begin;
    std::vector<std::uint32_t> degree;  ///< of each cell: its gates that are not gone
    std::span<const std::uint32_t> at(std::uint32_t cell) const {
      return std::span(all).subspan(begin[cell], begin[cell + 1] - begin[cell]);
    }
  };
  struct Twig {
    std::uint32_t gate, tip, root;
  };
  /// Blind ends, from their tips on.
  struct Twigs {
    std::vector<Twig> all;
    std::vector<double> length;  ///< of each gate: the way beyond it to the farthest tip
    std::vector<bool> gone;      ///< of each gate
  };
  GatesByCell gates_by_cell() const;
  Twigs take_twigs(GatesByCell& gates) const;
  Vec2 middle(const Gate& gate) const {
    const double at = gate.half.side + 0.5 * (double{gate.half.low} + double{gate.half.high});
    const double line = gate.half.line;
    return gate.half.on_row ? Vec2{at, line} : Vec2{line, at};
  }
  const raster::Grid& grid_;
  std::vector<Gate> gates_;
  std::vector<std::uint64_t> faces_;  ///< drawn pixels with gates, by index in the grid
  std::vector<std::array<std::uint32_t, 4>> around_;
  std::vector<bool> stuck_;
  std::vector<bool> rooted_;  ///< of each cell: whether interior pixels come to it
};

Complex::Complex(Cells& cells, const raster::Grid& grid) : grid_(grid) {
  std::sort(cells.halves.begin(), cells.halves.end(), [](const Half& a, const Half& b) {
    return a.key != b.key ? a.key < b.key : a.cell < b.cell;
  });
  rooted_.assign(cells.count, false);
  for (const Corners& corners : cells.corners) rooted_[corners.cell] = true;
  const auto pixels = [&](const Half& half) {
    const Pixel low = half.on_row ? Pixel{half.side, half.line} : Pixel{half.line, half.side};
    const Pixel high =
        half.on_row ? Pixel{half.side + 1, half.line} : Pixel{half.line, half.side + 1};
    constexpr std::uint64_t no_pixel = ~std::uint64_t{0};
    return std::array{half.low_pixel ? grid.index(low) : no_pixel,
                      half.high_pixel ? grid.index(high) : no_pixel};
  };
  for (const Half& half : cells.halves) {
    if (gates_.empty() || gates_.back().half.key != half.key) {
      gates_.push_back({half});
      gates_.back().cell[0] = half.cell;
      for (const std::uint64_t p : pixels(half))
        if (p != ~std::uint64_t{0}) faces_.push_back(p);
    } else {
      gates_.back().cell[1] = half.cell;
    }
  }
  // A gate that only one of its cells knows, as the other's square is torn, ends blindly.
  for (Gate& gate : gates_)
    if (gate.cell[1] == none) {
      gate.cell[1] = static_cast<std::uint32_t>(rooted_.size());
      rooted_.push_back(false);
    }
  cells.halves = {};
  std::sort(faces_.begin(), faces_.end());
  faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());
  around_.assign(faces_.size(), {none, none, none, none});
  stuck_.assign(faces_.size(), true);
  for (std::uint32_t g = 0; g < gates_.size(); ++g) {
    const auto both = pixels(gates_[g].half);
    for (std::size_t end = 0; end < 2; ++end) {
      if (both[end] == ~std::uint64_t{0}) continue;
      const auto face = static_cast<std::uint32_t>(
          std::lower_bound(faces_.begin(), faces_.end(), both[end]) - faces_.begin());
      gates_[g].face[end] = face;
      const auto place = std::find(around_[face].begin(), around_[face].end(), none);
      if (place != around_[face].end()) *place = g;
    }
  }
}

void Complex::collapse() {
  using Free = std::pair<float, std::uint32_t>;
  std::priority_queue<Free, std::vector<Free>, std::greater<>> free;
  const auto face_of = [&](const Gate& gate) {
    std::uint32_t found = none, count = 0;
    for (const std::uint32_t face : gate.face)
      if (face != none && stuck_[face]) {
        found = face;
        ++count;
      }
    return count == 1 ? found : none;
  };
  const auto offer = [&](std::uint32_t g) {
    const Gate& gate = gates_[g];
    if (gate.there && face_of(gate) != none) free.push({gate.half.high - gate.half.low, g});
  };
  for (std::uint32_t g = 0; g < gates_.size(); ++g) offer(g);
  while (!free.empty()) {
    const std::uint32_t g = free.top().second;
    free.pop();
    const std::uint32_t face = face_of(gates_[g]);
    if (!gates_[g].there || face == none) continue;
    gates_[g].there = false;
    stuck_[face] = false;
    for (const std::uint32_t other : around_[face])
      if (other != none) offer(other);
  }
}

Complex::GatesByCell Complex::gates_by_cell() const {
  GatesByCell gates;
  gates.begin.assign(rooted_.size() + 1, 0);
  for (const Gate& gate : gates_)
    if (gate.there)
      for (const std::uint32_t cell : gate.cell) ++gates.begin[cell + 1];
  gates.degree.assign(gates.begin.begin() + 1, gates.begin.end());
  std::partial_sum(gates.begin.begin(), gates.begin.end(), gates.begin.begin());
  gates.all.resize(gates.begin.back());
  std::vector<std::uint32_t> fill(gates.begin.begin(), gates.begin.end() - 1);
  for (std::uint32_t g = 0; g < gates_.size(); ++g)
    if (gates_[g].there)
      for (const std::uint32_t cell : gates_[g].cell) gates.all[fill[cell]++] = g;
  return gates;
}

Complex::Twigs Complex::take_twigs(GatesByCell& gates) const {
  Twigs twigs{{}, std::vector<double>(gates_.size(), 0), std::vector<bool>(gates_.size(), false)};
  std::vector<std::uint32_t> tips;
  const auto is_tip = [&](std::uint32_t cell) { return gates.degree[cell] == 1 && !rooted_[cell]; };
  for (std::uint32_t c = 0; c < gates.degree.size(); ++c)
    if (is_tip(c)) tips.push_back(c);
  while (!tips.empty()) {
    const std::uint32_t tip = tips.back();
    tips.pop_back();
    if (!is_tip(tip)) continue;
    std::uint32_t gate = none;
    for (const std::uint32_t g : gates.at(tip))
      if (!twigs.gone[g]) gate = g;
    double& length = twigs.length[gate];
    for (const std::uint32_t g : gates.at(tip))
      if (g != gate)
        length =
            std::max(length, twigs.length[g] + distance(middle(gates_[g]), middle(gates_[gate])));
    twigs.gone[gate] = true;
    const auto& cell = gates_[gate].cell;
    const std::uint32_t root = cell[0] == tip ? cell[1] : cell[0];
    --gates.degree[tip];
    --gates.degree[root];
    twigs.all.push_back({gate, tip, root});
    if (is_tip(root)) tips.push_back(root);
  }
  return twigs;
}

void Complex::prune(double shortest) {
  GatesByCell gates = gates_by_cell();
  const Twigs twigs = take_twigs(gates);
  // From the roots: a long branch stays with its longest way to a tip; of what depends on nothing
  // else, something stays.
  std::vector<bool> visited(rooted_.size(), false), kept(gates_.size(), false);
  const auto longest = [&](std::uint32_t cell, std::uint32_t from) {
    std::uint32_t best = none;
    for (const std::uint32_t g : gates.at(cell))
      if (twigs.gone[g] && g != from && (best == none || twigs.length[g] > twigs.length[best]))
        best = g;
    return best;
  };
  for (std::size_t i = twigs.all.size(); i-- > 0;) {
    const Twig& twig = twigs.all[i];
    std::uint32_t& degree = gates.degree[twig.root];
    if (!visited[twig.root]) {
      visited[twig.root] = true;
      if (degree == 0 && !rooted_[twig.root]) kept[longest(twig.root, none)] = true;
    }
    const bool connected = rooted_[twig.root] || degree > 0;
    if (connected && twigs.length[twig.gate] >= shortest) kept[twig.gate] = true;
    visited[twig.tip] = true;
    if (!kept[twig.gate]) continue;
    ++degree;
    ++gates.degree[twig.tip];
    const std::uint32_t on = longest(twig.tip, twig.gate);
    if (on != none) kept[on] = true;
  }
  for (std::uint32_t g = 0; g < gates_.size(); ++g)
    if (twigs.gone[g] && !kept[g]) gates_[g].there = false;
}

void Complex::result(const std::vector<Corners>& corners, Necks& necks) const {
  for (std::size_t f = 0; f < faces_.size(); ++f)
    if (stuck_[f])
      necks.undrawn.push_back({static_cast<std::uint32_t>(faces_[f] % grid_.columns),
                               static_cast<std::uint32_t>(faces_[f] / grid_.columns)});
  std::vector<std::uint32_t> meeting(rooted_.size(), none);
  const auto meeting_at = [&](std::uint32_t cell) -> Necks::Meeting& {
    if (meeting[cell] == none) {
      meeting[cell] = static_cast<std::uint32_t>(necks.meetings.size());
      necks.meetings.emplace_back();
    }
    return necks.meetings[meeting[cell]];
  };
  for (const Gate& gate : gates_) {
    if (!gate.there) continue;
    const Half& half = gate.half;
    for (const std::uint32_t cell : gate.cell)
      meeting_at(cell).gates.push_back(static_cast<std::uint32_t>(necks.gates.size()));
    necks.gates.push_back(
        {half.on_row, half.line, half.side + double{half.low}, half.side + double{half.high}});
  }
  // Corners come by increasing cell.
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t cell = corners[i].cell;
    const bool twice = (i > 0 && corners[i - 1].cell == cell) ||
                       (i + 1 < corners.size() && corners[i + 1].cell == cell);
    if (meeting[cell] == none && !twice) continue;
    std::vector<Pixel> pixels;
    for (int k = 0; k < corners[i].count; ++k)
      pixels.push_back(corner_of(corners[i].square, (corners[i].first + k) % 4));
    meeting_at(cell).corners.push_back(std::move(pixels));
  }
  std::erase_if(necks.meetings,
                [](const Necks::Meeting& m) { return m.gates.size() + m.corners.size() < 2; });
}

/// The necks of a boundary map.
Necks necks_of(const LocalGrid& local, const BitMap& boundary, const InteriorSets& sets,
               const Crossings& crossings) {
  constexpr double shortest_branch = 3;
  Cells cells(local, boundary, sets, crossings);
  cells.build();
  Necks necks;
  necks.hidden = crossings.hidden;
  necks.torn = cells.torn;
  Complex complex(cells, local.grid);
  complex.collapse();
  complex.prune(shortest_branch);
  complex.result(cells.corners, necks);
  std::sort(cells.surrounded.begin(), cells.surrounded.end());
  for (std::size_t i = 0; i + 3 < cells.surrounded.size(); ++i)
    if (cells.surrounded[i] == cells.surrounded[i + 3])
      necks.undrawn.push_back(cells.surrounded[i]);
  return necks;
}

}  // namespace

Necks find_necks(const EdgeOutline& outline, const LocalGrid& local, BitMap& boundary,
                 InteriorSets& sets) {
  const Crossings crossings = find_crossings(outline, local);
  Necks necks = necks_of(local, boundary, sets, crossings);
  while (!necks.undrawn.empty()) {
    for (const Pixel p : necks.undrawn) boundary.clear(p);
    sets = interior_sets(outline, local, boundary);
    necks = necks_of(local, boundary, sets, crossings);
  }
  return necks;
}

}  // namespace medial::ridge
