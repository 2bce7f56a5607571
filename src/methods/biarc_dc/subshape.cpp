#include "methods/biarc_dc/subshape.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace medial::biarc_dc {
namespace {

/// The elements with their kinds and what joins them, as BaseCase spells them.
std::string spell(const Subshape& subshape, const SiteOutline& outline, std::size_t begin) {
  std::string word;
  for (std::size_t step = 0, i = begin; step < subshape.size(); ++step, i = subshape.next(i)) {
    const Element& element = subshape.elements[i];
    word += outline.sites[element.site].is_vertex() ? 'V' : 'S';
    if (!element.is_joined()) {
      word += '|';
      continue;
    }
    switch (outline.joints[element.site]) {
      case Joint::smooth:
        word += '-';
        break;
      case Joint::corner:
      case Joint::blunt:
        word += '^';
        break;
      case Joint::reflex:
        word += 'v';
        break;
    }
  }
  return word;
}

struct Spelling {
  const char* word;
  BaseCase base_case;
};
constexpr std::array<Spelling, base_case_count - 1> spellings{{{"S-S|S|", BaseCase::a},
                                                               {"S|S|", BaseCase::b},
                                                               {"S|S|S|", BaseCase::c},
                                                               {"S-S-S|", BaseCase::d},
                                                               {"S^S|S|", BaseCase::e},
                                                               {"S^S|V|", BaseCase::f},
                                                               {"S-S|V|", BaseCase::g},
                                                               {"S|V|", BaseCase::h},
                                                               {"V|V|", BaseCase::i},
                                                               {"S|S|V|", BaseCase::j},
                                                               {"S|V|V|", BaseCase::k},
                                                               {"V|V|V|", BaseCase::l},
                                                               {"S^S|", BaseCase::m}}};

/// Whether all of a sub-shape lies on its only dividing disk, or bends away from it: between two
/// contacts, a boundary turns to the left by the angle between them.
bool is_cap(const Subshape& subshape, const SiteOutline& outline, const std::vector<Disk>& disks,
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
  return std::all_of(subshape.elements.begin(), subshape.elements.end(), [&](const Element& one) {
    const site::Site& site = outline.sites[one.site];
    return touches(site.at(one.from)) && touches(site.at(0.5 * (one.from + one.to))) &&
           touches(site.at(one.to));
  });
}

}  // namespace

std::size_t Subshape::measure() const {
  std::size_t joints = 0;
  for (const Element& element : elements) joints += element.is_joined() ? 1 : 0;
  return elements.size() + joints;
}

std::vector<Subshape> split(const Subshape& subshape, const std::vector<Seam>& seams,
                            std::uint32_t disk) {
  std::vector<Subshape> parts;
  parts.reserve(seams.size());
  const std::size_t n = subshape.size();
  for (std::size_t j = 0; j < seams.size(); ++j) {
    const Seam &begin = seams[j], &end = seams[j + 1 == seams.size() ? 0 : j + 1];
    Subshape& part = parts.emplace_back();
    part.component = subshape.component;
    const std::size_t count = (end.last + n - begin.first) % n + 1;
    part.elements.reserve(count);
    for (std::size_t step = 0, i = begin.first; step < count; ++step, i = subshape.next(i))
      part.elements.push_back(subshape.elements[i]);
    part.elements.front().from = begin.from;
    part.elements.back().to = end.to;
    part.elements.back().disk_after = disk;
  }
  return parts;
}

const char* name_of(BaseCase base_case) {
  constexpr std::array<const char*, base_case_count> names{"a", "b", "c", "d", "e", "f", "g",
                                                           "h", "i", "j", "k", "l", "m", "cap"};
  return names[static_cast<std::size_t>(base_case)];
}

std::optional<BaseShape> base_shape_of(const Subshape& subshape, const SiteOutline& outline,
                                       const std::vector<Disk>& disks, double tolerance) {
  BaseShape base;
  base.component = subshape.component;
  if (is_cap(subshape, outline, disks, tolerance)) return base;
  if (subshape.size() > 3) return std::nullopt;
  for (std::size_t begin = 0; begin < subshape.size(); ++begin) {
    const std::string word = spell(subshape, outline, begin);
    const auto* const found = std::find_if(spellings.begin(), spellings.end(),
                                           [&](const Spelling& s) { return word == s.word; });
    if (found == spellings.end()) continue;
    base.base_case = found->base_case;
    base.size = static_cast<std::uint8_t>(subshape.size());
    for (std::size_t step = 0, i = begin; step < subshape.size(); ++step, i = subshape.next(i))
      base.element[step] = subshape.elements[i];
    // Only an arc of locally maximal curvature has a centre where the axis ends.
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
