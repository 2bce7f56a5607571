#include "methods/biarc_dc/outline.h"

#include "methods/disks/connect.h"

namespace medial::biarc_dc {

SiteOutline outline_of(const Problem& problem, Statistics& statistics) {
  const disks::Boundary boundary = disks::connected_boundary(problem);
  const std::vector<disks::Bridge>& bridges = boundary.bridges;
  statistics.bridges = bridges.size();
  statistics.queries += bridges.size();
  SiteOutline outline;
  outline.sites.reserve(boundary.sites.size());
  outline.joints.reserve(boundary.sites.size());
  outline.disk_after.reserve(boundary.sites.size());
  outline.originals.reserve(boundary.sites.size());
  outline.component.resize(bridges.size());
  for (const disks::Bridge& bridge : bridges) outline.cutting_disks.push_back(bridge.disk);
  for (const disks::Boundary::SiteRange& run : boundary.runs) {
    const auto first = static_cast<std::uint32_t>(outline.sites.size());
    const auto component = static_cast<std::uint32_t>(outline.cycles.size());
    for (std::uint32_t i = run.first; i <= run.last; ++i) {
      if (boundary.elements[i] == disks::Element::bridge) {
        outline.disk_after.back() = boundary.originals[i];
        outline.component[boundary.originals[i]] = component;
        continue;
      }
      const std::uint32_t next = run.after(i);
      const bool beside_vertex = boundary.elements[i] == disks::Element::vertex ||
                                 boundary.elements[next] == disks::Element::vertex;
      outline.sites.push_back(boundary.sites[i]);
      outline.joints.push_back(beside_vertex ? Joint::reflex : boundary.joint(i));
      outline.disk_after.push_back(none);
      outline.originals.push_back(boundary.originals[i]);
    }
    outline.cycles.push_back({first, static_cast<std::uint32_t>(outline.sites.size() - 1)});
  }
  return outline;
}

}  // namespace medial::biarc_dc
