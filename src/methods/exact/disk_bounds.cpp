#include "methods/exact/disk_bounds.h"

#include "methods/exact/disk_of_three.h"

namespace medial::exact {
namespace {

/// The disk on a spoke whose radius is `times` the spoke.
template <class Real>
std::optional<DiskBounds<Real>> disk_on(const Spoke<Bounded<Real>>& spoke,
                                        const Bounded<Real>& times) {
  if (!times.positive()) return std::nullopt;
  return DiskBounds<Real>{spoke.foot + times * spoke.normal, times * spoke.size};
}

}  // namespace

template <class Real>
std::optional<DiskBounds<Real>> disk_bounds(const SiteLoops& outline,
                                            const std::array<std::uint32_t, 3>& sites) {
  using Number = Bounded<Real>;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t a = sites[i], b = sites[(i + 1) % 3], c = sites[(i + 2) % 3];
    if (!outline.joined(a, b) || !outline.joined(b, c)) continue;
    const ExactSite& arc = outline.sites[b];
    if (!(arc.bulge > 0)) continue;
    const auto own = spoke_of<Number>(arc, false);
    // Its own circle is clear of the neighbours where these bend no more.
    for (const std::uint32_t neighbor : {a, c}) {
      const ExactSite& site = outline.sites[neighbor];
      if (!(site.bulge > 0)) continue;
      const auto other = spoke_of<Number>(site, false);
      if ((Number(site.bulge) * own.size - Number(arc.bulge) * other.size).positive())
        return std::nullopt;
    }
    return disk_on(own, Number(1.0) / Number(4 * arc.bulge));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t a = sites[i], b = sites[(i + 1) % 3], c = sites[(i + 2) % 3];
    if (!outline.joined(a, b)) continue;
    if (outline.joined(b, c) || outline.joined(c, a)) return std::nullopt;
    const auto spoke = outline.template spoke_after<Number>(a);
    const auto form = form_of<Number>(outline.sites[c], spoke.foot);
    const auto closing_on = [&](const Spoke<Number>& at) {
      return form.size * at.size - dot(form.slope, at.normal);
    };
    const Number closing = closing_on(spoke);
    if (!closing.positive()) return std::nullopt;
    auto disk = disk_on(spoke, form.height / closing);
    if (!disk) return std::nullopt;
    // It is smaller than the circles of all three: those of the joined ones on their own normals.
    for (const std::uint32_t site : {a, b}) {
      const Number four_bulges(4 * outline.sites[site].bulge);
      if (!(outline.sites[site].bulge > 0)) continue;
      const auto own = spoke_of<Number>(outline.sites[site], site == a);
      if (!(closing_on(own) - four_bulges * form.height).positive()) return std::nullopt;
    }
    if (const double bulge = outline.sites[c].bulge; bulge > 0) {
      const auto own = spoke_of<Number>(outline.sites[c], false);
      if (!(own.size - Number(4 * bulge) * disk->radius).positive()) return std::nullopt;
    }
    return disk;
  }
  return disk_of_three<Real>(outline, sites);
}

template <class Real>
std::optional<int> further_along(const ExactSite& site, const DiskBounds<Real>& from,
                                 const DiskBounds<Real>& to) {
  using Number = Bounded<Real>;
  const auto start = exact_vector<Number>(site.start);
  if (site.is_vertex()) {
    // Round a reflex vertex, normals turn to the right.
    return cross(to.center - start, from.center - start).sign();
  }
  if (!site.is_arc())
    return dot(exact_vector<Number>(site.end) - start, to.center - from.center).sign();
  const auto normal = normal_of<Number>(site, false);
  const Number factor(-4 * site.bulge);
  const auto normal_at = [&](const DiskBounds<Real>& disk) {
    return normal + factor * (disk.center - start);
  };
  const auto before = normal_at(from), after = normal_at(to);
  // An arc can turn by a half circle: feet on different sides of its middle are distinguished
  // first.
  const auto middle = left_of(exact_vector<Number>(site.end) - start);
  const auto from_side = cross(middle, before).sign(), to_side = cross(middle, after).sign();
  const int left = site.bulge > 0 ? 1 : -1;
  if (from_side && to_side && *from_side * *to_side < 0) return *to_side * left;
  const auto turn = cross(before, after);
  return (left > 0 ? turn : -turn).sign();
}

template std::optional<DiskBounds<Twofold>> disk_bounds(const SiteLoops&,
                                                        const std::array<std::uint32_t, 3>&);
template std::optional<DiskBounds<Precise>> disk_bounds(const SiteLoops&,
                                                        const std::array<std::uint32_t, 3>&);
template std::optional<DiskBounds<Wide>> disk_bounds(const SiteLoops&,
                                                     const std::array<std::uint32_t, 3>&);
template std::optional<int> further_along(const ExactSite&, const DiskBounds<Twofold>&,
                                          const DiskBounds<Twofold>&);
template std::optional<int> further_along(const ExactSite&, const DiskBounds<Precise>&,
                                          const DiskBounds<Precise>&);
template std::optional<int> further_along(const ExactSite&, const DiskBounds<Wide>&,
                                          const DiskBounds<Wide>&);

}  // namespace medial::exact
