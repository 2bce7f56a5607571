#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "axis/statistics.h"
#include "io/native.h"

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
    const Vec2 end = shape_.points[site.kind == SiteKind::vertex ? vertex : next_[vertex]];
    if (site.kind == SiteKind::arc && site.bulge != shape_.bulge(vertex)) return false;
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

class NativeWriter {
 public:
  explicit NativeWriter(OutputStream& out) : out_(out) {}

  Status write(const Document<AxisItem>& file) {
    const bool arcs = std::ranges::any_of(
        file.items, [](const AxisItem& item) { return !item.shape.bulges.empty(); });
    out_.put("{\"medial\":");
    out_.put(arcs ? native_version : 1);
    if (!file.crs_wkt.empty()) {
      out_.put(",\n\"crs\":");
      out_.put(quoted(file.crs_wkt));
    }
    if (file.y_down) out_.put(",\n\"y_down\":true");
    out_.put(",\n\"items\":[");
    for (std::size_t i = 0; i < file.items.size(); ++i) {
      out_.put(i == 0 ? "\n{" : ",\n{");
      write_attributes(file.items[i].attributes);
      write_shape(file.items[i].shape);
      write_axis(file.items[i].shape, file.items[i].axis);
      out_.put("}}");
    }
    out_.put("\n]}\n");
    if (!finite_) return Error{ErrorCode::internal, "a number of the result is not finite", {}};
    return success();
  }

 private:
  void number(double value) {
    if (std::isfinite(value)) {
      out_.put(value);
    } else {
      finite_ = false;
    }
  }
  void put_name(std::string_view name) {
    out_.put('"');
    out_.put(name);
    out_.put("\":");
  }
  void member(std::string_view name, double value) {
    out_.put(name);
    number(value);
  }

  template <class Range, class Put>
  void array(std::string_view name, const Range& values, Put put) {
    out_.put(name);
    out_.put('[');
    bool first = true;
    for (const auto& value : values) {
      if (!first) out_.put(',');
      first = false;
      put(value);
    }
    out_.put(']');
  }
  /// A row of a table.
  template <class... Values>
  void row(Values... values) {
    out_.put('\n');
    char separator = '[';
    const auto one = [&](auto value) {
      out_.put(separator);
      separator = ',';
      if constexpr (std::is_same_v<decltype(value), double>) {
        number(value);
      } else {
        out_.put(static_cast<std::uint32_t>(value));
      }
    };
    (one(values), ...);
    out_.put(']');
  }

  void write_attributes(const Attributes& attributes) {
    array("\"attributes\":", attributes, [this](const auto& attribute) {
      out_.put('[');
      out_.put(quoted(attribute.first));
      out_.put(',');
      out_.put(quoted(attribute.second));
      out_.put(']');
    });
  }

  void write_shape(const Shape& shape) {
    array(",\n\"shape\":{\"points\":", shape.points, [this](Vec2 p) { row(p.x, p.y); });
    if (!shape.bulges.empty()) {
      array(",\n\"bulges\":", shape.bulges, [this](double bulge) { number(bulge); });
    }
    array(",\n\"sources\":", shape.sources, [this](VertexSource s) { row(s.ring, s.vertex); });
    array(",\n\"loop_begin\":", shape.loop_begin, [this](std::uint32_t begin) { out_.put(begin); });
    array(",\n\"component\":", shape.component, [this](std::uint32_t c) { out_.put(c); });
    array(",\n\"hole\":", shape.hole, [this](bool hole) { out_.put(hole ? "true" : "false"); });
    out_.put("}");
  }

  void write_axis(const Shape& shape, const MedialAxis& axis) {
    out_.put(",\n\"axis\":{\"method\":");
    out_.put(quoted(axis.method));
    member(",\"tolerance\":", axis.tolerance);
    member(",\"resolution\":", axis.resolution);
    if (axis.exterior != 0) member(",\"exterior\":", axis.exterior);
    SiteNames names(shape);
    array(",\n\"sites\":", axis.sites, [&](const Site& site) {
      if (const auto vertex = names.vertex_of(site)) {
        row(site.kind, *vertex);
      } else if (site.kind == SiteKind::arc) {
        row(site.kind, site.start.x, site.start.y, site.end.x, site.end.y, site.ring, site.vertex,
            site.bulge);
      } else {
        row(site.kind, site.start.x, site.start.y, site.end.x, site.end.y, site.ring, site.vertex);
      }
    });
    array(",\n\"nodes\":", axis.nodes, [this](const Node& node) {
      row(node.disk.center.x, node.disk.center.y, node.disk.radius, node.component, node.kind);
    });
    array(",\n\"edges\":", axis.edges, [&](const Edge& edge) {
      const auto [from, to] = edge.node;
      const auto [left, right] = edge.site;
      const Disk& control = edge.control;
      if (is_plain(axis, edge)) {
        row(from, to, left, right);
      } else if (edge.weight == 1) {
        row(from, to, left, right, control.center.x, control.center.y, control.radius);
      } else {
        row(from, to, left, right, control.center.x, control.center.y, control.radius, edge.weight);
      }
    });
    write_statistics(axis.statistics);
  }

  void write_statistics(const Statistics& statistics) {
    out_.put(",\n\"statistics\":{");
    for (const auto& [name, count] : statistics_counts) {
      const bool of_exact = std::string_view(name).starts_with("exact_");
      if (of_exact && statistics.*count == 0) continue;
      if (count != &Statistics::queries) out_.put(',');
      put_name(name);
      out_.put(statistics.*count);
    }
    member(",\"largest_residual\":", statistics.largest_residual);
    for (const auto& [name, seconds] : statistics_times) {
      out_.put(',');
      put_name(name);
      number(statistics.*seconds);
    }
    out_.put(",\"threads\":");
    out_.put(statistics.threads);
    out_.put('}');
  }

  OutputStream& out_;
  bool finite_ = true;
};

}  // namespace

Disk middle_of(const Disk& a, const Disk& b) {
  return {midpoint(a.center, b.center), a.radius + 0.5 * (b.radius - a.radius)};
}

Status write_native(OutputStream& out, const Document<AxisItem>& file) {
  return NativeWriter(out).write(file);
}

}  // namespace medial::io
