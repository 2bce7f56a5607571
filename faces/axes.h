#pragma once

// What the bindings of Python and of JavaScript share: options by name, lines along boundaries and
// axes, stored axes. `Named` moves values by their names into variables: named.take("step", step).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "medial/medial.h"

namespace medial::faces {

inline Error no_such(const std::string& what, const std::string& name, const std::string& names) {
  return {ErrorCode::invalid_option, what + " is one of " + names + ", not '" + name + "'", {}};
}

inline Result<RepairRule> repair_from(const std::string& name) {
  if (name == "make_valid") return RepairRule::make_valid;
  if (name == "even_odd") return RepairRule::even_odd;
  if (name == "non_zero") return RepairRule::non_zero;
  return no_such("repair", name, "make_valid, even_odd, non_zero");
}

// take_own() reads the options that one method alone has. Errors: invalid_option.

template <class Named>
Status take_own(Named&, method::Disks&) {
  return success();
}
template <class Named>
Status take_own(Named&, method::Lee&) {
  return success();
}
template <class Named>
Status take_own(Named&, method::Auto&) {
  return success();
}
template <class Named>
Status take_own(Named& named, method::BiarcDc& own) {
  named.take("seed", own.seed);
  return success();
}
template <class Named>
Status take_own(Named& named, method::Ridge& own) {
  std::string search = "tree", rule = "crossing";
  named.take("resolution", own.grid.resolution).take("pixels", own.grid.pixels);
  named.take("collinear", own.collinear).take("search", search).take("rule", rule);
  own.sorted_list = search == "sorted-list";
  own.rule = rule == "difference" ? RidgeRule::difference : RidgeRule::crossing;
  if (search != "tree" && !own.sorted_list) return no_such("search", search, "tree, sorted-list");
  if (rule != "crossing" && rule != "difference")
    return no_such("rule", rule, "crossing, difference");
  return success();
}
template <class Named>
Status take_own(Named& named, method::Brushfire& own) {
  std::string family = name_of(own.family);
  named.take("resolution", own.grid.resolution).take("pixels", own.grid.pixels);
  named.take("family", family);
  const auto found = brushfire_from(family);
  if (!found) return no_such("family", family, "sequential, sides, marking, simultaneous");
  own.family = *found;
  return success();
}
template <class Named>
Status take_own(Named& named, method::Potential& own) {
  std::optional<std::array<double, 2>> start;
  std::optional<std::array<double, 4>> within;
  named.take("order", own.order).take("base_order", own.base_order).take("step", own.step);
  named.take("coarse", own.coarse).take("angle", own.angle).take("movement", own.movement);
  named.take("start", start).take("within", within);
  if (start) own.from = Vec2{(*start)[0], (*start)[1]};
  if (within) own.within = Box{{(*within)[0], (*within)[1]}, {(*within)[2], (*within)[3]}};
  return success();
}
template <class Named>
Status take_own(Named& named, method::CurveAxis& own) {
  named.take("step", own.step).take("first_maximum", own.first_maximum).take("fit", own.fit);
  return success();
}
/// The same for a method that is chosen already.
template <class Named>
Status take_own(Named& named, Method& method) {
  return std::visit([&](auto& own) { return take_own(named, own); }, method);
}

/// Appends a ring's points, closed, with arcs as chords.
inline void add_outline(const Ring& ring, double chord, std::vector<Vec2>& points) {
  ToolPath path;
  for (std::size_t k = 0; k <= ring.points.size(); ++k) {
    const std::size_t at = k % ring.points.size();
    path.points.push_back({ring.points[at], 0, ring.bulges.empty() ? 0 : ring.bulges[at]});
  }
  path.points.back().bulge = 0;
  for (const ToolPoint& point : without_arcs(path, chord)) points.push_back(point.point);
}

/// Whether sample_by_chord() certainly returns nothing but the two nodes: half of what it allows.
inline bool is_one_chord(const MedialAxis& axis, const Edge& edge, double chord) {
  const Disk &a = axis.nodes[edge.node[0]].disk, &b = axis.nodes[edge.node[1]].disk;
  const Vec2 bend = (a.center - edge.control.center) + (b.center - edge.control.center);
  const double radius_bend = (a.radius - edge.control.radius) + (b.radius - edge.control.radius);
  return edge.weight == 1 && std::max(norm(bend), std::abs(radius_bend)) <= 2 * chord;
}

/// Appends polylines along all branches, within a chord or, where it is above 0, with steps; and
/// where each ends.
template <class Count>
void add_lines(const MedialAxis& axis, double chord, double step, std::vector<Disk>& disks,
               std::vector<Count>& begin) {
  for (const Branch& branch : branches(axis)) {
    const std::size_t start = disks.size();
    for (const Step& piece : branch.steps) {
      const Edge& edge = axis.edges[piece.edge];
      const bool first = disks.size() == start;
      if (!(step > 0) && is_one_chord(axis, edge, chord)) {
        if (first) disks.push_back(axis.nodes[edge.node[piece.forward ? 0 : 1]].disk);
        disks.push_back(axis.nodes[edge.node[piece.forward ? 1 : 0]].disk);
        continue;
      }
      std::vector<Disk> samples =
          step > 0 ? sample_by_step(axis, edge, step) : sample_by_chord(axis, edge, chord);
      if (!piece.forward) std::reverse(samples.begin(), samples.end());
      disks.insert(disks.end(), samples.begin() + (first ? 0 : 1), samples.end());
    }
    begin.push_back(static_cast<Count>(disks.size()));
  }
}

/// An axis whose arrays come from outside. Errors: malformed, where they do not fit together.
inline Result<MedialAxis> sound(MedialAxis axis) {
  const auto finite = [](const Disk& disk) {
    return std::isfinite(disk.center.x) && std::isfinite(disk.center.y) &&
           std::isfinite(disk.radius);
  };
  const auto good_node = [&](const Node& node) {
    return finite(node.disk) && node.disk.radius >= 0 && node.kind <= NodeKind::branching;
  };
  const auto good_edge = [&](const Edge& edge) {
    const auto known = [&](std::uint32_t site) {
      return site < axis.sites.size() || site == no_site;
    };
    return edge.node[0] < axis.nodes.size() && edge.node[1] < axis.nodes.size() &&
           known(edge.site[0]) && known(edge.site[1]) && finite(edge.control) && edge.weight > 0 &&
           std::isfinite(edge.weight);
  };
  if (!std::all_of(axis.nodes.begin(), axis.nodes.end(), good_node) ||
      !std::all_of(axis.edges.begin(), axis.edges.end(), good_edge))
    return Error{ErrorCode::malformed, "the arrays of the axis do not fit together", {}};
  return axis;
}

}  // namespace medial::faces
