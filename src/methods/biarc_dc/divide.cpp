#include "methods/biarc_dc/divide.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

#include "axis/statistics.h"
#include "base/random.h"
#include "base/threads.h"

namespace medial::biarc_dc {
namespace {

/// The number of random disks tried on a small sub-shape before all its branchings.
constexpr int most_tries = 8;

/// A cut of a large sub-shape is accepted if no part has more than this share of it.
constexpr double most_share = 0.75;

/// One task divides a sub-shape of at most this many elements completely.
constexpr std::size_t task_size = 4096;

/// A disk, its contacts, and the largest part: from one seam to the next.
struct Cut {
  MaximalDisk maximal;
  std::vector<Seam> seams;
  std::size_t heaviest = 0;
  std::size_t weight = 0;

  const Seam& begin() const { return seams[heaviest]; }
  const Seam& end() const { return seams[heaviest + 1 == seams.size() ? 0 : heaviest + 1]; }
  Gate gate() const { return {begin().first, end().last, maximal.disk}; }
};

/// Divides a list of sub-shapes into base cases.
class Divider {
 public:
  /// `earlier` are the dividing disks around the list.
  Divider(const Context& shared, std::span<const Disk> earlier, std::uint64_t seed)
      : context_(shared), random_(seed), disks_{earlier, {}} {
    context_.statistics = {};
  }

  /// Divides the last sub-shape of the list until the list is empty. Returns false if rounding
  /// leaves a sub-shape that no disk divides.
  bool divide(Parts& list, const std::atomic<bool>* cancel) {
    while (!list.empty()) {
      if (cancel != nullptr && cancel->load(std::memory_order_relaxed)) return true;
      if (!cut(list.back())) return false;
      list.pop_back();
      list.append(parts_);
    }
    return true;
  }
  /// Divides a sub-shape once, into parts(); a base case has none. Returns false as divide() does.
  bool cut(const Subshape& subshape) {
    parts_.clear();
    const auto base = base_shape_of(subshape, context_.outline, disks_, context_.tolerance);
    if (base && base->base_case == BaseCase::cap) {
      ++division.caps;
    } else if (base) {
      division.base_shapes.push_back(*base);
    } else if (find_parts(subshape)) {
      division.divided_elements += subshape.size();
    } else {
      const Element& element = subshape.elements.front();
      stuck = context_.site(element).at(element.from);
      return false;
    }
    return true;
  }
  const Parts& parts() const { return parts_; }

  /// The result, after everything is divided.
  Division division;
  std::optional<Vec2> stuck;  ///< a place of a sub-shape that no disk divides
  std::vector<Disk>& disks() { return disks_.own; }
  const Statistics& statistics() const { return context_.statistics; }

 private:
  /// Finds the parts into which a disk divides the sub-shape, all of them smaller. Returns false if
  /// rounding leaves no such disk.
  bool find_parts(const Subshape& subshape) {
    if (subshape.size() > most_scanned) {
      const Cut cut = balanced_cut(subshape);
      if (cut.seams.size() > 1 && divides(cut.maximal.disk, subshape, cut.seams)) {
        ++(cut.maximal.count == 3 ? division.branching_disks : division.random_disks);
        return true;
      }
    }
    for (int tries = 0; tries < most_tries; ++tries) {
      const std::optional<Place> place = random_place(subshape);
      if (!place) break;
      const MaximalDisk maximal = maximal_disk(context_, subshape, *place, disks_);
      if (divides(maximal, subshape)) {
        ++division.random_disks;
        return true;
      }
      const auto arc = artificial_arc_behind(maximal, subshape);
      if (arc && divides_by_branching(subshape, *arc)) return true;
    }
    const std::uint32_t begin = random_.below(static_cast<std::uint32_t>(subshape.size()));
    for (std::size_t step = 0, i = begin; step < subshape.size(); ++step, i = subshape.next(i))
      if (!subshape.elements[i].is_joined() && divides_by_branching(subshape, i)) return true;
    return false;
  }

  /// The paper's cut and walk: takes the most balanced of some random disks, and walks from there
  /// along the axis into the largest part, until no part is too large. Expected O(sqrt n) disks.
  Cut balanced_cut(const Subshape& subshape) {
    const auto most = static_cast<std::size_t>(most_share * static_cast<double>(subshape.size()));
    const auto tries = static_cast<int>(0.25 * std::sqrt(static_cast<double>(subshape.size())));
    Cut best{{}, {}, 0, subshape.size() + 1};
    for (int i = 0; i < tries && best.weight > most; ++i) {
      const std::optional<Place> place = random_place(subshape);
      if (!place) break;
      Cut cut = cut_by(maximal_disk(context_, subshape, *place, disks_), subshape);
      if (cut.seams.size() > 1 && cut.weight < best.weight) best = std::move(cut);
    }
    while (best.weight > most) {
      const auto gate = best.seams.empty() ? some_gate(subshape) : best.gate();
      const auto next = gate ? branching_disk(context_, subshape, *gate, disks_) : std::nullopt;
      if (!next) break;
      Cut cut = cut_by(*next, subshape);
      if (cut.seams.size() < 2 || cut.weight >= best.weight) break;
      best = std::move(cut);
    }
    return best;
  }

  Cut cut_by(const MaximalDisk& maximal, const Subshape& subshape) {
    Cut cut{maximal, {}, 0, 0};
    if (!find_contacts(context_, subshape, maximal, disks_, cut.seams)) cut.seams.clear();
    for (std::size_t j = 0; j < cut.seams.size(); ++j) {
      const Seam& end = cut.seams[j + 1 == cut.seams.size() ? 0 : j + 1];
      const std::size_t weight = subshape.count(cut.seams[j].first, end.last);
      if (weight <= cut.weight) continue;
      cut.weight = weight;
      cut.heaviest = j;
    }
    return cut;
  }

  /// A gate from a random artificial arc into the sub-shape.
  std::optional<Gate> some_gate(const Subshape& subshape) {
    std::size_t i = random_.below(static_cast<std::uint32_t>(subshape.size()));
    for (std::size_t step = 0; step < subshape.size(); ++step, i = subshape.next(i))
      if (!subshape.elements[i].is_joined()) return gate_after(subshape, i);
    return std::nullopt;
  }
  Gate gate_after(const Subshape& subshape, std::size_t i) const {
    return {subshape.next(i), i, disks_[subshape.elements[i].disk_after]};
  }

  /// The joint of a random arc with a reflex vertex, or else its middle. None if there are only
  /// reflex vertices.
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

  bool divides(const MaximalDisk& maximal, const Subshape& subshape) {
    if (find_contacts(context_, subshape, maximal, disks_, seams_)) {
      if (seams_.empty() || (seams_.size() == 1 && seams_[0].first == seams_[0].last)) return false;
    } else {
      seams_.clear();
    }
    return divides(maximal.disk, subshape, seams_);
  }

  /// Splits at a disk. Returns false, and keeps the sub-shape whole, if this does not make all
  /// parts smaller.
  bool divides(const Disk& disk, const Subshape& subshape, const std::vector<Seam>& seams) {
    const auto number = static_cast<std::uint32_t>(disks_.earlier.size() + disks_.own.size());
    parts_.clear();
    split(subshape, seams, number, parts_);
    // All joints of a part are joints of the whole.
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (parts_[i].size() >= subshape.size() && parts_[i].measure() >= subshape.measure())
        return false;
    disks_.own.push_back(disk);
    division.component.push_back(subshape.component);
    if (seams.size() >= 4) ++division.multi_branchings;
    // An artificial arc inside a seam that is cut out belongs to the same disk.
    for (const Seam& seam : seams)
      for (std::size_t i = seam.last; i != seam.first; i = subshape.next(i))
        if (!subshape.elements[i].is_joined())
          division.equal.push_back({subshape.elements[i].disk_after, number});
    return true;
  }

  bool divides_by_branching(const Subshape& subshape, std::size_t artificial_arc) {
    const auto maximal =
        branching_disk(context_, subshape, gate_after(subshape, artificial_arc), disks_);
    if (!maximal || !divides(*maximal, subshape)) return false;
    ++division.branching_disks;
    return true;
  }

  /// The artificial arc between the two elements that a disk touches, if the disk does not reduce
  /// the sub-shape.
  std::optional<std::size_t> artificial_arc_behind(const MaximalDisk& maximal,
                                                   const Subshape& subshape) const {
    if (maximal.count != 2) return std::nullopt;
    const std::size_t a = maximal.place[0].element, b = maximal.place[1].element;
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}})
      if (!subshape.elements[from].is_joined() && subshape.next(from) == to) return from;
    return std::nullopt;
  }

  Context context_;
  Random random_;
  DiskList disks_;
  Parts parts_;              ///< of the last division
  std::vector<Seam> seams_;  ///< of the last disk
};

Parts whole_shape(const SiteOutline& outline) {
  Parts parts;
  for (std::uint32_t c = 0; c < outline.cycles.size(); ++c) {
    parts.begin(c);
    for (std::uint32_t i = outline.cycles[c].first; i <= outline.cycles[c].last; ++i)
      parts.add({i, outline.disk_after[i], 0, outline.sites[i].length});
  }
  return parts;
}

/// Maps the disks of a task that follow the first `known` ones to the list of all disks.
struct Renumbering {
  std::size_t known;
  std::uint32_t shift;
  void operator()(std::uint32_t& disk) const {
    if (disk != none && disk >= known) disk += shift;
  }
};

/// Appends the result of a task.
void append(Division& part, const std::vector<Disk>& disks, const Renumbering& renumber,
            Division& all) {
  for (auto& [one, other] : part.equal) {
    renumber(one);
    renumber(other);
  }
  for (BaseShape& base : part.base_shapes)
    for (Element& element : base.element) renumber(element.disk_after);
  const auto add = [](const auto& more, auto& to) {
    to.insert(to.end(), more.begin(), more.end());
  };
  add(disks, all.disks);
  add(part.component, all.component);
  add(part.equal, all.equal);
  add(part.base_shapes, all.base_shapes);
  all.caps += part.caps;
  all.random_disks += part.random_disks;
  all.branching_disks += part.branching_disks;
  all.multi_branchings += part.multi_branchings;
  all.only_vertices += part.only_vertices;
  all.divided_elements += part.divided_elements;
}

/// The beginnings of lists of about task_size elements, and the end.
std::vector<std::size_t> task_begins(const Parts& parts) {
  std::vector<std::size_t> begins{0};
  std::size_t elements = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    elements += parts[i].size();
    if (elements < task_size && i + 1 < parts.size()) continue;
    begins.push_back(i + 1);
    elements = 0;
  }
  return begins;
}

/// Divides parts in parallel, each with its own random numbers.
class Round {
 public:
  Round(Context& context, Division& all, std::size_t count)
      : context_(context), all_(all), known_(all.disks), tasks_(count) {}

  /// Calls divide(divider, task) for each task. Returns false if a task fails; later tasks may then
  /// be skipped, but none before it, so that the reported place does not depend on the threads.
  template <class Divide>
  bool run(std::uint64_t seed, const Divide& divide) {
    std::atomic<std::size_t> failed = tasks_.size();
    parallel_for(tasks_.size(), [&](std::size_t t) {
      std::size_t first = failed;
      if (t > first) return;
      Divider& divider = tasks_[t].emplace(context_, known_, Random(seed + t).next());
      if (divide(divider, t)) return;
      while (t < first && !failed.compare_exchange_weak(first, t)) {
      }
    });
    if (failed == tasks_.size()) return true;
    context_.stuck = tasks_[failed]->stuck;
    return false;
  }
  /// Appends the results of all tasks, and calls take(parts, renumbering) for each.
  template <class Take>
  void collect(const Take& take) {
    for (auto& task : tasks_) {
      const Renumbering renumber{known_.size(),
                                 static_cast<std::uint32_t>(all_.disks.size() - known_.size())};
      append(task->division, task->disks(), renumber, all_);
      context_.statistics += task->statistics();
      take(task->parts(), renumber);
    }
  }

 private:
  Context& context_;
  Division& all_;
  const std::vector<Disk> known_;
  std::vector<std::optional<Divider>> tasks_;
};

}  // namespace

std::optional<Division> divide(Context& context, std::uint64_t seed, const Options& options) {
  const SiteOutline& outline = context.outline;
  Division all;
  all.disks = outline.cutting_disks;
  all.component = outline.component;

  Parts large, small;
  const auto take = [&](const Parts& parts, const Renumbering& renumber) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      Parts& to = parts[i].size() > task_size ? large : small;
      to.begin(parts[i].component);
      to.add(parts[i].elements);
      for (std::size_t k = 0; k < parts[i].size(); ++k) renumber(to.of_last(k).disk_after);
    }
  };
  const auto is_cancelled = [&] { return options.cancel != nullptr && options.cancel->load(); };
  take(whole_shape(outline), {0, 0});
  while (!large.empty() && !is_cancelled()) {
    const Parts parts = std::exchange(large, {});
    Round round(context, all, parts.size());
    if (!round.run(seed, [&](Divider& divider, std::size_t t) { return divider.cut(parts[t]); }))
      return std::nullopt;
    seed += parts.size();
    round.collect(take);
  }

  const std::vector<std::size_t> begins = task_begins(small);
  std::atomic<std::size_t> finished = 0;
  Round round(context, all, begins.size() - 1);
  const bool divided = round.run(seed, [&](Divider& divider, std::size_t t) {
    Parts list;
    for (std::size_t i = begins[t]; i < begins[t + 1]; ++i) {
      list.begin(small[i].component);
      list.add(small[i].elements);
    }
    const bool done = divider.divide(list, options.cancel);
    if (options.progress)
      options.progress(static_cast<double>(++finished) / static_cast<double>(begins.size() - 1));
    return done;
  });
  if (!divided) return std::nullopt;
  round.collect([](const Parts&, const Renumbering&) {});
  return all;
}

}  // namespace medial::biarc_dc
