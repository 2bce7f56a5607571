// Section 5 of Aichholzer et al. (2009): arcs, errors and times of four shapes bounded by curves.

#include "papers/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cli/plot.h"
#include "medial/compute.h"
#include "medial/query.h"
#include "medial/shape.h"
#include "medial/verify.h"
#include "methods/biarc_dc/biarc_dc.h"
#include "papers/aichholzer_2009/shapes.h"
#include "papers/aichholzer_2009/stability.h"
#include "papers/table.h"

namespace medial::papers {
namespace {

using cli::Plot;
using cli::Series;
using NamedContours = std::pair<std::string, std::vector<Contour>>;

constexpr double unmeasured = std::numeric_limits<double>::quiet_NaN();

/// One shape at one tolerance: a line of Table 1, a point in Figs. 12, 15 and 16. Times in seconds.
struct Row {
  std::string shape;
  double tolerance = 0;           ///< relative to the diagonal
  std::uint64_t edges = 0;        ///< of the shape: arcs, and the straight edges beside them
  double error = 0;               ///< certified Hausdorff distance, relative to the diagonal
  double conversion = 0;          ///< approximate_by_arcs(), the paper's first column of times
  double building = 0;            ///< build_shape(): crossings, nesting; the paper has no such step
  double axis = 0;                ///< compute(), the paper's column of double
  double exact = unmeasured;      ///< with Options::exact, the paper's column of Gmpq
  double published = unmeasured;  ///< the paper's own method, biarc-dc
  double conquer = unmeasured;    ///< of `published`: base cases and curves
  std::vector<std::uint64_t> base_cases;  ///< of biarc-dc: how many of (a), ..., (m), Figs. 5 and 6
  std::uint64_t leaves = 0;
  std::uint64_t branchings = 0;
  std::string failure;   ///< an error, or what verify() refused; empty: verified
  bool refused = false;  ///< by biarc-dc, as a shape that it does not take
};

std::uint64_t count(const MedialAxis& axis, NodeKind kind) {
  return static_cast<std::uint64_t>(
      std::count_if(axis.nodes.begin(), axis.nodes.end(),
                    [kind](const Node& node) { return node.kind == kind; }));
}

std::string failure_of(const Shape& shape, const MedialAxis& axis) {
  const Certificate certificate = verify(shape, axis);
  if (certificate.passed) return {};
  return certificate.failures.empty() ? "not verified" : certificate.failures.front();
}

std::string verdict(const std::string& failure, bool refused = false) {
  if (!failure.empty()) return "NO: " + failure;
  return refused ? "yes; biarc-dc refuses" : "yes";
}

/// What is wrong with the axis of biarc-dc beside that of `disks`.
std::string difference(const Shape& shape, const MedialAxis& published, const MedialAxis& axis) {
  if (const std::string failure = failure_of(shape, published); !failure.empty()) return failure;
  const std::uint64_t leaves = count(published, NodeKind::leaf),
                      expected = count(axis, NodeKind::leaf);
  if (leaves != expected) return fmt::format("{} leaves, not {}", leaves, expected);
  const double a = total_length(axis), b = total_length(published);
  if (std::abs(a - b) > 1e-9 * a) return fmt::format("length off by {:.1e}", std::abs(a - b) / a);
  return {};
}

/// The paper's own method beside `disks`: its time, and whether it finds the same graph.
void measure_published(const Shape& shape, const MedialAxis& axis, int rounds, Row& row) {
  const Options options{.method = method::BiarcDc{}, .threads = 1};
  const auto published = timed(rounds, row.published, [&] { return compute(shape, options); });
  std::string failure;
  if (published) {
    row.conquer = published->statistics.seconds_collect;
    biarc_dc::Report division;
    static_cast<void>(biarc_dc::run({shape, options}, &division));  // the same again: the same seed
    row.base_cases.assign(division.base_cases.begin(), division.base_cases.end());
    failure = difference(shape, *published, axis);
  } else {
    row.published = unmeasured;
    row.refused = published.error().code == ErrorCode::unsupported;
    if (!row.refused) failure = to_string(published.error());
  }
  if (row.failure.empty() && !failure.empty()) row.failure = "biarc-dc: " + failure;
}

Row measure(const NamedContours& input, double tolerance, int rounds, bool all_methods = true) {
  progress(fmt::format("{}, tolerance {:.0e}", input.first, tolerance));
  Row row;
  row.shape = input.first;
  row.tolerance = tolerance;
  const auto fail = [&](const Error& error) {
    row.failure = to_string(error);
    return row;
  };
  const ArcOptions arc_options{.tolerance = tolerance, .threads = 1};
  ArcReport report;
  const auto rings = timed(rounds, row.conversion,
                           [&] { return approximate_by_arcs(input.second, arc_options, &report); });
  if (!rings) return fail(rings.error());
  row.error = report.largest_error * tolerance / report.tolerance;
  const auto shape = timed(rounds, row.building, [&] { return build_shape(*rings); });
  if (!shape) return fail(shape.error());
  row.edges = shape->points.size();
  const auto axis = timed(rounds, row.axis, [&] { return compute(*shape, {.threads = 1}); });
  if (!axis) return fail(axis.error());
  row.leaves = count(*axis, NodeKind::leaf);
  row.branchings = count(*axis, NodeKind::branching);
  row.failure = failure_of(*shape, *axis);
  if (!all_methods) return row;
  Options exact;
  exact.threads = 1;
  exact.exact = true;
  if (!timed(1, row.exact, [&] { return compute(*shape, exact); }))
    row.exact = unmeasured;  // built without exact decisions
  measure_published(*shape, *axis, rounds, row);
  return row;
}

std::vector<Row> measure_by_tolerance(const Request& request) {
  const std::array<NamedContours, 4> shapes = {{{"tree", tree(5)},
                                                {"snowflake", snowflake(4)},
                                                {"lettering", lettering(8)},
                                                {"border", border(10)}}};
  std::vector<Row> rows;
  for (const NamedContours& input : shapes) {
    const std::size_t first = rows.size();
    for (int i = 1; i <= (request.quick ? 2 : 9); ++i) {
      rows.push_back(measure(input, std::pow(10, -2 - i), request.rounds));
      // Spiral biarcs keep the leaves whatever the tolerance (Section 2.4 of the paper).
      Row& row = rows.back();
      if (row.failure.empty() && row.leaves != rows[first].leaves)
        row.failure =
            fmt::format("{} leaves, {} at the first tolerance", row.leaves, rows[first].leaves);
    }
  }
  return rows;
}

/// Shapes of about 1e4, 1e5 and 1e6 arcs at the tolerance 1e-6.
std::vector<Row> measure_by_size(const Request& request) {
  struct Family {
    const char* name;
    std::vector<Contour> (*make)(int size);
    std::array<int, 3> sizes;
  };
  constexpr std::array<Family, 3> families = {{{"tree", tree, {4, 7, 10}},
                                               {"snowflake", snowflake, {4, 6, 8}},
                                               {"lettering", lettering, {7, 27, 97}}}};
  std::vector<Row> rows;
  for (const Family& family : families)
    for (std::size_t i = 0; i < (request.quick ? 1 : family.sizes.size()); ++i)
      rows.push_back(measure({family.name, family.make(family.sizes[i])}, 1e-6, request.rounds));
  return rows;
}

// ---- Fig. 13 ------------------------------------------------------------------------------------

/// A point of a piece, a line or a Bezier curve without weights, by de Casteljau.
Vec2 point_at(const Contour& contour, const CurvePiece& piece, double t) {
  std::array<Vec2, 4> work;
  std::copy_n(contour.points.begin() + piece.first, piece.degree + 1, work.begin());
  for (std::uint32_t level = piece.degree; level > 0; --level) {
    for (std::uint32_t i = 0; i < level; ++i) work[i] = work[i] + t * (work[i + 1] - work[i]);
  }
  return work[0];
}

double distance_to_chord(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 chord = b - a;
  const double t = std::clamp(dot(p - a, chord) / squared_norm(chord), 0.0, 1.0);
  return distance(p, a + t * chord);
}

/// The contours flattened with `chords` chords for every curve. `error` grows to the largest
/// distance found between a chord and its curve.
std::vector<Ring> flattened(const std::vector<Contour>& contours, int chords, double& error) {
  constexpr int samples = 16;
  std::vector<Ring> rings;
  for (const Contour& contour : contours) {
    Ring& ring = rings.emplace_back();
    ring.points.push_back(contour.points[0]);
    for (const CurvePiece& piece : contour.pieces) {
      const int count = piece.degree == 1 ? 1 : chords;
      for (int i = 0; i < count; ++i) {
        const Vec2 from = ring.points.back();
        const Vec2 to = point_at(contour, piece, (i + 1.0) / count);
        for (int j = 1; j < samples; ++j) {
          const Vec2 p = point_at(contour, piece, (i + static_cast<double>(j) / samples) / count);
          error = std::max(error, distance_to_chord(p, from, to));
        }
        ring.points.push_back(to);
      }
    }
  }
  return rings;
}

/// The same shape by arcs, and by the polygon with as many edges or a few more. Adds a row to the
/// table; false if an axis failed.
bool compare_with_polygon(const NamedContours& input, double tolerance, Table& table) {
  const Row arcs = measure(input, tolerance, 1, false);
  std::string failure = arcs.failure;
  std::uint64_t leaves = 0;
  double error = 0;
  for (int chords = 1; failure.empty(); ++chords) {
    error = 0;
    const auto polygon = build_shape(flattened(input.second, chords, error));
    if (polygon && polygon->points.size() < arcs.edges) continue;
    const auto axis = polygon ? compute(*polygon) : polygon.error();
    if (!axis) {
      failure = to_string(axis.error());
      break;
    }
    leaves = count(*axis, NodeKind::leaf);
    error /= diagonal(bounding_box(*polygon));
    failure = failure_of(*polygon, *axis);
    break;
  }
  table.add({input.first, arcs.edges, arcs.leaves, leaves, arcs.error, error, verdict(failure)});
  return failure.empty();
}

// ---- Section 2.4 --------------------------------------------------------------------------------

/// How far the axis is off where the boundary is off by a tolerance, beside the bound of Section
/// 2.4; the axis at 1e-10 stands in for the exact one. False if one failed, or the bound.
bool measure_stability(const Request& request, const NamedContours& input, Table& table) {
  progress(fmt::format("{}: stability", input.first));
  const auto axis_at = [&](double tolerance, ArcReport& report) -> Result<MedialAxis> {
    const auto rings = approximate_by_arcs(input.second, {.tolerance = tolerance}, &report);
    if (!rings) return rings.error();
    const auto shape = build_shape(*rings);
    return shape ? compute(*shape) : shape.error();
  };
  ArcReport fine;
  const auto exact = axis_at(1e-10, fine);
  if (!exact) return false;
  bool holds = true;
  for (int i = 2; i <= (request.quick ? 3 : 7); ++i) {
    ArcReport coarse;
    const double tolerance = std::pow(10, -i);
    const auto axis = axis_at(tolerance, coarse);
    if (!axis) return false;
    const double epsilon = coarse.largest_error + fine.largest_error;
    const Stability found = stability(*exact, *axis, epsilon);
    const double diagonal = coarse.tolerance / tolerance;
    table.add({input.first, tolerance, epsilon / diagonal, std::uint64_t{found.points},
               found.largest / diagonal, found.worst_share, found.worst_share <= 1 ? "yes" : "NO"});
    holds = holds && found.worst_share <= 1;
  }
  return holds;
}

// ---- Tables and plots ---------------------------------------------------------------------------

/// Microseconds an edge.
double per_edge(double seconds, const Row& row) {
  return row.edges == 0 ? 0 : 1e6 * seconds / static_cast<double>(row.edges);
}

Table rows_table(const std::vector<Row>& rows) {
  Table table({{"shape"},
               {"tolerance", "{:.0e}"},
               {"arcs"},
               {"error", "{:.2e}"},
               {"conversion s", "{:.4f}"},
               {"build s", "{:.4f}"},
               {"axis s", "{:.4f}"},
               {"conversion us/arc", "{:.2f}"},
               {"build us/arc", "{:.2f}"},
               {"axis us/arc", "{:.2f}"},
               {"biarc-dc s", "{:.3f}"},
               {"biarc-dc / axis", "{:.1f}"},
               {"its conquer s (wall)", "{:.3f}"},
               {"exact s", "{:.4f}"},
               {"exact / axis", "{:.1f}"},
               {"leaves"},
               {"branchings"},
               {"verified"}});
  for (const Row& row : rows)
    table.add({row.shape, row.tolerance, row.edges, row.error, row.conversion, row.building,
               row.axis, per_edge(row.conversion, row), per_edge(row.building, row),
               per_edge(row.axis, row), row.published, row.published / row.axis, row.conquer,
               row.exact, row.exact / row.axis, row.leaves, row.branchings,
               verdict(row.failure, row.refused)});
  return table;
}

/// The rows of each shape, in order.
std::vector<std::vector<Row>> by_shape(const std::vector<Row>& rows) {
  std::vector<std::vector<Row>> groups;
  for (const Row& row : rows) {
    if (groups.empty() || groups.back().front().shape != row.shape) groups.emplace_back();
    groups.back().push_back(row);
  }
  return groups;
}

Points against_edges(const std::vector<Row>& rows, double Row::*value) {
  Points points;
  for (const Row& row : rows)
    if (row.edges > 0 && row.*value > 0)
      points.emplace_back(static_cast<double>(row.edges), row.*value);
  return points;
}

/// What each series says as a whole.
std::string fits_table(const std::vector<Row>& rows) {
  Table table({{"shape"},
               {"error ~ n^p", "{:.2f}"},
               {"conversion ~ n^p", "{:.2f}"},
               {"axis ~ n^p", "{:.2f}"},
               {"biarc-dc ~ n^p", "{:.2f}"},
               {"axis us/(arc log2 arcs): first", "{:.4f}"},
               {"last", "{:.4f}"}});
  const auto exponent = [](const Points& points) {
    return points.size() < 2 ? unmeasured : fitted_exponent(points);
  };
  const auto share = [](const Row& row) {
    return row.edges < 2 ? 0 : per_edge(row.axis, row) / std::log2(row.edges);
  };
  for (const auto& group : by_shape(rows)) {
    // Where tolerances are coarse, the number of arcs is that of the spirals, whatever the error.
    Points errors = against_edges(group, &Row::error);
    const double twice = errors.empty() ? 0 : 2 * errors.front().first;
    std::erase_if(errors, [&](const auto& point) { return point.first < twice; });
    const bool one_tolerance = group.front().tolerance == group.back().tolerance;
    table.add({group.front().shape, one_tolerance ? unmeasured : exponent(errors),
               exponent(against_edges(group, &Row::conversion)),
               exponent(against_edges(group, &Row::axis)),
               exponent(against_edges(group, &Row::published)), share(group.front()),
               share(group.back())});
  }
  return table.markdown();
}

/// How often each base case of Figs. 5 and 6 was met.
std::string base_cases_table(const std::vector<Row>& rows) {
  std::vector<Table::Column> columns{{"shape"}, {"tolerance", "{:.0e}"}, {"arcs"}};
  for (char name = 'a'; name <= 'm'; ++name) columns.push_back({std::string(1, name)});
  columns.push_back({"cap"});
  Table table(std::move(columns));
  for (const Row& row : rows) {
    if (row.base_cases.empty()) continue;
    std::vector<Table::Cell> cells{row.shape, row.tolerance, row.edges};
    cells.insert(cells.end(), row.base_cases.begin(), row.base_cases.end());
    table.add(std::move(cells));
  }
  return table.markdown();
}

/// The time at this many microseconds per arc, over the arcs of all rows.
Series reference_line(const std::vector<Row>& rows, double microseconds, const char* name) {
  const auto [least, most] = std::minmax_element(
      rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.edges < b.edges; });
  Series series{name, {}, true};
  for (const std::uint64_t edges : {least->edges, most->edges}) {
    const auto n = static_cast<double>(std::max<std::uint64_t>(edges, 1));
    series.points.emplace_back(n, 1e-6 * microseconds * n);
  }
  return series;
}

Status draw_plots(const Request& request, const std::vector<Row>& by_tolerance,
                  const std::vector<Row>& by_size) {
  const auto plot = [](const char* title, const char* y_label, const std::vector<Row>& rows,
                       double Row::*value) {
    Plot drawn{title, "arcs", y_label, {}};
    for (const auto& group : by_shape(rows))
      drawn.series.push_back({group.front().shape, against_edges(group, value)});
    return drawn;
  };
  std::vector<Plot> plots{
      plot("Error against arcs (Fig. 12)", "certified error / diagonal", by_tolerance, &Row::error),
      plot("Time against arcs, by tolerance (Figs. 15, 16)", "axis, seconds", by_tolerance,
           &Row::axis),
      plot("Time against arcs, by size at tolerance 1e-6", "axis, seconds", by_size, &Row::axis),
      plot("Boundary conversion against arcs", "conversion, seconds", by_tolerance,
           &Row::conversion)};
  plots[1].series.push_back(reference_line(by_tolerance, 1, "1 us an arc"));
  plots[2].series.push_back(reference_line(by_size, 1, "1 us an arc"));
  plots[3].series.push_back(reference_line(by_tolerance, 1.5, "1.5 us an arc"));
  return cli::write_plots((request.to / "plots.svg").string(), plots);
}

Status write_shapes(const Request& request) {
  return in_order([&] { return write(request, "tree.svg", svg_document(tree(5))); },
                  [&] { return write(request, "snowflake.svg", svg_document(snowflake(4))); },
                  [&] { return write(request, "lettering.svg", svg_document(lettering(8))); },
                  [&] { return write(request, "border.svg", svg_document(border(10))); });
}

}  // namespace

Result<bool> run_aichholzer_2009(const Request& request) {
  const std::vector<Row> by_tolerance = measure_by_tolerance(request);
  const std::vector<Row> by_size = measure_by_size(request);
  Table polygons({{"shape"},
                  {"edges"},
                  {"leaves of arcs"},
                  {"leaves of the polygon"},
                  {"error of arcs", "{:.2e}"},
                  {"error of the polygon", "{:.2e}"},
                  {"verified"}});
  bool passed = true;
  for (const double tolerance : {1e-3, 1e-4}) {
    passed = compare_with_polygon({"lettering", lettering(1)}, tolerance, polygons) && passed;
    passed = compare_with_polygon({"tree", tree(3)}, tolerance, polygons) && passed;
  }
  Table stable({{"shape"},
                {"tolerance", "{:.0e}"},
                {"epsilon", "{:.2e}"},
                {"points"},
                {"largest distance", "{:.2e}"},
                {"of the bound", "{:.3f}"},
                {"holds"}});
  for (const NamedContours& input : {NamedContours{"tree", tree(5)},
                                     {"snowflake", snowflake(4)},
                                     {"lettering", lettering(2)},
                                     {"border", border(10)}})
    passed = measure_stability(request, input, stable) && passed;
  for (const auto* rows : {&by_tolerance, &by_size})
    for (const Row& row : *rows) passed = passed && row.failure.empty();
  const Table tolerances = rows_table(by_tolerance), sizes = rows_table(by_size);
  const std::string text = fmt::format(
      "Processor time of one thread, the least of {} round(s) (exact: one); "
      "tolerance\n"
      "and error relative to the diagonal of the bounding box.\n\n"
      "## By tolerance (Table 1, Figs. 12, 15, 16)\n\n{}\n{}\n"
      "## Base cases of biarc-dc (Figs. 5, 6)\n\n{}\n"
      "## By size\n\n{}\n{}\n"
      "## Arcs and polygons (Fig. 13)\n\n{}\n"
      "## Stability (Section 2.4)\n\n{}",
      request.rounds, tolerances.markdown(), fits_table(by_tolerance),
      base_cases_table(by_tolerance), sizes.markdown(), fits_table(by_size), polygons.markdown(),
      stable.markdown());
  const Status written =
      in_order([&] { return write(request, "tables.md", text); },
               [&] { return write(request, "by_tolerance.csv", tolerances.csv()); },
               [&] { return write(request, "by_size.csv", sizes.csv()); },
               [&] { return write(request, "polygons.csv", polygons.csv()); },
               [&] { return write(request, "stability.csv", stable.csv()); },
               [&] { return draw_plots(request, by_tolerance, by_size); },
               [&] { return write_shapes(request); });
  if (!written) return written.error();
  return passed;
}

}  // namespace medial::papers
