#include "methods/disks/tie_fit.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "base/compat.h"

namespace medial::disks {
namespace {

template <class Real>
Real size_of(const Real& x) {
  return x < 0 ? Real(-x) : x;
}

using exact::exact_vector;
using exact::Precise;
using exact::Vector;

template <class Real>
Real norm_of(const Vector<Real>& v) {
  using std::sqrt;
  return sqrt(dot(v, v));
}
template <class Real>
Disk rounded(const DiskOf<Real>& disk) {
  return {{static_cast<double>(disk.center.x), static_cast<double>(disk.center.y)},
          static_cast<double>(disk.radius)};
}

template <class Real>
ContactOf<Real> contact_with_point(Vec2 point, const DiskOf<Real>& disk) {
  const Vector<Real> to = disk.center - exact_vector<Real>(point);
  const Real away = norm_of(to);
  return {{to.x / away, to.y / away}, away - disk.radius};
}

ContactOf<double> contact_of(const TieSites& sites, const Touch& i, const DiskOf<double>& disk) {
  const Disk own = rounded(disk);
  return disks::contact_of(i.seen_from(sites.sites, own.center), own);
}

/// By how much the nearest point of what is to be touched is nearer or further than the radius:
/// more than contact_of() has where a foot is beyond a site's end.
double residual_of(const TieSites& sites, const Touch& i, const DiskOf<double>& disk) {
  const Disk own = rounded(disk);
  return std::abs(site::gap(
      i.part == Touch::Part::site ? sites.sites[i.site] : i.seen_from(sites.sites, own.center),
      own));
}

/// Of a site as the shape has it. `Real` has more digits than double.
template <class Real>
ContactOf<Real> contact_of(const TieSites& sites, const Touch& i, const DiskOf<Real>& disk) {
  const exact::ExactSite& site = sites.exact->site(i.site);
  const site::Site seen = i.seen_from(sites.sites, rounded(disk).center);
  if (seen.is_vertex() && site.is_arc()) return contact_with_point(seen.point, disk);
  if (site.is_vertex()) return contact_with_point(site.start, disk);
  const Vector<Real> start = exact_vector<Real>(site.start),
                     along = exact_vector<Real>(site.end) - start, across = exact::left_of(along);
  const Real length = norm_of(along);
  if (!site.is_arc()) {
    const Vector<Real> normal{across.x / length, across.y / length};
    return {normal, dot(normal, disk.center - start) - disk.radius};
  }
  const Real bulge(site.bulge), squared = bulge * bulge;
  const Real height = (1 - squared) / (4 * bulge);
  const Vector<Real> to = disk.center - (start + Real(0.5) * along + height * across);
  const Real away = norm_of(to);
  const Real radius = length * (1 + squared) / (4 * bulge);  // signed
  const Real sense(bulge > 0 ? -1.0 : 1.0);
  return {{sense * to.x / away, sense * to.y / away}, radius + sense * away - disk.radius};
}

enum class Verdict : std::uint8_t { yes, no, open };

/// A bound, and what the numbers in use leave open.
struct Bound {
  double value, noise;
};

template <class Real>
class Exchange {
 public:
  Exchange(const TieSites& sites, DiskOf<Real> start) : disk(start), sites_(sites), start_(start) {}

  DiskOf<Real> disk;
  Real worst{0};  ///< the largest residual at the last contacts asked for

  Verdict judge(std::span<const Touch> contacts, const Bound& bound) {
    constexpr int most_rounds = 48;
    const Real low(bound.value - bound.noise), high(bound.value + bound.noise);
    Real before(-1);
    for (int round = 0; round < most_rounds; ++round) {
      measure(contacts);
      if (worst <= low) return Verdict::yes;
      const DiskOf<Real> measured = disk;
      if ((count_ == 0 && !begin(contacts)) || !improve()) {
        disk = measured;
        return Verdict::open;
      }
      // No disk does better than the level.
      const Real change = size_of(Real(level_ - before));
      if ((level_ > high && change <= level_ / 64) || has_strayed()) return Verdict::no;
      if (level_ > low && level_ <= high && change <= Real(bound.noise)) break;
      before = level_;
    }
    measure(contacts);
    return worst <= low ? Verdict::yes : Verdict::open;
  }

  /// Moves on until the largest residual is the least, or below `noise`.
  void settle(std::span<const Touch> contacts, double noise) {
    constexpr int most_rounds = 24;
    measure(contacts);
    DiskOf<Real> best = disk;
    Real least = worst;
    for (int round = 0; round < most_rounds && worst > Real(noise); ++round) {
      const Real before = level_;
      if ((count_ == 0 && !begin(contacts)) || !improve()) break;
      measure(contacts);
      if (worst < least) {
        best = disk;
        least = worst;
      }
      const bool has_begun = count_ == 4 && before > 0;
      if (has_begun && size_of(Real(level_ - before)) <= Real(noise)) break;
    }
    disk = best;
    worst = least;
  }

 private:
  /// No disk is that far from the first one, against its radius.
  static constexpr double furthest = 0x1p-7;

  /// The contact of the disk. Of few, each is worked out once for each disk.
  ContactOf<Real> contact(const Touch& i) {
    const auto end = known_.begin() + static_cast<std::ptrdiff_t>(known_count_);
    for (auto known = known_.begin(); known != end; ++known)
      if (known->first == i) return known->second;
    const ContactOf<Real> found = contact_of(sites_, i, disk);
    if (are_few_ && known_count_ < known_.size()) known_[known_count_++] = {i, found};
    return found;
  }
  Real residual(const Touch& i) {
    if constexpr (std::is_same_v<Real, double>)
      if (sites_.exact == nullptr) return residual_of(sites_, i, disk);
    return size_of(contact(i).residual);
  }

  void measure(std::span<const Touch> contacts) {
    are_few_ = contacts.size() <= known_.size();
    worst = 0;
    furthest_ = contacts[0];
    for (const Touch& i : contacts) {
      const Real residual = this->residual(i);
      if (residual <= worst) continue;  // one that is no number is the worst
      worst = residual;
      furthest_ = i;
    }
  }

  /// Begins with three of the contacts, as far apart as they can be found at once, from the one
  /// with the largest residual on: in any order of the contacts with the same, since round vertices
  /// several disks may be better than all beside them. False where a disk in a vertex has no
  /// direction from it.
  bool begin(std::span<const Touch> contacts) {
    const ContactOf<Real> first = contact(furthest_);
    reference_.fill(furthest_);  // where a disk is in a vertex, no other is apart from it
    Real largest(-1);
    Vector<Real> widest{Real(0), Real(0)};
    for (const Touch& i : contacts) {
      const Vector<Real> way = contact(i).toward - first.toward;
      const Real size = dot(way, way);
      if (!(size > largest)) continue;
      largest = size;
      reference_[1] = i;
      widest = way;
    }
    if (!(largest >= 0)) return false;
    largest = -1;
    for (const Touch& i : contacts) {
      const Real size = size_of(cross(widest, contact(i).toward - first.toward));
      if (!(size > largest)) continue;
      largest = size;
      reference_[2] = i;
    }
    if (!(largest >= 0)) return false;
    count_ = 3;
    return true;
  }

  bool has_strayed() const {
    const Vector<Real> way = disk.center - start_.center;
    return !(dot(way, way) <= Real(furthest * furthest) * start_.radius * start_.radius);
  }

  /// Takes the contact with the largest residual into account. False where no next disk is known.
  bool improve() {
    const auto end = reference_.begin() + static_cast<std::ptrdiff_t>(count_);
    if (std::find(reference_.begin(), end, furthest_) == end) exchange();
    if (count_ < 4)
      return move({contact(reference_[0]), contact(reference_[1]), contact(reference_[2])}, {});
    const std::array<ContactOf<Real>, 4> contact = contacts(reference_);
    const Dependency<Real> dependency(contact);
    level_ = size_of(dependency.level);
    // The contact with the largest factor follows from the others, which are far from singular.
    std::size_t last = 0;
    for (std::size_t i = 1; i < 4; ++i)
      if (size_of(dependency.factor[i]) > size_of(dependency.factor[last])) last = i;
    std::array<ContactOf<Real>, 3> others;
    std::array<Real, 3> goal{};
    for (std::size_t i = 0, k = 0; i < 4; ++i) {
      if (i == last) continue;
      others[k] = contact[i];
      goal[k++] = dependency.factor[i] < 0 ? Real(-dependency.level) : dependency.level;
    }
    return move(others, goal);
  }

  std::array<ContactOf<Real>, 4> contacts(const std::array<Touch, 4>& reference) {
    return {contact(reference[0]), contact(reference[1]), contact(reference[2]),
            contact(reference[3])};
  }

  /// The best disk for five contacts is the one for those four of them that ask for the largest
  /// residual.
  void exchange() {
    if (count_ < 4) {
      reference_[count_++] = furthest_;
      return;
    }
    std::array<Touch, 4> best = reference_;
    Real highest(-1);
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<Touch, 4> next = reference_;
      next[i] = furthest_;
      const Real level = size_of(Dependency<Real>(contacts(next)).level);
      if (!(level > highest)) continue;
      highest = level;
      best = next;
    }
    reference_ = best;
  }

  /// Moves to where three residuals have the given values.
  bool move(const std::array<ContactOf<Real>, 3>& contact, const std::array<Real, 3>& goal) {
    const Vector<Real> b = contact[1].toward - contact[0].toward,
                       c = contact[2].toward - contact[0].toward;
    const Real a_change = goal[0] - contact[0].residual;
    const Real db = goal[1] - contact[1].residual - a_change;
    const Real dc = goal[2] - contact[2].residual - a_change;
    const Real area = cross(b, c);
    if (area == 0) return false;
    const Vector<Real> step{(db * c.y - dc * b.y) / area, (b.x * dc - c.x * db) / area};
    const Real growth = dot(contact[0].toward, step) - a_change;
    disk.center = disk.center + step;
    disk.radius += growth;
    keep_contacts(step, growth);
    return disk.radius > 0;
  }

  /// Contacts with segments change by how far a move leads along their normals; others are worked
  /// out again. In double, so are all: the residual would miss how the centre is rounded.
  void keep_contacts(const Vector<Real>& step, const Real& growth) {
    std::size_t kept = 0;
    for (std::size_t k = 0; !std::is_same_v<Real, double> && k < known_count_; ++k) {
      auto& [touch, contact] = known_[k];
      if (sites_.sites[touch.site].is_vertex() || sites_.sites[touch.site].is_arc()) continue;
      contact.residual += dot(contact.toward, step) - growth;
      known_[kept++] = known_[k];
    }
    known_count_ = kept;
  }

  const TieSites& sites_;
  const DiskOf<Real> start_;
  std::array<Touch, 4> reference_{};
  std::size_t count_ = 0;  ///< of the reference
  Real level_{0};
  Touch furthest_;
  std::array<std::pair<Touch, ContactOf<Real>>, 8> known_;
  std::size_t known_count_ = 0;
  bool are_few_ = false;
};

}  // namespace

ContactOf<double> contact_of(const site::Site& site, const Disk& disk) {
  const Vec2 toward = site::outward(site, disk.center);
  return {{toward.x, toward.y}, site::carrier_distance(site, disk.center) - disk.radius};
}

site::Site Touch::seen_from(std::span<const site::Site> sites, Vec2 center) const {
  const site::Site& whole = sites[site];
  if (!whole.is_arc()) return whole;
  double s = part == Part::middle ? 0.5 * whole.length : part == Part::end ? whole.length : 0;
  if (part == Part::site) {
    s = site::foot_parameter(whole, center);
    if (s > 0 && s < whole.length) return whole;
  }
  return site::make_vertex(whole.at(s));
}

namespace {

/// What a distance loses in double.
constexpr double noise_of_double = 0x1p-51;
/// Of twice a double's digits, a distance to a segment's line is a sum of two products of normal
/// and difference, each with seven operations that lose less than 2^-102 of what they compute; the
/// products together are at most the distance to the segment's start, below 12: less than 2^-94. A
/// distance to a vertex has fewer operations; those to flat arcs may lose all digits.
constexpr double noise_of_twofold = 0x1p-90;

/// Asks in these numbers, from a fit's disk on, which moves.
template <class Real, class Ask>
Verdict ask_in(const TieSites& sites, TieFit& fit, const Ask& ask) {
  Exchange<Real> exchange(sites, {exact_vector<Real>(fit.disk.center), Real(fit.disk.radius)});
  const Verdict verdict = ask(exchange);
  fit.disk = rounded(exchange.disk);
  fit.worst = static_cast<double>(exchange.worst);
  return verdict;
}

}  // namespace

bool TieFit::fits(std::span<const Touch> contacts, double bound) {
  const auto judge = [&](double noise) {
    return [=](auto& exchange) { return exchange.judge(contacts, {bound, noise}); };
  };
  Verdict verdict = ask_in<double>(*sites_, *this, judge(noise_of_double));
  if (verdict == Verdict::open && sites_->exact != nullptr) {
    const Disk start = disk;
    if (ranges::none_of(contacts, [&](const Touch& i) { return sites_->sites[i.site].is_arc(); }))
      verdict = ask_in<Twofold>(*sites_, *this, judge(noise_of_twofold));
    if (verdict == Verdict::open) {
      disk = start;
      verdict = ask_in<Precise>(*sites_, *this, judge(0x1p-200));
    }
  }
  return verdict == Verdict::yes || (verdict == Verdict::open && worst <= bound);
}

void TieFit::settle(std::span<const Touch> contacts) {
  const auto settle = [&](double noise) {
    return [=](auto& exchange) {
      exchange.settle(contacts, noise);
      return Verdict::yes;
    };
  };
  if (sites_->exact != nullptr)
    ask_in<Twofold>(*sites_, *this, settle(noise_of_twofold));
  else
    ask_in<double>(*sites_, *this, settle(noise_of_double));
}

}  // namespace medial::disks
