// Section IV of Volkmann and St. Clair (1987): times of ridge following against edges, area, holes
// and concave vertices.

#include "methods/raster/ridge/ridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cli/plot.h"
#include "medial/compute.h"
#include "medial/verify.h"
#include "papers/experiment.h"
#include "papers/figure.h"
#include "papers/table.h"
#include "papers/volkmann_stclair_1987/volkmann.h"

namespace medial::papers {
namespace {

// ---- Shapes -------------------------------------------------------------------------------------

/// The area of the shapes of which something else varies.
constexpr double usual_area = 30;

Ring scaled_to(Ring ring, double wanted) {
  double doubled = 0;
  for (std::size_t i = 0; i < ring.points.size(); ++i)
    doubled += cross(ring.points[i], ring.points[(i + 1) % ring.points.size()]);
  const double scale = std::sqrt(wanted / (0.5 * std::abs(doubled)));
  for (Vec2& p : ring.points) p = scale * p;
  return ring;
}

Ring regular(int edges) {
  Ring ring;
  for (int i = 0; i < edges; ++i) {
    const double angle = 2 * std::numbers::pi * i / edges;
    ring.points.push_back({std::cos(angle), std::sin(angle)});
  }
  return ring;
}

/// p seen in the mirror that is the line through a and b.
Vec2 reflected(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = (1 / distance(a, b)) * (b - a);
  const Vec2 foot = a + dot(p - a, along) * along;
  return 2 * foot - p;
}

/// A square with teeth along its border; each hole takes the place of three teeth (Fig. 29). At
/// most 20 holes; edges, convex and concave vertices are as many for any number of holes.
std::vector<Ring> toothed_square(int holes) {
  constexpr double tooth = 0.5, height = 0.4, margin = 2, depth = 1;
  constexpr int places = 5, teeth_each = 3;
  // A tooth that stays before, between and after the places: no two long edges make one.
  constexpr double side = 2 * margin + (places * (teeth_each + 1) + 1) * tooth;
  std::vector<Ring> rings(1);
  int place = 0;
  for (int s = 0; s < 4; ++s) {
    // Along this side: x forward, y inward; sides counter-clockwise around the centre.
    const auto put = [s](double x, double y) {
      Vec2 p{x - 0.5 * side, y - 0.5 * side};
      for (int turn = 0; turn < s; ++turn) p = left_of(p);
      return p;
    };
    const auto add_teeth = [&](double x, int count) {
      for (int t = 0; t < count; ++t) {
        rings[0].points.push_back(put(x + t * tooth, 0));
        rings[0].points.push_back(put(x + (t + 0.5) * tooth, height));
      }
    };
    rings[0].points.push_back(put(0, 0));
    for (int k = 0; k < places; ++k, ++place) {
      const double before = margin + k * (teeth_each + 1) * tooth, x = before + tooth;
      const bool hole = place * holes / 20 != (place + 1) * holes / 20;  // spread evenly
      add_teeth(before, 1);
      if (hole)
        rings[0].points.push_back(put(x, 0));
      else
        add_teeth(x, teeth_each);
      if (!hole) continue;
      // A triangle with dents in two of its sides.
      const double c = x + 0.5 * teeth_each * tooth;
      Ring ring;
      for (const Vec2 p :
           {Vec2{-0.4, 0}, Vec2{0.4, 0}, Vec2{0.1, 0.25}, Vec2{0, 0.7}, Vec2{-0.1, 0.25}})
        ring.points.push_back(put(c + p.x, depth + p.y));
      rings.push_back(std::move(ring));
    }
    add_teeth(side - margin - tooth, 1);
    rings[0].points.push_back(put(side - margin, 0));
  }
  return rings;
}

/// The regular polygon of 20 edges of which `sets` runs of `run` vertices are reflected about the
/// line through their neighbours (Fig. 31).
Ring flipped_polygon(int sets, int run) {
  Ring ring = regular(20);
  std::vector<Vec2>& points = ring.points;
  for (int s = 0; s < sets; ++s) {
    const auto at = [&points](int i) -> Vec2& { return points[static_cast<std::size_t>(i % 20)]; };
    const int before = s * (run + 1);
    const Vec2 a = at(before), b = at(before + run + 1);
    for (int i = 1; i <= run; ++i) at(before + i) = reflected(at(before + i), a, b);
  }
  // The size of the whole polygon, not its area, is that of the others.
  const double scale = std::sqrt(usual_area / (10 * std::sin(2 * std::numbers::pi / 20)));
  for (Vec2& p : points) p = scale * p;
  return ring;
}

// ---- Measuring ----------------------------------------------------------------------------------

/// What the report times, and what it had to do. Seconds of one thread, each the least of all
/// rounds.
struct Times {
  double start = 0;   ///< digitising, vertex types, combined edges, lines: steps 1 to 6 of Table I
  double first = 0;   ///< inner point and first medial pixel: 7 and 8
  double follow = 0;  ///< the rest of the medial pixels: 9
  double thin = 0;    ///< 10
  std::uint64_t checked = 0;  ///< pixels of which the nearest edges were sought
  std::uint64_t found = 0;    ///< medial pixels before thinning
  std::uint64_t kept = 0;     ///< and after
  double total() const { return start + first + follow + thin; }
};

/// One way to the medial pixels. The report's own is the first one.
struct Way {
  const char* name;
  bool sorted_list;
  RidgeRule rule;
  double collinear;  ///< degrees; 0 keeps every edge
};
constexpr std::array<Way, 3> ways = {{{"sorted list", true, RidgeRule::difference, 5},
                                      {"tree", false, RidgeRule::difference, 5},
                                      {"tree, crossing", false, RidgeRule::crossing, 0}}};

/// One shape: a point in each plot of its series.
struct Row {
  std::string series;       ///< "edges", "area", "holes", "concave"
  double value = 0;         ///< what varies: edges, area, holes, concave vertices
  std::uint64_t run = 0;    ///< of "concave": concave vertices next to each other
  std::uint64_t edges = 0;  ///< of the shape
  double area = 0;
  std::uint64_t concave = 0;  ///< vertices
  std::array<Times, ways.size()> times;
  std::string refused;  ///< what build_shape() says of a shape that is none
  std::string failure;  ///< list and tree differ, or an axis has other cycles than holes
};

MedialAxis measure(const Shape& shape, const Way& way, const Request& request, Times& times) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const double step = request.quick ? 1.0 / 6 : 1.0 / 20;  // pixels along a unit of length
  const Options options{
      .method = method::Ridge{{.resolution = step}, way.collinear, way.sorted_list, way.rule},
      .threads = 1};
  times = {never, never, never, never};
  MedialAxis axis;
  for (int round = 0; round < request.rounds; ++round) {
    ridge::Report report;
    axis = ridge::run({shape, options}, &report);
    times = {std::min(times.start, report.seconds_start),
             std::min(times.first, report.seconds_first),
             std::min(times.follow, report.seconds_follow),
             std::min(times.thin, report.seconds_thin),
             report.queries,
             report.found,
             report.kept};
  }
  return axis;
}

bool same_pixels(const MedialAxis& a, const MedialAxis& b) {
  return std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(),
                    [](const Node& p, const Node& q) {
                      return p.disk.center == q.disk.center && p.disk.radius == q.disk.radius;
                    });
}

std::uint64_t concave_vertices(const Shape& shape) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const Vec2 p = loop[j], q = loop[(j + 1) % loop.size()], r = loop[(j + 2) % loop.size()];
      if (cross(q - p, r - q) < 0) ++count;
    }
  }
  return count;
}

Row measure(Row row, const std::vector<Ring>& rings, const Request& request) {
  progress(fmt::format("{} {:g}", row.series, row.value));
  const auto shape = build_shape(rings);
  if (!shape) {
    row.refused = name_of(shape.error().code);
    return row;
  }
  row.edges = shape->points.size();
  row.area = area(*shape);
  row.concave = concave_vertices(*shape);
  std::array<MedialAxis, ways.size()> axes;
  for (std::size_t i = 0; i < ways.size(); ++i)
    axes[i] = measure(*shape, ways[i], request, row.times[i]);
  if (!same_pixels(axes[0], axes[1])) row.failure = "the searches differ";
  for (const MedialAxis* axis : {&axes[1], &axes[2]}) {
    const Certificate certificate = verify(*shape, *axis);
    if (row.failure.empty() && certificate.cycles != certificate.holes)
      row.failure = fmt::format("{} cycles, {} holes", certificate.cycles, certificate.holes);
  }
  return row;
}

std::vector<Row> measure_all(const Request& request) {
  std::vector<Row> rows;
  const auto add = [&](const char* series, int value, std::uint64_t run,
                       const std::vector<Ring>& rings) {
    Row row;
    row.series = series;
    row.value = value;
    row.run = run;
    rows.push_back(measure(std::move(row), rings, request));
  };
  const int step = request.quick ? 20 : 1;
  for (int n = 3; n <= 70; n += step) add("edges", n, 0, {scaled_to(regular(n), usual_area)});
  for (int a = 3; a <= 70; a += step) add("area", a, 0, {scaled_to(regular(3), a)});
  for (int holes = 0; holes <= 20; holes += request.quick ? 10 : 1)
    add("holes", holes, 0, toothed_square(holes));
  add("concave", 0, 0, {flipped_polygon(0, 1)});
  for (int run = 1; run <= 9; ++run)
    for (int sets = 1; sets * (run + 1) <= 20; ++sets)
      add("concave", sets * run, static_cast<std::uint64_t>(run), {flipped_polygon(sets, run)});
  return rows;
}

// ---- Tables and plots ---------------------------------------------------------------------------

struct Phase {
  const char* name;
  double (*of)(const Times&);
};
constexpr std::array<Phase, 5> phases = {{{"start", [](const Times& t) { return t.start; }},
                                          {"first", [](const Times& t) { return t.first; }},
                                          {"follow", [](const Times& t) { return t.follow; }},
                                          {"thin", [](const Times& t) { return t.thin; }},
                                          {"total", [](const Times& t) { return t.total(); }}}};

/// What the report says of a phase, beside the exponents and the correlation found.
struct Claim {
  const char* figure;
  std::string series;
  std::size_t phase;
  const char* text;
};
const std::array<Claim, 11> claims = {{{"19", "edges", 0, "n; correlation 0.64"},
                                       {"20", "edges", 1, "n; correlation 0.74 (Table I: n log n)"},
                                       {"21", "edges", 2, "above n log n, up from 16 edges"},
                                       {"22", "edges", 3, "above n log n, level from 40 edges"},
                                       {"23", "edges", 4, ""},
                                       {"24", "area", 0, "sqrt n"},
                                       {"25", "area", 1, "1; correlation 0.30"},
                                       {"26", "area", 2, "sqrt n (Table I: n)"},
                                       {"27", "area", 3, "n"},
                                       {"28", "area", 4, ""},
                                       {"30", "holes", 4, "falls with the holes"}}};

/// The seconds of a claim's phase against what varies, on one of the ways.
Points points_of(const std::vector<Row>& rows, const Claim& claim, std::size_t way) {
  Points points;
  for (const Row& row : rows)
    if (row.series == claim.series && row.refused.empty())
      points.emplace_back(row.value, phases[claim.phase].of(row.times[way]));
  return points;
}

/// Holes count from 0, and logarithms do not.
Points shifted(Points points, const Claim& claim) {
  if (claim.series == "holes")
    for (auto& point : points) point.first += 1;
  return points;
}

std::string claims_table(const std::vector<Row>& rows) {
  Table table({{"figure"},
               {"against"},
               {"phase"},
               {"the report"},
               {"sorted list ~ n^p", "{:.2f}"},
               {"correlation", "{:.2f}"},
               {"tree ~ n^p", "{:.2f}"},
               {"tree, crossing ~ n^p", "{:.2f}"}});
  for (const Claim& claim : claims) {
    const auto exponent = [&](std::size_t way) {
      return fitted_exponent(shifted(points_of(rows, claim, way), claim));
    };
    table.add({claim.figure, claim.series, phases[claim.phase].name, claim.text, exponent(0),
               correlation(points_of(rows, claim, 0)), exponent(1), exponent(2)});
  }
  return table.markdown();
}

std::string rows_table(const std::vector<Row>& rows, const std::string& series) {
  const bool concave = series == "concave";
  std::vector<Table::Column> columns{
      {concave ? "A / B" : series}, {"edges"}, {"concave"}, {"area", "{:.3g}"}};
  for (const char* name : {"start", "first", "follow", "thin", "total"})
    columns.push_back({name, "{:.3f}"});
  for (const char* name : {"pixels checked", "found", "kept"}) columns.push_back({name});
  for (const char* name : {"tree: total", "crossing: total"}) columns.push_back({name, "{:.3f}"});
  for (const char* name : {"its found", "its kept", ""}) columns.push_back({name});
  Table table(columns);
  for (const Row& row : rows) {
    if (row.series != series) continue;
    std::vector<Table::Cell> cells{concave ? fmt::format("{:g}/{}", row.value, row.run)
                                           : fmt::format("{:g}", row.value)};
    if (row.refused.empty()) {
      const auto& [list, tree, crossing] = row.times;
      cells.insert(cells.end(), {row.edges, row.concave, row.area});
      for (const Phase& phase : phases) cells.emplace_back(1e3 * phase.of(list));
      cells.insert(cells.end(), {list.checked, list.found, list.kept, 1e3 * tree.total(),
                                 1e3 * crossing.total(), crossing.found, crossing.kept,
                                 row.failure.empty() ? "" : "FAILED: " + row.failure});
    } else {
      cells.resize(columns.size() - 1);
      cells.emplace_back("refused: " + row.refused);
    }
    table.add(std::move(cells));
  }
  return table.markdown();
}

std::string report_text(const std::vector<Row>& rows, const Request& request) {
  return fmt::format(
      "Milliseconds of one thread, of each phase the least of {} round(s).\nThe columns without "
      "another name are the report's own way: sorted list, rule `difference`, 5 degrees.\n\n"
      "## Exponents beside the report's claims (Figs. 19 to 30, Table I)\n\n{}\n"
      "## Number of edges (Figs. 19 to 23)\n\n{}\n## Area (Figs. 24 to 28)\n\n{}\n"
      "## Number of holes (Fig. 30)\n\n{}\n"
      "## Number and distribution of concave vertices (Fig. 32)\n\nA concave vertices in all, B "
      "next to each other.\n\n{}",
      request.rounds, claims_table(rows), rows_table(rows, "edges"), rows_table(rows, "area"),
      rows_table(rows, "holes"), rows_table(rows, "concave"));
}

std::string rows_csv(const std::vector<Row>& rows) {
  std::vector<Table::Column> columns;
  for (const char* name :
       {"series", "value", "run", "edges", "area", "concave", "refused", "failure"})
    columns.push_back({name});
  for (const std::string way : {"list", "tree", "crossing"})
    for (const char* name : {"start", "first", "follow", "thin", "checked", "found", "kept"})
      columns.push_back({way + "_" + name});
  Table table(columns);
  for (const Row& row : rows) {
    std::vector<Table::Cell> cells{row.series, row.value,   row.run,     row.edges,
                                   row.area,   row.concave, row.refused, row.failure};
    for (const Times& t : row.times)
      cells.insert(cells.end(), {t.start, t.first, t.follow, t.thin, t.checked, t.found, t.kept});
    table.add(std::move(cells));
  }
  return table.csv();
}

std::vector<cli::Plot> plots_of(const std::vector<Row>& rows) {
  std::vector<cli::Plot> plots;
  for (const Claim& claim : claims) {
    const char* phase = phases[claim.phase].name;
    cli::Plot plot{fmt::format("Fig. {}: {} against {}", claim.figure, phase, claim.series),
                   claim.series == "holes" ? "holes + 1" : claim.series,
                   "seconds",
                   {}};
    for (std::size_t way = 0; way < ways.size(); ++way) {
      Points points = shifted(points_of(rows, claim, way), claim);
      // Above 20 every other one is enough on a logarithmic axis.
      std::erase_if(points, [](const auto& p) {
        return !(p.second > 0) || (p.first > 20 && std::fmod(p.first, 2) == 1);
      });
      plot.series.push_back({plots.empty() ? ways[way].name : "", points});
    }
    plots.push_back(std::move(plot));
  }
  cli::Plot concave{"Fig. 32: total against concave vertices", "concave vertices", "seconds", {}};
  for (std::uint64_t run = 1; run <= 5; ++run) {
    cli::Series series{fmt::format("sets of {}", run), {}};
    for (const Row& row : rows)
      if (row.series == "concave" && row.run == run && row.refused.empty())
        series.points.emplace_back(row.value, row.times[0].total());
    if (!series.points.empty()) concave.series.push_back(std::move(series));
  }
  plots.push_back(std::move(concave));
  return plots;
}

// ---- Figures ------------------------------------------------------------------------------------

/// Draws rings, moved.
void draw_rings(Figure& figure, const std::vector<Ring>& rings, Vec2 shift) {
  for (const Ring& ring : rings) {
    std::vector<Vec2> line;
    for (const Vec2 p : ring.points) line.push_back(p + shift);
    line.push_back(line.front());
    figure.line(line);
  }
}

/// Fig. 29: squares of as many edges with more and more holes.
Status draw_toothed_squares(const Request& request) {
  constexpr double apart = 17;
  Figure figure({{-9, -9}, {3 * apart - 8, 9}});
  figure.ink();
  double x = 0;
  for (const int holes : {0, 10, 20}) {
    draw_rings(figure, toothed_square(holes), {x, 0});
    x += apart;
  }
  return figure.write(request.to / "fig29.svg");
}

/// Fig. 31: one row for each number of reflected vertices side by side. Those that cross themselves
/// are dashed.
Status draw_flipped_polygons(const Request& request) {
  constexpr double apart = 8;
  constexpr int most_run = 9, most_sets = 10;
  Figure figure({{-apart / 2, -most_run * apart + apart / 2}, {most_sets * apart + 3, apart / 2}});
  for (int run = 1; run <= most_run; ++run)
    for (int sets = 1; sets * (run + 1) <= 20; ++sets) {
      const Ring ring = flipped_polygon(sets, run);
      const Vec2 shift{(sets - 1) * apart, (1 - run) * apart};
      if (build_shape(std::vector<Ring>{ring})) {
        figure.ink();
        draw_rings(figure, {ring}, shift);
        continue;
      }
      figure.thin();
      std::vector<Vec2> line;
      for (const Vec2 p : ring.points) line.push_back(p + shift);
      line.push_back(line.front());
      figure.dashed(line);
    }
  return figure.write(request.to / "fig31.svg");
}

}  // namespace

Result<bool> measure_ridge_following(const Request& request) {
  const std::vector<Row> rows = measure_all(request);
  const Status written = in_order(
      [&] { return write(request, "tables.md", report_text(rows, request)); },
      [&] { return write(request, "rows.csv", rows_csv(rows)); },
      [&] { return draw_toothed_squares(request); }, [&] { return draw_flipped_polygons(request); },
      [&] { return cli::write_plots((request.to / "plots.svg").string(), plots_of(rows)); });
  if (!written) return written.error();
  return std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.failure.empty(); });
}

}  // namespace medial::papers
