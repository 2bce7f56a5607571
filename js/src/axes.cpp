// Axes of single shapes: computation, arrays, queries.

#include "faces/axes.h"

#include <algorithm>
#include <cmath>

#include "binding.h"

namespace medial::js {
namespace {

constexpr std::size_t fine_work = 4000;  // with fewer points, one thread may be as fast as several

Options options_from(const char* given) {
  Named named(given);
  std::string name = "disks";
  named.take("method", name);
  const std::optional<Method> method = method_from(name);
  if (!method) refuse(ErrorCode::invalid_option, "there is no method '" + name + "'");
  Options options;
  options.method = *method;
  named.take("tolerance", options.tolerance).take("corner_angle", options.corner_angle);
  named.take("exact", options.exact).take("exterior", options.exterior);
  named.take("margin", options.margin).take("threads", options.threads);
  value_of(faces::take_own(named, options.method));
  named.finish();
  return options;
}

/// Polylines along all branches: rows of x, y, radius; the first row of each; the branch's nodes.
void answer_lines(const MedialAxis& axis, double chord, double step) {
  std::vector<Disk> disks;
  std::vector<double> begin{0};
  std::vector<double> ends;
  faces::add_lines(axis, chord, step, disks, begin);
  for (const Branch& branch : branches(axis))
    ends.insert(ends.end(), {number(branch.from), number(branch.to)});
  answer().tables = {table_of(disks), std::move(begin), std::move(ends)};
}

Json& add_statistics(Json& json, const Statistics& from) {
  return json.add("queries", number(from.queries))
      .add("apollonius", number(from.apollonius))
      .add("bridges", number(from.bridges))
      .add("precision_retries", number(from.precision_retries))
      .add("exact_changes", number(from.exact_changes))
      .add("largest_residual", from.largest_residual)
      .add("seconds", from.seconds);
}

/// The default threshold of each measure, by name and without a unit.
std::string measures() {
  Json json;
  for (const PruneMeasure measure : prune_measures())
    json.add(name_of(measure), default_threshold(measure));
  return json.text();
}

}  // namespace

AxisOf* new_axis(SharedShape shape, MedialAxis axis) {
  return new AxisOf{std::move(shape), std::move(axis)};
}

MEDIAL_JS AxisOf* medial_axis(const ShapeOf* of, const char* given) {
  return answered([&] {
    Options options = options_from(given);
    if (options.threads == 0 && of->shape->points.size() < fine_work) options.threads = 1;
    return new_axis(of->shape, value_of(compute(*of->shape, options, of->contours)));
  });
}

/// The addresses and numbers of nodes, edges and sites, then tolerance, resolution, exterior,
/// length, branches. The text has the method and statistics.
MEDIAL_JS int medial_axis_numbers(const AxisOf* of) {
  return answered([&] {
    const MedialAxis& axis = of->axis;
    static_assert(sizeof(Node) == 32 && sizeof(Edge) == 48 && sizeof(Site) == 48);
    answer().tables = {{address_of(axis.nodes.data()), number(axis.nodes.size()),
                        address_of(axis.edges.data()), number(axis.edges.size()),
                        address_of(axis.sites.data()), number(axis.sites.size()), axis.tolerance,
                        axis.resolution, axis.exterior}};
    Json json;
    json.add("method", axis.method);
    answer().text = add_statistics(json, axis.statistics).text();
    return 1;
  });
}

MEDIAL_JS double medial_total_length(const AxisOf* of) { return total_length(of->axis); }
MEDIAL_JS double medial_branch_count(const AxisOf* of) { return number(branch_count(of->axis)); }

MEDIAL_JS int medial_edge_lengths(const AxisOf* of) {
  return answered([&] {
    std::vector<double> lengths;
    for (const Edge& edge : of->axis.edges) lengths.push_back(length(of->axis, edge));
    answer().tables = {std::move(lengths)};
    return 1;
  });
}

MEDIAL_JS int medial_lines(const AxisOf* of, double chord, double step) {
  return answered([&] {
    answer_lines(of->axis, chord, step);
    return 1;
  });
}

/// Rows of x, y, radius, distance, t, edge (-1: none).
MEDIAL_JS int medial_nearest(AxisOf* of, const double* points, std::size_t count) {
  return answered([&] {
    if (!of->locator) of->locator = std::make_unique<AxisLocator>(of->axis);
    std::vector<double> rows;
    for (const Vec2 p : points_at(points, count)) {
      const AxisPoint at = of->locator->nearest(p);
      const double edge = std::isfinite(at.distance) ? number(at.edge) : -1;
      rows.insert(rows.end(),
                  {at.disk.center.x, at.disk.center.y, at.disk.radius, at.distance, at.t, edge});
    }
    answer().tables = {std::move(rows)};
    return 1;
  });
}

/// The maximal disk that touches the boundary nearest to a point: edge, t, and the disk.
MEDIAL_JS int medial_place_at(const AxisOf* of, double x, double y) {
  return answered([&] {
    answer().tables = {{}};
    const auto place = place_on_axis(of->axis, {x, y});
    if (!place) return 1;
    const Disk disk = disk_at(of->axis, of->axis.edges[place->edge], place->t);
    answer().tables = {{number(place->edge), place->t, disk.center.x, disk.center.y, disk.radius}};
    return 1;
  });
}

/// The disk at a parameter of an edge, and its feet on both sites: x, y, radius, left x, y, right
/// x, y. Feet only if the sites are known.
MEDIAL_JS int medial_disk_at(const AxisOf* of, std::uint32_t edge, double t) {
  return answered([&] {
    const MedialAxis& axis = of->axis;
    if (edge >= axis.edges.size() || !(t >= 0 && t <= 1))
      refuse(ErrorCode::invalid_option, "there is no such edge, or t is not in [0, 1]");
    const Disk disk = disk_at(axis, axis.edges[edge], t);
    std::vector<double> row{disk.center.x, disk.center.y, disk.radius};
    for (const std::uint32_t site : axis.edges[edge].site) {
      if (site == no_site) continue;
      const Vec2 at = foot(axis.sites[site], disk.center);
      row.insert(row.end(), {at.x, at.y});
    }
    answer().tables = {std::move(row)};
    return 1;
  });
}

/// Makes an axis from the records of a stored one, as they are in memory.
MEDIAL_JS AxisOf* medial_restored_axis(const ShapeOf* of, const char* method, double tolerance,
                                       double resolution, double exterior, const Site* sites,
                                       std::size_t site_count, const Node* nodes,
                                       std::size_t node_count, const Edge* edges,
                                       std::size_t edge_count) {
  return answered([&] {
    MedialAxis axis{method,
                    tolerance,
                    resolution,
                    exterior,
                    {sites, sites + site_count},
                    {nodes, nodes + node_count},
                    {edges, edges + edge_count},
                    {}};
    return new_axis(of->shape, value_of(faces::sound(std::move(axis))));
  });
}

MEDIAL_JS ShapeOf* medial_shape_of(const AxisOf* of) {
  return answered([&] { return new ShapeOf{of->shape}; });
}

/// The methods, as rows of name, summary and supported input, in the text.
MEDIAL_JS int medial_methods() {
  return answered([&] {
    for (const MethodInfo& method : methods())
      answer().text += Json()
                           .add("name", method.name)
                           .add("summary", method.summary)
                           .add("exact", method.exact())
                           .add("exterior", method.exterior)
                           .text() +
                       "\n";
    return 1;
  });
}
MEDIAL_JS int medial_prune_measures() {
  return answered([&] {
    answer().text = measures();
    return 1;
  });
}

MEDIAL_JS void medial_free_axis(AxisOf* of) { delete of; }

}  // namespace medial::js
