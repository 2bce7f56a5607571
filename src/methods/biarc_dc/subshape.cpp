#include "methods/biarc_dc/subshape.h"

#include <algorithm>
#include <cmath>

namespace medial::biarc_dc {
namespace {

/// The kind of an element and of what follows it, in three bits. A sub-shape's word consists of the
/// letters of all its elements, after a leading 1.
constexpr std::uint32_t letter(bool is_vertex, char follower) {
  const std::uint32_t after = follower == '|' ? 0 : follower == '-' ? 1 : follower == '^' ? 2 : 3;
  return 4 * (is_vertex ? 1U : 0U) + after;
}

constexpr std::uint32_t word_of(const char* spelling) {
  std::uint32_t word = 1;
  for (; spelling[0] != 0; spelling += 2) word = 8 * word + letter(spelling[0] == 'V', spelling[1]);
  return word;
}

char follower_of(const Element& element, const SiteOutline& outline) {
  if (!element.is_joined()) return '|';
  const Joint joint = outline.joints[element.site];
  return joint == Joint::smooth ? '-' : joint == Joint::reflex ? 'v' : '^';
}

/// The word of a sub-shape, starting at element `begin`.
std::uint32_t word_of(const Subshape& subshape, const SiteOutline& outline, std::size_t begin) {
  std::uint32_t word = 1;
  for (std::size_t step = 0, i = begin; step < subshape.size(); ++step, i = subshape.next(i)) {
    const Element& element = subshape.elements[i];
    const bool is_vertex = outline.sites[element.site].is_vertex();
    word = 8 * word + letter(is_vertex, follower_of(element, outline));
  }
  return word;
}

struct Spelling {
  std::uint32_t word;
  BaseCase base_case;
};
constexpr std::array<Spelling, base_case_count - 1> spellings{{{word_of("S-S|S|"), BaseCase::a},
                                                               {word_of("S|S|"), BaseCase::b},
                                                               {word_of("S|S|S|"), BaseCase::c},
                                                               {word_of("S-S-S|"), BaseCase::d},
                                                               {word_of("S^S|S|"), BaseCase::e},
                                                               {word_of("S^S|V|"), BaseCase::f},
                                                               {word_of("S-S|V|"), BaseCase::g},
                                                               {word_of("S|V|"), BaseCase::h},
                                                               {word_of("V|V|"), BaseCase::i},
                                                               {word_of("S|S|V|"), BaseCase::j},
                                                               {word_of("S|V|V|"), BaseCase::k},
                                                               {word_of("V|V|V|"), BaseCase::l},
                                                               {word_of("S^S|"), BaseCase::m}}};

/// Whether all of a sub-shape is on its only dividing disk, or bends away from it: between two
/// contacts, a boundary turns left by the angle between them.
bool is_cap(const Subshape& subshape, const SiteOutline& outline, const DiskList& disks,
            double tolerance) {
  std::uint32_t disk = none;
  bool is_concave = true, has_corner = false, is_blunt = false;
  for (const Element& element : subshape.elements) {
    if (outline.sites[element.site].curvature > 0) is_concave = false;
    if (element.is_joined()) {
      const Joint joint = outline.joints[element.site];
      has_corner |= joint == Joint::corner;
      is_blunt |= joint == Joint::blunt;
    } else if (disk != none) {
      return false;
    } else {
      disk = element.disk_after;
    }
  }
  if (disk == none) return false;
  if (has_corner) return false;
  if (subshape.size() <= 2) return true;
  if (is_blunt) return false;
  if (is_concave) return true;
  const auto touches = [&](Vec2 p) {
    return std::abs(distance(p, disks[disk].center) - disks[disk].radius) <= tolerance;
  };
  for (std::size_t i = 0; i < subshape.size(); ++i) {
    const Element& one = subshape.elements[i];
    const site::Site& site = outline.sites[one.site];
    if (!(touches(site.at(one.from)) && touches(site.at(0.5 * (one.from + one.to))) &&
          touches(site.at(one.to))) ||
        ends_elsewhere(subshape, outline, i, disks[disk], tolerance))
      return false;
  }
  return true;
}

}  // namespace

bool ends_elsewhere(const Subshape& subshape, const SiteOutline& outline, std::size_t i,
                    const Disk& disk, double tolerance) {
  const site::Site& arc = outline.sites[subshape.elements[i].site];
  if (!(arc.curvature > 0)) return false;
  const auto is_flatter = [&](std::size_t joint, std::size_t neighbor) {
    const Element& element = subshape.elements[joint];
    return element.is_joined() && outline.joints[element.site] == Joint::smooth &&
           outline.sites[subshape.elements[neighbor].site].curvature <= arc.curvature;
  };
  const std::size_t before = subshape.before(i);
  if (!is_flatter(before, before) || !is_flatter(i, subshape.next(i))) return false;
  const Vec2 center = arc.point + (1 / arc.curvature) * arc.normal();
  return squared_norm(center - disk.center) > tolerance * tolerance;
}

std::size_t Subshape::measure() const {
  std::size_t joints = 0;
  for (const Element& element : elements) joints += element.is_joined() ? 1 : 0;
  return elements.size() + joints;
}

std::size_t Subshape::find(std::uint32_t site) const {
  const auto found =
      std::lower_bound(elements.begin(), elements.end(), site,
                       [](const Element& element, std::uint32_t s) { return element.site < s; });
  if (found == elements.end() || found->site != site) return elements.size();
  return static_cast<std::size_t>(found - elements.begin());
}

void Parts::append(const Parts& others) {
  for (std::size_t i = 0; i < others.size(); ++i) {
    begin(others[i].component);
    add(others[i].elements);
  }
}

void split(const Subshape& subshape, std::span<const Seam> seams, std::uint32_t disk,
           Parts& parts) {
  for (std::size_t j = 0; j < seams.size(); ++j) {
    const Seam &begin = seams[j], &end = seams[j + 1 == seams.size() ? 0 : j + 1];
    const std::size_t count = subshape.count(begin.first, end.last);
    parts.begin(subshape.component);
    // If a part passes the end of the list, its elements at the beginning of the list come first.
    const bool wraps = begin.first > end.last;
    if (wraps) parts.add(subshape.elements.first(end.last + 1));
    parts.add(
        subshape.elements.subspan(begin.first, wraps ? subshape.size() - begin.first : count));
    parts.of_last(wraps ? end.last + 1 : 0).from = begin.from;
    Element& last = parts.of_last(wraps ? end.last : count - 1);
    last.to = end.to;
    last.disk_after = disk;
  }
}

const char* name_of(BaseCase base_case) {
  constexpr std::array<const char*, base_case_count> names{"a", "b", "c", "d", "e", "f", "g",
                                                           "h", "i", "j", "k", "l", "m", "cap"};
  return names[static_cast<std::size_t>(base_case)];
}

std::optional<BaseShape> base_shape_of(const Subshape& subshape, const SiteOutline& outline,
                                       const DiskList& disks, double tolerance) {
  BaseShape base;
  base.component = subshape.component;
  if (is_cap(subshape, outline, disks, tolerance)) return base;
  if (subshape.size() > 3) return std::nullopt;
  for (std::size_t begin = 0; begin < subshape.size(); ++begin) {
    const std::uint32_t word = word_of(subshape, outline, begin);
    const auto* const found = std::find_if(spellings.begin(), spellings.end(),
                                           [&](const Spelling& s) { return word == s.word; });
    if (found == spellings.end()) continue;
    base.base_case = found->base_case;
    for (std::size_t step = 0, i = begin; step < subshape.size(); ++step, i = subshape.next(i))
      base.element[step] = subshape.elements[i];
    // Only an arc of locally largest curvature has an end of the axis in its centre.
    const auto curvature = [&](std::size_t i) {
      return outline.sites[base.element[i].site].curvature;
    };
    if (base.base_case == BaseCase::d &&
        !(curvature(1) > std::max({curvature(0), curvature(2), 0.0})))
      return std::nullopt;
    return base;
  }
  return std::nullopt;
}

}  // namespace medial::biarc_dc
