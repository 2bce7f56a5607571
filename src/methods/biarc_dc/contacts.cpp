#include <algorithm>
#include <cmath>

#include "methods/biarc_dc/maximal_disk.h"

namespace medial::biarc_dc {
namespace {

using site::Site;

/// An element that a disk touches within the tolerance.
struct Touch {
  std::size_t element = 0;
  double parameter = 0;    ///< of the nearest point
  double distance = 0;     ///< to it
  bool on_circle = false;  ///< all of the element lies on the disk's circle
  bool is_sure = false;
};

bool names(const Place& place, std::size_t element, const Subshape& subshape) {
  return element == place.element || (place.at_joint && element == subshape.next(place.element));
}

Seam seam_at(const Subshape& subshape, const Place& place) {
  const std::size_t i = place.element;
  if (!place.at_joint) return {i, i, place.parameter, place.parameter};
  const std::size_t next = subshape.next(i);
  return {i, next, subshape.elements[i].to, subshape.elements[next].from};
}

/// All touched elements in boundary order; those of sure contacts always.
std::vector<Touch> touched_elements(const Context& context, const Subshape& subshape,
                                    const MaximalDisk& maximal) {
  // A disk as large as an arc's circle that touches the arc covers all of it.
  constexpr double same_circle = 1e-7;
  const Disk& disk = maximal.disk;
  const double reach = disk.radius + context.tolerance;
  std::vector<Touch> touches;
  for (std::size_t i = 0; i < subshape.size(); ++i) {
    const Element& element = subshape.elements[i];
    const Site& site = context.site(element);
    const bool is_sure = std::any_of(maximal.contacts.begin(), maximal.contacts.end(),
                                     [&](const Place& place) { return names(place, i, subshape); });
    if (!is_sure && site::squared_distance(site, disk.center) > reach * reach) continue;
    Touch touch{i, 0, 0, false, is_sure};
    if (!site.is_vertex())
      touch.parameter =
          std::clamp(site::foot_parameter(site, disk.center), element.from, element.to);
    touch.distance = distance(site.at(touch.parameter), disk.center);
    if (!is_sure && touch.distance > reach) continue;
    if (std::abs(site.curvature * disk.radius - 1) <= same_circle) {
      const auto on_circle = [&](double s) {
        return std::abs(distance(site.at(s), disk.center) - disk.radius) <= context.tolerance;
      };
      // A disk through both ends only ends beside the centre of the arc.
      touch.on_circle = on_circle(element.from) && on_circle(element.to) &&
                        on_circle(0.5 * (element.from + element.to));
    }
    touches.push_back(touch);
  }
  return touches;
}

/// Where a run of touched elements, joined without a corner, is really touched if no contact is
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
    // A vertex is not nearer than a neighbour that is touched inside, but for rounding.
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

}  // namespace

std::optional<std::vector<Seam>> contacts_of(const Context& context, const Subshape& subshape,
                                             const MaximalDisk& maximal) {
  const std::vector<Touch> touches = touched_elements(context, subshape, maximal);
  const std::size_t count = touches.size();
  const bool all =
      count == subshape.size() &&
      std::all_of(touches.begin(), touches.end(), [](const Touch& t) { return t.on_circle; });
  if (all) return std::nullopt;
  std::vector<Seam> seams;
  if (count == 0) return seams;

  /// Whether a touched element continues the one before in the list.
  const auto continues = [&](std::size_t j) {
    const std::size_t before = subshape.before(touches[j].element);
    return touches[(j + count - 1) % count].element == before &&
           context.joins_smoothly(subshape.elements[before]);
  };
  std::size_t begin = 0;
  while (begin + 1 < count && continues(begin)) ++begin;
  std::vector<const Touch*> run;
  for (std::size_t step = 0; step < count;) {
    run.clear();
    do run.push_back(&touches[(begin + step++) % count]);
    while (step < count && continues((begin + step) % count));

    const auto is_on_circle = [](const Touch* touch) { return touch->on_circle; };
    const auto first_on = std::find_if(run.begin(), run.end(), is_on_circle);
    if (first_on != run.end()) {
      const auto last_on = std::find_if(run.rbegin(), run.rend(), is_on_circle);
      const std::size_t last = subshape.before((*first_on)->element),
                        first = subshape.next((*last_on)->element);
      seams.push_back({last, first, subshape.elements[last].to, subshape.elements[first].from});
      continue;
    }
    const std::size_t before = seams.size();
    for (const Touch* touch : run)
      for (const bool at_joint : {false, true})
        for (const Place& place : maximal.contacts)
          if (place.element == touch->element && place.at_joint == at_joint)
            seams.push_back(seam_at(subshape, place));
    if (seams.size() == before) seams.push_back(contact_in_run(context, subshape, run));
  }
  return seams;
}

}  // namespace medial::biarc_dc
