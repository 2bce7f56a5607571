#include "methods/exact/touch.h"

#include <algorithm>

namespace medial::exact {
namespace {

using Number = Bounded<Precise>;
using Roots = ApproximateRoots<Precise>;

bool is_negative(const Number& number) { return number.sign() == -1; }

int clearance_of_point(Vec2 point, const DiskBounds<Precise>& disk) {
  const auto d = disk.center - exact_vector<Number>(point);
  return (dot(d, d) - disk.radius * disk.radius).sign().value_or(0);
}

}  // namespace

bool may_have_foot(const ExactSite& site, const DiskBounds<Precise>& disk) {
  if (site.is_vertex()) return true;
  const auto start = exact_vector<Number>(site.start), end = exact_vector<Number>(site.end);
  if (!site.is_arc()) {
    const auto along = end - start;
    return !is_negative(dot(along, disk.center - start)) &&
           !is_negative(dot(along, end - disk.center));
  }
  Roots roots;
  const auto first = spoke_of<Number>(site, false, roots).normal;
  const auto last = spoke_of<Number>(site, true, roots).normal;
  const auto toward = first + Number(-4 * site.bulge) * (disk.center - start);
  const auto before = cross(first, toward), after = cross(toward, last);
  return site.bulge > 0 ? !is_negative(before) && !is_negative(after)
                        : !is_negative(-before) && !is_negative(-after);
}

int clearance(const ExactSite& site, const DiskBounds<Precise>& disk) {
  if (site.is_vertex()) return clearance_of_point(site.start, disk);
  Roots roots;
  const auto form = form_of<Number>(site, disk.center, roots);
  const Number bend = form.round * disk.radius * disk.radius, reach = form.size * disk.radius;
  // With the centre as origin, on the left of the carrier and on its right.
  const auto ahead = (form.height - bend - reach).sign();
  if (!ahead || *ahead >= 0) return ahead.value_or(0);
  const auto behind = (form.height - bend + reach).sign();
  if (behind && *behind < 0) return 1;
  if (may_have_foot(site, disk)) return behind && *behind > 0 ? -1 : 0;
  return std::min(clearance_of_point(site.start, disk), clearance_of_point(site.end, disk));
}

std::optional<DiskBounds<Precise>> disk_along(const Spoke<Number>& spoke, const ExactSite& site) {
  Roots roots;
  const auto form = form_of<Number>(site, spoke.foot, roots);
  const Number closing = form.size * spoke.size - dot(form.slope, spoke.normal);
  if (!closing.positive() || !form.height.positive()) return std::nullopt;
  const Number times = form.height / closing;
  return DiskBounds<Precise>{spoke.foot + times * spoke.normal, times * spoke.size};
}

std::optional<DiskBounds<Precise>> disk_from(Vec2 foot, Vec2 direction, const ExactSite& site) {
  Roots roots;
  const auto normal = exact_vector<Number>(direction);
  return disk_along({exact_vector<Number>(foot), normal, roots.root(dot(normal, normal))}, site);
}

}  // namespace medial::exact
