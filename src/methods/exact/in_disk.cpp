#include "methods/exact/in_disk.h"

#include <algorithm>
#include <array>
#include <utility>

namespace medial::exact {
namespace {

Sign as_sign(int sign) { return static_cast<Sign>(sign); }
template <class Real>
Sign sign_of(const Bounded<Real>& number) {
  const auto sign = number.sign();
  return sign ? as_sign(*sign) : Sign::open;
}
Sign sign_of(const RootNumber& number) { return as_sign(number.sign()); }

bool decided(Sign sign) { return sign != Sign::open && sign != Sign::none; }
Sign operator-(Sign sign) { return decided(sign) ? as_sign(-static_cast<int>(sign)) : sign; }
/// Of a product.
Sign times(Sign a, Sign b) {
  if (!decided(a)) return a;
  if (!decided(b)) return b;
  return as_sign(static_cast<int>(a) * static_cast<int>(b));
}

/// The sign of a + b sqrt(square), square being known not to be negative.
template <class Real>
Sign sign_with(const Bounded<Real>& a, const Bounded<Real>& b, const Bounded<Real>& square) {
  return sign_of(a + b * root_of(square));
}
Sign sign_with(const RootNumber& a, const RootNumber& b, const RootNumber& square) {
  return as_sign(sign_with_root(a, b, square));
}

template <class Real>
double near(const Bounded<Real>& number) {
  return static_cast<double>(number.value);
}
double near(const RootNumber& number) { return static_cast<double>(number.bounded().value); }

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

/// The decisions in one kind of numbers.
template <class Number, class Roots>
class Kernel {
 public:
  Kernel(const SiteLoops& outline, Roots& roots) : outline_(outline), roots_(roots) {}

  /// No two of the sites are joined.
  Sign apart(const std::array<std::uint32_t, 3>& touched, std::uint32_t fourth) {
    Three three;
    const Sign found = solve(touched, three);
    if (found != Sign::positive) return found;
    const auto side = [&](const Vector<Number>& direction, const Vector<Number>& foot) {
      const Number constant = direction.x * three.point[0] + direction.y * three.point[1] +
                              dot(direction, three.origin - foot) * three.scale;
      if (!three.round) return times(sign_of(constant), three.scale_sign);
      return sign_of_linear(three, constant,
                            direction.x * three.along[0] + direction.y * three.along[1]);
    };
    const auto outside = [&](const ExactSite& site) {
      return value(three, form_of<Number>(site, three.origin, roots_));
    };
    return clears(fourth, outside, side);
  }

  /// The disk that touches three sites, no two of which are joined; none if undecided.
  template <class Real>
  std::optional<DiskBounds<Real>> disk_of(const std::array<std::uint32_t, 3>& touched) {
    Three three;
    if (solve(touched, three) != Sign::positive) return std::nullopt;
    std::array<Number, 3> disk = three.point;
    if (three.round) {
      const Number root = root_of(three.discriminant);
      const Number lambda =
          three.cancels ? three.zeroth / (three.upper ? -three.first - root : root - three.first)
                        : (three.upper ? root - three.first : -three.first - root) / three.second;
      for (std::size_t i = 0; i < 3; ++i) disk[i] = disk[i] + lambda * three.along[i];
    }
    for (Number& coordinate : disk) coordinate = coordinate / three.scale;
    if (!disk[2].positive()) return std::nullopt;
    return DiskBounds<Real>{three.origin + Vector<Number>{disk[0], disk[1]}, disk[2]};
  }

  /// `a` and `b` are joined: the disk that touches their joint and `third`.
  Sign at_joint(std::uint32_t a, std::uint32_t third, std::uint32_t fourth) {
    const Spoke<Number> spoke = outline_.template spoke_after<Number>(a, roots_);
    const Reach c = reach(spoke, third), d = reach(spoke, fourth);
    const Sign meets_c = meets(a, c, third);
    if (meets_c == Sign::open) return meets_c;
    if (meets_c != Sign::positive) {
      const Sign meets_d = meets(a, d, fourth);
      return meets_d == Sign::positive ? Sign::negative
             : meets_d == Sign::open   ? Sign::open
                                       : Sign::none;
    }
    const Sign ahead = sign_of(d.height);
    if (ahead == Sign::open) return ahead;
    if (ahead != Sign::positive) return Sign::positive;
    return clears(fourth, spoke, c.height, c.closing);
  }

  /// `a` and the site after it are joined, and so are `third` and the one after that: whether the
  /// foot on `third` of the disk at the first joint comes before the second joint.
  Sign at_two_joints(std::uint32_t a, std::uint32_t third) {
    const Spoke<Number> spoke = outline_.template spoke_after<Number>(a, roots_);
    const Spoke<Number> end = outline_.template spoke_after<Number>(third, roots_);
    const Reach c = reach(spoke, third);
    const Vector<Number> forward = end.tangent();
    const Sign ahead = sign_of(c.height);
    if (ahead == Sign::open) return ahead;
    // Where the first joint lies behind `third`, it is beside it.
    if (ahead != Sign::positive) return -sign_of(dot(forward, spoke.foot - end.foot));
    const Sign met = meets(a, c, third);
    if (met == Sign::open) return met;
    if (met != Sign::positive) return Sign::none;
    return -sign_of(dot(forward, spoke.foot - end.foot) * c.closing +
                    c.height * dot(forward, spoke.normal));
  }

  /// `arc` is joined to its neighbours: whether its own circle stays clear of `fourth`.
  Sign own_circle(std::uint32_t arc, std::uint32_t fourth) {
    const ExactSite& site = outline_.sites[arc];
    const Spoke<Number> spoke = spoke_of<Number>(site, false, roots_);
    return clears(fourth, spoke, Number(1.0), Number(4 * site.bulge));
  }

  /// The sign of a's curvature less b's; arcs.
  Sign curvatures(std::uint32_t a, std::uint32_t b) {
    const auto [bulge_a, size_a] = curvature_of(a);
    const auto [bulge_b, size_b] = curvature_of(b);
    return sign_of(bulge_a * size_b - bulge_b * size_a);
  }

 private:
  /// How a disk that grows at a spoke's foot gets to a site: with t times the spoke as radius, the
  /// site's form is height - t closing.
  struct Reach {
    Number height, closing;
  };
  Reach reach(const Spoke<Number>& spoke, std::uint32_t site) {
    return reach(spoke, outline_.sites[site]);
  }
  Reach reach(const Spoke<Number>& spoke, const ExactSite& site) {
    const auto form = form_of<Number>(site, spoke.foot, roots_);
    return {form.height, form.size * spoke.size - dot(form.slope, spoke.normal)};
  }

  /// Whether a disk stays outside a site. Near the centre of a convex arc's own circle it can
  /// reach over that circle elsewhere than on the arc: where its centre lies beyond the normals at
  /// the arc's ends, these decide. `outside` gives the sign of a site's form, `side` that of
  /// direction.(centre - point).
  template <class Outside, class Side>
  Sign clears(std::uint32_t fourth, const Outside& outside, const Side& side) {
    const ExactSite& site = outline_.sites[fourth];
    const Sign sign = outside(site);
    if (sign != Sign::negative) return sign;
    const Sign reached = reaches(fourth, side);
    if (reached != Sign::negative) return reached == Sign::open ? reached : sign;
    for (const Vec2 end : {site.start, site.end}) {
      const Sign at_end = outside({end, end, 0});
      if (at_end != Sign::positive) return at_end;
    }
    return Sign::positive;
  }
  /// For the disk at a spoke whose radius is height / closing of it.
  Sign clears(std::uint32_t fourth, const Spoke<Number>& spoke, const Number& height,
              const Number& closing) {
    const auto outside = [&](const ExactSite& site) {
      const Reach d = reach(spoke, site);
      return sign_of(d.height * closing - height * d.closing);
    };
    const auto side = [&](const Vector<Number>& direction, const Vector<Number>& point) {
      return sign_of(dot(direction, spoke.foot - point) * closing +
                     height * dot(direction, spoke.normal));
    };
    return clears(fourth, outside, side);
  }
  /// Whether a disk's centre lies between the normals at a convex arc's ends; negative if not.
  template <class Side>
  Sign reaches(std::uint32_t site, const Side& side) {
    const ExactSite& arc = outline_.sites[site];
    if (!(arc.bulge > 0)) return Sign::positive;
    for (const bool at_end : {false, true}) {
      const auto end = spoke_of<Number>(arc, at_end, roots_);
      const Sign ahead = side(end.tangent(), end.foot);
      if (ahead == Sign::open) return ahead;
      if (ahead == (at_end ? Sign::positive : Sign::negative)) return Sign::negative;
    }
    return Sign::positive;
  }

  /// Whether the disk that grows at the joint after `a` meets a site before it is as large as the
  /// own circle of an arc that begins or ends there, on that arc's own normal. It never meets the
  /// line (or circle) of a site that the joint lies behind, as it may where the two are nearly on
  /// one line.
  Sign meets(std::uint32_t a, const Reach& c, std::uint32_t third) {
    Sign sign = sign_of(c.height);
    if (sign == Sign::positive) sign = sign_of(c.closing);
    for (const std::uint32_t edge : {a, outline_.next_of(a)}) {
      const ExactSite& site = outline_.sites[edge];
      if (!(site.bulge > 0) || sign != Sign::positive) continue;
      const Reach own = edge == a ? c : reach(spoke_of<Number>(site, false, roots_), third);
      sign = sign_of(own.closing - Number(4 * site.bulge) * own.height);
    }
    return sign;
  }

  std::pair<Number, Number> curvature_of(std::uint32_t i) {
    const ExactSite& site = outline_.sites[i];
    return {Number(site.bulge), spoke_of<Number>(site, false, roots_).size};
  }

  /// The disk that touches three sites in counter-clockwise order: as seen from the origin,
  /// point / scale where all three are straight. Otherwise it is (point + lambda along) / scale,
  /// and lambda a root of second / 2 lambda^2 + first lambda + zeroth / 2.
  struct Three {
    Vector<Number> origin;
    std::array<Number, 3> point;
    Number scale;
    Sign scale_sign = Sign::open;
    bool round = false;
    Form<Number> base;  ///< one of the three forms, a round one
    std::array<Number, 3> along;
    Number second, first, zeroth, discriminant;
    bool upper = false;    ///< the root (-first + sqrt(discriminant)) / second
    bool cancels = false;  ///< is better written as zeroth / (-first - sqrt(discriminant))
    Sign divisor = Sign::open;
  };

  /// Positive where there is such a disk, smaller than the own circles of the three.
  Sign solve(std::array<std::uint32_t, 3> touched, Three& three) {
    // First the site whose equation is the roundest: a vertex where there is one.
    const auto roundness = [&](std::uint32_t i) {
      const ExactSite& site = outline_.sites[i];
      return site.is_vertex() ? 2 : std::abs(site.bulge);
    };
    const auto roundest = std::max_element(
        touched.begin(), touched.end(),
        [&](std::uint32_t a, std::uint32_t b) { return roundness(a) < roundness(b); });
    std::rotate(touched.begin(), roundest, touched.end());
    three.origin = exact_vector<Number>(outline_.sites[touched[0]].start);
    std::array<Form<Number>, 3> forms;
    for (std::size_t i = 0; i < 3; ++i)
      forms[i] = form_of<Number>(outline_.sites[touched[i]], three.origin, roots_);
    three.round = roundness(touched[0]) > 0;
    return three.round ? solve_round(forms, three) : solve_straight(forms, three);
  }

  static Sign solve_straight(const std::array<Form<Number>, 3>& forms, Three& three) {
    const auto row = [&](std::size_t i) {
      return Row<Number>{forms[i].slope.x, forms[i].slope.y, -forms[i].size, -forms[i].height};
    };
    const Row<Number> a = row(0), b = row(1), c = row(2);
    // Counter-clockwise contacts make the determinant negative.
    three.scale = determinant(a, b, c);
    three.scale_sign = sign_of(three.scale);
    if (three.scale_sign == Sign::open) return Sign::open;
    if (three.scale_sign != Sign::negative) return Sign::none;
    const auto replaced = [](Row<Number> one, std::size_t column) {
      (column == 0 ? one.x : column == 1 ? one.y : one.r) = one.rest;
      return one;
    };
    for (std::size_t i = 0; i < 3; ++i)
      three.point[i] = determinant(replaced(a, i), replaced(b, i), replaced(c, i));
    return Sign::positive;
  }

  /// The base form eliminates the quadric x.x - r r from another one: a plane in (x, y, r).
  static Row<Number> plane_of(const Form<Number>& base, const Form<Number>& f) {
    return {base.round * f.slope.x - f.round * base.slope.x,
            base.round * f.slope.y - f.round * base.slope.y,
            f.round * base.size - base.round * f.size,
            base.round * f.height - f.round * base.height};
  }

  /// Two planes meet in a line, on which the base form is a quadratic function. Of its two roots
  /// the order of the contacts selects one: the base form's slope along the line has the
  /// sign of the three gradients' determinant, which is negative for disks that the three sites
  /// touch in counter-clockwise order.
  static Sign solve_round(const std::array<Form<Number>, 3>& forms, Three& three) {
    const Form<Number>& base = three.base = forms[0];
    const Row<Number> a = plane_of(base, forms[1]), b = plane_of(base, forms[2]);
    auto& along =
        three.along = {a.y * b.r - a.r * b.y, a.r * b.x - a.x * b.r, a.x * b.y - a.y * b.x};
    // The point of the line where one coordinate is zero: that along which the line is longest.
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (std::abs(near(along[i])) > std::abs(near(along[k]))) k = i;
    const Number& scale = three.scale = along[k];
    three.scale_sign = sign_of(scale);
    if (three.scale_sign == Sign::open) return Sign::open;
    if (three.scale_sign == Sign::zero) return Sign::none;
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const auto column = [](const Row<Number>& row, std::size_t c) {
      return c == 0 ? row.x : c == 1 ? row.y : row.r;
    };
    auto& point = three.point;
    point[i] = column(a, j) * b.rest - a.rest * column(b, j);
    point[j] = a.rest * column(b, i) - column(a, i) * b.rest;
    point[k] = Number(0.0);

    const auto quadric = [](const std::array<Number, 3>& u, const std::array<Number, 3>& v) {
      return u[0] * v[0] + u[1] * v[1] - u[2] * v[2];
    };
    const auto linear = [&](const std::array<Number, 3>& u) {
      return base.slope.x * u[0] + base.slope.y * u[1] - base.size * u[2];
    };
    const Number two(2.0);
    three.second = two * base.round * quadric(along, along);
    three.first = two * base.round * quadric(point, along) + scale * linear(along);
    three.zeroth =
        two * (base.round * quadric(point, point) + scale * (linear(point) + scale * base.height));
    three.discriminant = three.first * three.first - three.second * three.zeroth;
    const Sign real = sign_of(three.discriminant);
    if (real == Sign::open) return Sign::open;
    if (real == Sign::negative) return Sign::none;
    three.upper = three.scale_sign == Sign::negative;
    three.cancels = three.upper ? near(three.first) > 0 : near(three.first) < 0;
    three.divisor = three.cancels ? -sign_of(three.first) : sign_of(three.second);
    if (three.divisor == Sign::open) return Sign::open;
    if (three.divisor == Sign::zero) return Sign::none;
    for (const Form<Number>& f : forms) {
      if (sign_of(f.round) != Sign::negative) continue;
      const Number twice = two * f.round;
      const Sign fits = sign_of_linear(three, f.size * scale + twice * point[2], twice * along[2]);
      if (fits == Sign::open) return Sign::open;
      if (fits != Sign::positive) return Sign::none;
    }
    return Sign::positive;
  }

  /// The sign of (constant + lambda factor) / scale.
  static Sign sign_of_linear(const Three& three, const Number& constant, const Number& factor) {
    const Sign value = three.cancels
                           ? sign_with(factor * three.zeroth - constant * three.first,
                                       three.upper ? -constant : constant, three.discriminant)
                           : sign_with(constant * three.second - factor * three.first,
                                       three.upper ? factor : -factor, three.discriminant);
    return times(times(value, three.divisor), three.scale_sign);
  }

  /// The sign of a fourth form at the disk of three.
  static Sign value(const Three& three, const Form<Number>& d) {
    if (!three.round) {
      const Vector<Number> center{three.point[0], three.point[1]};
      const Number& radius = three.point[2];
      const Number flat = dot(d.slope, center) - d.size * radius + d.height * three.scale;
      if (sign_of(d.round) == Sign::zero) return times(sign_of(flat), three.scale_sign);
      return sign_of(d.round * (dot(center, center) - radius * radius) + three.scale * flat);
    }
    const Row<Number> plane = plane_of(three.base, d);
    const auto at = [&](const std::array<Number, 3>& v) {
      return plane.x * v[0] + plane.y * v[1] + plane.r * v[2];
    };
    return times(sign_of_linear(three, at(three.point) + plane.rest * three.scale, at(three.along)),
                 sign_of(three.base.round));
  }

  const SiteLoops& outline_;
  Roots& roots_;
};

/// Four sites in order around a disk, and which neighbours are joined.
struct Quad {
  std::array<std::uint32_t, 4> site;
  std::array<bool, 4> joined;  ///< to the one after it

  Quad turned(std::size_t by) const {
    Quad result = *this;
    std::rotate(result.site.begin(), result.site.begin() + static_cast<std::ptrdiff_t>(by),
                result.site.end());
    std::rotate(result.joined.begin(), result.joined.begin() + static_cast<std::ptrdiff_t>(by),
                result.joined.end());
    return result;
  }
};

/// Three sites joined one after the other, the middle one an arc whose circle can be a maximal
/// disk: the fourth must stay clear of it. The middle of three is passed on its whole length
/// otherwise.
template <class AKernel>
Sign three_joined(const SiteLoops& outline, AKernel& kernel, const Quad& quad) {
  const std::uint32_t before = quad.site[0], middle = quad.site[1], after = quad.site[2];
  const auto convex = [&](std::uint32_t i) { return outline.sites[i].bulge > 0; };
  if (!convex(middle)) {
    if (quad.joined[2] && convex(after)) return Sign::negative;
    return quad.joined[2] ? Sign::none : Sign::negative;
  }
  for (const std::uint32_t neighbor : {before, after}) {
    if (!convex(neighbor)) continue;
    const Sign sharper = kernel.curvatures(middle, neighbor);
    if (sharper == Sign::open || sharper == Sign::negative) return sharper;
    // Arcs of one circle: it touches all of both.
    if (sharper == Sign::zero && neighbor == after && quad.joined[2]) return sharper;
  }
  if (quad.joined[2]) return Sign::positive;  // the fourth goes on from an arc that is no sharper
  return kernel.own_circle(middle, quad.site[3]);
}

template <class AKernel>
Sign decide(const SiteLoops& outline, AKernel&& kernel, const Quad& quad) {
  const auto joints = std::count(quad.joined.begin(), quad.joined.end(), true);
  // A quarter turn exchanges the two ways to divide the four sites.
  for (std::size_t by = 0; by < 4; ++by) {
    const Quad turned = quad.turned(by);
    const auto& j = turned.joined;
    Sign sign = Sign::none;
    if (joints == 0) {
      sign = kernel.apart({turned.site[0], turned.site[1], turned.site[2]}, turned.site[3]);
    } else if (joints == 1) {
      if (!j[0]) continue;
      sign = kernel.at_joint(turned.site[0], turned.site[2], turned.site[3]);
    } else if (joints == 2 && j[0] && j[2]) {
      sign = kernel.at_two_joints(turned.site[0], turned.site[2]);
    } else if (j[0] && j[1] && (joints == 2 || (joints == 3 && j[2]) || joints == 4)) {
      sign = three_joined(outline, kernel, turned);
    } else {
      continue;
    }
    if (sign == Sign::none) continue;
    return by % 2 == 0 ? sign : -sign;
  }
  return Sign::none;
}

template <class Real>
Sign decide_in(const SiteLoops& outline, const Quad& quad) {
  ApproximateRoots<Real> roots;
  return decide(outline, Kernel<Bounded<Real>, ApproximateRoots<Real>>(outline, roots), quad);
}

}  // namespace

template <class Real>
std::optional<DiskBounds<Real>> disk_of_three(const SiteLoops& outline,
                                              const std::array<std::uint32_t, 3>& sites) {
  ApproximateRoots<Real> roots;
  return Kernel<Bounded<Real>, ApproximateRoots<Real>>(outline, roots)
      .template disk_of<Real>(sites);
}

template std::optional<DiskBounds<Twofold>> disk_of_three(const SiteLoops&,
                                                          const std::array<std::uint32_t, 3>&);
template std::optional<DiskBounds<Precise>> disk_of_three(const SiteLoops&,
                                                          const std::array<std::uint32_t, 3>&);

Sign in_disk(const SiteLoops& outline, std::uint32_t first, std::uint32_t second,
             std::uint32_t third, std::uint32_t fourth, Decisions& decisions) {
  const Quad quad{{first, second, third, fourth},
                  {outline.joined(first, second), outline.joined(second, third),
                   outline.joined(third, fourth), outline.joined(fourth, first)}};
  Sign sign = decide_in<double>(outline, quad);
  if (sign != Sign::open) {
    ++decisions.filtered;
  } else if (sign = decide_in<Twofold>(outline, quad); sign != Sign::open) {
    ++decisions.twofold;
  } else if (sign = decide_in<Precise>(outline, quad); sign != Sign::open) {
    ++decisions.precise;
  } else {
    RootField field;
    sign = decide(outline, Kernel<RootNumber, RootField>(outline, field), quad);
    ++decisions.rational;
  }
  decisions.ties += sign == Sign::zero ? 1 : 0;
  return sign;
}

}  // namespace medial::exact
