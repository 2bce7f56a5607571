#include "medial/editor.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/arc.h"
#include "base/in_flight.h"
#include "base/threads.h"
#include "methods/edit/parts.h"

namespace medial {

using edit::error_of;

Editor::Editor(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Editor::Editor(const Editor& other) : parts_(std::make_unique<Parts>(*other.parts_)) {}
Editor::Editor(Editor&&) noexcept = default;
Editor& Editor::operator=(Editor other) noexcept {
  std::swap(parts_, other.parts_);
  return *this;
}
Editor::~Editor() = default;

namespace {

/// The result of work() on `threads` threads, or the error that it throws.
template <class T, class Work>
Result<T> guarded(int threads, const Work& work) {
  return medial::guarded([&]() -> Result<T> { return on_threads(threads, work); });
}

}  // namespace

Result<Editor> Editor::make(const Shape& shape, const Options& options) {
  return guarded<Editor>(options.threads, [&]() -> Result<Editor> {
    if (options.exact || options.exterior || !std::holds_alternative<method::Disks>(options.method))
      return Error{ErrorCode::unsupported,
                   "an editor takes the method disks, without `exact` and `exterior`",
                   {}};
    auto parts = std::make_unique<Parts>();
    parts->options = options;
    if (auto started = parts->start(shape, true, false); !started)
      return std::move(started).error();
    parts->options.progress = {};
    parts->options.cancel = nullptr;
    return Editor(std::move(parts));
  });
}

namespace {

Error no_such_vertex(std::uint32_t vertex) {
  return error_of(ErrorCode::invalid_option, "there is no such vertex", vertex);
}

/// A change without effect.
AxisChange unchanged(std::uint32_t vertex) {
  AxisChange nothing;
  nothing.vertex = vertex;
  return nothing;
}

/// The bulge of the arc that replaces two consecutive arcs when the vertex between them is removed.
/// It turns by the same angle; where that is a full circle, it is a segment.
double joined_bulge(double first, double second) {
  const double both = std::atan(first) + std::atan(second);
  return std::abs(both) < 0.5 * std::numbers::pi ? std::tan(both) : 0;
}

/// The bulges of the two arcs of the circle through three points.
std::array<double, 2> bulges_through(Vec2 start, Vec2 middle, Vec2 end) {
  return {std::tan(0.5 * signed_angle(end - start, end - middle)),
          std::tan(0.5 * signed_angle(middle - start, end - start))};
}

}  // namespace

Result<AxisChange> Editor::move(std::uint32_t vertex, Vec2 to) {
  const Rings& rings = parts_->edited();
  if (!rings.has(vertex)) return no_such_vertex(vertex);
  if (rings[vertex].point == to) return unchanged(vertex);
  return guarded<AxisChange>(1, [&] {
    const Rings::Vertex& own = rings[vertex];
    return parts_->change(
        {own.before, own.next, vertex, vertex, to, {rings[own.before].bulge, own.bulge}, {}, {}});
  });
}

Result<AxisChange> Editor::insert(std::uint32_t before, Vec2 point) {
  const Rings& rings = parts_->edited();
  if (!rings.has(before)) return no_such_vertex(before);
  return guarded<AxisChange>(1, [&] {
    const Rings::Vertex& from = rings[before];
    std::array<double, 2> bulge{};
    if (from.bulge != 0) bulge = bulges_through(from.point, point, rings[from.next].point);
    return parts_->change({before, from.next, none, rings.unused(), point, bulge, {}, {}});
  });
}

Result<AxisChange> Editor::remove(std::uint32_t vertex) {
  const Rings& rings = parts_->edited();
  if (!rings.has(vertex)) return no_such_vertex(vertex);
  return guarded<AxisChange>(1, [&] {
    const Rings::Vertex& own = rings[vertex];
    const double bulge = joined_bulge(rings[own.before].bulge, own.bulge);
    return parts_->change({own.before, own.next, vertex, none, {}, {bulge, 0}, {}, {}});
  });
}

Result<AxisChange> Editor::set_bulge(std::uint32_t vertex, double bulge) {
  const Rings& rings = parts_->edited();
  if (!rings.has(vertex)) return no_such_vertex(vertex);
  if (rings[vertex].bulge == bulge) return unchanged(vertex);
  return guarded<AxisChange>(1, [&] {
    const Rings::Vertex& own = rings[vertex];
    return parts_->change({own.before,
                           own.next,
                           vertex,
                           vertex,
                           own.point,
                           {rings[own.before].bulge, bulge},
                           {},
                           {}});
  });
}

Result<AxisChange> Editor::insert_loop(const Ring& ring) {
  return guarded<AxisChange>(1, [&]() -> Result<AxisChange> {
    if (!ring.bulges.empty() && ring.bulges.size() != ring.points.size())
      return Error{ErrorCode::invalid_option, "a ring has as many bulges as points, or none", {}};
    edit::Edit edit;
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      const Vec2 p = ring.points[i];
      if (p == ring.points[i + 1 < ring.points.size() ? i + 1 : 0]) continue;
      const auto number = parts_->edited().unused() + static_cast<std::uint32_t>(edit.in.size());
      edit.in.push_back({number, p, i < ring.bulges.size() ? ring.bulges[i] : 0});
    }
    if (edit.in.size() < 2)
      return Error{ErrorCode::too_few_points, "the ring has fewer than two distinct points", {}};
    return parts_->change(edit);
  });
}

Result<AxisChange> Editor::remove_loop(std::uint32_t vertex) {
  if (!parts_->edited().has(vertex)) return no_such_vertex(vertex);
  return guarded<AxisChange>(1, [&] {
    edit::Edit edit;
    edit.out = parts_->corners_of(vertex);
    return parts_->change(edit);
  });
}

Result<AxisChange> Editor::move_loop(std::uint32_t vertex, Vec2 by) {
  if (!parts_->edited().has(vertex)) return no_such_vertex(vertex);
  if (by == Vec2{}) return unchanged(vertex);
  return guarded<AxisChange>(1, [&] {
    edit::Edit edit;
    edit.out = edit.in = parts_->corners_of(vertex);
    for (edit::Corner& corner : edit.in) corner.point = corner.point + by;
    return parts_->change(edit);
  });
}

Result<AxisChange> Editor::undo() {
  return guarded<AxisChange>(1, [&] { return parts_->undo(); });
}

std::optional<Vec2> Editor::vertex(std::uint32_t number) const {
  if (!parts_->edited().has(number)) return std::nullopt;
  return parts_->edited()[number].point;
}
std::optional<double> Editor::bulge(std::uint32_t vertex) const {
  if (!parts_->edited().has(vertex)) return std::nullopt;
  return parts_->edited()[vertex].bulge;
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
  if (!parts_->rings.is_site(number)) return std::nullopt;
  return parts_->site(number);
}

Shape Editor::shape() const {
  Shape shape = parts_->rings.shape();
  if (parts_->touching)
    for (VertexSource& source : shape.sources)
      source.vertex = parts_->touching->vertex_at(source.vertex);
  return shape;
}

MedialAxis Editor::axis() const {
  const Parts& parts = *parts_;
  MedialAxis axis;
  axis.method = "disks";
  axis.tolerance = parts.tolerance;
  std::vector<std::uint32_t> nodes, edges, site_numbers;
  parts.list_all(nodes, edges);
  std::vector<std::uint32_t> number(parts.graph.node_slots());
  const std::vector<std::uint32_t> components = parts.rings.component_numbers();
  for (const std::uint32_t node : nodes) {
    number[node] = static_cast<std::uint32_t>(axis.nodes.size());
    axis.nodes.push_back(parts.node(node));
    std::uint32_t& component = axis.nodes.back().component;
    component = components[component];
  }
  site_numbers.resize(2 * parts.rings.size(), none);
  parts.rings.for_sites([&](std::uint32_t site) {
    site_numbers[site] = static_cast<std::uint32_t>(axis.sites.size());
    axis.sites.push_back(parts.site(site));
  });
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
