#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "methods/exact/site_form.h"
#include "methods/problem.h"

namespace medial::exact {

/// Sites by their numbers, worked out at each question: few of them are ever asked for.
struct SiteList {
  std::function<ExactSite(std::uint32_t)> work_out;
  ExactSite operator[](std::uint32_t i) const { return work_out(i); }
};

/// Of two edges that join smoothly, whether the normal of the second one counts for both.
bool by_second(const ExactSite& first, const ExactSite& second);

/// The boundary as loops of sites, numbered as in MedialAxis::sites.
struct SiteLoops {
  SiteList sites;
  /// The site that follows on the loop; empty: the next number, after a loop's last its first one.
  std::vector<std::uint32_t> next;
  /// Whether a foot can pass on from the site to the next one: at a reflex vertex's ends and at a
  /// smooth joint, but not at a corner, nor at a blunt joint: there disks touch the edges on both
  /// sides as well, only that no edge of the axis leads there.
  std::vector<bool> passes;
  std::vector<std::uint32_t> loop_begin;  ///< first site of each loop, and the number of all sites
  bool has_arcs = false;                  ///< joints may be smooth only to rounding
  /// Whether coordinates, or their differences between neighbours, are so small beside the size
  /// that Precise numbers do not hold them, and Wide ones are asked instead.
  bool is_wide = false;

  std::uint32_t next_of(std::uint32_t site) const {
    if (!next.empty()) return next[site];
    const auto end = std::upper_bound(loop_begin.begin(), loop_begin.end(), site);
    return site + 1 == *end ? *(end - 1) : site + 1;
  }
  /// The site before it on the loop, where `next` is empty.
  std::uint32_t before(std::uint32_t site) const {
    const auto end = std::upper_bound(loop_begin.begin(), loop_begin.end(), site);
    return site == *(end - 1) ? *end - 1 : site - 1;
  }
  bool joined(std::uint32_t site, std::uint32_t after) const {
    return passes[site] && next_of(site) == after;
  }
  /// The disks that touch the boundary where `site` ends and the next one begins: on the normal of
  /// the edge that ends there, or, after a vertex and by by_second(), of the edge that begins. So
  /// where two edges join smoothly only to rounding, the normal of one counts for both.
  template <class Number>
  Spoke<Number> spoke_after(std::uint32_t site) const {
    const ExactSite own = sites[site], after = sites[next_of(site)];
    if (own.is_vertex() || (has_arcs && !after.is_vertex() && by_second(own, after)))
      return spoke_of<Number>(after, false);
    return spoke_of<Number>(own, true);
  }
};

/// Whether 256 bits do not hold a point, or by how much two points differ, beside 1: with the
/// product of two lengths of 2^-100, 56 bits of it are left.
bool is_wide(Vec2 a, Vec2 b);

/// `numbers`: the problem's, or those of parted_numbers(). Both must outlive it.
SiteLoops outline_of(const Problem& problem, const site::SiteNumbers& numbers);

/// Sites that are numbered by joints as they stand: what counts as smooth is blunt where the
/// boundary turns to the left, and where it turns to the right the vertex is a site.
struct PartedNumbers {
  site::SiteNumbers numbers;
  /// What the axis calls each site: a vertex that counts as smooth has the name of an edge there.
  std::vector<std::uint32_t> names;
  std::vector<bool> ends_smooth;  ///< of each site: an edge that ends in a blunt joint of this kind
};
/// Of the sites that are numbered as `whole`, which need not be the problem's own. `components`:
/// those whose joints are parted.
PartedNumbers parted_numbers(const Problem& problem, const site::SiteNumbers& whole,
                             const std::vector<bool>& components);

}  // namespace medial::exact
