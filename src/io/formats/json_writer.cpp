#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "axis/statistics.h"
#include "io/axis_writer.h"
#include "io/formats/json.h"
#include "io/formats/json_text.h"
#include "io/spill.h"
#include "methods/problem.h"

namespace medial::io {

namespace {

/// Finds which vertex of the shape a site comes from, so that a file need not repeat coordinates.
/// Sites mostly follow the shape's own order: the next vertex is tried before searching.
class SiteNames {
 public:
  explicit SiteNames(const Shape& shape) : shape_(shape), next_(shape.points.size()) {
    for (std::size_t i = 0; i + 1 < shape.loop_begin.size(); ++i) {
      for (std::uint32_t k = shape.loop_begin[i]; k < shape.loop_begin[i + 1]; ++k) {
        next_[k] = k + 1 == shape.loop_begin[i + 1] ? shape.loop_begin[i] : k + 1;
      }
    }
  }

  /// The vertex from which the site follows bit by bit; none if there is no such vertex.
  std::optional<std::uint32_t> vertex_of(const Site& site) {
    if (next_.empty()) return std::nullopt;
    if (fits(last_, site)) return last_;
    for (const std::uint32_t guess : {next_[last_], last_ + 1}) {
      if (guess < next_.size() && fits(guess, site)) return last_ = guess;
    }
    if (by_source_.empty()) sort_by_source();
    const auto source = [this](std::uint32_t k) {
      return std::pair(shape_.sources[k].ring, shape_.sources[k].vertex);
    };
    const std::pair wanted(site.ring, site.vertex);
    auto found = std::ranges::lower_bound(by_source_, wanted, {}, source);
    const auto end = by_source_.end();
    while (found != end && source(*found) == wanted && !fits(*found, site)) ++found;
    if (found == end || source(*found) != wanted) return std::nullopt;
    return last_ = *found;
  }

 private:
  static bool same(Vec2 a, Vec2 b) {
    return a == b && std::signbit(a.x) == std::signbit(b.x) &&
           std::signbit(a.y) == std::signbit(b.y);
  }
  bool fits(std::uint32_t vertex, const Site& site) const {
    const Vec2 end = shape_.points[site.kind() == SiteKind::vertex ? vertex : next_[vertex]];
    if (site.kind() == SiteKind::arc && site.bulge != shape_.bulge(vertex)) return false;
    return shape_.sources[vertex].ring == site.ring &&
           shape_.sources[vertex].vertex == site.vertex &&
           same(shape_.points[vertex], site.start) && same(end, site.end);
  }
  void sort_by_source() {
    by_source_.resize(next_.size());
    std::iota(by_source_.begin(), by_source_.end(), 0U);
    std::ranges::sort(by_source_, {}, [this](std::uint32_t k) {
      return std::pair(shape_.sources[k].ring, shape_.sources[k].vertex);
    });
  }

  const Shape& shape_;
  std::vector<std::uint32_t> next_;       ///< vertex of the same loop
  std::vector<std::uint32_t> by_source_;  ///< vertices; made when first needed
  std::uint32_t last_ = 0;
};

/// Whether an edge's control point is the middle of its ends bit by bit, and the weight 1.
bool is_plain(const MedialAxis& axis, const Edge& edge) {
  const Disk middle = middle_of(axis.nodes[edge.node[0]].disk, axis.nodes[edge.node[1]].disk);
  return edge.weight == 1 && middle.center == edge.control.center &&
         middle.radius == edge.control.radius &&
         std::signbit(middle.center.x) == std::signbit(edge.control.center.x) &&
         std::signbit(middle.center.y) == std::signbit(edge.control.center.y) &&
         std::signbit(middle.radius) == std::signbit(edge.control.radius);
}

/// `place` is that in the file, `number` what the input calls the feature: it is written where they
/// differ.
void put_attributes_and_shape(OutputStream& out, std::uint64_t place, std::uint64_t number,
                              const Attributes& attributes, const Shape& shape) {
  if (number != place) {
    put_member(out, "\"feature\":", number);
    out.put(",\n");
  }
  out.put("\"attributes\":");
  put_attributes(out, attributes);
  out.put(",\n\"shape\":{\"points\":");
  put_lines(out, shape.points, [&](Vec2 p) { put_row(out, p.x, p.y); });
  const auto plain = [&](const char* name, const auto& values) {
    out.put(name);
    put_list(out, values, [&](auto value) { put_json(out, value); });
  };
  if (!shape.bulges.empty()) {
    out.put(",\n\"bulges\":");
    put_list(out, shape.bulges, [&](double bulge) { out.put(bulge); });
  }
  out.put(",\n\"sources\":");
  put_lines(out, shape.sources, [&](VertexSource s) { put_row(out, s.ring, s.vertex); });
  plain(",\n\"loop_begin\":", shape.loop_begin);
  plain(",\n\"component\":", shape.component);
  out.put(",\n\"hole\":");
  put_list(out, shape.hole, [&](bool hole) { put_json(out, hole); });
  out.put('}');
}

void put_site(OutputStream& out, const Site& site, SiteNames& names) {
  if (const auto vertex = names.vertex_of(site))
    put_row(out, site.kind(), *vertex);
  else
    put_site(out, site);
}

void put_edge(OutputStream& out, const Edge& edge, bool plain) {
  const auto [from, to] = edge.node;
  const auto [left, right] = edge.site;
  const Disk& control = edge.control;
  if (plain) {
    put_row(out, from, to, left, right);
  } else if (edge.weight == 1) {
    put_row(out, from, to, left, right, control.center.x, control.center.y, control.radius);
  } else {
    put_row(out, from, to, left, right, control.center.x, control.center.y, control.radius,
            edge.weight);
  }
}

/// Counts only: a file holds nothing that differs from run to run.
void put_statistics(OutputStream& out, const Statistics& statistics) {
  out.put(",\n\"statistics\":{");
  for (const auto& [name, count] : statistics_counts)
    if (statistics.*count != 0 || !std::string_view(name).starts_with("exact_")) {
      put_quoted(out, name);
      out.put(':');
      out.put(statistics.*count);
      out.put(',');
    }
  put_member(out, "\"largest_residual\":", statistics.largest_residual);
  out.put('}');
}

/// What stands before the sites.
void put_axis_head(OutputStream& out, const MedialAxis& axis) {
  put_member(out, ",\n\"axis\":{\"method\":", axis.method);
  const auto member = [&](const char* name, double value) {
    out.put(name);
    out.put(value);
  };
  member(",\"tolerance\":", axis.tolerance);
  member(",\"resolution\":", axis.resolution);
  if (axis.exterior != 0) member(",\"exterior\":", axis.exterior);
}

void put_axis(OutputStream& out, const Shape& shape, const MedialAxis& axis) {
  put_axis_head(out, axis);
  SiteNames names(shape);
  out.put(",\n\"sites\":");
  put_lines(out, axis.sites, [&](const Site& site) { put_site(out, site, names); });
  out.put(",\n\"nodes\":");
  put_lines(out, axis.nodes, [&](const Node& node) { put_node(out, node); });
  out.put(",\n\"edges\":");
  put_lines(out, axis.edges, [&](const Edge& edge) { put_edge(out, edge, is_plain(axis, edge)); });
  put_statistics(out, axis.statistics);
}

/// What stands before the items.
template <class Item>
void put_head(Target& target, const Document<Item>& file) {
  OutputStream& out = *target.out;
  const bool arcs = target.arcs || std::ranges::any_of(file.items, [](const Item& item) {
                      return !item.shape.bulges.empty();
                    });
  put_member(out, "{\"medial\":", arcs ? native_version : 1);
  if (!file.crs_wkt.empty()) put_member(out, ",\n\"crs\":", file.crs_wkt);
  // Also where the reference system has it: not every reader understands those.
  if (file.unit != Unit::unknown) put_member(out, ",\n\"unit\":", name_of(file.unit));
  if (file.y_down) out.put(",\n\"y_down\":true");
  if (file.corner_angle > 0) put_member(out, ",\n\"corner_angle\":", file.corner_angle);
  if (!file.text_attributes.empty()) {
    out.put(",\n\"text_attributes\":");
    put_list(out, file.text_attributes, [&](const std::string& name) { put_quoted(out, name); });
  }
  out.put(",\n\"items\":");
}

template <class Item>
Status put_file(Target& target, const Document<Item>& file) {
  OutputStream& out = *target.out;
  const Part& part = target.part;
  if (part.begins) put_head(target, file);
  std::size_t i = 0;
  put_items(out, part, file.items, [&](const Item& item) {
    out.put('{');
    put_attributes_and_shape(out, part.feature + i, part.number_of(file, i), item.attributes,
                             item.shape);
    ++i;
    if constexpr (std::is_same_v<Item, AxisItem>)
      put_axis(out, item.shape, item.axis);
    else
      put_axis(out, item.shape, MedialAxis{});
    out.put('}');
    if constexpr (std::is_same_v<Item, AxisItem>)
      if (item.part) out.put(",\n\"part\":true");
    out.put('}');
  });
  return success();
}

/// Axes that are written while they grow: edges wait in a file until all nodes are there.
class GrowingJson final : public AxisWriter {
 public:
  GrowingJson(Target& target, const GrowingFrame& frame)
      : out_(*target.out), frame_(frame), spill_(frame.folder, 1) {
    Document<ShapeItem> head;
    static_cast<DocumentInfo&>(head) = frame.shapes;
    put_head(target, head);
    out_.put('[');
  }

  Status begin() override {
    nodes_ = edges_ = 0;
    spill_.clear();
    return success();
  }

  Status add(AxisPart&& part) override {
    if (nodes_ == 0) put_beginning(part.axis);
    std::string text;
    OutputStream edges = OutputStream::to(text);
    std::vector<bool> plain;
    for (const Edge& edge : part.axis.edges) plain.push_back(is_plain(part.axis, edge));
    take_whole_numbers(part);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      edges.put(edges_++ == 0 ? "\n" : ",\n");
      put_edge(edges, part.axis.edges[i], plain[i]);
    }
    for (const Node& node : part.axis.nodes) {
      out_.put(nodes_++ == 0 ? "\n" : ",\n");
      put_node(out_, node);
    }
    if (Status complete = edges.finish(); !complete) return complete;
    spill_.put(0, text);
    return spill_.status();
  }

  Status end(const Statistics& statistics) override {
    out_.put("],\n\"edges\":[");
    Status done = spill_.read(0, [&](std::string_view text) { out_.put(text); });
    out_.put(']');
    put_statistics(out_, statistics);
    out_.put("}}");
    return done;
  }

  Status finish() override {
    out_.put("\n]}\n");
    return success();
  }

 private:
  /// The shape, the sites and what else stands before the nodes.
  void put_beginning(const MedialAxis& about) {
    out_.put(begun_ == 0 ? "\n{" : ",\n{");
    const ShapeItem& item = frame_.shapes.items[begun_];
    put_attributes_and_shape(out_, begun_, frame_.shapes.index_of(begun_), item.attributes,
                             item.shape);
    ++begun_;
    put_axis_head(out_, about);
    const Problem problem(item.shape, frame_.options);
    out_.put(",\n\"sites\":[");
    std::size_t point = 0;
    for (std::uint32_t site = 0; site < problem.numbers().count; ++site) {
      point = site::point_of(problem.numbers(), site, point);
      out_.put(site == 0 ? "\n" : ",\n");
      const bool is_vertex = site < problem.numbers().edge[point];
      put_row(out_, is_vertex ? SiteKind::vertex : SiteKind::segment, point);
    }
    out_.put("],\n\"nodes\":[");
  }

  OutputStream& out_;
  GrowingFrame frame_;
  Spill spill_;  ///< of edges, as text
  std::size_t begun_ = 0;
  std::uint64_t nodes_ = 0, edges_ = 0;  ///< of this axis so far
};

std::unique_ptr<AxisWriter> grow_json(Target& target, const GrowingFrame& frame) {
  return std::make_unique<GrowingJson>(target, frame);
}

}  // namespace

void put_site(OutputStream& out, const Site& site) {
  const Vec2 a = site.start, b = site.end;
  const SiteKind kind = site.kind();
  if (kind == SiteKind::arc)
    put_row(out, kind, a.x, a.y, b.x, b.y, site.ring, site.vertex, site.bulge);
  else
    put_row(out, kind, a.x, a.y, b.x, b.y, site.ring, site.vertex);
}

void put_node(OutputStream& out, const Node& node) {
  put_row(out, node.disk.center.x, node.disk.center.y, node.disk.radius, node.component, node.kind);
}

void put_unit(Target& target) {
  if (!target.unit.empty()) put_member(*target.out, ",\n\"unit\":", target.unit);
}

Disk middle_of(const Disk& a, const Disk& b) {
  return {midpoint(a.center, b.center), a.radius + 0.5 * (b.radius - a.radius)};
}

Status write_json(Target& target, const AxesOutput& output) {
  return put_file(target, output.document);
}

Status write_json(Target& target, const ShapesOutput& output) {
  return put_file(target, output.document);
}

Format json_format() {
  Format format = native_reading(".json");
  format.sniff = begins_like_native;
  format.in_parts = true;
  format.growing = Growing::graph;
  format.grow = grow_json;
  return format.writes<AxesOutput, ShapesOutput, VoronoiOutput, OffsetsOutput, FeaturesOutput>(
      write_json, write_json, write_json, write_json, write_json);
}

}  // namespace medial::io
