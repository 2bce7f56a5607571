#include "site/boundary_tree.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "base/threads.h"

namespace medial::site {
namespace {

using site::Site;

/// Beyond this a site belongs to no box: cuts, as bridges leave them, lie there.
constexpr double outside = 64;
bool is_inside(const Site& site) { return std::abs(site.point.x) <= outside; }

/// What single precision (u = 2^-24) may add to the distance from a box, for local coordinates
/// below 2 and distances below 4. Along each axis: the query's centre rounded, 2 u; the difference,
/// below 4, rounded, 4 u; the box is rounded outward, which is the safe side. Both axes together: 6
/// sqrt(2) u < 8.5 u. The squares and their sum round by 2 u of the squared distance, u of the
/// distance: 4 u; the limit's square by half of that. In all less than 14.5 u; this is 16 u.
constexpr double single_precision_slack = 0x1p-20;

/// What rounding (u = 2^-53) may do to a height above a chord, or to a position along it. A sum of
/// two products with a local point below 2 in both coordinates: 4 sqrt(2) u < 6 u, once for the
/// boundary's point and once for the query's centre; the end of a site, 4 roundings below 2, or the
/// next one's start instead, up to 8 u away in both coordinates: 12 u; a direction that is a unit
/// vector up to 3 u, times a distance below 4: 12 u. That makes 36 u; this is 64 u.
constexpr double chord_rounding = 0x1p-47;
/// Chord boxes pay where the boundary strays from the chord by no more than this share of it,
constexpr double flat_enough = 1.0 / 16;
/// and on the levels of nodes of 8 to 512 sites: larger ones are few,
constexpr std::size_t chord_levels = 4;
/// and where so many sites lie in so small a box, whatever their height: next to disks that are
/// much larger, all teeth of a comb, and all holes in a row, are all but touched.
constexpr std::uint32_t level_of_many = 2;
constexpr std::size_t many = std::size_t{8} << (2 * level_of_many);
constexpr double small = 0x1p-8;
/// where at least one node in so many has one. Boxes of 8 sites take more memory than all others.
constexpr std::size_t rare_of(std::uint32_t level) { return level == 0 ? 2 : 16; }

struct Waiting {
  std::uint32_t index;
  std::uint32_t level;  ///< 0: a block
  float squared;
};

}  // namespace

BoundaryTree::BoundaryTree(std::span<const Site> sites, Chords chords)
    : sites_(sites),
      has_arcs_(
          std::any_of(sites.begin(), sites.end(), [](const Site& site) { return site.is_arc(); })) {
  if (sites.size() <= short_range) return;
  const auto nodes_over = [](std::size_t count) { return (count + fan - 1) / fan; };
  constexpr std::size_t grain = 1024;

  levels_.emplace_back(nodes_over((sites.size() + block_size - 1) / block_size));
  parallel_ranges(levels_[0].size(), grain, [&](std::size_t node, std::size_t last) {
    for (; node < last; ++node) {
      for (std::size_t lane = 0; lane < fan; ++lane) {
        const std::size_t begin = (node * fan + lane) * block_size;
        const std::size_t end = std::min(begin + block_size, sites.size());
        Extent extent;
        for (std::size_t i = begin; i < end; ++i)
          if (is_inside(sites[i])) extent.add(sites[i]);
        levels_[0][node].set(lane, extent);
      }
    }
  });
  while (levels_.back().size() > 1) {
    const WorkVector<Boxes>& lower = levels_.back();
    WorkVector<Boxes> upper(nodes_over(lower.size()));
    parallel_ranges(lower.size(), grain, [&](std::size_t child, std::size_t last) {
      for (; child < last; ++child) upper[child / fan].set(child % fan, lower[child]);
    });
    levels_.push_back(std::move(upper));
  }
  if (chords != Chords::none) build_chord_boxes(chords == Chords::all);
}

void BoundaryTree::build_chord_boxes(bool of_8_sites) {
  chords_.resize(std::min<std::size_t>(chord_levels, levels_.size()));
  for (std::uint32_t level = of_8_sites ? 0 : 1; level < chords_.size(); ++level) {
    const std::size_t span = std::size_t{block_size} << (2 * level);
    const std::size_t nodes = levels_[level].size();
    const auto is_rare = [&](std::size_t lanes) {
      return lanes * rare_of(level) * span < sites_.size();
    };
    WorkVector<ChordBoxes>& boxes = chords_[level].boxes;
    // Where few of a sample fit, the level takes no memory.
    constexpr std::size_t sampled = 16;
    if (nodes > sampled * sampled) {
      Fitting fitting;
      ChordBoxes some;
      for (std::size_t node = 0; node < nodes; node += sampled)
        set_chord_boxes(node, span, some, fitting);
      if (is_rare(sampled * fitting.lanes)) continue;
    }
    boxes.resize(nodes);
    std::atomic<std::size_t> lanes = 0, flat = 0;
    parallel_ranges(nodes, 256, [&](std::size_t node, std::size_t last) {
      Fitting fitting;
      for (; node < last; ++node) set_chord_boxes(node, span, boxes[node], fitting);
      lanes += fitting.lanes;
      flat += fitting.flat;
    });
    if (is_rare(lanes))
      free_memory(boxes);
    else if (is_rare(flat))
      chords_[level].least_reach = small;
  }
}

/// The boxes of a node over lanes of `span` sites each.
void BoundaryTree::set_chord_boxes(std::size_t node, std::size_t span, ChordBoxes& boxes,
                                   Fitting& fitting) const {
  for (std::size_t lane = 0; lane < fan; ++lane) {
    const std::size_t begin = (node * fan + lane) * span;
    const std::size_t end = std::min(begin + span, sites_.size());
    std::optional<ChordBox> box;
    if (begin < end) box = chord_box(sites_.subspan(begin, end - begin));
    if (box) {
      ++fitting.lanes;
      if (box->is_flat) ++fitting.flat;
    } else {
      constexpr double all = std::numeric_limits<double>::infinity();
      box = ChordBox{{1, 0}, -all, all, -all, all};
    }
    boxes.normal_x[lane] = box->normal.x;
    boxes.normal_y[lane] = box->normal.y;
    boxes.low[lane] = box->low;
    boxes.high[lane] = box->high;
    boxes.begin[lane] = box->begin;
    boxes.end[lane] = box->end;
  }
}

/// The normal of the line that a boundary shows to what lies on its left, through the highest
/// points of its first and of its last third; that of its chord where these are near to each other.
/// Of a staircase, or of a row of holes, no box in another direction keeps as clear.
Vec2 BoundaryTree::facing_normal(std::span<const Site> sites, Vec2 begin, Vec2 chord) {
  const auto highest = [&](std::span<const Site> some, Vec2 so_far) {
    double height = 0;
    for (const Site& site : some) {
      const double h = cross(chord, site.point - begin);
      if (!(h > height) || !is_inside(site)) continue;
      height = h;
      so_far = site.point;
    }
    return so_far;
  };
  const std::size_t third = sites.size() / 3;
  Vec2 along = highest(sites.last(third), begin + chord) - highest(sites.first(third), begin);
  constexpr double near = 0.25;
  if (!(dot(along, chord) > near * squared_norm(chord))) along = chord;
  return left_of((1 / norm(along)) * along);
}

std::optional<BoundaryTree::ChordBox> BoundaryTree::chord_box(std::span<const Site> sites) {
  const auto first = std::find_if(sites.begin(), sites.end(), is_inside);
  if (first == sites.end()) return std::nullopt;
  const Vec2 begin = first->point,
             chord = std::find_if(sites.rbegin(), sites.rend(), is_inside)->end() - begin;
  const double length = norm(chord), highest = flat_enough * length;
  constexpr double shortest = 0x1p-500;  // a unit vector needs its square
  if (!(length > shortest)) return std::nullopt;
  const bool may_be_high = sites.size() >= many && length <= small;
  // Most that do not fit are recognised by a few of their points.
  for (std::size_t i = 1; i < 4 && !may_be_high; ++i) {
    const Site& site = sites[i * sites.size() / 4];
    if (!is_inside(site) || std::abs(cross(chord, site.point - begin)) > highest * length)
      return std::nullopt;
  }
  constexpr double all = std::numeric_limits<double>::infinity();
  ChordBox box{facing_normal(sites, begin, chord), all, -all, all, -all};
  const auto add = [&](Vec2 p) {
    const double height = dot(box.normal, p), position = cross(p, box.normal);
    box.low = std::min(box.low, height);
    box.high = std::max(box.high, height);
    box.begin = std::min(box.begin, position);
    box.end = std::max(box.end, position);
  };
  for (const Site& site : sites) {
    if (is_inside(site)) {
      const Site* const next = &site == &sites.back() ? nullptr : &site + 1;
      add(site.point);
      if (site.is_arc()) add(site.apex());
      if (!site.is_vertex() && (next == nullptr || !meets(site, *next))) add(site.end());
    } else if (!may_be_high) {
      return std::nullopt;
    }
  }
  box.is_flat = box.high - box.low <= highest;
  const double size = std::max(box.high - box.low, box.end - box.begin);
  if (!box.is_flat && !(may_be_high && size <= small)) return std::nullopt;
  box.low -= chord_rounding;
  box.high += chord_rounding;
  box.begin -= chord_rounding;
  box.end += chord_rounding;
  return box;
}

/// The lanes whose chord boxes lie beyond the reach from c.
std::uint32_t BoundaryTree::beyond(const ChordBoxes& boxes, Vec2 c, double reach) {
  std::uint32_t lanes = 0;
#if defined(__SSE2__)
  const __m128d cx = _mm_set1_pd(c.x), cy = _mm_set1_pd(c.y), zero = _mm_setzero_pd();
  const __m128d squared_reach = _mm_set1_pd(reach * reach);
  for (std::uint32_t i = 0; i < fan; i += 2) {
    const __m128d nx = _mm_load_pd(&boxes.normal_x[i]), ny = _mm_load_pd(&boxes.normal_y[i]);
    const __m128d height = _mm_add_pd(_mm_mul_pd(nx, cx), _mm_mul_pd(ny, cy));
    const __m128d position = _mm_sub_pd(_mm_mul_pd(ny, cx), _mm_mul_pd(nx, cy));
    const __m128d across = _mm_max_pd(_mm_max_pd(_mm_sub_pd(height, _mm_load_pd(&boxes.high[i])),
                                                 _mm_sub_pd(_mm_load_pd(&boxes.low[i]), height)),
                                      zero);
    const __m128d along = _mm_max_pd(_mm_max_pd(_mm_sub_pd(position, _mm_load_pd(&boxes.end[i])),
                                                _mm_sub_pd(_mm_load_pd(&boxes.begin[i]), position)),
                                     zero);
    const __m128d squared = _mm_add_pd(_mm_mul_pd(across, across), _mm_mul_pd(along, along));
    lanes |= static_cast<std::uint32_t>(_mm_movemask_pd(_mm_cmpge_pd(squared, squared_reach))) << i;
  }
#else
  for (std::uint32_t i = 0; i < fan; ++i) {
    const double height = boxes.normal_x[i] * c.x + boxes.normal_y[i] * c.y;
    const double position = boxes.normal_y[i] * c.x - boxes.normal_x[i] * c.y;
    const double across = std::max({height - boxes.high[i], boxes.low[i] - height, 0.0});
    const double along = std::max({position - boxes.end[i], boxes.begin[i] - position, 0.0});
    if (across * across + along * along >= reach * reach) lanes |= 1u << i;
  }
#endif
  return lanes;
}

namespace {

/// Of the four children from `child` on, as bits, those in [first, last]; without branches, which
/// nobody could predict.
inline std::uint32_t children_within(std::uint32_t child, std::uint32_t first, std::uint32_t last) {
  const auto skipped = [](std::uint32_t from, std::uint32_t to) {
    return std::max(static_cast<std::int32_t>(to - from), 0);
  };
  return (0xFu << skipped(child, first)) & (0xFu >> skipped(last, child + 3));
}

using Stack = std::array<Waiting, 4 * 16 + 4>;

/// The nearest of the children in `mask`, at least one; the others wait, the farthest at the
/// bottom.
[[gnu::always_inline]] inline Waiting take_nearest(std::uint32_t mask, std::uint32_t child,
                                                   std::uint32_t level, const Lanes& squared,
                                                   Stack& stack, std::size_t& size) {
  auto lane = static_cast<std::uint32_t>(std::countr_zero(mask));
  Waiting top{child + lane, level, squared[lane]};
  const std::size_t bottom = size;
  for (mask &= mask - 1; mask != 0; mask &= mask - 1) {
    lane = static_cast<std::uint32_t>(std::countr_zero(mask));
    Waiting later{child + lane, level, squared[lane]};
    if (later.squared < top.squared) std::swap(later, top);
    std::size_t at = size++;
    for (; at > bottom && stack[at - 1].squared < later.squared; --at) stack[at] = stack[at - 1];
    stack[at] = later;
  }
  return top;
}

/// The first of the children in `mask`, at least one; the others wait, the last at the bottom.
[[gnu::always_inline]] inline Waiting take_first(std::uint32_t mask, std::uint32_t child,
                                                 std::uint32_t level, const Lanes& squared,
                                                 Stack& stack, std::size_t& size) {
  for (;;) {
    const auto lane = static_cast<std::uint32_t>(std::bit_width(mask) - 1);
    const Waiting last{child + lane, level, squared[lane]};
    mask ^= 1u << lane;
    if (mask == 0) return last;
    stack[size++] = last;
  }
}

}  // namespace

template <BoundaryTree::Order order, class Visit>
[[gnu::always_inline]] inline void BoundaryTree::visit_blocks(Vec2 c, double& reach,
                                                              std::uint32_t first,
                                                              std::uint32_t last,
                                                              Visit&& visit) const {
  if (last - first < short_range) {
    visit(first, last);
    return;
  }
  const auto x = static_cast<float>(c.x), y = static_cast<float>(c.y);
  const auto squared_reach = [&] {
    const double r = reach + single_precision_slack;
    return static_cast<float>(r * r);
  };
  float limit = squared_reach();

  // Start at the lowest node over the whole range.
  const std::uint32_t first_block = first / block_size, last_block = last / block_size;
  const auto common = static_cast<std::uint32_t>(std::bit_width(first_block ^ last_block) + 1) / 2;
  const auto chord_count = static_cast<std::uint32_t>(chords_.size());

  Stack stack;
  std::size_t size = 0;
  Waiting top{first_block >> (2 * common), common, 0};
  for (;;) {
    if (top.level == 0) {
      visit(std::max(first, top.index * block_size),
            std::min(last, top.index * block_size + block_size - 1));
      limit = squared_reach();
    } else {
      const std::uint32_t below = top.level - 1;
      const Boxes& boxes = levels_[below][top.index];
      const std::uint32_t child = top.index * fan;
      std::uint32_t mask =
          children_within(child, first_block >> (2 * below), last_block >> (2 * below));
      Lanes squared;
      mask &= nearer(boxes, x, y, limit, squared);
      if (below < chord_count && mask != 0 && chords_[below].pay(reach))
        mask &= ~beyond(chords_[below].boxes[top.index], c, reach);
      if (mask != 0) {
        if constexpr (order == Order::nearest_first)
          top = take_nearest(mask, child, below, squared, stack, size);
        else
          top = take_first(mask, child, below, squared, stack, size);
        continue;
      }
    }
    // What was near may be out of reach since: of many sites, that is worth asking again.
    const auto is_beyond = [&] {
      if (reach < small || top.level < level_of_many || top.level >= chord_count ||
          chords_[top.level].boxes.empty())
        return false;
      const ChordBoxes& boxes = chords_[top.level].boxes[top.index / fan];
      return (beyond(boxes, c, reach) >> top.index % fan & 1U) != 0;
    };
    do {
      if (size == 0) return;
      top = stack[--size];
    } while (!(top.squared < limit) || is_beyond());
  }
}

namespace {

/// Whether a site is surely not nearer to c than `reach`, whatever rounding does: none is longer
/// than its parameter.
inline bool is_out_of_reach(const Site& site, Vec2 c, double reach) {
  constexpr double a_little_more = 1 + 0x1p-40;
  const double far = a_little_more * (reach + site.length);
  return squared_norm(c - site.point) > far * far;
}

}  // namespace

BoundaryTree::Hit BoundaryTree::nearest(Vec2 c, double reach, std::uint32_t first,
                                        std::uint32_t last) const {
  Hit hit;
  if (first > last || !(reach > 0)) return hit;
  hit.squared_distance = reach * reach;
  const auto take_if_nearer = [&](std::uint32_t i, double squared) {
    if (squared < hit.squared_distance) hit = {i, squared};
  };
  visit_blocks<Order::nearest_first>(
      c, reach, first, last, [&](std::uint32_t from, std::uint32_t to) {
        const double before = hit.squared_distance;
        const Site* site = &sites_[from];
        if (!has_arcs_) {
          // Two at a time; rarely is one of them near enough.
          for (; from < to; from += 2, site += 2) {
            if (!one_is_nearer(site[0], site[1], c, hit.squared_distance)) continue;
            take_if_nearer(from, site::squared_distance(site[0], c));
            take_if_nearer(from + 1, site::squared_distance(site[1], c));
          }
        }
        for (; from <= to; ++from, ++site)
          if (!is_out_of_reach(*site, c, reach))
            take_if_nearer(from, site::squared_distance(*site, c));
        if (hit.squared_distance < before) reach = std::sqrt(hit.squared_distance);
      });
  return hit;
}

BoundaryTree::Hit BoundaryTree::nearest_facing(Vec2 c, double reach, std::uint32_t first,
                                               std::uint32_t last) const {
  Hit front, back;
  if (first > last || !(reach > 0)) return front;
  // What two distances to one place may differ by.
  constexpr double rounding = 0x1p-48;
  front.squared_distance = back.squared_distance = reach * reach;
  double limit = reach * reach;
  const auto faces = [&](const Site& site) {
    if (site.is_vertex()) return true;
    const double s = site::carrier_parameter(site, c);
    return site::carrier_distance(site, c) > 0 && s >= 0 && s <= site.length;
  };
  const auto look_at = [&](std::uint32_t i) {
    const double squared = site::squared_distance(sites_[i], c);
    if (!(squared < limit)) return;
    Hit& hit = faces(sites_[i]) ? front : back;
    if (squared < hit.squared_distance) hit = {i, squared};
    const double near = std::sqrt(back.squared_distance) + rounding;
    limit = std::min({front.squared_distance, near * near, limit});
  };
  visit_blocks<Order::nearest_first>(
      c, reach, first, last, [&](std::uint32_t from, std::uint32_t to) {
        const double before = limit;
        if (!has_arcs_) {
          for (; from < to; from += 2) {
            if (!one_is_nearer(sites_[from], sites_[from + 1], c, limit)) continue;
            look_at(from);
            look_at(from + 1);
          }
        }
        for (; from <= to; ++from) look_at(from);
        if (limit < before) reach = std::sqrt(limit);
      });
  if (!back) return front;
  if (!front) return back;
  return std::sqrt(front.squared_distance) <= std::sqrt(back.squared_distance) + rounding ? front
                                                                                          : back;
}

BoundaryTree::Hit BoundaryTree::nearest_lowest(Vec2 c, double reach) const {
  Hit hit;
  if (sites_.empty() || !(reach > 0)) return hit;
  // Boxes at the distance of the best so far must still be looked into.
  constexpr double a_little_more = 1 + 0x1p-40;
  double squared = reach * reach;
  reach *= a_little_more;
  const auto take_if_nearer = [&](std::uint32_t i) {
    const double d = site::squared_distance(sites_[i], c);
    if (d < squared || (d == squared && i < hit.site)) {
      squared = d;
      hit = {i, d};
    }
  };
  visit_blocks<Order::nearest_first>(
      c, reach, 0, static_cast<std::uint32_t>(sites_.size() - 1),
      [&](std::uint32_t from, std::uint32_t to) {
        const double before = squared;
        if (!has_arcs_)
          for (; from < to; from += 2) {
            const double or_equal = a_little_more * squared + std::numeric_limits<double>::min();
            if (!one_is_nearer(sites_[from], sites_[from + 1], c, or_equal)) continue;
            take_if_nearer(from);
            take_if_nearer(from + 1);
          }
        for (; from <= to; ++from) take_if_nearer(from);
        if (squared < before) reach = a_little_more * std::sqrt(squared);
      });
  return hit;
}

void BoundaryTree::within(Vec2 c, double reach, std::uint32_t first, std::uint32_t last,
                          std::vector<std::uint32_t>& found) const {
  found.clear();
  if (first > last || !(reach > 0)) return;
  const double squared = reach * reach;
  const auto take_if_near = [&](std::uint32_t i) {
    if (site::squared_distance(sites_[i], c) < squared) found.push_back(i);
  };
  visit_blocks<Order::along_boundary>(
      c, reach, first, last, [&](std::uint32_t from, std::uint32_t to) {
        if (!has_arcs_)
          for (; from < to; from += 2) {
            if (!one_is_nearer(sites_[from], sites_[from + 1], c, squared)) continue;
            take_if_near(from);
            take_if_near(from + 1);
          }
        for (; from <= to; ++from) take_if_near(from);
      });
}

bool BoundaryTree::few_within(Vec2 c, double reach, std::size_t most,
                              std::vector<std::uint32_t>& found) const {
  found.clear();
  if (sites_.empty() || !(reach > 0)) return true;
  const double squared = reach * reach;
  visit_blocks<Order::nearest_first>(c, reach, 0, static_cast<std::uint32_t>(sites_.size() - 1),
                                     [&](std::uint32_t from, std::uint32_t to) {
                                       for (; from <= to; ++from)
                                         if (site::squared_distance(sites_[from], c) < squared)
                                           found.push_back(from);
                                       if (found.size() > most)
                                         reach = -single_precision_slack;  // nothing is that near
                                     });
  return found.size() <= most;
}

}  // namespace medial::site
