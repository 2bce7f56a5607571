#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "methods/biarc_dc/maximal_disk.h"
#include "methods/disks/boundary.h"

namespace medial::biarc_dc {
namespace {

using site::Site;

bool names(const Place& place, std::size_t element, const Subshape& subshape) {
  return element == place.element || (place.at_joint && element == subshape.next(place.element));
}

Seam seam_at(const Subshape& subshape, const Place& place) {
  const std::size_t i = place.element;
  if (!place.at_joint) return {i, i, place.parameter, place.parameter};
  const std::size_t next = subshape.next(i);
  return {i, next, subshape.elements[i].to, subshape.elements[next].from};
}

/// How a disk touches an element, or none if it is further away than the tolerance.
std::optional<Touch> touch_of(const Context& context, const Subshape& subshape, std::size_t i,
                              const MaximalDisk& maximal) {
  // A disk that has an arc's radius and touches the arc covers all of it.
  constexpr double same_circle = 1e-7;
  const Disk& disk = maximal.disk;
  // If a disk misses an element by e, and the gap closes c times as fast as the disk moves, the
  // disk that touches it is e / c further on. Both may be one if that is less than sqrt(tolerance *
  // radius) (see join_ties()). With this e, that holds for c above 1/11; from a radius of 128
  // tolerances on, e is the tolerance.
  constexpr double share = 0x1p-7;
  const double reach = disk.radius + std::clamp(std::sqrt(share * context.tolerance * disk.radius),
                                                context.rounding(), context.tolerance);
  const Element& element = subshape.elements[i];
  const Site& site = context.site(element);
  const auto contacts = maximal.contacts();
  const bool is_sure = std::any_of(contacts.begin(), contacts.end(),
                                   [&](const Place& place) { return names(place, i, subshape); });
  const auto is_beyond = [&] {
    return is_far(site, disk.center, reach) ||
           site::squared_distance(site, disk.center) > reach * reach;
  };
  // A disk that touches the end of an edge touches the vertex there.
  const auto ends_at_vertex = [&](double s) {
    const Element& before = subshape.elements[subshape.before(i)];
    return (s <= 0 && before.is_joined() && context.site(before).is_vertex()) ||
           (s >= site.length && element.is_joined() &&
            context.site(subshape.elements[subshape.next(i)]).is_vertex());
  };
  // A disk touches an arc at a convex joint only if it touches the arc's circle there, too.
  const auto ends_at_corner = [&](const Touch& touch) {
    const Element& before = subshape.elements[subshape.before(i)];
    const bool is_convex =
        (touch.parameter <= 0 && before.is_joined() && !context.joins_smoothly(before)) ||
        (touch.parameter >= site.length && element.is_joined() && !context.joins_smoothly(element));
    return site.is_arc() && is_convex &&
           std::abs(site::carrier_distance(site, disk.center) - disk.radius) > reach - disk.radius;
  };
  if (!is_sure && is_beyond()) return std::nullopt;
  Touch touch{i, 0, 0, false};
  if (!site.is_vertex()) {
    const double s = site::foot_parameter(site, disk.center);
    if (!is_sure && ends_at_vertex(s)) return std::nullopt;
    touch.parameter = std::clamp(s, element.from, element.to);
  }
  touch.distance = distance(site.at(touch.parameter), disk.center);
  if (!is_sure && (touch.distance > reach || ends_at_corner(touch))) return std::nullopt;
  if (std::abs(site.curvature * disk.radius - 1) <= same_circle) {
    const auto on_circle = [&](double s) {
      return std::abs(distance(site.at(s), disk.center) - disk.radius) <= context.tolerance;
    };
    // A disk that passes through both ends only has its centre next to that of the arc.
    touch.on_circle = on_circle(element.from) && on_circle(element.to) &&
                      on_circle(0.5 * (element.from + element.to));
  }
  return touch;
}

/// Finds all touched elements in boundary order; always includes those of known contacts.
void find_touched(Context& context, const Subshape& subshape, const MaximalDisk& maximal,
                  std::vector<Touch>& touches) {
  touches.clear();
  const auto look_at = [&](std::size_t i) {
    if (const auto touch = touch_of(context, subshape, i, maximal)) touches.push_back(*touch);
  };
  if (subshape.size() <= most_scanned) {
    for (std::size_t i = 0; i < subshape.size(); ++i) look_at(i);
    return;
  }
  constexpr double a_little_more = 1 + 0x1p-40;
  context.tree.within(maximal.disk.center,
                      a_little_more * (maximal.disk.radius + context.tolerance),
                      subshape.elements.front().site, subshape.elements.back().site, context.found);
  for (const Place& place : maximal.contacts())
    for (const std::size_t i : {place.element, subshape.next(place.element)})
      if (names(place, i, subshape)) context.found.push_back(subshape.elements[i].site);
  std::sort(context.found.begin(), context.found.end());
  context.found.erase(std::unique(context.found.begin(), context.found.end()), context.found.end());
  for (const std::uint32_t site : context.found)
    if (const std::size_t i = subshape.find(site); i < subshape.size()) look_at(i);
}

/// The contact in a run of touched elements that are joined without a corner, if no contact is
/// sure: in a reflex vertex or inside the nearest element, or else at a joint.
Seam contact_in_run(const Context& context, const Subshape& subshape,
                    const std::vector<const Touch*>& run) {
  const auto is_vertex = [&](const Touch& touch) {
    return context.site(subshape.elements[touch.element]).is_vertex();
  };
  const auto is_inside = [&](const Touch& touch) {
    const Element& element = subshape.elements[touch.element];
    return !is_vertex(touch) && touch.parameter > element.from && touch.parameter < element.to;
  };
  const Touch* nearest = nullptr;
  for (std::size_t j = 0; j < run.size(); ++j) {
    const Touch& touch = *run[j];
    const Element& element = subshape.elements[touch.element];
    const bool has_before = j > 0, has_after = j + 1 < run.size();
    // A vertex counts as further away than a neighbour that is touched inside: rounding decides
    // between them.
    const bool at_joint = is_vertex(touch) ? (has_before && is_inside(*run[j - 1])) ||
                                                 (has_after && is_inside(*run[j + 1]))
                                           : (has_before && touch.parameter <= element.from) ||
                                                 (has_after && touch.parameter >= element.to);
    if (!at_joint && (nearest == nullptr || touch.distance < nearest->distance)) nearest = &touch;
  }
  if (nearest != nullptr) return seam_at(subshape, {nearest->element, false, nearest->parameter});
  for (std::size_t j = 0; j + 1 < run.size(); ++j)
    if (run[j]->parameter >= subshape.elements[run[j]->element].to)
      return seam_at(subshape, {run[j]->element, true, 0});
  return seam_at(subshape, {run[0]->element, false, run[0]->parameter});
}

/// Of the copies of a reflex vertex, and of the edges that end there, keeps only the one whose
/// range of directions contains the disk.
void drop_other_copies(Context& context, const Subshape& subshape, Vec2 center,
                       const DiskList& disks, std::vector<Seam>& seams) {
  constexpr double same_place = 16;  // tolerances
  const auto point_of = [&](std::size_t i, double parameter) {
    return context.site(subshape.elements[i]).at(parameter);
  };
  const auto is_other = [&](const Seam& seam) {
    if (seam.first != seam.last) return false;
    const Site& site = context.site(subshape.elements[seam.first]);
    if (seam.to > 0 && seam.to < site.length) return false;
    const Vec2 point = point_of(seam.last, seam.to);
    const auto is_here = [&](Vec2 p) {
      return distance(p, point) <= same_place * context.tolerance;
    };
    const auto here = std::count_if(seams.begin(), seams.end(), [&](const Seam& one) {
      return is_here(point_of(one.last, one.to)) || is_here(point_of(one.first, one.from));
    });
    if (here < 2) return false;
    return site.is_vertex() ? !faces(context, subshape, seam.first, center, disks)
                            : !disks::faces_edge(site, center);
  };
  context.seams.clear();
  std::remove_copy_if(seams.begin(), seams.end(), std::back_inserter(context.seams), is_other);
  if (context.seams.size() < seams.size()) seams = context.seams;
}

}  // namespace

bool find_contacts(Context& context, const Subshape& subshape, const MaximalDisk& maximal,
                   const DiskList& disks, std::vector<Seam>& seams) {
  seams.clear();
  std::vector<Touch>& touches = context.touches;
  find_touched(context, subshape, maximal, touches);
  const std::size_t count = touches.size();
  const bool all =
      count == subshape.size() &&
      std::all_of(touches.begin(), touches.end(), [](const Touch& t) { return t.on_circle; });
  if (all) return false;
  if (count == 0) return true;

  /// Whether a touched element continues the previous one in the list.
  const auto continues = [&](std::size_t j) {
    const std::size_t before = subshape.before(touches[j].element);
    return touches[j == 0 ? count - 1 : j - 1].element == before &&
           context.joins_smoothly(subshape.elements[before]);
  };
  std::size_t begin = 0;
  while (begin + 1 < count && continues(begin)) ++begin;
  std::vector<const Touch*>& run = context.run;
  for (std::size_t step = 0; step < count;) {
    run.clear();
    do run.push_back(&touches[(begin + step++) % count]);
    while (step < count && continues((begin + step) % count));

    const auto is_on_circle = [](const Touch* touch) { return touch->on_circle; };
    const auto first_on = std::find_if(run.begin(), run.end(), is_on_circle);
    const bool ends = std::none_of(run.begin(), run.end(), [&](const Touch* touch) {
      return ends_elsewhere(subshape, context.outline, touch->element, maximal.disk,
                            context.tolerance);
    });
    if (first_on != run.end() && ends) {
      const auto last_on = std::find_if(run.rbegin(), run.rend(), is_on_circle);
      const std::size_t last = subshape.before((*first_on)->element),
                        first = subshape.next((*last_on)->element);
      seams.push_back({last, first, subshape.elements[last].to, subshape.elements[first].from});
      continue;
    }
    const std::size_t before = seams.size();
    for (const Touch* touch : run)
      for (const bool at_joint : {false, true})
        for (const Place& place : maximal.contacts())
          if (place.element == touch->element && place.at_joint == at_joint)
            seams.push_back(seam_at(subshape, place));
    if (seams.size() == before) seams.push_back(contact_in_run(context, subshape, run));
  }
  if (seams.size() > 1) drop_other_copies(context, subshape, maximal.disk.center, disks, seams);
  return true;
}

}  // namespace medial::biarc_dc
