#include "medial/prune.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "axis/curve.h"
#include "axis/node_kinds.h"
#include "base/numbers.h"
#include "medial/query.h"
#include "ops/importance.h"
#include "ops/trees.h"

namespace medial {
namespace {

struct Named {
  PruneMeasure measure;
  const char* name;
  double threshold;
};
constexpr std::array<Named, 12> measures = [] {
  using enum PruneMeasure;
  return std::array<Named, 12>{{
      {prominence, "prominence", 0.25},
      {significance, "significance", 0.3},
      {length, "length", 1.5},
      {ratio, "ratio", 1.5},
      {radius, "radius", 0.1},
      {angle, "angle", 100},
      {erosion, "erosion", 0.1},
      {potential, "potential", 0.1},
      {residual, "residual", 0.1},
      {area, "area", 0.005},
      {lambda, "lambda", 0.1},
      {scale, "scale-axis", 1.3},
  }};
}();

const Named& named(PruneMeasure measure) { return measures[static_cast<std::size_t>(measure)]; }

/// Where in [low, high] a measure reaches the threshold, which it has at `high`. Halving asks the
/// same points whatever the threshold, so that a larger one never gives a lower place.
double crossing_of(const ops::Importance& importance, std::uint32_t edge, double low, double high,
                   double threshold) {
  constexpr int halvings = 44;  // to a few units in the last place of lengths along the edge
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (importance.reaches(edge, middle, threshold) ? high : low) = middle;
  }
  return high;
}

}  // namespace

const char* name_of(PruneMeasure measure) { return named(measure).name; }

const std::vector<PruneMeasure>& prune_measures() {
  static const std::vector<PruneMeasure> all = [] {
    std::vector<PruneMeasure> list;
    for (const Named& one : measures) list.push_back(one.measure);
    return list;
  }();
  return all;
}

std::optional<PruneMeasure> prune_measure_from(std::string_view name) {
  for (const Named& one : measures)
    if (name == one.name) return one.measure;
  return std::nullopt;
}

double default_threshold(PruneMeasure measure) { return named(measure).threshold; }

struct PruneOrder::Parts {
  const MedialAxis& axis;
  ops::Trees trees;
  ops::Importance importance;
  bool whole = false;  ///< edges stay or go as a whole
  /// Of each edge: at its inner end, and at its outer one.
  std::vector<double> inner, outer;

  Parts(const MedialAxis& of, PruneMeasure measure, bool tips)
      : axis(of),
        trees(of),
        importance(of, trees, measure, tips),
        whole(tips || importance.of_branches()),
        inner(of.edges.size(), infinity),
        outer(of.edges.size(), infinity) {
    if (!importance.of_branches()) rise();
    if (whole) spread(tips);
  }

  std::uint32_t end_of(std::uint32_t e, bool outer_end) const {
    const int out = trees.outer_end(axis, e);
    return axis.edges[e].node[static_cast<std::size_t>(outer_end ? out : 1 - out)];
  }

  /// From the ends inwards: never less than anything beyond.
  void rise() {
    std::vector<double> beyond(axis.nodes.size(), 0);
    for (const std::uint32_t e : trees.order) {
      double most = std::max(beyond[end_of(e, true)], importance.at(e, 0));
      outer[e] = most;
      for (int k = 1; k <= importance.steps(); ++k)
        most = std::max(most, importance.at(e, static_cast<double>(k) / importance.steps()));
      inner[e] = most;
      double& next = beyond[end_of(e, false)];
      next = std::max(next, most);
    }
  }

  /// From the core outwards: what belongs together has one value, that where it begins.
  void spread(bool tips) {
    const std::vector<std::uint32_t> degree = degrees_of(axis);
    std::vector<std::uint32_t> farthest;
    if (tips) {
      farthest.assign(axis.nodes.size(), none);
      std::vector<double> most(axis.nodes.size(), -1);
      for (const std::uint32_t e : trees.order) {
        const std::uint32_t node = end_of(e, false);
        const double reach = importance.reach(e);
        if (reach <= most[node]) continue;
        most[node] = reach;
        farthest[node] = e;
      }
    }
    for (auto e = trees.order.rbegin(); e != trees.order.rend(); ++e) {
      const std::uint32_t node = end_of(*e, false), before = trees.inwards[node];
      const bool goes_on = before != none && (tips ? farthest[node] == *e : degree[node] == 2);
      if (goes_on) {
        inner[*e] = inner[before];
      } else if (importance.of_branches()) {
        inner[*e] = importance.at(*e, 1);
        if (before != none) inner[*e] = std::min(inner[*e], inner[before]);
      }
    }
    outer = inner;
  }

  /// The part of an edge that stays, as a range of s from its outer end. Requires that some does.
  double begin_of(std::uint32_t e, double threshold) const {
    if (outer[e] >= threshold) return 0;
    // The same points as in rise().
    const int steps = importance.steps();
    for (int k = 1; k <= steps; ++k) {
      const double high = static_cast<double>(k) / steps;
      if (k < steps && !importance.reaches(e, high, threshold)) continue;
      return crossing_of(importance, e, static_cast<double>(k - 1) / steps, high, threshold);
    }
    return 0;
  }
};

PruneOrder::PruneOrder(const MedialAxis& axis, PruneMeasure measure, bool tips)
    : parts_(std::make_shared<Parts>(axis, measure, tips)) {}

double PruneOrder::of_edge(std::uint32_t edge) const { return parts_->inner[edge]; }

std::vector<PathPiece> PruneOrder::parts(double threshold) const {
  const Parts& p = *parts_;
  std::vector<PathPiece> kept;
  for (std::uint32_t e = 0; e < p.axis.edges.size(); ++e) {
    if (!(p.inner[e] >= threshold)) continue;
    const double begin = p.begin_of(e, threshold);
    PathPiece part{e, 0, 1};
    if (begin > 0)
      (p.trees.outer_end(p.axis, e) == 0 ? part.from : part.to) =
          p.trees.outer_end(p.axis, e) == 0 ? begin : 1 - begin;
    kept.push_back(part);
  }
  return kept;
}

MedialAxis PruneOrder::at(double threshold) const {
  const Parts& p = *parts_;
  const MedialAxis& axis = p.axis;
  MedialAxis out;
  out.method = axis.method;
  out.tolerance = axis.tolerance;
  out.resolution = axis.resolution;
  out.exterior = axis.exterior;
  out.sites = axis.sites;
  out.statistics = axis.statistics;
  // A node stays where the way inwards stays at its end; a cut takes the place of the outer node.
  constexpr std::uint32_t gone = 0xFFFFFFFF;
  std::vector<std::uint32_t> index(axis.nodes.size(), gone);
  for (std::uint32_t i = 0; i < axis.nodes.size(); ++i) {
    const std::uint32_t e = p.trees.inwards[i];
    if (e != none && !(p.inner[e] >= threshold)) continue;
    index[i] = static_cast<std::uint32_t>(out.nodes.size());
    out.nodes.push_back(axis.nodes[i]);
  }
  for (const PathPiece& part : parts(threshold)) {
    Edge edge = axis.edges[part.edge];
    if (part.from > 0 || part.to < 1) {
      const Curve curve = curve_of(axis, edge).part(part.from, part.to);
      edge.control = {curve.origin + curve.p1, curve.r1};
      edge.weight = curve.weight;
      Node& cut = out.nodes[index[edge.node[part.from > 0 ? 0 : 1]]];
      cut.disk = part.from > 0 ? Disk{curve.origin, curve.r0} : Disk{curve.end, curve.r2};
    }
    for (std::uint32_t& node : edge.node) node = index[node];
    out.edges.push_back(edge);
  }
  set_node_kinds(out);
  return out;
}

std::uint64_t PruneOrder::branches_at(double threshold) const {
  const Parts& p = *parts_;
  return branch_count(p.axis, [&](std::uint32_t edge) { return p.inner[edge] >= threshold; });
}

std::uint64_t PruneOrder::cuts_at(double threshold) const {
  std::uint64_t cuts = 0;
  for (std::size_t e = 0; e < parts_->inner.size(); ++e)
    cuts += parts_->inner[e] >= threshold && !(parts_->outer[e] >= threshold) ? 1 : 0;
  return cuts;
}

double PruneOrder::threshold_of(std::uint64_t branches) const {
  // The count changes only where an edge goes; a larger threshold never has more.
  std::vector<double> values;
  for (const double value : parts_->inner)
    if (value < infinity) values.push_back(value);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  const auto above = [&](std::size_t i) {
    return i == 0 ? 0.0 : std::nextafter(values[i - 1], infinity);
  };
  std::size_t low = 0, high = values.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (branches_at(above(middle)) <= branches) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return above(low);
}

Result<MedialAxis> prune(const MedialAxis& axis, const PruneOptions& options, PruneReport* report) {
  if (options.threshold && options.keep)
    return Error{ErrorCode::invalid_option,
                 "a pruning threshold and a number of branches to keep exclude each other",
                 {}};
  if (options.threshold && !(*options.threshold >= 0))
    return Error{ErrorCode::invalid_option, "a pruning threshold must not be negative", {}};
  const PruneOrder order(axis, options.measure, options.tips);
  const double threshold = options.keep
                               ? order.threshold_of(*options.keep)
                               : options.threshold.value_or(default_threshold(options.measure));
  MedialAxis pruned = order.at(threshold);
  if (report != nullptr) {
    *report = {};
    report->threshold = threshold;
    report->edges_before = axis.edges.size();
    report->edges = pruned.edges.size();
    report->branches_before = order.branches_at(0);
    report->branches = order.branches_at(threshold);
    report->cuts = order.cuts_at(threshold);
  }
  return pruned;
}

}  // namespace medial
