#include <algorithm>
#include <limits>

#include "axis/statistics.h"
#include "io/formats/json.h"
#include "io/formats/json_rows.h"
#include "medial/document.h"

namespace medial::io {

namespace {

Vec2 read_point(json::value value) {
  Row row(value);
  const Vec2 point = row.point();
  row.end();
  return point;
}

VertexSource read_vertex_source(json::value value) {
  Row row(value);
  const auto ring = row.index<std::uint32_t>();
  const VertexSource source{ring, row.index<std::uint32_t>()};
  row.end();
  return source;
}

void check_shape(const Shape& shape) {
  const std::size_t loops = shape.component.size();
  demand(shape.sources.size() == shape.points.size(), "not one source for each point");
  demand(shape.bulges.empty() || shape.bulges.size() == shape.points.size(),
         "not one bulge for each point");
  demand(shape.hole.size() == loops, "not one 'hole' for each loop");
  if (loops == 0) {
    demand(shape.points.empty() && shape.loop_begin.size() <= 1, "points without a loop");
    return;
  }
  demand(shape.loop_begin.size() == loops + 1, "not one 'loop_begin' for each loop and one more");
  demand(shape.loop_begin.front() == 0 && shape.loop_begin.back() == shape.points.size(),
         "the loops do not cover the points");
  const std::size_t components = shape.component_count();
  for (std::size_t i = 0; i < loops; ++i) {
    // Two arcs can make a loop, two segments cannot.
    const std::uint32_t fewest = shape.bulges.empty() ? 3 : 2;
    demand(shape.loop_begin[i] < shape.loop_begin[i + 1] &&
               shape.loop_begin[i + 1] - shape.loop_begin[i] >= fewest,
           "a loop has too few points");
    demand(shape.component[i] < components, "a component out of range");
  }
}

void check_axis(const Shape& shape, const MedialAxis& axis) {
  for (const Edge& edge : axis.edges) {
    demand(std::max(edge.node[0], edge.node[1]) < axis.nodes.size(), "an edge's node out of range");
    for (const std::uint32_t site : edge.site) {
      demand(site < axis.sites.size() || (site == no_site && axis.resolution > 0),
             "an edge's site out of range");
    }
    demand(edge.weight > 0, "an edge's weight is not positive");
  }
  // The exterior has components of its own: a frame, and what loops enclose between their vertices.
  const std::size_t components =
      std::max<std::size_t>(axis.exterior != 0 ? shape.points.size() : shape.component_count(), 1);
  for (const Node& node : axis.nodes)
    demand(node.component < components, "a node's component out of range");
}

void read_shape(json::value value, Shape& shape) {
  const auto list = [](const char* name, auto& values, auto read) {
    return Member{name, [&values, read](json::value v) { append_all(v, values, read); }};
  };
  read_members(value.get_object(), list("points", shape.points, read_point),
               list("bulges", shape.bulges, number),
               list("sources", shape.sources, read_vertex_source),
               list("loop_begin", shape.loop_begin, integer<std::uint32_t>),
               list("component", shape.component, integer<std::uint32_t>),
               list("hole", shape.hole, [](json::value v) -> bool { return v.get_bool(); }));
}

/// Sites that are given by a vertex of the shape are completed when the shape is known, because the
/// members of an object may stand in any order.
struct Unresolved {
  struct OfVertex {
    std::uint32_t site, vertex;
    SiteKind kind;
  };
  std::vector<OfVertex> sites;
  std::vector<std::uint32_t> plain_edges;
};

void read_site(json::value element, MedialAxis& axis, Unresolved& unresolved) {
  Row row(element);
  const SiteKind kind = site_kind(row.index<std::uint32_t>());
  const double first = row.real();
  if (row.more()) {
    axis.sites.push_back(read_site(row, kind, first));
  } else {
    demand(first >= 0 && first < std::numeric_limits<std::uint32_t>::max() &&
               first == std::floor(first),
           "a vertex has no whole number");
    unresolved.sites.push_back(
        {static_cast<std::uint32_t>(axis.sites.size()), static_cast<std::uint32_t>(first), kind});
    axis.sites.emplace_back();
  }
}

void read_edge(json::value element, MedialAxis& axis, Unresolved& unresolved) {
  Row row(element);
  Edge edge;
  for (std::uint32_t& node : edge.node) node = row.index<std::uint32_t>();
  for (std::uint32_t& site : edge.site) site = row.index<std::uint32_t>();
  if (row.more()) {
    edge.control.center = row.point();
    edge.control.radius = row.real();
    if (row.more()) edge.weight = row.real();
    row.end();
  } else {
    unresolved.plain_edges.push_back(static_cast<std::uint32_t>(axis.edges.size()));
  }
  axis.edges.push_back(edge);
}

void read_statistics(json::value value, Statistics& statistics) {
  for (json::field field : value.get_object()) {
    const std::string_view key = field.unescaped_key();
    json::value content = field.value();
    for (const auto& [name, count] : statistics_counts)
      if (key == name) statistics.*count = integer<std::uint64_t>(content);
    if (key == "largest_residual") statistics.largest_residual = number(content);
  }
}

void read_axis(json::value value, MedialAxis& axis, Unresolved& unresolved) {
  const auto real = [](const char* name, double& into) {
    return Member{name, [&into](json::value v) { into = number(v); }};
  };
  read_members(value.get_object(),
               Member{"method", [&](json::value v) { axis.method = text_of(v); }},
               real("tolerance", axis.tolerance), real("resolution", axis.resolution),
               real("exterior", axis.exterior),
               Member{"sites",
                      [&](json::value v) {
                        for_each(v, [&](json::value site) { read_site(site, axis, unresolved); });
                      }},
               Member{"nodes", [&](json::value v) { append_all(v, axis.nodes, read_node); }},
               Member{"edges",
                      [&](json::value v) {
                        for_each(v, [&](json::value edge) { read_edge(edge, axis, unresolved); });
                      }},
               Member{"statistics", [&](json::value v) { read_statistics(v, axis.statistics); }});
}

void resolve(const Shape& shape, MedialAxis& axis, const Unresolved& unresolved) {
  std::vector<std::uint32_t> next(shape.points.size());
  for (std::size_t i = 0; i + 1 < shape.loop_begin.size(); ++i) {
    for (std::uint32_t k = shape.loop_begin[i]; k < shape.loop_begin[i + 1]; ++k) {
      next[k] = k + 1 == shape.loop_begin[i + 1] ? shape.loop_begin[i] : k + 1;
    }
  }
  for (const auto& [number, vertex, kind] : unresolved.sites) {
    demand(vertex < next.size(), "a site's vertex out of range");
    Site& site = axis.sites[number];
    site.start = shape.points[vertex];
    site.end = shape.points[kind == SiteKind::vertex ? vertex : next[vertex]];
    if (kind == SiteKind::arc) site.bulge = shape.bulge(vertex);
    site.ring = shape.sources[vertex].ring;
    site.vertex = shape.sources[vertex].vertex;
    demand(site.kind() == kind, "a site is not of its kind");
  }
  for (const std::uint32_t i : unresolved.plain_edges) {
    Edge& edge = axis.edges[i];
    demand(std::max(edge.node[0], edge.node[1]) < axis.nodes.size(), "an edge's node out of range");
    edge.control = middle_of(axis.nodes[edge.node[0]].disk, axis.nodes[edge.node[1]].disk);
  }
}

RingRole ring_role(const std::string& name) {
  if (name == "any") return RingRole::any;
  if (name == "outer") return RingRole::outer;
  if (name == "hole") return RingRole::hole;
  demand(name == "winding", "an unknown role of a contour");
  return RingRole::winding;
}

/// A piece is a row that begins with its kind: "line", "arc", "bezier" or "rational".
void read_piece(json::value element, Contour& contour) {
  std::string kind;
  std::vector<double> numbers;
  for (json::value value : element.get_array()) {
    if (kind.empty()) {
      kind = text_of(value);
      demand(!kind.empty(), "a piece has no kind");
    } else {
      numbers.push_back(number(value));
    }
  }
  const auto demand_length = [&](bool fits) { demand(fits, "a piece has a wrong length"); };
  if (kind == "line") {
    demand_length(numbers.size() == 2);
    contour.line_to({numbers[0], numbers[1]});
  } else if (kind == "arc") {
    demand_length(numbers.size() == 3);
    contour.arc_to({numbers[0], numbers[1]}, numbers[2]);
  } else if (kind == "bezier") {
    demand_length(!numbers.empty() && numbers.size() % 2 == 0);
    std::vector<Vec2> control;
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
      control.push_back({numbers[i], numbers[i + 1]});
    }
    contour.bezier_to(control);
  } else if (kind == "rational") {
    demand_length(!numbers.empty() && numbers.size() % 3 == 0);
    std::vector<Vec2> control;
    std::vector<double> weights;
    for (std::size_t i = 0; i < numbers.size(); i += 3) {
      control.push_back({numbers[i], numbers[i + 1]});
      weights.push_back(numbers[i + 2]);
      demand(weights.back() > 0, "a weight is not positive");
    }
    contour.bezier_to(control, weights);
  } else {
    throw Malformed{"an unknown kind of piece"};
  }
}

Contour read_contour(json::value value) {
  Contour contour;
  bool started = false;
  read_members(value.get_object(),
               Member{"role", [&](json::value v) { contour.role = ring_role(text_of(v)); }},
               Member{"start",
                      [&](json::value v) {
                        contour.start_at(read_point(v));
                        started = true;
                      }},
               Member{"pieces", [&](json::value v) {
                        demand(started, "the pieces of a contour come before its start");
                        for_each(v, [&contour](json::value piece) { read_piece(piece, contour); });
                      }});
  demand(started, "a contour has no start");
  return contour;
}

/// `number`: that of the feature, its place in this file unless the file names another.
AxisItem read_item(json::value value, std::uint64_t& number) {
  AxisItem item;
  Unresolved unresolved;
  read_members(
      value.get_object(),
      Member{"feature", [&](json::value v) { number = integer<std::uint64_t>(v); }},
      Member{"attributes",
             [&](json::value v) {
               read_attributes(v, "an attribute is not a pair of strings", item.attributes);
             }},
      Member{"shape", [&](json::value v) { read_shape(v, item.shape); }},
      Member{"contours", [&](json::value v) { append_all(v, item.contours, read_contour); }},
      Member{"axis", [&](json::value v) { read_axis(v, item.axis, unresolved); }},
      Member{"part", [&](json::value v) { item.part = v.get_bool(); }});
  demand(item.contours.empty() || (item.shape.points.empty() && item.axis.nodes.empty()),
         "an item has both contours and a shape");
  check_shape(item.shape);
  resolve(item.shape, item.axis, unresolved);
  check_axis(item.shape, item.axis);
  return item;
}

Document<AxisItem> read_file(json::document& document) {
  Document<AxisItem> file;
  bool renumbered = false;
  const auto read_next = [&](json::value v) {
    const std::uint64_t place = file.indices.size();
    AxisItem item = read_item(v, file.indices.emplace_back(place));
    renumbered = renumbered || file.indices.back() != place;
    return item;
  };
  file.items = read_items<AxisItem>(
      document, "medial", native_version, read_next,
      Member{"crs", [&](json::value v) { file.crs_wkt = text_of(v); }},
      Member{"unit", [&](json::value v) { file.unit = unit_from(text_of(v)); }},
      Member{"y_down", [&](json::value v) { file.y_down = v.get_bool(); }},
      Member{"corner_angle",
             [&](json::value v) { file.corner_angle = corner_angle_from(number(v)); }},
      Member{"text_attributes", [&](json::value v) {
               for_each(
                   v, [&file](json::value name) { file.text_attributes.push_back(text_of(name)); });
             }});
  if (!renumbered) file.indices.clear();
  return file;
}

}  // namespace

void check_item(const AxisItem& item) {
  for (const Node& node : item.axis.nodes) {
    node_kind(static_cast<std::uint32_t>(node.kind));
    demand(node.disk.radius >= 0, "a node's radius is negative");
  }
  check_shape(item.shape);
  check_axis(item.shape, item.axis);
}

double corner_angle_from(double degrees) {
  demand(degrees >= 0 && degrees <= 10, "the corner angle is not in 0 to 10 degrees");
  return degrees;
}

std::optional<Unit> stored_unit(std::string_view name) {
  for (const Unit unit : {Unit::pixel, Unit::degree})
    if (name == name_of(unit)) return unit;
  return unit_of(name);
}

Unit unit_from(const std::string& name) {
  const auto unit = stored_unit(name);
  demand(unit.has_value(), "an unknown unit");
  return *unit;
}

bool begins_like_native(std::string_view text) { return begins_with_member(text, "\"medial\""); }

Result<Document<AxisItem>> read_native(TextSource& source) {
  return read_document(source, native_version, read_file);
}

Document<Feature> features_of(Document<AxisItem> file) {
  Document<Feature> dataset{file, {}};
  std::int64_t id = 0;
  for (AxisItem& item : file.items) {
    Feature& feature = dataset.items.emplace_back();
    feature.id = id++;
    feature.attributes = std::move(item.attributes);
    feature.contours = std::move(item.contours);
    const Shape& shape = item.shape;
    // A component's outer loop comes before its holes, whatever the order in the shape.
    std::vector<std::size_t> loops(shape.loop_count());
    for (std::size_t i = 0; i < loops.size(); ++i) loops[i] = i;
    std::ranges::stable_sort(loops, {}, [&shape](std::size_t i) {
      return std::pair(shape.component[i], static_cast<bool>(shape.hole[i]));
    });
    for (const std::size_t i : loops) {
      feature.rings.push_back(ring_of(shape, i));
      const auto sources = shape.sources.begin();
      feature.sources.insert(feature.sources.end(), sources + shape.loop_begin[i],
                             sources + shape.loop_begin[i + 1]);
    }
  }
  return dataset;
}

namespace {

Result<Document<Feature>> read_native_features(const Input& input, const ReadOptions&) {
  Result<Document<AxisItem>> file = read_native(*input.source);
  if (!file) return file.error();
  return features_of(std::move(*file));
}

}  // namespace

Format native_reading(const char* extensions) {
  Format format{extensions};
  format.read = read_native_features;
  format.accepts = begins_like_native;
  return format;
}

}  // namespace medial::io
