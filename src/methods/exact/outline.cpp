#include "methods/exact/outline.h"

#include <cmath>

#include "methods/checks.h"
#include "site/smooth_place.h"

namespace medial::exact {

namespace {

double curvature_of(const ExactSite& edge) { return curvature({edge.start, edge.end, edge.bulge}); }

/// By which way the boundary turns from one edge to the next: 1 to the left, 0 not at all.
int turn_between(const ExactSite& before, const ExactSite& after) {
  return cross(normal_of<Rational>(before, true), normal_of<Rational>(after, false)).sign();
}

ExactSite edge_of(const site::LoopEdges& loop, std::uint32_t i) {
  return {loop.local(i), loop.local(loop.next(i)), loop.bulge(i)};
}

/// The site of that number.
ExactSite site_of(const Problem& problem, const site::SiteNumbers& numbers, std::uint32_t site) {
  // The share of the points before it is about that of the sites.
  const double share = static_cast<double>(site) / numbers.count;
  const auto about = static_cast<std::size_t>(share * static_cast<double>(numbers.edge.size()));
  const std::size_t point = site::point_of(numbers, site, about);
  const medial::Site found = site::result_site(problem.shape, numbers, site, point);
  return {problem.frame.to_local(found.start), problem.frame.to_local(found.end), found.bulge};
}

}  // namespace

bool by_second(const ExactSite& first, const ExactSite& second) {
  return site::by_second(site::pieces_of(first.start, first.end, first.bulge).last(),
                         site::pieces_of(second.start, second.end, second.bulge).first());
}

bool is_wide(Vec2 a, Vec2 b) {
  const auto is_tiny = [](double apart) { return apart != 0 && std::abs(apart) < 0x1p-100; };
  return is_tiny(a.x) || is_tiny(a.y) || is_tiny(b.x - a.x) || is_tiny(b.y - a.y);
}

SiteLoops outline_of(const Problem& problem, const site::SiteNumbers& numbers) {
  SiteLoops outline;
  outline.sites.work_out = [&problem, &numbers](std::uint32_t site) {
    return site_of(problem, numbers, site);
  };
  outline.passes.assign(numbers.count, false);
  outline.has_arcs = has_arcs(problem.shape);
  for (std::size_t l = 0; l < problem.shape.loop_count(); ++l) {
    const site::LoopEdges loop(problem.shape, l, problem.frame);
    outline.loop_begin.push_back(numbers.first(loop.begin()));
    Vec2 here = loop.local(0);
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      const std::size_t point = loop.begin() + i, after = loop.begin() + loop.next(i);
      const std::uint32_t edge = numbers.edge[point];
      if (loop.size() == 1) continue;  // a lone point has no edge
      const Vec2 there = loop.local(loop.next(i));
      outline.is_wide = outline.is_wide || is_wide(here, there);
      here = there;
      if (numbers.is_site(point)) outline.passes[edge - 1] = true;
      const site::Joint joint = numbers.joints[after];
      outline.passes[edge] = joint == site::Joint::smooth || joint == site::Joint::reflex;
    }
  }
  outline.loop_begin.push_back(numbers.count);
  return outline;
}

PartedNumbers parted_numbers(const Problem& problem, const site::SiteNumbers& whole,
                             const std::vector<bool>& components) {
  using site::Joint;
  PartedNumbers parted{whole, {}, {}};
  site::SiteNumbers& numbers = parted.numbers;
  std::vector<std::uint32_t> flatter(numbers.joints.size()), before_blunt;
  for (std::size_t l = 0; l < problem.shape.loop_count(); ++l) {
    const site::LoopEdges loop(problem.shape, l, problem.frame);
    const bool is_parted = components[problem.shape.component[l]];
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t before = loop.begin() + loop.before(i), point = loop.begin() + i;
      flatter[point] = whole.edge[point];
      if (numbers.joints[point] != Joint::smooth || !is_parted) continue;
      const ExactSite first = edge_of(loop, loop.before(i)), second = edge_of(loop, i);
      const int turn = turn_between(first, second);
      if (turn != 0) numbers.joints[point] = turn > 0 ? Joint::blunt : Joint::reflex;
      if (turn > 0) before_blunt.push_back(before);
      if (curvature_of(first) < curvature_of(second)) flatter[point] = whole.edge[before];
    }
  }
  site::count_sites(problem.shape, numbers);
  parted.names.resize(numbers.count);
  parted.ends_smooth.assign(numbers.count, false);
  for (const std::uint32_t point : before_blunt) parted.ends_smooth[numbers.edge[point]] = true;
  for (std::size_t point = 0; point < numbers.joints.size(); ++point) {
    const std::uint32_t edge = numbers.edge[point];
    if (edge < numbers.count) parted.names[edge] = whole.edge[point];
    if (numbers.is_site(point))
      parted.names[edge - 1] = whole.is_site(point) ? whole.edge[point] - 1 : flatter[point];
  }
  return parted;
}

}  // namespace medial::exact
