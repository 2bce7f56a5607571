#include "methods/exact/disk_bounds.h"

#include <algorithm>
#include <cmath>

#include "base/compat.h"

namespace medial::exact {
namespace {

/// Its sign, or 0 where the numbers do not tell.
template <class Real>
int sign_of(const Bounded<Real>& number) {
  return number.sign().value_or(0);
}
template <class Real>
double near(const Bounded<Real>& number) {
  return static_cast<double>(number.value);
}

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

namespace {

template <class Number>
struct Row {
  Number x, y, r;  ///< factors of the centre and the radius
  Number rest;
};
template <class Number>
Number determinant(const Row<Number>& a, const Row<Number>& b, const Row<Number>& c) {
  return a.x * (b.y * c.r - b.r * c.y) + a.y * (b.r * c.x - b.x * c.r) +
         a.r * (b.x * c.y - b.y * c.x);
}

template <class Number>
using Triple = std::array<Number, 3>;  ///< x, y and radius

/// The disk that touches three straight sites in counter-clockwise order, times `scale`.
template <class Number>
std::optional<Triple<Number>> solve_straight(const std::array<Form<Number>, 3>& forms,
                                             Number& scale) {
  const auto row = [&](std::size_t i) {
    return Row<Number>{forms[i].slope.x, forms[i].slope.y, -forms[i].size, -forms[i].height};
  };
  const Row<Number> a = row(0), b = row(1), c = row(2);
  // Counter-clockwise contacts make the determinant negative.
  scale = determinant(a, b, c);
  if (sign_of(scale) >= 0) return std::nullopt;
  const auto replaced = [](Row<Number> one, std::size_t column) {
    (column == 0 ? one.x : column == 1 ? one.y : one.r) = one.rest;
    return one;
  };
  Triple<Number> disk;
  for (std::size_t i = 0; i < 3; ++i)
    disk[i] = determinant(replaced(a, i), replaced(b, i), replaced(c, i));
  return disk;
}

/// The base form eliminates the quadric x.x - r r from another one: a plane in (x, y, r).
template <class Number>
Row<Number> plane_of(const Form<Number>& base, const Form<Number>& f) {
  return {base.round * f.slope.x - f.round * base.slope.x,
          base.round * f.slope.y - f.round * base.slope.y,
          f.round * base.size - base.round * f.size, base.round * f.height - f.round * base.height};
}

/// The same where the first site is round. Two planes meet in the line point + lambda along, on
/// which the base form is a quadratic function of lambda, second / 2 lambda^2 + first lambda +
/// zeroth / 2. Of its two roots the order of the contacts selects one: the base form's slope along
/// the line has the sign of the three gradients' determinant, which is negative for disks that the
/// three sites touch in counter-clockwise order.
template <class Number>
std::optional<Triple<Number>> solve_round(const std::array<Form<Number>, 3>& forms, Number& scale) {
  const Form<Number>& base = forms[0];
  const Row<Number> a = plane_of(base, forms[1]), b = plane_of(base, forms[2]);
  const Triple<Number> along{a.y * b.r - a.r * b.y, a.r * b.x - a.x * b.r, a.x * b.y - a.y * b.x};
  // The point of the line where one coordinate is zero: that along which the line is longest.
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(near(along[i])) > std::abs(near(along[k]))) k = i;
  scale = along[k];
  const int scale_sign = sign_of(scale);
  if (scale_sign == 0) return std::nullopt;
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  const auto column = [](const Row<Number>& row, std::size_t c) {
    return c == 0 ? row.x : c == 1 ? row.y : row.r;
  };
  Triple<Number> point;
  point[i] = column(a, j) * b.rest - a.rest * column(b, j);
  point[j] = a.rest * column(b, i) - column(a, i) * b.rest;
  point[k] = Number(0.0);

  const auto quadric = [](const Triple<Number>& u, const Triple<Number>& v) {
    return u[0] * v[0] + u[1] * v[1] - u[2] * v[2];
  };
  const auto linear = [&](const Triple<Number>& u) {
    return base.slope.x * u[0] + base.slope.y * u[1] - base.size * u[2];
  };
  const Number two(2.0);
  const Number second = two * base.round * quadric(along, along),
               first = two * base.round * quadric(point, along) + scale * linear(along),
               zeroth = two * (base.round * quadric(point, point) +
                               scale * (linear(point) + scale * base.height));
  const Number discriminant = first * first - second * zeroth;
  if (const auto real = discriminant.sign(); !real || *real < 0) return std::nullopt;
  const Number root = root_of(discriminant);
  const bool upper = scale_sign < 0;  // the root (-first + sqrt(discriminant)) / second
  // It is better written as zeroth / (-first - sqrt(discriminant)).
  const int middle = (upper ? near(first) > 0 : near(first) < 0) ? sign_of(first) : 0;
  const bool cancels = middle != 0;
  const int divisor = cancels ? -middle : sign_of(second);
  if (divisor == 0) return std::nullopt;
  // The disk is smaller than the own circles: (constant + lambda factor) / scale is positive.
  for (const Form<Number>& f : forms) {
    if (sign_of(f.round) >= 0) continue;
    const Number twice = two * f.round;
    const Number constant = f.size * scale + twice * point[2], factor = twice * along[2];
    const int value =
        sign_of(cancels ? factor * zeroth - constant * first + (upper ? -constant : constant) * root
                        : constant * second - factor * first + (upper ? factor : -factor) * root);
    if (value * divisor * scale_sign <= 0) return std::nullopt;
  }
  const Number lambda = cancels ? zeroth / (upper ? -first - root : root - first)
                                : (upper ? root - first : -first - root) / second;
  for (std::size_t c = 0; c < 3; ++c) point[c] = point[c] + lambda * along[c];
  return point;
}

/// The disk on a spoke whose radius is `times` the spoke.
template <class Real>
std::optional<DiskBounds<Real>> disk_on(const Spoke<Bounded<Real>>& spoke,
                                        const Bounded<Real>& times) {
  if (!times.positive()) return std::nullopt;
  return DiskBounds<Real>{spoke.foot + times * spoke.normal, times * spoke.size};
}

/// Where two segments meet in a convex corner of more than a right angle: the bisector, and the
/// cross product of the normals, whose square is x.x - r r of the disks on it, against the spoke's.
/// (Of a sharp corner the bisector would lose what three lines keep.)
template <class Number>
struct Corner {
  Spoke<Number> bisector;
  Number turn;
  double cosine;  ///< of the turn, about
};
template <class Number>
std::optional<Corner<Number>> corner_between(const ExactSite& first, const ExactSite& second) {
  const auto is_segment = [](const ExactSite& site) { return !site.is_vertex() && !site.is_arc(); };
  if (!is_segment(first) || !is_segment(second) || first.end != second.start) return std::nullopt;
  const auto end = spoke_of<Number>(first, true), begin = spoke_of<Number>(second, false);
  const Number turn = cross(end.normal, begin.normal), along = dot(end.normal, begin.normal),
               sizes = begin.size * end.size;
  if (!(near(along) > 0) || !turn.positive()) return std::nullopt;
  return Corner<Number>{
      {end.foot, begin.size * end.normal + end.size * begin.normal, sizes + along},
      turn,
      near(along) / near(sizes)};
}

/// The disk that grows from a corner, touching both sides, until it touches a straight site: the
/// first root. The intersection of three lines would lose a flat corner.
template <class Real>
std::optional<DiskBounds<Real>> disk_in_corner(const Corner<Bounded<Real>>& corner,
                                               const ExactSite& site) {
  using Number = Bounded<Real>;
  const Spoke<Number>& bisector = corner.bisector;
  if (!site.is_vertex()) return disk_along(bisector, site);
  const auto form = form_of<Number>(site, bisector.foot);
  const Number closing = form.size * bisector.size - dot(form.slope, bisector.normal);
  if (!closing.positive()) return std::nullopt;
  const Number discriminant =
      closing * closing - Number(4.0) * corner.turn * corner.turn * form.height;
  if (!discriminant.positive()) return std::nullopt;
  return disk_on(bisector, Number(2.0) * form.height / (closing + root_of(discriminant)));
}

/// The disk that three sites touch in this counter-clockwise order and that is smaller than their
/// own circles. No two of the sites may be joined. None if there is no such disk, or if this
/// precision does not tell.
template <class Real>
std::optional<DiskBounds<Real>> disk_of_three(const SiteLoops& outline,
                                              const std::array<std::uint32_t, 3>& sites) {
  using Number = Bounded<Real>;
  std::array<ExactSite, 3> touched{outline.sites[sites[0]], outline.sites[sites[1]],
                                   outline.sites[sites[2]]};
  // From the flattest corner, if there are two.
  std::optional<Corner<Number>> flattest;
  const ExactSite* third = nullptr;
  for (std::size_t i = 0; i < 3; ++i) {
    if (touched[(i + 2) % 3].is_arc()) continue;
    const auto corner = corner_between<Number>(touched[i], touched[(i + 1) % 3]);
    if (!corner || (flattest && !(corner->cosine > flattest->cosine))) continue;
    flattest = corner;
    third = &touched[(i + 2) % 3];
  }
  if (flattest) return disk_in_corner<Real>(*flattest, *third);
  // First the site whose equation is the roundest: a vertex where there is one.
  const auto roundness = [](const ExactSite& site) {
    return site.is_vertex() ? 2 : std::abs(site.bulge);
  };
  std::rotate(touched.begin(), ranges::max_element(touched, {}, roundness), touched.end());
  const auto origin = exact_vector<Number>(touched[0].start);
  std::array<Form<Number>, 3> forms;
  for (std::size_t i = 0; i < 3; ++i) forms[i] = form_of<Number>(touched[i], origin);
  Number scale;
  auto disk = roundness(touched[0]) > 0 ? solve_round(forms, scale) : solve_straight(forms, scale);
  if (!disk) return std::nullopt;
  for (Number& coordinate : *disk) coordinate = coordinate / scale;
  const auto& [x, y, radius] = *disk;
  if (!radius.positive()) return std::nullopt;
  return DiskBounds<Real>{origin + Vector<Number>{x, y}, radius};
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
