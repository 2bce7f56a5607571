#include "methods/lee/elements.h"

namespace medial::lee {

std::optional<Elements> elements_of(const Problem& problem) {
  const site::SiteNumbers& numbers = problem.numbers();
  Elements elements;
  elements.sites.reserve(numbers.count);
  elements.originals.reserve(numbers.count);
  for (std::size_t l = 0; l < problem.shape.loop_count(); ++l) {
    const site::LoopEdges loop(problem.shape, l, problem.frame);
    const auto is_reflex = [&](std::uint32_t i) { return numbers.is_site(loop.begin() + i); };
    std::uint32_t start = 0;
    while (start < loop.size() && is_reflex(start)) ++start;
    if (start == loop.size()) return std::nullopt;
    const auto first_chain = static_cast<std::uint32_t>(elements.chains.size());
    for (std::uint32_t step = 0, i = start; step < loop.size(); ++step, i = loop.next(i)) {
      const std::uint32_t number = numbers.edge[loop.begin() + i];
      if (is_reflex(i)) {
        elements.sites.push_back(site::make_vertex(loop.local(i)));
        elements.originals.push_back(number - 1);
      } else {
        elements.chains.push_back(elements.size());
      }
      elements.sites.push_back(site::make_segment(loop.local(i), loop.local(loop.next(i))));
      elements.originals.push_back(number);
    }
    elements.loops.push_back({first_chain, static_cast<std::uint32_t>(elements.chains.size()),
                              problem.shape.component[l]});
  }
  elements.chains.push_back(elements.size());
  return elements;
}

}  // namespace medial::lee
