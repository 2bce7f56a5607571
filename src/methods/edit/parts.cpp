#include "methods/edit/parts.h"

#include <algorithm>
#include <utility>

#include "axis/node_kinds.h"
#include "base/tolerance.h"
#include "methods/checks.h"
#include "methods/disks/disks.h"
#include "methods/problem.h"

namespace medial {
namespace edit {
namespace {

/// Merges what a second change removes and adds into the lists of a first one.
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

}  // namespace

void join(AxisChange& first, const AxisChange& second) {
  join(first.removed_nodes, first.added_nodes, second.removed_nodes, second.added_nodes);
  join(first.removed_edges, first.added_edges, second.removed_edges, second.added_edges);
}

std::uint32_t subject_of(const edit::Edit& edit) {
  if (edit.is_of_loops()) return (edit.in.empty() ? edit.out : edit.in).front().number;
  return edit.fresh != none ? edit.fresh : edit.old;
}

Error error_of(ErrorCode code, const char* text, std::uint32_t vertex) {
  Error error{code, text, {}};
  error.place.vertex = vertex;
  return error;
}

Result<MedialAxis> local_axis(const Shape& shape, const Options& options, double joint_tolerance) {
  Problem problem(shape, options);
  problem.joint_tolerance = joint_tolerance;
  auto axis = disks::run(problem);
  if (axis && problem.is_cancelled()) return Error{ErrorCode::cancelled, "cancelled", {}};
  return axis;
}

}  // namespace edit

namespace {

/// The number in Rings of each site of an axis: from the names of the vertices in the shape's
/// sources, or with `counted` from the order of the shape's points.
std::vector<std::uint32_t> site_numbers(const MedialAxis& axis, const Shape& shape, bool counted) {
  std::vector<std::uint32_t> sites;
  sites.reserve(axis.sites.size());
  for (const Site& site : axis.sites)
    sites.push_back(2 * (counted ? site.vertex : shape.sources[site.vertex].vertex) +
                    (site.kind() == SiteKind::vertex ? 0 : 1));
  return sites;
}

/// Converts an error of a shape's image in the local frame to one of the shape.
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
/// vertices. `touches`: some of its edges touch.
Status Editor::Parts::start(const Shape& shape, bool is_first, bool touches) {
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
  const Rings::Joining joining{tolerance_for(box, 0), options.corner_angle};
  const auto axis = edit::local_axis(local, local_options, frame.scale * joining.tolerance);
  if (!axis) return from_local(axis.error(), shape, frame);
  tolerance = tolerance_for(box, options.tolerance);
  measures = {frame.scale * tolerance, tolerance_for(local_box, options.tolerance),
              radius_limit(box, frame)};
  if (is_first) {
    rings = Rings(shape, frame, joining);
    rings.find_touches(!rings.has_arcs());
  } else {
    set_rings(shape, frame, joining, touches);
  }
  graph = AxisGraph(*axis, site_numbers(*axis, shape, is_first || touching));
  marks.assign(graph.node_slots() + graph.node_slots() / edit::spare_share, 0);
  mark = 0;
  return success();
}

/// Adopts the loops of a shape that was built from the rings.
void Editor::Parts::set_rings(const Shape& shape, const LocalFrame& frame,
                              const Rings::Joining& joining, bool touches) {
  if (touching) {
    rings = std::move(touching->rings());
    touching.reset();
  }
  rings.find_touches(touches && !rings.has_arcs());
  if (rings.adopt(shape, frame, joining)) return;
  Rings loops(shape, frame, joining);
  touching.emplace(std::move(rings), shape, loops);
  rings = std::move(loops);
}

void Editor::Parts::list_all(std::vector<std::uint32_t>& nodes,
                             std::vector<std::uint32_t>& edges) const {
  for (std::uint32_t i = 0; i < graph.node_slots(); ++i)
    if (graph.has_node(i)) nodes.push_back(i);
  for (std::uint32_t i = 0; i < graph.edge_slots(); ++i)
    if (graph.has_edge(i)) edges.push_back(i);
}

/// Recomputes everything from the rings after an edit.
Status Editor::Parts::start_again() {
  std::vector<std::vector<std::uint32_t>> numbers;
  const std::vector<Ring> all = edited().rings(numbers);
  ShapeReport report;
  auto shape = build_shape(all, {}, &report);
  if (!shape) {
    Error error = std::move(shape).error();
    if (error.place.ring && error.place.vertex && *error.place.ring < numbers.size() &&
        *error.place.vertex < numbers[*error.place.ring].size())
      error.place.vertex = numbers[*error.place.ring][*error.place.vertex];
    error.place.ring.reset();
    return error;
  }
  for (VertexSource& source : shape->sources) source.vertex = numbers[source.ring][source.vertex];
  if (auto started = start(*shape, false, report.touching_vertices > 0); !started) {
    Error error = std::move(started).error();
    error.place.ring.reset();  // the vertex number identifies it
    return error;
  }
  for (edit::Edit& one : inverse) one.seat.reset();  // the order of the loops may have changed
  return success();
}

/// Recomputes everything after an edit. If that fails, nothing has changed.
Result<AxisChange> Editor::Parts::rebuild(const edit::Edit& edit) {
  AxisChange change;
  change.vertex = subject_of(edit);
  change.everything = true;
  list_all(change.removed_nodes, change.removed_edges);
  Parts next = *this;
  next.inverse.push_back(edited().inverse(edit));
  (touching ? next.touching->rings() : next.rings).apply(edit, false);
  if (auto started = next.start_again(); !started) return std::move(started).error();
  next.list_all(change.added_nodes, change.added_edges);
  *this = std::move(next);
  return change;
}

std::vector<edit::Corner> Editor::Parts::corners_of(std::uint32_t vertex) const {
  const Rings& own = edited();
  std::vector<edit::Corner> corners;
  std::uint32_t v = vertex;
  do {
    corners.push_back({v, own[v].point, own[v].bulge});
    v = own[v].next;
  } while (v != vertex);
  return corners;
}

Node Editor::Parts::node(std::uint32_t number) const {
  const LocalFrame& frame = rings.frame();
  const Disk& disk = graph.disk(number);
  std::uint32_t component = 0, site = none;
  graph.for_edges_at(number,
                     [&](std::uint32_t edge, std::size_t) { site = graph.edge(edge).site[0]; });
  if (site == none) site = rings.arc_of(disk);
  if (site != none) component = rings.component(rings[site / 2].loop);
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
  const std::uint32_t v = number / 2;
  const Rings::Vertex& vertex = rings[v];
  const std::uint32_t shown = touching ? touching->vertex_at(v) : v;
  if (!Rings::is_edge(number)) return {vertex.point, vertex.point, vertex.loop, shown};
  const Vec2 end = rings[rings.corner_after(v)].point;
  return {vertex.point, end, vertex.loop, shown, vertex.bulge};
}

}  // namespace medial
