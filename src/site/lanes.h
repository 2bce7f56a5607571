#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "medial/geometry.h"
#include "site/site.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

// Four boxes or two sites side by side: what both trees do all the time.

namespace medial::site {

/// Four numbers, one of each of a node's children.
using Lanes = std::array<float, 4>;

/// A box under way.
struct Extent : Box {
  Extent() : Box(nothing()) {}
  using Box::add;
  void add(const site::Site& site) {
    add(site.point);
    add(site.end());
    if (site.is_arc()) add(site.apex());
  }
};

/// The nearest numbers of single precision that are not above, or below, v.
inline float rounded_down(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) <= v ? f
                                     : std::nextafter(f, -std::numeric_limits<float>::infinity());
}
inline float rounded_up(double v) { return -rounded_down(-v); }

/// Four boxes; of nothing, nothing is near.
struct alignas(64) Boxes {
  Lanes low_x, low_y, high_x, high_y;

  Boxes() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    low_x.fill(infinity);
    low_y.fill(infinity);
    high_x.fill(-infinity);
    high_y.fill(-infinity);
  }
  void set(std::size_t lane, const Extent& extent) {
    low_x[lane] = rounded_down(extent.low.x);
    low_y[lane] = rounded_down(extent.low.y);
    high_x[lane] = rounded_up(extent.high.x);
    high_y[lane] = rounded_up(extent.high.y);
  }
  /// Makes a lane the box of all four of another node.
  void set(std::size_t lane, const Boxes& all) {
    low_x[lane] = *std::min_element(all.low_x.begin(), all.low_x.end());
    low_y[lane] = *std::min_element(all.low_y.begin(), all.low_y.end());
    high_x[lane] = *std::max_element(all.high_x.begin(), all.high_x.end());
    high_y[lane] = *std::max_element(all.high_y.begin(), all.high_y.end());
  }
};

#if defined(__SSE2__)

/// Sets squared[i] to the squared distance of (x, y) from box i, and returns the set of the lanes
/// where it is below `limit`, as bits.
inline std::uint32_t nearer(const Boxes& boxes, float x, float y, float limit, Lanes& squared) {
  const __m128 zero = _mm_setzero_ps(), cx = _mm_set1_ps(x), cy = _mm_set1_ps(y);
  const __m128 dx = _mm_max_ps(_mm_max_ps(_mm_sub_ps(_mm_load_ps(boxes.low_x.data()), cx),
                                          _mm_sub_ps(cx, _mm_load_ps(boxes.high_x.data()))),
                               zero);
  const __m128 dy = _mm_max_ps(_mm_max_ps(_mm_sub_ps(_mm_load_ps(boxes.low_y.data()), cy),
                                          _mm_sub_ps(cy, _mm_load_ps(boxes.high_y.data()))),
                               zero);
  const __m128 d = _mm_add_ps(_mm_mul_ps(dx, dx), _mm_mul_ps(dy, dy));
  _mm_storeu_ps(squared.data(), d);
  return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmplt_ps(d, _mm_set1_ps(limit))));
}

/// site::squared_distance() to two segments or vertices side by side.
inline __m128d squared_distances(const site::Site& a, const site::Site& b, Vec2 c) {
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

/// Whether one of two segments or vertices is nearer to c than the root of `squared`.
inline bool one_is_nearer(const site::Site& a, const site::Site& b, Vec2 c, double squared) {
  return _mm_movemask_pd(_mm_cmplt_pd(squared_distances(a, b, c), _mm_set1_pd(squared))) != 0;
}

#else

inline std::uint32_t nearer(const Boxes& boxes, float x, float y, float limit, Lanes& squared) {
  std::uint32_t lanes = 0;
  for (std::uint32_t i = 0; i < squared.size(); ++i) {
    const float dx = std::max({boxes.low_x[i] - x, x - boxes.high_x[i], 0.0F});
    const float dy = std::max({boxes.low_y[i] - y, y - boxes.high_y[i], 0.0F});
    squared[i] = dx * dx + dy * dy;
    if (squared[i] < limit) lanes |= 1u << i;
  }
  return lanes;
}

inline bool one_is_nearer(const site::Site& a, const site::Site& b, Vec2 c, double squared) {
  return site::squared_distance(a, c) < squared || site::squared_distance(b, c) < squared;
}

#endif

}  // namespace medial::site
