#include "methods/biarc_dc/outline.h"

namespace medial::biarc_dc {

SiteOutline outline_of(const Problem& problem) {
  const site::SiteNumbers& numbers = problem.numbers();
  SiteOutline outline;
  outline.sites.reserve(numbers.count);
  outline.joints.reserve(numbers.count);
  outline.originals.reserve(numbers.count);
  const auto add = [&](const site::Site& site, std::uint32_t original, Joint joint) {
    outline.sites.push_back(site);
    outline.originals.push_back(original);
    outline.joints.push_back(joint);
  };
  for (std::size_t l = 0; l < problem.shape.loop_count(); ++l) {
    const site::LoopEdges loop(problem.shape, l, problem.frame);
    const auto first = static_cast<std::uint32_t>(outline.sites.size());
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t number = numbers.edge[loop.begin() + i];
      if (numbers.is_site(loop.begin() + i))
        add(site::make_vertex(loop.local(i)), number - 1, Joint::reflex);
      const site::Pieces pieces = loop.edge(i);
      if (pieces.count == 2) add(pieces.first(), number, Joint::smooth);
      add(pieces.last(), number, numbers.joints[loop.begin() + loop.next(i)]);
    }
    outline.loops.push_back({first, static_cast<std::uint32_t>(outline.sites.size() - 1)});
  }
  return outline;
}

}  // namespace medial::biarc_dc
