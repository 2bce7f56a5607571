#include "medial/editor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "axis/node_kinds.h"
#include "base/in_flight.h"
#include "base/threads.h"
#include "base/tolerance.h"
#include "methods/checks.h"
#include "methods/edit/repair.h"
#include "methods/edit/rings.h"
#include "methods/edit/window.h"
#include "site/bisector.h"

namespace medial {

using edit::AxisGraph;
using edit::none;
using edit::Rings;
using edit::spare_share;

namespace {

/// What an edit has changed, and what was there in the order of `change`.
struct Step {
  AxisChange change;
  std::vector<Disk> nodes;
  std::vector<AxisGraph::Edge> edges;
};

}  // namespace

struct Editor::Parts {
  Options options;
  Box box;  ///< of the shape, and of places where it was
  Rings rings;
  AxisGraph graph;
  edit::Measures measures;
  double tolerance = 0;  ///< in units of the input
  std::vector<edit::Edit> inverse;
  std::vector<std::uint32_t> marks;  ///< see Spread
  std::uint32_t mark = 0;
  /// The shape's sites where its edges are not those of the rings, since some touch or vertices lie
  /// in a straight line; empty: they are.
  std::vector<Site> apart;
  Shape apart_shape;
  std::vector<std::uint32_t> apart_components;  ///< of nodes

  Status start(const Shape& shape, bool is_first);
  Result<AxisChange> change(const edit::Edit& edit);
  Result<AxisChange> undo();

  std::optional<Error> refuse(const edit::Edit& edit) const;
  std::optional<Step> follow(const edit::Edit& edit);
  std::optional<Step> follow_in_two(const edit::Edit& edit);
  Result<AxisChange> rebuild(const edit::Edit& edit);
  bool fits_frame(Vec2 place) const;
  std::optional<Step> repair(const edit::Edit& edit, const std::vector<Rings::Extent>& before);
  std::optional<Step> replace(const edit::Affected& affected, const edit::Repair& repair);
  void put_back(const Step& step);
  void list_all(std::vector<std::uint32_t>& nodes, std::vector<std::uint32_t>& edges) const;
  Node node(std::uint32_t number) const;
  Edge edge(std::uint32_t number) const;
  Site site(std::uint32_t number) const;
};

namespace {

Error error_of(ErrorCode code, const char* text, std::uint32_t vertex) {
  Error error{code, text, {}};
  error.place.vertex = vertex;
  return error;
}

/// For each site of an axis of the shape's image in the local frame its number.
std::vector<std::uint32_t> site_numbers(const MedialAxis& axis, const Shape& shape, bool is_first) {
  std::vector<std::uint32_t> sites;
  sites.reserve(axis.sites.size());
  for (const Site& site : axis.sites)
    sites.push_back(2 * (is_first ? site.vertex : shape.sources[site.vertex].vertex) +
                    (site.kind == SiteKind::vertex ? 0 : 1));
  return sites;
}

/// Adds what a second change removes and adds to lists of a first one.
void join(std::vector<std::uint32_t>& removed, std::vector<std::uint32_t>& added,
          const std::vector<std::uint32_t>& then_removed,
          const std::vector<std::uint32_t>& then_added) {
  std::sort(added.begin(), added.end());
  std::vector<std::uint32_t> gone;
  for (const std::uint32_t number : then_removed)
    (std::binary_search(added.begin(), added.end(), number) ? gone : removed).push_back(number);
  std::sort(gone.begin(), gone.end());
  added.erase(std::remove_if(added.begin(), added.end(),
                             [&](std::uint32_t number) {
                               return std::binary_search(gone.begin(), gone.end(), number);
                             }),
              added.end());
  added.insert(added.end(), then_added.begin(), then_added.end());
}
void join(AxisChange& first, const AxisChange& second) {
  join(first.removed_nodes, first.added_nodes, second.removed_nodes, second.added_nodes);
  join(first.removed_edges, first.added_edges, second.removed_edges, second.added_edges);
}

/// An error of a shape's image in the local frame, as one of the shape.
Error from_local(Error error, const Shape& shape, const LocalFrame& frame) {
  if (error.place.point) error.place.point = frame.to_input(*error.place.point);
  if (error.place.vertex && *error.place.vertex < shape.sources.size()) {
    const VertexSource source = shape.sources[*error.place.vertex];
    error.place.ring = source.ring;
    error.place.vertex = source.vertex;
  }
  return error;
}

}  // namespace

/// Computes the axis of a shape: the first one, or one built from the rings, whose sources name
/// vertices.
Status Editor::Parts::start(const Shape& shape, bool is_first) {
  if (auto error = medial::refuse(shape, options)) return std::move(*error);
  box = bounding_box(shape);
  const LocalFrame frame = frame_of(box);
  Shape local = shape;
  for (Vec2& p : local.points) p = frame.to_local(p);
  for (std::uint32_t i = 0; i < local.sources.size(); ++i) local.sources[i] = {0, i};
  const Box local_box = bounding_box(local);
  Options local_options = options;
  const double scaled = frame.scale * tolerance_for(box, options.tolerance);
  if (scaled > tolerance_for(local_box, options.tolerance))
    local_options.tolerance = relative_tolerance(scaled, local_box);
  const auto axis = compute(local, local_options);
  if (!axis) return from_local(axis.error(), shape, frame);
  tolerance = tolerance_for(box, options.tolerance);
  measures = {frame.scale * tolerance, tolerance_for(local_box, options.tolerance),
              radius_limit(box, frame)};
  apart.clear();
  apart_shape = {};
  apart_components.clear();
  if (is_first) rings = Rings(shape, frame);
  if (is_first || rings.adopt(shape, frame)) {
    graph = AxisGraph(*axis, site_numbers(*axis, shape, is_first));
  } else {
    std::vector<std::uint32_t> counted(axis->sites.size());
    for (std::uint32_t i = 0; i < counted.size(); ++i) counted[i] = i;
    apart = axis->sites;
    for (Site& site : apart) {
      const VertexSource source = shape.sources[site.vertex];
      site = {frame.to_input(site.start),
              frame.to_input(site.end),
              source.ring,
              source.vertex,
              site.kind,
              site.bulge};
    }
    apart_shape = shape;
    for (const Node& node : axis->nodes) apart_components.push_back(node.component);
    rings.set_frame(frame);
    graph = AxisGraph(*axis, counted);
  }
  marks.assign(graph.node_slots() + graph.node_slots() / spare_share, 0);
  mark = 0;
  return success();
}

/// Whether all local coordinates of a place are exact.
bool Editor::Parts::fits_frame(Vec2 place) const {
  const Vec2 local = rings.frame().to_local(place);
  constexpr double largest = 2;
  return std::abs(local.x) < largest && std::abs(local.y) < largest &&
         rings.frame().to_input(local) == place;
}

void Editor::Parts::list_all(std::vector<std::uint32_t>& nodes,
                             std::vector<std::uint32_t>& edges) const {
  for (std::uint32_t i = 0; i < graph.node_slots(); ++i)
    if (graph.has_node(i)) nodes.push_back(i);
  for (std::uint32_t i = 0; i < graph.edge_slots(); ++i)
    if (graph.has_edge(i)) edges.push_back(i);
}

std::optional<Error> Editor::Parts::refuse(const edit::Edit& edit) const {
  const std::uint32_t shown = edit.fresh != none ? edit.fresh : edit.old;
  if (edit.fresh != none && !(std::isfinite(edit.place.x) && std::isfinite(edit.place.y)))
    return error_of(ErrorCode::not_finite, "a coordinate is not finite", shown);
  constexpr std::uint32_t fewest = 3;
  if (edit.fresh == none && rings.loop_size(rings[edit.before].loop) <= fewest)
    return error_of(ErrorCode::too_few_points, "a loop keeps three vertices", shown);
  return std::nullopt;
}

Result<AxisChange> Editor::Parts::change(const edit::Edit& edit) {
  if (auto error = refuse(edit)) return std::move(*error);
  if (!apart.empty() || (edit.fresh != none && !fits_frame(edit.place))) return rebuild(edit);
  const Rings::Judgement judgement = rings.judge(edit);
  if (judgement.verdict == Rings::Verdict::crosses) {
    Error error = error_of(ErrorCode::crossing, "edges would cross", judgement.edge);
    error.place.point = judgement.point;
    return error;
  }
  const edit::Edit back = rings.inverse(edit);
  edit::make_room(inverse, inverse.size() + 1);
  if (edit.fresh != none) box.add(edit.place);
  measures.radius_limit = radius_limit(box, rings.frame());
  auto step = judgement.verdict == Rings::Verdict::unclear ? follow_in_two(edit) : follow(edit);
  if (!step) return rebuild(edit);
  inverse.push_back(back);
  step->change.vertex = edit.fresh != none ? edit.fresh : edit.old;
  return std::move(step->change);
}

/// Makes an edit by which no loop changes its form, and repairs the axis. None, and nothing has
/// happened, where all has to be computed again.
std::optional<Step> Editor::Parts::follow(const edit::Edit& edit) {
  const std::vector<Rings::Extent> before = rings.sites_around(edit);
  const edit::Edit back = rings.inverse(edit);
  rings.apply(edit);
  std::optional<Step> step;
  try {
    step = repair(edit, before);
  } catch (...) {
    rings.apply(back);
    throw;
  }
  if (!step) rings.apply(back);
  return step;
}

/// Takes a vertex that jumps across others out, and puts it in again where it shall be. None, and
/// nothing has happened, where one of the two changes the form of a loop.
std::optional<Step> Editor::Parts::follow_in_two(const edit::Edit& edit) {
  const edit::Edit out{edit.before, edit.after, edit.old, none, {}};
  const edit::Edit in{edit.before, edit.after, none, edit.fresh, edit.place};
  const auto keeps_form = [&](const edit::Edit& one) {
    return rings.judge(one).verdict == Rings::Verdict::keeps_form;
  };
  if (edit.old != edit.fresh || refuse(out) || !keeps_form(out)) return std::nullopt;
  const edit::Edit back = rings.inverse(out);
  std::optional<Step> first = follow(out), second;
  if (!first) return std::nullopt;
  const auto take_back = [&] {
    put_back(*first);
    rings.apply(back);
  };
  try {
    if (keeps_form(in)) second = follow(in);
    if (second) {
      // In a copy: if memory runs out halfway, put_back() still needs the first change as it was.
      AxisChange both = first->change;
      join(both, second->change);
      first->change = std::move(both);
    }
  } catch (...) {
    if (second) {
      put_back(*second);
      rings.apply(out);
    }
    take_back();
    throw;
  }
  if (second) return first;
  take_back();
  return std::nullopt;
}

/// Finds what changes, and the new part of the axis. None where all has to be computed again.
std::optional<Step> Editor::Parts::repair(const edit::Edit& edit,
                                          const std::vector<Rings::Extent>& before) {
  constexpr double margin = 64;  // tolerances
  constexpr int most_rounds = 16;
  edit::Spread spread(graph, marks, ++mark);
  const std::vector<Rings::Extent> after = rings.sites_around(edit);
  const auto stays_in = [&](const Rings::Extent& one, const std::vector<Rings::Extent>& others) {
    const bool moves =
        edit.old == edit.fresh && (one.site / 2 == edit.fresh || one.end == edit.fresh);
    return !moves && std::any_of(others.begin(), others.end(), [&](const Rings::Extent& other) {
      return other.site == one.site && other.end == one.end;
    });
  };
  bool changes = false;
  for (const Rings::Extent& one : before) {
    if (stays_in(one, after)) continue;
    spread.add_site(one.site);
    changes = true;
  }
  if (!changes) return Step{};
  std::vector<site::Site> fresh;
  for (const Rings::Extent& one : after)
    if (!stays_in(one, before)) fresh.push_back(rings.site(one.site));
  for (int round = 0; round < most_rounds; ++round) {
    spread.spread(fresh, margin * measures.tolerance);
    const edit::Affected affected = spread.result();
    const auto window =
        edit::window_of(rings, graph, affected, rings[edit.before].loop, measures.radius_limit);
    if (!window) return std::nullopt;
    std::vector<std::uint32_t> doubtful;
    const auto found = edit::repair(rings, graph, affected, *window, measures, doubtful);
    if (found) return replace(affected, *found);
    if (doubtful.empty()) return std::nullopt;
    for (const std::uint32_t node : doubtful) spread.add_around(node, std::size_t{1} << round);
  }
  return std::nullopt;
}

/// Puts the new part in the place of the old one; none, and nothing happens, where that would
/// change how many cycles there are.
std::optional<Step> Editor::Parts::replace(const edit::Affected& affected,
                                           const edit::Repair& repair) {
  const auto fresh =
      static_cast<std::size_t>(std::count(repair.old_nodes.begin(), repair.old_nodes.end(), none));
  if (fresh + affected.edges.size() != affected.nodes.size() + repair.links.size())
    return std::nullopt;
  // Memory may run out here, and nowhere below.
  std::vector<std::uint32_t> number = repair.old_nodes;
  Step step;
  AxisChange& change = step.change;
  for (const std::uint32_t node : affected.nodes) step.nodes.push_back(graph.disk(node));
  for (const std::uint32_t edge : affected.edges) step.edges.push_back(graph.edge(edge));
  change.removed_nodes = affected.nodes;
  change.removed_edges = affected.edges;
  change.added_nodes.reserve(fresh);
  change.added_edges.reserve(repair.links.size());
  graph.make_room(fresh, repair.links.size(), 2 * rings.size());
  for (const std::uint32_t edge : affected.edges) graph.remove_edge(edge);
  for (const std::uint32_t node : affected.nodes) graph.remove_node(node);
  for (std::size_t i = 0; i < number.size(); ++i)
    if (number[i] == none)
      change.added_nodes.push_back(number[i] = graph.add_node(repair.disks[i]));
  for (const disks::Link& link : repair.links) {
    AxisGraph::Edge edge{{number[link.node[0]], number[link.node[1]]}, link.site, {}, 1};
    const site::Control control =
        site::control_of(rings.site(edge.site[0]), rings.site(edge.site[1]),
                         graph.disk(edge.node[0]), graph.disk(edge.node[1]));
    edge.control = control.point;
    edge.weight = control.weight;
    change.added_edges.push_back(graph.add_edge(edge));
  }
  return step;
}

/// Undoes the last replace(): in the opposite order all numbers come back as they were.
void Editor::Parts::put_back(const Step& step) {
  const AxisChange& change = step.change;
  for (auto i = change.added_edges.rbegin(); i != change.added_edges.rend(); ++i)
    graph.remove_edge(*i);
  for (auto i = change.added_nodes.rbegin(); i != change.added_nodes.rend(); ++i)
    graph.remove_node(*i);
  for (auto i = step.nodes.rbegin(); i != step.nodes.rend(); ++i) graph.add_node(*i);
  for (auto i = step.edges.rbegin(); i != step.edges.rend(); ++i) graph.add_edge(*i);
}

/// Computes all again after an edit; nothing happens where that fails.
Result<AxisChange> Editor::Parts::rebuild(const edit::Edit& edit) {
  AxisChange change;
  change.vertex = edit.fresh != none ? edit.fresh : edit.old;
  change.everything = true;
  list_all(change.removed_nodes, change.removed_edges);
  Parts next = *this;
  next.rings.apply(edit);
  std::vector<std::vector<std::uint32_t>> numbers;
  const std::vector<Ring> all = next.rings.rings(numbers);
  auto shape = build_shape(all);
  if (!shape) {
    Error error = std::move(shape).error();
    if (error.place.ring && error.place.vertex && *error.place.ring < numbers.size() &&
        *error.place.vertex < numbers[*error.place.ring].size())
      error.place.vertex = numbers[*error.place.ring][*error.place.vertex];
    error.place.ring.reset();
    return error;
  }
  for (VertexSource& source : shape->sources) source.vertex = numbers[source.ring][source.vertex];
  if (auto started = next.start(*shape, false); !started) {
    Error error = std::move(started).error();
    error.place.ring.reset();  // the vertex has its number
    return error;
  }
  next.list_all(change.added_nodes, change.added_edges);
  next.inverse.push_back(rings.inverse(edit));
  *this = std::move(next);
  return change;
}

Result<AxisChange> Editor::Parts::undo() {
  if (inverse.empty()) return AxisChange{};
  edit::Edit last = inverse.back();
  // build_shape() may have turned the loop round since.
  if (rings[last.before].next != (last.old != none ? last.old : last.after))
    std::swap(last.before, last.after);
  auto result = change(last);
  if (!result) return result;
  inverse.pop_back();  // of this edit
  inverse.pop_back();
  return result;
}

Node Editor::Parts::node(std::uint32_t number) const {
  const LocalFrame& frame = rings.frame();
  const Disk& disk = graph.disk(number);
  std::uint32_t component = apart.empty() ? 0 : apart_components[number];
  if (apart.empty())
    graph.for_edges_at(number, [&](std::uint32_t edge, std::size_t) {
      component = rings.component(rings[graph.edge(edge).site[0] / 2].loop);
    });
  return {{frame.to_input(disk.center), frame.inverse * disk.radius},
          component,
          kind_of_degree(graph.degree(number))};
}

Edge Editor::Parts::edge(std::uint32_t number) const {
  const LocalFrame& frame = rings.frame();
  const AxisGraph::Edge& own = graph.edge(number);
  return {own.node,
          own.site,
          {frame.to_input(own.control.center), frame.inverse * own.control.radius},
          own.weight};
}

Site Editor::Parts::site(std::uint32_t number) const {
  if (!apart.empty()) return apart[number];
  const Rings::Vertex& vertex = rings[number / 2];
  const bool is_edge = Rings::is_edge(number);
  return {vertex.point, is_edge ? rings[rings.corner_after(number / 2)].point : vertex.point,
          vertex.loop, number / 2, is_edge ? SiteKind::segment : SiteKind::vertex};
}

Editor::Editor(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Editor::Editor(const Editor& other) : parts_(std::make_unique<Parts>(*other.parts_)) {}
Editor::Editor(Editor&&) noexcept = default;
Editor& Editor::operator=(Editor other) noexcept {
  std::swap(parts_, other.parts_);
  return *this;
}
Editor::~Editor() = default;

namespace {

/// What work() returns on so many threads, or the error that it throws.
template <class T, class Work>
Result<T> guarded(int threads, const Work& work) {
  return medial::guarded([&]() -> Result<T> { return on_threads(threads, work); });
}

}  // namespace

Result<Editor> Editor::make(const Shape& shape, const Options& options) {
  return guarded<Editor>(options.threads, [&]() -> Result<Editor> {
    if (has_arcs(shape)) return Error{ErrorCode::unsupported, "an editor takes no arcs yet", {}};
    if (options.exact || options.exterior || !std::holds_alternative<method::Disks>(options.method))
      return Error{ErrorCode::unsupported,
                   "an editor takes the method disks, without `exact` and `exterior`",
                   {}};
    auto parts = std::make_unique<Parts>();
    parts->options = options;
    if (auto started = parts->start(shape, true); !started) return std::move(started).error();
    parts->options.progress = {};
    parts->options.cancel = nullptr;
    return Editor(std::move(parts));
  });
}

Result<AxisChange> Editor::move(std::uint32_t vertex, Vec2 to) {
  const Rings& rings = parts_->rings;
  if (!rings.has(vertex))
    return error_of(ErrorCode::invalid_option, "there is no such vertex", vertex);
  if (rings[vertex].point == to) {
    AxisChange nothing;
    nothing.vertex = vertex;
    return nothing;
  }
  return guarded<AxisChange>(1, [&] {
    return parts_->change({rings[vertex].before, rings[vertex].next, vertex, vertex, to});
  });
}

Result<AxisChange> Editor::insert(std::uint32_t before, Vec2 point) {
  const Rings& rings = parts_->rings;
  if (!rings.has(before))
    return error_of(ErrorCode::invalid_option, "there is no such vertex", before);
  return guarded<AxisChange>(1, [&] {
    return parts_->change({before, rings[before].next, none, rings.unused(), point});
  });
}

Result<AxisChange> Editor::remove(std::uint32_t vertex) {
  const Rings& rings = parts_->rings;
  if (!rings.has(vertex))
    return error_of(ErrorCode::invalid_option, "there is no such vertex", vertex);
  return guarded<AxisChange>(1, [&] {
    return parts_->change({rings[vertex].before, rings[vertex].next, vertex, none, {}});
  });
}

Result<AxisChange> Editor::undo() {
  return guarded<AxisChange>(1, [&] { return parts_->undo(); });
}

std::optional<Vec2> Editor::vertex(std::uint32_t number) const {
  if (!parts_->rings.has(number)) return std::nullopt;
  return parts_->rings[number].point;
}
std::optional<Node> Editor::node(std::uint32_t number) const {
  if (!parts_->graph.has_node(number)) return std::nullopt;
  return parts_->node(number);
}
std::optional<Edge> Editor::edge(std::uint32_t number) const {
  if (!parts_->graph.has_edge(number)) return std::nullopt;
  return parts_->edge(number);
}
std::optional<Site> Editor::site(std::uint32_t number) const {
  const bool is_there =
      parts_->apart.empty() ? parts_->rings.is_site(number) : number < parts_->apart.size();
  if (!is_there) return std::nullopt;
  return parts_->site(number);
}

Shape Editor::shape() const {
  if (!parts_->apart.empty()) return parts_->apart_shape;
  return parts_->rings.shape();
}

MedialAxis Editor::axis() const {
  const Parts& parts = *parts_;
  MedialAxis axis;
  axis.method = "disks";
  axis.tolerance = parts.tolerance;
  std::vector<std::uint32_t> nodes, edges, site_numbers;
  parts.list_all(nodes, edges);
  std::vector<std::uint32_t> number(parts.graph.node_slots());
  for (const std::uint32_t node : nodes) {
    number[node] = static_cast<std::uint32_t>(axis.nodes.size());
    axis.nodes.push_back(parts.node(node));
  }
  if (!parts.apart.empty()) {
    axis.sites = parts.apart;
    for (std::uint32_t i = 0; i < axis.sites.size(); ++i) site_numbers.push_back(i);
  } else {
    site_numbers.resize(2 * parts.rings.size(), none);
    parts.rings.for_sites([&](std::uint32_t site) {
      site_numbers[site] = static_cast<std::uint32_t>(axis.sites.size());
      axis.sites.push_back(parts.site(site));
    });
  }
  for (const std::uint32_t i : edges) {
    Edge edge = parts.edge(i);
    for (std::size_t k = 0; k < 2; ++k) {
      edge.node[k] = number[edge.node[k]];
      edge.site[k] = site_numbers[edge.site[k]];
    }
    axis.edges.push_back(edge);
  }
  return axis;
}

}  // namespace medial
