#include "methods/exact/touch.h"

#include <algorithm>

#include "base/compat.h"

namespace medial::exact {
namespace {

template <class Real>
bool is_negative(const Bounded<Real>& number) {
  return number.sign() == -1;
}

template <class Real>
int clearance_of_point(Vec2 point, const DiskBounds<Real>& disk, std::span<const Vec2> touched) {
  if (std::find(touched.begin(), touched.end(), point) != touched.end()) return 0;
  const auto d = disk.center - exact_vector<Bounded<Real>>(point);
  return (dot(d, d) - disk.radius * disk.radius).sign().value_or(0);
}

}  // namespace

template <class Real>
bool may_have_foot(const ExactSite& site, const DiskBounds<Real>& disk) {
  using Number = Bounded<Real>;
  if (site.is_vertex()) return true;
  const auto start = exact_vector<Number>(site.start), end = exact_vector<Number>(site.end);
  if (!site.is_arc()) {
    const auto along = end - start;
    return !is_negative(dot(along, disk.center - start)) &&
           !is_negative(dot(along, end - disk.center));
  }
  const auto first = normal_of<Number>(site, false);
  const auto last = normal_of<Number>(site, true);
  const auto toward = first + Number(-4 * site.bulge) * (disk.center - start);
  const auto before = cross(first, toward), after = cross(toward, last);
  return site.bulge > 0 ? !is_negative(before) && !is_negative(after)
                        : !is_negative(-before) && !is_negative(-after);
}

template <class Real>
int clearance(const ExactSite& site, const DiskBounds<Real>& disk, std::span<const Vec2> touched) {
  using Number = Bounded<Real>;
  if (site.is_vertex()) return clearance_of_point(site.start, disk, touched);
  const auto form = form_of<Number>(site, disk.center);
  const Number bend = form.round * disk.radius * disk.radius, reach = form.size * disk.radius;
  // With the centre as origin, on the left of the carrier and on its right.
  const auto ahead = (form.height - bend - reach).sign();
  if (!ahead || *ahead >= 0) return ahead.value_or(0);
  const auto behind = (form.height - bend + reach).sign();
  if (behind && *behind < 0) return 1;
  if (may_have_foot(site, disk)) return behind && *behind > 0 ? -1 : 0;
  return std::min(clearance_of_point(site.start, disk, touched),
                  clearance_of_point(site.end, disk, touched));
}

template <class Real>
std::optional<DiskBounds<Real>> disk_along(const Spoke<Bounded<Real>>& spoke,
                                           const ExactSite& site) {
  using Number = Bounded<Real>;
  const auto form = form_of<Number>(site, spoke.foot);
  const Number closing = form.size * spoke.size - dot(form.slope, spoke.normal);
  if (!closing.positive() || !form.height.positive()) return std::nullopt;
  const Number times = form.height / closing;
  return DiskBounds<Real>{spoke.foot + times * spoke.normal, times * spoke.size};
}

template <class Real>
std::optional<DiskBounds<Real>> disk_from(Vec2 foot, Vec2 direction, const ExactSite& site) {
  using Number = Bounded<Real>;
  const auto normal = exact_vector<Number>(direction);
  return disk_along<Real>({exact_vector<Number>(foot), normal, root_of(dot(normal, normal))}, site);
}

template bool may_have_foot(const ExactSite&, const DiskBounds<Twofold>&);
template bool may_have_foot(const ExactSite&, const DiskBounds<Precise>&);
template bool may_have_foot(const ExactSite&, const DiskBounds<Wide>&);
template int clearance(const ExactSite&, const DiskBounds<Twofold>&, std::span<const Vec2>);
template int clearance(const ExactSite&, const DiskBounds<Precise>&, std::span<const Vec2>);
template int clearance(const ExactSite&, const DiskBounds<Wide>&, std::span<const Vec2>);
template std::optional<DiskBounds<Twofold>> disk_along(const Spoke<Bounded<Twofold>>&,
                                                       const ExactSite&);
template std::optional<DiskBounds<Precise>> disk_along(const Spoke<Bounded<Precise>>&,
                                                       const ExactSite&);
template std::optional<DiskBounds<Wide>> disk_along(const Spoke<Bounded<Wide>>&, const ExactSite&);
template std::optional<DiskBounds<Twofold>> disk_from(Vec2, Vec2, const ExactSite&);
template std::optional<DiskBounds<Precise>> disk_from(Vec2, Vec2, const ExactSite&);
template std::optional<DiskBounds<Wide>> disk_from(Vec2, Vec2, const ExactSite&);

}  // namespace medial::exact
