#include "methods/biarc_dc/divide.h"

#include <algorithm>
#include <optional>

#include "base/random.h"

namespace medial::biarc_dc {
namespace {

/// Random disks tried on a sub-shape before all its branchings are.
constexpr int most_tries = 8;

class Divider {
 public:
  Divider(Context& context, std::uint64_t seed) : context_(context), random_(seed) {}

  /// The parts that a disk divides the sub-shape into, all of them smaller; nothing where rounding
  /// leaves no such disk.
  std::optional<std::vector<Subshape>> parts_of(const Subshape& subshape) {
    for (int tries = 0; tries < most_tries; ++tries) {
      const std::optional<Place> place = random_place(subshape);
      if (!place) break;
      const MaximalDisk maximal = maximal_disk(context_, subshape, *place);
      if (auto parts = parts_by(maximal, subshape)) {
        ++division.random_disks;
        return parts;
      }
      if (const auto arc = artificial_arc_behind(maximal, subshape))
        if (auto parts = parts_by_branching(subshape, *arc)) return parts;
    }
    const std::uint32_t begin = random_.below(static_cast<std::uint32_t>(subshape.size()));
    for (std::size_t step = 0, i = begin; step < subshape.size(); ++step, i = subshape.next(i)) {
      if (subshape.elements[i].is_joined()) continue;
      if (auto parts = parts_by_branching(subshape, i)) return parts;
    }
    return std::nullopt;
  }

  Division division;

 private:
  /// A random arc's joint with a reflex vertex, or else its middle; none if there are only reflex
  /// vertices.
  std::optional<Place> random_place(const Subshape& subshape) {
    std::size_t i = random_.below(static_cast<std::uint32_t>(subshape.size()));
    for (std::size_t step = 0; step < subshape.size(); ++step, i = subshape.next(i)) {
      const Element& element = subshape.elements[i];
      if (context_.site(element).is_vertex()) continue;
      const auto has_reflex_end = [&](std::size_t k) {
        const Element& one = subshape.elements[k];
        return one.is_joined() && context_.outline.joints[one.site] == Joint::reflex;
      };
      if (has_reflex_end(i)) return Place{i, true, 0};
      if (has_reflex_end(subshape.before(i))) return Place{subshape.before(i), true, 0};
      return Place{i, false, 0.5 * (element.from + element.to)};
    }
    ++division.only_vertices;
    return std::nullopt;
  }

  /// Splits at a disk; nothing if that does not make all parts smaller.
  std::optional<std::vector<Subshape>> parts_by(const MaximalDisk& maximal,
                                                const Subshape& subshape) {
    const auto found = contacts_of(context_, subshape, maximal);
    const std::vector<Seam> seams = found.value_or(std::vector<Seam>());
    if (found && (seams.empty() || (seams.size() == 1 && seams[0].first == seams[0].last)))
      return std::nullopt;
    const auto disk = static_cast<std::uint32_t>(division.disks.size());
    std::vector<Subshape> parts = split(subshape, seams, disk);
    const std::size_t whole = subshape.measure();
    for (const Subshape& part : parts)
      if (part.measure() >= whole) return std::nullopt;
    division.disks.push_back(maximal.disk);
    division.component.push_back(subshape.component);
    if (seams.size() >= 4) ++division.multi_branchings;
    // An artificial arc beside what is cut out belongs to the same disk.
    for (const Seam& seam : seams)
      for (std::size_t i = seam.last; i != seam.first; i = subshape.next(i))
        if (!subshape.elements[i].is_joined())
          division.equal.push_back({subshape.elements[i].disk_after, disk});
    return parts;
  }

  std::optional<std::vector<Subshape>> parts_by_branching(const Subshape& subshape,
                                                          std::size_t artificial_arc) {
    const auto maximal = branching_disk(context_, subshape, artificial_arc, division.disks);
    if (!maximal) return std::nullopt;
    auto parts = parts_by(*maximal, subshape);
    if (parts) ++division.branching_disks;
    return parts;
  }

  /// The artificial arc between the two elements that a non-reducing disk touches.
  std::optional<std::size_t> artificial_arc_behind(const MaximalDisk& maximal,
                                                   const Subshape& subshape) const {
    if (maximal.contacts.size() != 2) return std::nullopt;
    const std::size_t a = maximal.contacts[0].element, b = maximal.contacts[1].element;
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}})
      if (!subshape.elements[from].is_joined() && subshape.next(from) == to) return from;
    return std::nullopt;
  }

  Context& context_;
  Random random_;
};

}  // namespace

std::optional<Division> divide(Context& context, std::uint64_t seed,
                               const std::atomic<bool>* cancel,
                               const std::function<void(double)>& progress) {
  Divider divider(context, seed);
  Division& division = divider.division;
  const SiteOutline& outline = context.outline;
  std::vector<Subshape> stack;
  for (std::uint32_t c = 0; c < outline.loops.size(); ++c) {
    Subshape& whole = stack.emplace_back();
    whole.component = c;
    for (std::uint32_t i = outline.loops[c].first; i <= outline.loops[c].last; ++i)
      whole.elements.push_back({i, none, 0, outline.sites[i].length});
  }
  constexpr std::size_t report_interval = 4096;
  std::size_t finished = 0;
  while (!stack.empty()) {
    if (cancel != nullptr && cancel->load(std::memory_order_relaxed)) break;
    const Subshape subshape = std::move(stack.back());
    stack.pop_back();
    const auto base = base_shape_of(subshape, outline, division.disks, context.tolerance);
    if (!base) {
      auto parts = divider.parts_of(subshape);
      if (!parts) return std::nullopt;
      std::move(parts->begin(), parts->end(), std::back_inserter(stack));
      continue;
    }
    if (base->base_case == BaseCase::cap)
      ++division.caps;
    else
      division.base_shapes.push_back(*base);
    if (progress && ++finished % report_interval == 0)
      progress(std::min(
          1.0, static_cast<double>(finished) / static_cast<double>(2 * outline.sites.size())));
  }
  return division;
}

}  // namespace medial::biarc_dc
