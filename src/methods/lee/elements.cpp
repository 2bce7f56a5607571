#include "methods/lee/elements.h"

#include <algorithm>

#include "methods/checks.h"
#include "methods/disks/connect.h"

namespace medial::lee {
namespace {

void begin_chain(Elements& elements) { elements.chains.push_back(elements.size()); }

void add(Elements& elements, const site::Site& site, std::uint32_t original) {
  elements.sites.push_back(site);
  elements.originals.push_back(original);
}

/// Ends a list, given the chain and the element with which it began.
void end_loop(Elements& elements, std::uint32_t first_chain, std::uint32_t first,
              std::uint32_t component) {
  std::uint32_t size = elements.size() - first;
  for (auto p = elements.passages.rbegin(); p != elements.passages.rend() && p->begin > first; ++p)
    size -= 2;
  elements.loops.push_back(
      {first_chain, static_cast<std::uint32_t>(elements.chains.size()), component, size});
}

/// Adds a loop. Returns false if it has no convex vertex.
bool add_loop(const Problem& problem, std::size_t l, Elements& elements) {
  const site::SiteNumbers& numbers = problem.numbers();
  const site::LoopEdges loop(problem.shape, l, problem.frame);
  const auto is_reflex = [&](std::uint32_t i) { return numbers.is_site(loop.begin() + i); };
  std::uint32_t start = 0;
  while (start < loop.size() && is_reflex(start)) ++start;
  if (start == loop.size()) return false;
  const auto first_chain = static_cast<std::uint32_t>(elements.chains.size());
  const std::uint32_t first = elements.size();
  for (std::uint32_t step = 0, i = start; step < loop.size(); ++step, i = loop.next(i)) {
    const std::uint32_t number = numbers.edge[loop.begin() + i];
    if (is_reflex(i))
      add(elements, site::make_vertex(loop.local(i)), number - 1);
    else
      begin_chain(elements);
    add(elements, site::make_segment(loop.local(i), loop.local(loop.next(i))), number);
  }
  end_loop(elements, first_chain, first, problem.shape.component[l]);
  return true;
}

/// One half of the tangent of a disk at its foot on a site, as long as the disk's radius: the half
/// before the foot or the half after it.
site::Site half_tangent(const Disk& disk, const site::Site& touched, bool is_before) {
  const Vec2 foot = site::foot(touched, disk.center);
  const Vec2 normal = (1 / distance(disk.center, foot)) * (disk.center - foot);
  const Vec2 direction = -left_of(normal);
  return {is_before ? foot - disk.radius * direction : foot, direction, disk.radius};
}

void add_passage(const disks::Boundary& boundary, std::uint32_t i, Elements& elements) {
  const std::uint32_t bridge = boundary.originals[i];
  const Disk& disk = boundary.bridges[bridge].disk;
  add(elements, half_tangent(disk, boundary.sites[i - 1], false), none);
  elements.passages.push_back({elements.size(), bridge});
  elements.disks_of_passages.push_back(disk);
  begin_chain(elements);
  add(elements, half_tangent(disk, boundary.sites[i + 1], true), none);
}

Beside beside_of(const disks::Boundary& boundary, std::uint32_t before, std::uint32_t after) {
  if (boundary.elements[before] == disks::Element::bridge ||
      boundary.elements[after] == disks::Element::bridge)
    return Beside::no;
  if (boundary.elements[before] != boundary.elements[after]) return Beside::smooth;
  const site::Joint joint = boundary.joint(before);
  return joint == site::Joint::smooth  ? Beside::smooth
         : joint == site::Joint::blunt ? Beside::blunt
                                       : Beside::no;
}

/// Adds how consecutive elements of a run join, for a shape with arcs.
void add_joints(const disks::Boundary& boundary, const disks::Boundary::SiteRange& run,
                std::uint32_t first, Elements& elements) {
  elements.joints.resize(elements.size(), Beside::no);
  elements.around.resize(elements.size(), Beside::no);
  std::uint32_t element = first;
  for (std::uint32_t i = run.first; i < run.last; ++i) {
    elements.joints[element] = beside_of(boundary, i, i + 1);
    element += boundary.elements[i] == disks::Element::bridge ? 2 : 1;
  }
  elements.around[first] = elements.around[element] = beside_of(boundary, run.last, run.first);
}

/// Whether a chain begins at an element that is not the first of its list. False after a bridge.
bool begins_chain(const disks::Boundary& boundary, std::uint32_t i) {
  if (boundary.elements[i - 1] == disks::Element::bridge) return false;
  return boundary.is_corner(i - 1) || beside_of(boundary, i - 1, i) == Beside::blunt ||
         std::max(boundary.sites[i - 1].curvature, boundary.sites[i].curvature) > 0;
}

/// Adds all components, with their holes.
void add_connected(const Problem& problem, Elements& elements) {
  const disks::Boundary boundary = disks::connected_boundary(problem);
  std::uint32_t component = 0;
  for (const disks::Boundary::SiteRange& run : boundary.runs) {
    const auto first_chain = static_cast<std::uint32_t>(elements.chains.size());
    const std::uint32_t first = elements.size();
    for (std::uint32_t i = run.first; i <= run.last; ++i) {
      if (boundary.elements[i] == disks::Element::bridge) {
        add_passage(boundary, i, elements);
        continue;
      }
      if (i == run.first || begins_chain(boundary, i)) begin_chain(elements);
      add(elements, boundary.sites[i], boundary.originals[i]);
    }
    end_loop(elements, first_chain, first, component++);
    if (boundary.has_arcs) add_joints(boundary, run, first, elements);
  }
}

}  // namespace

std::optional<Elements> elements_of(const Problem& problem) {
  const Shape& shape = problem.shape;
  Elements elements;
  elements.sites.reserve(problem.numbers().count);
  elements.originals.reserve(problem.numbers().count);
  // Without holes and arcs, each vertex that is not a site begins a chain.
  elements.chains.reserve(2 * shape.points.size() - problem.numbers().count + 1);
  if (shape.hole_count() > 0 || has_arcs(shape))
    add_connected(problem, elements);
  else
    for (std::size_t l = 0; l < shape.loop_count(); ++l)
      if (!add_loop(problem, l, elements)) return std::nullopt;
  begin_chain(elements);
  return elements;
}

}  // namespace medial::lee
