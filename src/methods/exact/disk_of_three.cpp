#include "methods/exact/disk_of_three.h"

#include <algorithm>
#include <array>
#include <utility>

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

template <class Real>
class Kernel {
  using Number = Bounded<Real>;

 public:
  explicit Kernel(const SiteLoops& outline) : outline_(outline) {}

  std::optional<DiskBounds<Real>> disk_of(const std::array<std::uint32_t, 3>& touched) {
    Three three;
    if (!solve(touched, three)) return std::nullopt;
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

 private:
  /// The disk that touches three sites in counter-clockwise order: as seen from the origin,
  /// point / scale where all three are straight. Otherwise it is (point + lambda along) / scale,
  /// and lambda a root of second / 2 lambda^2 + first lambda + zeroth / 2.
  struct Three {
    Vector<Number> origin;
    std::array<Number, 3> point;
    Number scale;
    int scale_sign = 0;
    bool round = false;
    std::array<Number, 3> along;
    Number second, first, zeroth, discriminant;
    bool upper = false;    ///< the root (-first + sqrt(discriminant)) / second
    bool cancels = false;  ///< is better written as zeroth / (-first - sqrt(discriminant))
    int divisor = 0;
  };

  /// Whether there is such a disk, smaller than the own circles of the three.
  bool solve(std::array<std::uint32_t, 3> touched, Three& three) {
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
      forms[i] = form_of<Number>(outline_.sites[touched[i]], three.origin);
    three.round = roundness(touched[0]) > 0;
    return three.round ? solve_round(forms, three) : solve_straight(forms, three);
  }

  static bool solve_straight(const std::array<Form<Number>, 3>& forms, Three& three) {
    const auto row = [&](std::size_t i) {
      return Row<Number>{forms[i].slope.x, forms[i].slope.y, -forms[i].size, -forms[i].height};
    };
    const Row<Number> a = row(0), b = row(1), c = row(2);
    // Counter-clockwise contacts make the determinant negative.
    three.scale = determinant(a, b, c);
    if (sign_of(three.scale) >= 0) return false;
    const auto replaced = [](Row<Number> one, std::size_t column) {
      (column == 0 ? one.x : column == 1 ? one.y : one.r) = one.rest;
      return one;
    };
    for (std::size_t i = 0; i < 3; ++i)
      three.point[i] = determinant(replaced(a, i), replaced(b, i), replaced(c, i));
    return true;
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
  static bool solve_round(const std::array<Form<Number>, 3>& forms, Three& three) {
    const Form<Number>& base = forms[0];
    const Row<Number> a = plane_of(base, forms[1]), b = plane_of(base, forms[2]);
    auto& along =
        three.along = {a.y * b.r - a.r * b.y, a.r * b.x - a.x * b.r, a.x * b.y - a.y * b.x};
    // The point of the line where one coordinate is zero: that along which the line is longest.
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (std::abs(near(along[i])) > std::abs(near(along[k]))) k = i;
    const Number& scale = three.scale = along[k];
    three.scale_sign = sign_of(scale);
    if (three.scale_sign == 0) return false;
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
    if (const auto real = three.discriminant.sign(); !real || *real < 0) return false;
    three.upper = three.scale_sign < 0;
    three.cancels = three.upper ? near(three.first) > 0 : near(three.first) < 0;
    three.divisor = three.cancels ? -sign_of(three.first) : sign_of(three.second);
    if (three.divisor == 0) return false;
    for (const Form<Number>& f : forms) {
      if (sign_of(f.round) >= 0) continue;
      const Number twice = two * f.round;
      if (sign_of_linear(three, f.size * scale + twice * point[2], twice * along[2]) <= 0)
        return false;
    }
    return true;
  }

  /// The sign of (constant + lambda factor) / scale, as above.
  static int sign_of_linear(const Three& three, const Number& constant, const Number& factor) {
    const Number root = root_of(three.discriminant);
    const int value = sign_of(three.cancels ? factor * three.zeroth - constant * three.first +
                                                  (three.upper ? -constant : constant) * root
                                            : constant * three.second - factor * three.first +
                                                  (three.upper ? factor : -factor) * root);
    return value * three.divisor * three.scale_sign;
  }

  const SiteLoops& outline_;
};

}  // namespace

template <class Real>
std::optional<DiskBounds<Real>> disk_of_three(const SiteLoops& outline,
                                              const std::array<std::uint32_t, 3>& sites) {
  return Kernel<Real>(outline).disk_of(sites);
}

template std::optional<DiskBounds<Twofold>> disk_of_three(const SiteLoops&,
                                                          const std::array<std::uint32_t, 3>&);
template std::optional<DiskBounds<Precise>> disk_of_three(const SiteLoops&,
                                                          const std::array<std::uint32_t, 3>&);
template std::optional<DiskBounds<Wide>> disk_of_three(const SiteLoops&,
                                                       const std::array<std::uint32_t, 3>&);

}  // namespace medial::exact
