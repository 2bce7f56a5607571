#include "engines/lee/fan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/tangent_disk.h"

namespace medial::lee {
namespace {

/// Whether a disk touches all segments in [begin, end).
bool touches_all(const Elements& elements, std::uint32_t begin, std::uint32_t end, const Disk& disk,
                 double slack) {
  const auto touches = [&](const geometry::Site& site) {
    const Vec2 d = disk.center - site.point;
    const double foot = dot(site.direction, d);
    return std::abs(cross(site.direction, d) - disk.radius) <= slack && foot >= 0 &&
           foot <= site.length;
  };
  const auto first = elements.sites.begin();
  return std::all_of(first + begin, first + end, touches);
}

/// The disk that touches all segments in [begin, end), if there is one.
std::optional<Disk> common_disk(const Elements& elements, std::uint32_t begin, std::uint32_t end,
                                double radius_limit, double slack) {
  // Three segments that are far from parallel: a third of the way around a polygon, or else the
  // first, the last and the one in the middle.
  constexpr double nearly_parallel = 0.999;
  const bool is_closed = geometry::meets(elements.sites[end - 1], elements.sites[begin]);
  const std::uint32_t last = is_closed ? begin + 2 * ((end - begin) / 3) : end - 1;
  const geometry::Site &a = elements.sites[begin], &b = elements.sites[std::midpoint(begin, last)],
                       &c = elements.sites[last];
  if (dot(a.direction, c.direction) > nearly_parallel) return std::nullopt;
  const geometry::TangentDisks disks = geometry::tangent_disks(a, b, c);
  if (disks.count != 1 || !(disks.disk[0].radius <= radius_limit)) return std::nullopt;
  if (!touches_all(elements, begin, end, disks.disk[0], slack)) return std::nullopt;
  return disks.disk[0];
}

}  // namespace

std::uint32_t fan_of(Diagram& diagram, std::uint32_t first, std::uint32_t end, double radius_limit,
                     double slack, std::optional<Disk>& known) {
  const Elements& elements = diagram.elements;
  const std::uint32_t begin = elements.chains[first], last = elements.chains[end] - 1;
  if (last - begin + 1 != end - first) return none;
  if (!known || !touches_all(elements, begin, last + 1, *known, slack)) {
    const auto disk = common_disk(elements, begin, last + 1, radius_limit, slack);
    if (!disk) return none;
    known = disk;
  }
  // Places 2 i for B(e_i, e_i+1), 2 i + 1 for B(e_begin, e_i+1).
  diagram.edges[2 * begin] = {
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
