#include "ops/routes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "axis/curve.h"
#include "axis/steps.h"
#include "base/compat.h"
#include "base/numbers.h"
#include "base/quadrature.h"

namespace medial {
namespace ops {
namespace {

/// The integral of ds / r by Gauss and Legendre's rule of three points: the radius of an edge is
/// that of nearly the same disks, or the cost is large anyway.
double room_cost(const MedialAxis& axis, const PathPiece& piece) {
  const Curve curve = curve_of(axis, axis.edges[piece.edge]);
  const double middle = 0.5 * (piece.from + piece.to), half = 0.5 * (piece.to - piece.from);
  double sum = 0;
  for (const auto& [place, weight] : gauss3) {
    const double t = middle + half * place;
    const double speed = norm(curve.velocity(t));
    if (speed > 0) sum += weight * speed / curve.at(t).radius;
  }
  return std::abs(half) * sum;
}

}  // namespace

double cost_of(const MedialAxis& axis, const PathPiece& piece, Route route) {
  if (route == Route::roomy) return room_cost(axis, piece);
  const Curve curve = curve_of(axis, axis.edges[piece.edge]);
  return std::abs(curve.length(piece.to) - curve.length(piece.from));
}

void Search::run(std::span<const Start> starts) {
  for (const std::uint32_t node : reached_) {
    cost_[node] = std::numeric_limits<double>::infinity();
    via_[node] = none;
  }
  reached_.clear();
  for (const Start& start : starts) {
    if (!(start.cost < cost_[start.node])) continue;
    cost_[start.node] = start.cost;
    heap_.emplace(start.cost, start.node);
  }
  while (!heap_.empty()) {
    const auto [cost, node] = heap_.top();
    heap_.pop();
    if (cost > cost_[node]) continue;
    reached_.push_back(node);
    for (const std::uint32_t edge : incidence_.edges(node)) {
      const std::uint32_t next = other_end(axis_.edges[edge], node);
      const double own = edge_costs_[edge];
      const double sum = adding_ == Adding::sum ? cost + own : std::max(cost, own);
      if (!(sum < cost_[next])) continue;
      cost_[next] = sum;
      via_[next] = edge;
      heap_.emplace(sum, next);
    }
  }
}

std::vector<Step> Search::way_to(std::uint32_t node) const {
  std::vector<Step> steps;
  while (via_[node] != none) {
    const Edge& edge = axis_.edges[via_[node]];
    steps.push_back({via_[node], edge.node[1] == node});
    node = other_end(edge, node);
  }
  ranges::reverse(steps);
  return steps;
}

double narrowest_radius(const MedialAxis& axis, const PathPiece& piece) {
  const auto [low, high] = std::minmax(piece.from, piece.to);
  const double t = std::clamp(narrowest_place(axis, piece.edge).t, low, high);
  const Curve curve = curve_of(axis, axis.edges[piece.edge]);
  return std::min({curve.at(low).radius, curve.at(t).radius, curve.at(high).radius});
}

void measure(const MedialAxis& axis, AxisPath& path) {
  path.length = 0;
  path.narrowest = std::numeric_limits<double>::infinity();
  for (const PathPiece& piece : path.pieces) {
    path.length += cost_of(axis, piece, Route::shortest);
    path.narrowest = std::min(path.narrowest, narrowest_radius(axis, piece));
  }
}

AxisPath path_of(const MedialAxis& axis, std::span<const Step> steps) {
  AxisPath path;
  for (const Step step : steps)
    path.pieces.push_back({step.edge, step.forward ? 0.0 : 1.0, step.forward ? 1.0 : 0.0});
  measure(axis, path);
  return path;
}

}  // namespace ops

namespace {

using ops::Search;
using ops::Start;

bool is_place(const MedialAxis& axis, EdgePlace place) {
  return place.edge < axis.edges.size() && place.t >= 0 && place.t <= 1;
}

Status check_places(const MedialAxis& axis, EdgePlace from, EdgePlace to) {
  if (is_place(axis, from) && is_place(axis, to)) return success();
  return Error{ErrorCode::invalid_option, "a place is not on the axis", {}};
}

Error no_way() {
  return {ErrorCode::invalid_option, "no path along the axis joins the two places", {}};
}

/// The ways from a place to the two nodes of its edge.
std::array<PathPiece, 2> ways_out(EdgePlace place) {
  return {{{place.edge, place.t, 0}, {place.edge, place.t, 1}}};
}

/// The least path by the costs of whole edges and of parts of them; parts or edges of infinite cost
/// are closed.
template <class PieceCost>
Result<AxisPath> least_path(const MedialAxis& axis, std::span<const double> costs,
                            const PieceCost& cost_of_piece, EdgePlace from, EdgePlace to) {
  const Incidence incidence(axis);
  Search search(axis, incidence, costs);
  std::array<Start, 2> starts;
  for (std::size_t i = 0; i < 2; ++i)
    starts[i] = {axis.edges[from.edge].node[i], cost_of_piece(ways_out(from)[i])};
  search.run(starts);
  double best = infinity;
  std::size_t last = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const double cost = search.cost(axis.edges[to.edge].node[i]) + cost_of_piece(ways_out(to)[i]);
    if (!(cost < best)) continue;
    best = cost;
    last = i;
  }
  const PathPiece direct{from.edge, from.t, to.t};
  const bool is_direct = from.edge == to.edge && !(best < cost_of_piece(direct));
  AxisPath path;
  if (is_direct && cost_of_piece(direct) < infinity) {
    path.pieces = {direct};
  } else {
    if (!(best < infinity)) return no_way();
    const std::uint32_t end = axis.edges[to.edge].node[last];
    const std::vector<Step> steps = search.way_to(end);
    const std::uint32_t begin = steps.empty() ? end : tail_of(axis, steps.front());
    // Of an edge from a node to itself, the cheaper end.
    const auto& at = axis.edges[from.edge].node;
    const bool second = at[0] == at[1] ? starts[1].cost < starts[0].cost : begin == at[1];
    path.pieces.push_back({from.edge, from.t, second ? 1.0 : 0.0});
    for (const PathPiece& piece : ops::path_of(axis, steps).pieces) path.pieces.push_back(piece);
    path.pieces.push_back({to.edge, last == 0 ? 0.0 : 1.0, to.t});
  }
  // A place at a node is no way.
  if (path.pieces.size() > 1)
    std::erase_if(path.pieces, [](const PathPiece& piece) { return piece.from == piece.to; });
  ops::measure(axis, path);
  return path;
}

}  // namespace

Result<AxisPath> path_between(const MedialAxis& axis, EdgePlace from, EdgePlace to, Route route) {
  if (Status places = check_places(axis, from, to); !places) return std::move(places).error();
  std::vector<double> costs(axis.edges.size());
  for (std::uint32_t i = 0; i < costs.size(); ++i) costs[i] = ops::cost_of(axis, {i, 0, 1}, route);
  return least_path(
      axis, costs, [&](const PathPiece& piece) { return ops::cost_of(axis, piece, route); }, from,
      to);
}

Result<AxisPath> widest_path(const MedialAxis& axis, EdgePlace from, EdgePlace to) {
  if (Status places = check_places(axis, from, to); !places) return std::move(places).error();
  // Costs are radii, negated: a way is as narrow as its narrowest edge.
  const auto narrowness = [&](const PathPiece& piece) {
    return -ops::narrowest_radius(axis, piece);
  };
  std::vector<double> narrowest(axis.edges.size());
  for (std::uint32_t i = 0; i < narrowest.size(); ++i) narrowest[i] = narrowness({i, 0, 1});
  const Incidence incidence(axis);
  Search search(axis, incidence, narrowest, ops::Adding::most);
  std::array<Start, 2> starts;
  for (std::size_t i = 0; i < 2; ++i)
    starts[i] = {axis.edges[from.edge].node[i], narrowness(ways_out(from)[i])};
  search.run(starts);
  double least = from.edge == to.edge ? narrowness({from.edge, from.t, to.t}) : infinity;
  for (std::size_t i = 0; i < 2; ++i)
    least = std::min(
        least, std::max(search.cost(axis.edges[to.edge].node[i]), narrowness(ways_out(to)[i])));
  if (!(least < infinity)) return no_way();
  std::vector<double> costs(axis.edges.size(), infinity);
  for (std::uint32_t i = 0; i < costs.size(); ++i)
    if (narrowest[i] <= least) costs[i] = ops::cost_of(axis, {i, 0, 1}, Route::shortest);
  return least_path(
      axis, costs,
      [&](const PathPiece& piece) {
        return narrowness(piece) <= least ? ops::cost_of(axis, piece, Route::shortest) : infinity;
      },
      from, to);
}

}  // namespace medial
