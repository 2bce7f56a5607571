#include "methods/lee/fan.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "site/tangent_disk.h"

namespace medial::lee {
namespace {

bool touches(const site::Site& segment, const Disk& disk, double slack) {
  const Vec2 d = disk.center - segment.point;
  const double foot = dot(segment.direction, d);
  return !segment.is_arc() && std::abs(cross(segment.direction, d) - disk.radius) <= slack &&
         foot >= 0 && foot <= segment.length;
}

/// Consecutive segments of a list.
using Segments = std::span<const site::Site>;

bool touches_all(const Segments& segments, const Disk& disk, double slack) {
  return std::all_of(segments.begin(), segments.end(),
                     [&](const site::Site& s) { return touches(s, disk, slack); });
}

/// The disk that touches the first, the middle and the last segment; for a closed polygon, the
/// segments at 0, 1/3 and 2/3 of it.
std::optional<Disk> disk_of_three(const Segments& segments, double radius_limit) {
  constexpr double nearly_parallel = 0.999;
  const bool is_closed = site::meets(segments.back(), segments.front());
  const std::size_t last = is_closed ? 2 * (segments.size() / 3) : segments.size() - 1;
  const site::Site &a = segments[0], &b = segments[last / 2], &c = segments[last];
  if (a.is_arc() || dot(a.direction, c.direction) > nearly_parallel) return std::nullopt;
  const site::TangentDisks disks = site::tangent_disks(a, b, c);
  if (disks.count != 1 || !(disks.disk[0].radius <= radius_limit)) return std::nullopt;
  return disks.disk[0];
}

/// Counts the segments next to a list that the disk touches, in steps that first grow and then
/// shrink.
template <class IsTouched>
std::uint32_t reach(std::uint32_t step, std::uint32_t limit, const IsTouched& is_touched) {
  std::uint32_t far = 0;
  const auto fits = [&] { return limit - far >= step && is_touched(far + step - 1); };
  for (; fits(); step *= 2) far += step;
  for (; step > 0; step /= 2)
    if (fits()) far += step;
  return far;
}

/// The disk that touches all segments of [begin, end), if there is one. It is computed from three
/// segments that are as far apart as possible, also beyond the list, so that it fits the
/// neighbouring lists.
std::optional<Disk> common_disk(const Elements& elements, std::uint32_t begin, std::uint32_t end,
                                double radius_limit, double slack) {
  const Segments all(elements.sites);
  const Segments list = all.subspan(begin, end - begin);
  std::optional<Disk> disk = disk_of_three(list, radius_limit);
  if (!disk || !touches_all(list, *disk, slack)) return std::nullopt;
  // A wider range determines the disk better, and so the disk touches more segments.
  for (std::uint32_t low = begin, high = end;;) {
    const std::uint32_t size = high - low;
    const std::uint32_t before =
        reach(size, low, [&](std::uint32_t i) { return touches(all[low - 1 - i], *disk, slack); });
    const std::uint32_t after = reach(size, elements.size() - high, [&](std::uint32_t i) {
      return touches(all[high + i], *disk, slack);
    });
    if (before + after == 0) return disk;
    low -= before;
    high += after;
    const std::optional<Disk> better = disk_of_three(all.subspan(low, high - low), radius_limit);
    if (!better || !touches_all(list, *better, slack)) return disk;
    disk = better;
    if (before + after < size) return disk;
  }
}

}  // namespace

std::uint32_t fan_of(Diagram& diagram, std::uint32_t first, std::uint32_t end, double radius_limit,
                     double slack, std::optional<Disk>& known) {
  const Elements& elements = diagram.elements;
  const std::uint32_t begin = elements.chains[first], last = elements.chains[end] - 1;
  if (last - begin + 1 != end - first) return none;
  if (!known || !touches_all(Segments(elements.sites).subspan(begin, end - first), *known, slack)) {
    const auto disk = common_disk(elements, begin, last + 1, radius_limit, slack);
    if (!disk) return none;
    known = disk;
  }
  // Place 2 i holds B(e_i, e_i+1), place 2 i + 1 B(e_begin, e_i+1).
  diagram.edges[std::size_t{2} * begin] = {
      {begin, begin + 1}, {none, none}, {elements.sites[begin + 1].point, 0}};
  diagram.top[begin + 1][1] = 2 * begin;
  std::uint32_t outermost = 2 * begin;
  for (std::uint32_t i = begin + 1; i < last; ++i) {
    const std::uint32_t side = 2 * i, across = 2 * i + 1;
    diagram.edges[side] = {{i, i + 1}, {none, none}, {elements.sites[i + 1].point, 0}};
    diagram.edges[across] = {{begin, i + 1}, {outermost, side}, *known};
    diagram.top[i][0] = side;
    diagram.top[i + 1][1] = outermost = across;
  }
  diagram.top[begin][0] = outermost;
  diagram.free[first] = {2 * begin + 1, 2 * last + 1};
  diagram.edges[2 * begin + 1].inward[0] = 2 * last;
  return outermost;
}

}  // namespace medial::lee
