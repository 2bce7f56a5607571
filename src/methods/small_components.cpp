#include "methods/small_components.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

#include "axis/statistics.h"
#include "base/numbers.h"
#include "base/threads.h"
#include "base/tolerance.h"
#include "methods/checks.h"
#include "methods/disks/disks.h"
#include "methods/table.h"
#include "methods/whole_part.h"

namespace medial {
namespace {

using Loops = LoopsBySize::Loops;

/// The longer side of a box, which mirror images and quarter turns share.
double longer_side(const Box& box) {
  return std::max(box.high.x - box.low.x, box.high.y - box.low.y);
}

/// A shape of some components, in order.
Shape shape_of(const Shape& whole, const Loops& loops) {
  Shape shape;
  shape.loop_begin.push_back(0);
  for (const std::uint32_t loop : loops) {
    const std::uint32_t begin = whole.loop_begin[loop], end = whole.loop_begin[loop + 1];
    shape.points.insert(shape.points.end(), &whole.points[begin],
                        &whole.points[begin] + (end - begin));
    shape.sources.insert(shape.sources.end(), &whole.sources[begin],
                         &whole.sources[begin] + (end - begin));
    shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
    shape.hole.push_back(whole.hole[loop]);
  }
  std::vector<std::uint32_t> numbers;  // of the components
  for (const std::uint32_t loop : loops) numbers.push_back(whole.component[loop]);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  for (const std::uint32_t loop : loops)
    shape.component.push_back(static_cast<std::uint32_t>(
        std::lower_bound(numbers.begin(), numbers.end(), whole.component[loop]) - numbers.begin()));
  return shape;
}

/// A problem that consists of some components of another problem, whose numbers must be known.
class Piece {
 public:
  Piece(const Problem& whole, const Loops& loops, std::function<void(double)> progress)
      : options_(whole.options), shape_(shape_of(whole.shape, loops)), problem_(shape_, options_) {
    options_.progress = std::move(progress);
    component_.resize(shape_.component_count());
    names_.resize(problem_.numbers().count);
    for (std::size_t i = loops.size(), end = names_.size(); i-- > 0;) {
      component_[shape_.component[i]] = whole.shape.component[loops[i]];
      const std::uint32_t begin = first_site(problem_, i);
      std::iota(names_.begin() + begin, names_.begin() + static_cast<std::ptrdiff_t>(end),
                first_site(whole, loops[i]));
      end = begin;
    }
  }
  Piece(const Piece&) = delete;
  Piece& operator=(const Piece&) = delete;

  const Problem& problem() const { return problem_; }

  /// The number of a site in the whole problem.
  std::uint32_t site(std::uint32_t own) const { return names_[own]; }
  /// Replaces the component numbers of nodes by those of the whole problem.
  void name_components(std::vector<Node>& nodes) const {
    for (Node& node : nodes) node.component = component_[node.component];
  }

 private:
  static std::uint32_t first_site(const Problem& problem, std::size_t loop) {
    return problem.numbers().first(problem.shape.loop_begin[loop]);
  }

  Options options_;
  Shape shape_;
  Problem problem_;
  std::vector<std::uint32_t> component_;  ///< the whole's number of each component
  std::vector<std::uint32_t> names_;      ///< the whole's number of each site
};

std::size_t points_of(const Shape& shape, const Loops& loops) {
  std::size_t points = 0;
  for (const std::uint32_t loop : loops) points += shape.loop(loop).size();
  return points;
}

/// The end of the next batch of small components: it begins at `begin` and has at least `points`
/// points, or ends with the last component.
std::size_t end_of_batch(const Shape& shape, const LoopsBySize& loops, std::size_t begin,
                         std::size_t points) {
  std::size_t end = begin;
  for (std::size_t count = 0; end < loops.small.size() && count < points; ++end)
    count += points_of(shape, loops.small[end]);
  return end;
}

/// Computes the small components in batches, several at the same time. Calls take(piece, outcome,
/// batch) for each component of a batch, in order, and then use(batch) for each batch, in order.
template <class Batch, class Take, class Use>
Status run_small(const Problem& problem, const LoopsBySize& loops, const Take& take,
                 const Use& use) {
  const MethodRow& method = solver_of(problem.options);
  constexpr std::size_t of_batch = 1 << 11;  // points; the work of a thread at a time
  constexpr std::size_t together = 1 << 7;   // batches in memory at the same time
  std::size_t done = points_of(problem.shape, loops.large);
  for (std::size_t begin = 0; begin < loops.small.size();) {
    std::vector<std::size_t> bounds{begin};
    while (bounds.size() <= together && bounds.back() < loops.small.size())
      bounds.push_back(end_of_batch(problem.shape, loops, bounds.back(), of_batch));
    std::vector<Batch> batches(bounds.size() - 1);
    std::vector<std::optional<Error>> errors(batches.size());
    parallel_for(batches.size(), [&](std::size_t b) {
      for (std::size_t i = bounds[b]; i < bounds[b + 1] && !problem.is_cancelled(); ++i) {
        const Piece piece(problem, loops.small[i], nullptr);
        auto outcome = method.run(piece.problem());
        if (!outcome) {
          errors[b] = std::move(outcome).error();
          return;
        }
        take(piece, *std::move(outcome), batches[b]);
      }
    });
    for (std::size_t b = 0; b < batches.size(); ++b) {
      if (problem.is_cancelled()) return success();
      if (errors[b]) return *std::move(errors[b]);
      if (Status used = use(std::move(batches[b])); !used) return used;
    }
    for (std::size_t i = begin; i < bounds.back(); ++i)
      done += points_of(problem.shape, loops.small[i]);
    begin = bounds.back();
    if (problem.options.progress)
      problem.options.progress(static_cast<double>(done) /
                               static_cast<double>(problem.shape.points.size()));
  }
  return success();
}

/// The progress of the large components: a share of the whole progress.
std::function<void(double)> progress_of_large(const Problem& problem, const LoopsBySize& loops) {
  if (!problem.options.progress) return nullptr;
  const double share = static_cast<double>(points_of(problem.shape, loops.large)) /
                       static_cast<double>(problem.shape.points.size());
  return [&problem, share](double done) { problem.options.progress(share * done); };
}

/// The axes of several components together.
struct Sum {
  MedialAxis axis;
  bool to_check = false;  ///< see Outcome
};

void append(Sum&& part, Sum& sum) {
  sum.to_check = sum.to_check || part.to_check;
  MedialAxis &from = part.axis, &to = sum.axis;
  if (to.nodes.empty()) {
    to = std::move(from);
    return;
  }
  const auto nodes = static_cast<std::uint32_t>(to.nodes.size());
  for (Edge& edge : from.edges)
    for (std::uint32_t& node : edge.node) node += nodes;
  to.nodes.insert(to.nodes.end(), from.nodes.begin(), from.nodes.end());
  to.edges.insert(to.edges.end(), from.edges.begin(), from.edges.end());
  to.tolerance = std::max(to.tolerance, from.tolerance);
  to.statistics += from.statistics;
}

/// Appends the axis of a piece, with the whole's numbers.
void append(const Piece& piece, Outcome&& outcome, Sum& sum) {
  piece.name_components(outcome.axis.nodes);
  for (Edge& edge : outcome.axis.edges)
    for (std::uint32_t& site : edge.site) site = piece.site(site);
  append({std::move(outcome.axis), outcome.to_check}, sum);
}

}  // namespace

std::optional<LoopsBySize> small_components(const Problem& problem) {
  constexpr double small_share = 0x1p-10;
  constexpr std::size_t most_points = 1 << 16;  // a larger component is handed out while it grows
  const Shape& shape = problem.shape;
  const Options& options = problem.options;
  if (shape.component_count() < 2 || options.tolerance > 0 || has_arcs(shape) ||
      info_of(options.method).sampling != Sampling::curves)
    return std::nullopt;
  const double least = small_share * longer_side(problem.box);
  LoopsBySize loops;
  std::vector<std::uint32_t> place(shape.component_count(),
                                   none);  // index of each component in loops.small
  std::vector<std::size_t> points(shape.component_count());
  for (std::size_t i = 0; i < shape.loop_count(); ++i)
    points[shape.component[i]] += shape.loop(i).size();
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    if (shape.hole[i]) continue;
    Box box = Box::nothing();
    for (const Vec2 p : shape.loop(i)) box.add(p);
    if (!(longer_side(box) < least && points[shape.component[i]] <= most_points &&
          tolerance_for(box, 0) < problem.tolerance))
      continue;
    place[shape.component[i]] = static_cast<std::uint32_t>(loops.small.size());
    loops.small.emplace_back();
  }
  if (loops.small.empty()) return std::nullopt;
  for (std::uint32_t i = 0; i < shape.loop_count(); ++i) {
    const std::uint32_t own = place[shape.component[i]];
    (own == none ? loops.large : loops.small[own]).push_back(i);
  }
  return loops;
}

Result<Outcome> run_divided(const Problem& problem, const LoopsBySize& loops) {
  problem.numbers();  // several threads use them from here on
  Sum sum;
  if (!loops.large.empty()) {
    const Piece piece(problem, loops.large, progress_of_large(problem, loops));
    auto outcome = solver_of(problem.options).run(piece.problem());
    if (!outcome || problem.is_cancelled()) return outcome;
    append(piece, *std::move(outcome), sum);
  }
  const Status small = run_small<Sum>(
      problem, loops,
      [](const Piece& piece, Outcome&& outcome, Sum& batch) {
        append(piece, std::move(outcome), batch);
      },
      [&](Sum&& batch) {
        append(std::move(batch), sum);
        return success();
      });
  if (!small) return small.error();
  sum.axis.sites = problem.result_sites();
  return Outcome{std::move(sum.axis), sum.to_check};
}

Result<std::optional<MedialAxis>> run_divided_in_parts(const Problem& problem,
                                                       const LoopsBySize& loops,
                                                       const AxisSink& sink) {
  problem.numbers();
  std::uint32_t nodes = 0;  // in all parts so far
  const auto name = [](const Piece& piece, AxisPart& part) {
    piece.name_components(part.axis.nodes);
    for (std::uint32_t& site : part.sites) site = piece.site(site);
  };
  const auto hand_out = [&](AxisPart&& part) {
    nodes += static_cast<std::uint32_t>(part.nodes.size() - part.known);
    return sink(std::move(part));
  };
  std::optional<MedialAxis> rest;
  if (!loops.large.empty()) {
    const Piece piece(problem, loops.large, progress_of_large(problem, loops));
    auto large = disks::run_in_parts(piece.problem(), [&](AxisPart&& part) {
      name(piece, part);
      return hand_out(std::move(part));
    });
    if (!large || !*large || problem.is_cancelled()) return large;
    rest = std::move(*large);
  }
  struct OfPiece {
    AxisPart part;
    MedialAxis rest;
  };
  using Batch = std::vector<OfPiece>;
  const Status small = run_small<Batch>(
      problem, loops,
      [&](const Piece& piece, Outcome&& outcome, Batch& batch) {
        AxisPart part = whole_part(outcome.axis);
        name(piece, part);
        batch.push_back({std::move(part), std::move(outcome.axis)});
      },
      [&](Batch&& batch) -> Status {
        for (auto& [part, rest_of_part] : batch) {
          part.begins = nodes == 0;
          for (std::uint32_t& node : part.nodes) node += nodes;
          if (rest) {
            rest->tolerance = std::max(rest->tolerance, rest_of_part.tolerance);
            rest->statistics += rest_of_part.statistics;
          } else {
            rest = std::move(rest_of_part);
          }
          if (Status taken = hand_out(std::move(part)); !taken) return taken;
        }
        return success();
      });
  if (!small) return small.error();
  return rest;
}

}  // namespace medial
