#include "index/boundary_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace medial::index {
namespace {

using geometry::Site;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Beyond this a site belongs to no box.
constexpr double outside = 64;

/// What single precision (u = 2^-24) may add to the distance from a box, for local coordinates
/// below 2 and distances below 4. Along each axis: the query's centre rounded, 2 u; the difference,
/// below 4, rounded, 4 u; the box is rounded outward, which is the safe side. Both axes together: 6
/// sqrt(2) u < 8.5 u. The squares and their sum round by 2 u of the squared distance, u of the
/// distance: 4 u; the limit's square by half of that. In all less than 14.5 u; this is 16 u.
constexpr double single_precision_slack = 0x1p-20;

/// What rounding (u = 2^-53) may do to a height above a chord, or to a position along it. A sum of
/// two products with a local point below 2 in both coordinates: 4 sqrt(2) u < 6 u, once for the
/// boundary's point and once for the query's centre; the end of a site, 4 roundings below 2: 8 u; a
/// direction that is a unit vector up to 3 u, times a distance below 4: 12 u. That makes 32 u.
constexpr double chord_rounding = 0x1p-48;
/// Chord boxes pay where the boundary strays from the chord by no more than this share of it,
constexpr double flat_enough = 1.0 / 16;
/// and on the levels of nodes of 8 to 512 sites: larger ones are few.
constexpr std::size_t chord_levels = 4;

struct FloatBox {
  float low_x = infinity, low_y = infinity, high_x = -infinity, high_y = -infinity;

  void add(Vec2 p) {
    const auto below = [](double v) {
      const auto f = static_cast<float>(v);
      return static_cast<double>(f) <= v ? f : std::nextafter(f, -infinity);
    };
    const auto above = [](double v) {
      const auto f = static_cast<float>(v);
      return static_cast<double>(f) >= v ? f : std::nextafter(f, infinity);
    };
    low_x = std::min(low_x, below(p.x));
    low_y = std::min(low_y, below(p.y));
    high_x = std::max(high_x, above(p.x));
    high_y = std::max(high_y, above(p.y));
  }
};

struct Waiting {
  std::uint32_t index;
  std::uint32_t level;  ///< 0: a block
  float squared;
};

#if defined(__SSE2__)
/// geometry::squared_distance() to two segments or vertices side by side.
__m128d squared_distances(const Site& a, const Site& b, Vec2 c) {
  const __m128d a_point = _mm_loadu_pd(&a.point.x), b_point = _mm_loadu_pd(&b.point.x);
  const __m128d a_along = _mm_loadu_pd(&a.direction.x), b_along = _mm_loadu_pd(&b.direction.x);
  const __m128d x = _mm_sub_pd(_mm_set1_pd(c.x), _mm_unpacklo_pd(a_point, b_point));
  const __m128d y = _mm_sub_pd(_mm_set1_pd(c.y), _mm_unpackhi_pd(a_point, b_point));
  const __m128d along_x = _mm_unpacklo_pd(a_along, b_along);
  const __m128d along_y = _mm_unpackhi_pd(a_along, b_along);
  const __m128d length = _mm_loadh_pd(_mm_load_sd(&a.length), &b.length);
  const __m128d foot = _mm_add_pd(_mm_mul_pd(along_x, x), _mm_mul_pd(along_y, y));
  const __m128d s = _mm_min_pd(_mm_max_pd(foot, _mm_setzero_pd()), length);
  const __m128d dx = _mm_sub_pd(x, _mm_mul_pd(s, along_x));
  const __m128d dy = _mm_sub_pd(y, _mm_mul_pd(s, along_y));
  return _mm_add_pd(_mm_mul_pd(dx, dx), _mm_mul_pd(dy, dy));
}
#endif

}  // namespace

BoundaryTree::BoundaryTree(std::span<const Site> sites)
    : sites_(sites),
      has_arcs_(
          std::any_of(sites.begin(), sites.end(), [](const Site& site) { return site.is_arc(); })) {
  const auto store = [](Boxes& boxes, std::uint32_t lane, const FloatBox& box) {
    boxes.low_x[lane] = box.low_x;
    boxes.low_y[lane] = box.low_y;
    boxes.high_x[lane] = box.high_x;
    boxes.high_y[lane] = box.high_y;
  };
  const auto levels_over = [](std::size_t count) { return (count + fan - 1) / fan; };

  const std::size_t blocks = (sites.size() + block_size - 1) / block_size;
  levels_.emplace_back(levels_over(blocks));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, levels_[0].size(), 1024),
                    [&](const auto& range) {
                      for (std::size_t node = range.begin(); node < range.end(); ++node) {
                        for (std::uint32_t lane = 0; lane < fan; ++lane) {
                          FloatBox box;
                          const std::size_t begin = (node * fan + lane) * block_size;
                          const std::size_t end = std::min(begin + block_size, sites.size());
                          for (std::size_t i = begin; i < end; ++i) {
                            if (std::abs(sites[i].point.x) > outside) continue;
                            box.add(sites[i].point);
                            if (!sites[i].is_vertex()) box.add(sites[i].end());
                            if (sites[i].is_arc()) box.add(sites[i].apex());
                          }
                          store(levels_[0][node], lane, box);
                        }
                      }
                    });
  while (levels_.back().size() > 1) {
    const std::vector<Boxes>& lower = levels_.back();
    std::vector<Boxes> upper(levels_over(lower.size()));
    for (std::size_t node = 0; node < upper.size(); ++node) {
      for (std::uint32_t lane = 0; lane < fan; ++lane) {
        FloatBox box;
        const std::size_t child = node * fan + lane;
        if (child < lower.size()) {
          box.low_x = *std::min_element(lower[child].low_x.begin(), lower[child].low_x.end());
          box.low_y = *std::min_element(lower[child].low_y.begin(), lower[child].low_y.end());
          box.high_x = *std::max_element(lower[child].high_x.begin(), lower[child].high_x.end());
          box.high_y = *std::max_element(lower[child].high_y.begin(), lower[child].high_y.end());
        }
        store(upper[node], lane, box);
      }
    }
    levels_.push_back(std::move(upper));
  }
  build_chord_boxes();
}

void BoundaryTree::build_chord_boxes() {
  // Of each child of the level under way, whether it has a box.
  std::vector<std::uint8_t> fits_below;
  for (std::uint32_t level = 0; level < std::min<std::size_t>(chord_levels, levels_.size());
       ++level) {
    const std::size_t span = std::size_t{block_size} << (2 * level);
    const std::size_t nodes = levels_[level].size();
    std::vector<ChordBoxes> boxes(nodes);
    std::vector<std::uint8_t> fits(nodes * fan);
    std::atomic<bool> any = false;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nodes, 256), [&](const auto& range) {
      for (std::size_t node = range.begin(); node < range.end(); ++node) {
        for (std::size_t lane = 0; lane < fan; ++lane) {
          const std::size_t child = node * fan + lane, begin = child * span;
          const std::size_t end = std::min(begin + span, sites_.size());
          std::optional<ChordBox> box;
          // Only what is smooth in small can be smooth at large.
          const auto below = fits_below.begin() + static_cast<std::ptrdiff_t>(child * fan);
          if (begin < end && (level == 0 || std::all_of(below, below + fan, std::identity())))
            box = chord_box(sites_.subspan(begin, end - begin));
          if (box) {
            fits[child] = 1;
            any = true;
          } else {
            constexpr double all = std::numeric_limits<double>::infinity();
            box = ChordBox{{1, 0}, -all, all, -all, all};
          }
          boxes[node].normal_x[lane] = box->normal.x;
          boxes[node].normal_y[lane] = box->normal.y;
          boxes[node].low[lane] = box->low;
          boxes[node].high[lane] = box->high;
          boxes[node].begin[lane] = box->begin;
          boxes[node].end[lane] = box->end;
        }
      }
    });
    if (!any) return;
    chords_.push_back(std::move(boxes));
    fits_below = std::move(fits);
    fits_below.resize(fits_below.size() + fan * fan);  // children beyond the last do not fit
  }
}

std::optional<BoundaryTree::ChordBox> BoundaryTree::chord_box(std::span<const Site> sites) {
  constexpr double infinity_d = std::numeric_limits<double>::infinity();
  const Vec2 chord = sites.back().end() - sites.front().point;
  const double length = norm(chord);
  if (!(length > 0 && length < outside)) return std::nullopt;
  const Vec2 along = (1 / length) * chord;
  ChordBox box{left_of(along), infinity_d, -infinity_d, infinity_d, -infinity_d};
  const auto add = [&](Vec2 p) {
    const double height = dot(box.normal, p), position = dot(along, p);
    box.low = std::min(box.low, height);
    box.high = std::max(box.high, height);
    box.begin = std::min(box.begin, position);
    box.end = std::max(box.end, position);
  };
  for (const Site& site : sites) {
    if (std::abs(site.point.x) > outside) return std::nullopt;
    add(site.point);
    if (!site.is_vertex()) add(site.end());  // a loop may end here
    if (site.is_arc()) add(site.apex());
  }
  if (box.high - box.low > flat_enough * length) return std::nullopt;
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

template <class Visit>
[[gnu::always_inline]] inline void BoundaryTree::visit_blocks(Vec2 c, double& reach,
                                                              std::uint32_t first,
                                                              std::uint32_t last,
                                                              Visit&& visit) const {
  // Boxes cost about as much as a few sites.
  constexpr std::uint32_t short_range = 2 * block_size;
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

  std::array<Waiting, 4 * 16 + 4> stack;
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
      // Of the four lanes those that the range reaches; without branches, which nobody could guess.
      const auto skipped = [](std::uint32_t from, std::uint32_t to) {
        return std::max(static_cast<std::int32_t>(to - from), 0);
      };
      std::uint32_t mask = (0xFu << skipped(child, first_block >> (2 * below))) &
                           (0xFu >> skipped(last_block >> (2 * below), child + 3));

      alignas(16) std::array<float, fan> squared;
#if defined(__SSE2__)
      const __m128 zero = _mm_setzero_ps();
      const __m128 cx = _mm_set1_ps(x), cy = _mm_set1_ps(y);
      const __m128 dx = _mm_max_ps(_mm_max_ps(_mm_sub_ps(_mm_load_ps(boxes.low_x.data()), cx),
                                              _mm_sub_ps(cx, _mm_load_ps(boxes.high_x.data()))),
                                   zero);
      const __m128 dy = _mm_max_ps(_mm_max_ps(_mm_sub_ps(_mm_load_ps(boxes.low_y.data()), cy),
                                              _mm_sub_ps(cy, _mm_load_ps(boxes.high_y.data()))),
                                   zero);
      const __m128 d = _mm_add_ps(_mm_mul_ps(dx, dx), _mm_mul_ps(dy, dy));
      _mm_store_ps(squared.data(), d);
      mask &= static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmplt_ps(d, _mm_set1_ps(limit))));
#else
      for (std::uint32_t i = 0; i < fan; ++i) {
        const float dx = std::max({boxes.low_x[i] - x, x - boxes.high_x[i], 0.0F});
        const float dy = std::max({boxes.low_y[i] - y, y - boxes.high_y[i], 0.0F});
        squared[i] = dx * dx + dy * dy;
        if (!(squared[i] < limit)) mask &= ~(1u << i);
      }
#endif
      if (below < chord_count && mask != 0) mask &= ~beyond(chords_[below][top.index], c, reach);
      if (mask != 0) {
        // Go on with the nearest; the others wait, the farthest at the bottom.
        auto lane = static_cast<std::uint32_t>(std::countr_zero(mask));
        top = {child + lane, below, squared[lane]};
        const std::size_t bottom = size;
        for (mask &= mask - 1; mask != 0; mask &= mask - 1) {
          lane = static_cast<std::uint32_t>(std::countr_zero(mask));
          Waiting later{child + lane, below, squared[lane]};
          if (later.squared < top.squared) std::swap(later, top);
          std::size_t at = size++;
          for (; at > bottom && stack[at - 1].squared < later.squared; --at)
            stack[at] = stack[at - 1];
          stack[at] = later;
        }
        continue;
      }
    }
    do {
      if (size == 0) return;
      top = stack[--size];
    } while (!(top.squared < limit));
  }
}

BoundaryTree::Hit BoundaryTree::nearest(Vec2 c, double reach, std::uint32_t first,
                                        std::uint32_t last) const {
  Hit hit;
  if (first > last || !(reach > 0)) return hit;
  hit.squared_distance = reach * reach;
  const auto take_if_nearer = [&](std::uint32_t i, double squared) {
    if (squared < hit.squared_distance) hit = {i, squared};
  };
  visit_blocks(c, reach, first, last, [&](std::uint32_t from, std::uint32_t to) {
    const double before = hit.squared_distance;
    const Site *site = &sites_[from], *const end = &sites_[0] + to + 1;
#if defined(__SSE2__)
    if (!has_arcs_) {
      // Two at a time; rarely is one of them near enough.
      for (std::uint32_t i = from; i < to; i += 2, site += 2) {
        const __m128d squared = squared_distances(site[0], site[1], c);
        if (_mm_movemask_pd(_mm_cmplt_pd(squared, _mm_set1_pd(hit.squared_distance))) == 0)
          continue;
        take_if_nearer(i, _mm_cvtsd_f64(squared));
        take_if_nearer(i + 1, _mm_cvtsd_f64(_mm_unpackhi_pd(squared, squared)));
      }
    }
#endif
    for (; site != end; ++site)
      take_if_nearer(static_cast<std::uint32_t>(site - &sites_[0]),
                     geometry::squared_distance(*site, c));
    if (hit.squared_distance < before) reach = std::sqrt(hit.squared_distance);
  });
  return hit;
}

void BoundaryTree::within(Vec2 c, double reach, std::uint32_t first, std::uint32_t last,
                          std::vector<std::uint32_t>& found) const {
  found.clear();
  if (first > last || !(reach > 0)) return;
  const double squared = reach * reach;
  visit_blocks(c, reach, first, last, [&](std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t i = from; i <= to; ++i)
      if (geometry::squared_distance(sites_[i], c) < squared) found.push_back(i);
  });
  std::sort(found.begin(), found.end());
}

}  // namespace medial::index
