#include "methods/raster/ridge/thin.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <queue>
#include <vector>

namespace medial::ridge {

using raster::BitMap;
using raster::Pixel;

namespace {

/// A pixel that may go, or may have to.
struct Candidate {
  double quality;
  Pixel pixel;
};

Candidate candidate_of(const Found& found) { return {found.quality, found.pixel}; }

/// Whether one pixel is worse than another; no two are equal.
bool is_worse(const Candidate& a, const Candidate& b) {
  if (a.quality != b.quality) return a.quality > b.quality;
  return b.pixel < a.pixel;
}

/// All medial pixels but the pinned ones, by increasing x within increasing y.
std::vector<Candidate> candidates_in_rows(const MedialMap& map) {
  std::vector<Candidate> candidates;
  for (const std::uint32_t place : map.in_rows())
    if (!map.found[place].is_pinned()) candidates.push_back(candidate_of(map.found[place]));
  return candidates;
}

/// The five bits of a row around a column, the one two to the left lowest; beyond the map none.
std::uint32_t five_bits(const BitMap& map, std::int64_t row, std::uint32_t column) {
  if (row < 0 || row >= map.rows()) return 0;
  const auto words = map.row(static_cast<std::uint32_t>(row));
  const std::uint32_t word = column >> 6, bit = column & 63;
  std::uint64_t bits = bit >= 2 ? words[word] >> (bit - 2) : words[word] << (2 - bit);
  if (bit < 2 && word > 0) bits |= words[word - 1] >> (62 + bit);
  if (bit > 61 && word + 1 < map.words_per_row()) bits |= words[word + 1] << (66 - bit);
  return static_cast<std::uint32_t>(bits & 31);
}

/// The eight neighbours, a bit for each direction.
std::uint8_t ring(const BitMap& map, Pixel p) {
  constexpr std::array<std::uint32_t, 8> reversed{0, 4, 2, 6, 1, 5, 3, 7};
  const auto three_bits = [&](std::int64_t row) { return five_bits(map, row, p.column) >> 1 & 7; };
  const std::uint32_t below = three_bits(std::int64_t{p.row} - 1), beside = three_bits(p.row),
                      above = three_bits(std::int64_t{p.row} + 1);
  return static_cast<std::uint8_t>(beside >> 2 | reversed[above] << 1 | (beside & 1) << 4 |
                                   below << 5);
}

/// Takes pixels away in the order given, as often as that changes anything. Whether one may go must
/// depend on the pixels up to two columns and rows away only: unless one of those has gone since, a
/// pixel that had to stay is not asked again.
template <class MayGo>
void thin(const BitMap& boundary, MedialMap& map, const std::vector<Candidate>& order, bool at_once,
          MayGo may_go) {
  using Ranks = std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>>;
  constexpr std::uint32_t unranked = ~std::uint32_t{0};
  std::vector<std::uint32_t> rank(map.found.size(), unranked);
  for (std::uint32_t i = 0; i < order.size(); ++i) rank[map.place.at(order[i].pixel) - 1] = i;
  std::vector<bool> waits(order.size(), true);  // to be asked in this round or the next
  Ranks now, later;
  const auto ask = [&](std::uint32_t i) {
    waits[i] = false;
    const Pixel p = order[i].pixel;
    if (!is_simple(map.medial, boundary, p) || !may_go(order[i])) return;
    map.medial.clear(p);
    for (std::uint32_t row = p.row - 2; row != p.row + 3; ++row)
      for (std::uint32_t bits = five_bits(map.medial, static_cast<std::int32_t>(row), p.column);
           bits != 0; bits &= bits - 1) {
        const auto bit = static_cast<std::uint32_t>(std::countr_zero(bits));
        const std::uint32_t other = rank[map.place.at({p.column + bit - 2, row}) - 1];
        if (other == unranked || waits[other]) continue;
        waits[other] = true;
        (other > i || at_once ? now : later).push(other);
      }
  };
  const auto ask_again = [&] {
    while (!now.empty()) {
      const std::uint32_t i = now.top();
      now.pop();
      if (map.medial.at(order[i].pixel)) ask(i);
    }
  };
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    ask(i);
    if (at_once) ask_again();
  }
  while (!later.empty()) {
    std::swap(now, later);
    ask_again();
  }
}

/// Whether, with a medial pixel gone, all pixels among it and its neighbours that the axis passes
/// still are medial or have a medial neighbour.
bool stays_near(const BitMap& passed, const BitMap& medial, Pixel p) {
  std::array<std::uint32_t, 5> there{}, asked{};
  for (std::size_t i = 0; i < 5; ++i) {
    const std::int64_t row = std::int64_t{p.row} + static_cast<std::int64_t>(i) - 2;
    there[i] = five_bits(medial, row, p.column);
    asked[i] = five_bits(passed, row, p.column);
  }
  there[2] &= ~4u;
  for (std::size_t row = 1; row < 4; ++row) {
    const std::uint32_t any = there[row - 1] | there[row] | there[row + 1];
    const std::uint32_t near = any | any << 1 | any >> 1;
    if ((asked[row] & ~near & 0b01110u) != 0) return false;
  }
  return true;
}

}  // namespace

std::uint8_t closed_neighbours(const BitMap& medial, const BitMap& boundary, Pixel p) {
  constexpr std::uint8_t diagonals = 0b10101010;
  // Of each direction, whether those next to it on both sides are set.
  const auto between = [](std::uint8_t set) { return std::rotl(set, 1) & std::rotr(set, 1); };
  const std::uint8_t set = ring(medial, p);
  // Only diagonal ones without medial pixels beside them can lie across a contour.
  const int alone = set & diagonals & ~std::rotl(set, 1) & ~std::rotr(set, 1);
  const int across = alone == 0 ? 0 : alone & between(ring(boundary, p));
  return static_cast<std::uint8_t>((set & ~across) | (between(set) & diagonals));
}

bool is_simple(const BitMap& medial, const BitMap& boundary, Pixel p) {
  const std::uint8_t set = closed_neighbours(medial, boundary, p);
  const auto last = static_cast<std::uint8_t>(set & ~std::rotr(set, 1));  // the next one is not set
  return std::popcount(set) > 2 && std::has_single_bit(last);
}

void thin_by_report(const BitMap& boundary, MedialMap& map) {
  thin(boundary, map, candidates_in_rows(map), false, [&](const Candidate& candidate) {
    for (int direction = 0; direction < 8; ++direction) {
      const Pixel q = neighbour(candidate.pixel, direction);
      if (map.medial.at(q) && !crosses_contour(boundary, candidate.pixel, direction) &&
          !is_worse(candidate, candidate_of(map.at(q))))
        return false;
    }
    return true;
  });
}

void thin_to_lines(const BitMap& boundary, double step, MedialMap& map) {
  BitMap passed(map.medial.columns(), map.medial.rows());
  for (const Found& found : map.found)
    if (found.quality <= step) passed.set(found.pixel);
  std::vector<Candidate> order = candidates_in_rows(map);
  std::sort(order.begin(), order.end(), is_worse);
  thin(boundary, map, order, true,
       [&](const Candidate& candidate) { return stays_near(passed, map.medial, candidate.pixel); });
}

}  // namespace medial::ridge
