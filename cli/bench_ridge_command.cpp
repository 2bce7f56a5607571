// medial bench ridge: the experiments of Volkmann and St. Clair as tables, numbers and plots.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include "cli/bench_biarc.h"
#include "cli/bench_ridge.h"
#include "cli/commands.h"
#include "cli/common.h"
#include "cli/plot.h"
#include "cli/terminal.h"

namespace medial::cli {
namespace {

struct Phase {
  const char* name;
  double (*of)(const RidgeTimes&);
};
constexpr std::array<Phase, 5> phases = {
    {{"start", [](const RidgeTimes& t) { return t.start; }},
     {"first", [](const RidgeTimes& t) { return t.first; }},
     {"follow", [](const RidgeTimes& t) { return t.follow; }},
     {"thin", [](const RidgeTimes& t) { return t.thin; }},
     {"total", [](const RidgeTimes& t) { return t.total(); }}}};

struct Way {
  const char* name;
  const RidgeTimes& (*of)(const RidgeRow&);
};
constexpr std::array<Way, 3> ways = {
    {{"sorted list", [](const RidgeRow& r) -> const RidgeTimes& { return r.list; }},
     {"tree", [](const RidgeRow& r) -> const RidgeTimes& { return r.tree; }},
     {"tree, crossing", [](const RidgeRow& r) -> const RidgeTimes& { return r.crossing; }}}};

using Points = std::vector<std::pair<double, double>>;

Points points_of(const std::vector<RidgeRow>& rows, const std::string& series, const Way& way,
                 const Phase& phase) {
  Points points;
  for (const RidgeRow& row : rows)
    if (row.series == series && row.refused.empty())
      points.emplace_back(row.value, phase.of(way.of(row)));
  return points;
}

/// What the report says of a phase, beside the exponents and the correlation found.
struct Claim {
  const char* figure;
  const char* series;
  std::size_t phase;
  const char* text;
};
constexpr std::array<Claim, 11> claims = {
    {{"19", "edges", 0, "n; correlation 0.64"},
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

std::string claims_table(const std::vector<RidgeRow>& rows) {
  std::string text =
      "| figure | against | phase | the report | sorted list ~ n^p | correlation | tree ~ n^p | "
      "tree, crossing ~ n^p |\n| --- | --- | --- | --- | ---: | ---: | ---: | ---: |\n";
  for (const Claim& claim : claims) {
    std::array<std::string, 3> exponent;
    for (std::size_t w = 0; w < ways.size(); ++w) {
      Points points = points_of(rows, claim.series, ways[w], phases[claim.phase]);
      if (std::string(claim.series) == "holes")
        for (auto& point : points) point.first += 1;
      exponent[w] = fmt::format("{:.2f}", fitted_exponent(points));
    }
    text += fmt::format("| {} | {} | {} | {} | {} | {:.2f} | {} | {} |\n", claim.figure,
                        claim.series, phases[claim.phase].name, claim.text, exponent[0],
                        correlation(points_of(rows, claim.series, ways[0], phases[claim.phase])),
                        exponent[1], exponent[2]);
  }
  return text;
}

/// Milliseconds.
std::string ms(double seconds) { return fmt::format("{:.3f}", 1e3 * seconds); }

std::string rows_table(const std::vector<RidgeRow>& rows, const std::string& series) {
  const bool concave = series == "concave";
  std::string text = fmt::format(
      "| {} | edges | concave | area | start | first | follow | thin | total | pixels checked | "
      "found | kept | tree: total | crossing: total | its found | its kept | |\n| ---: | ---: | "
      "---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | "
      "---: | --- |\n",
      concave ? "A / B" : series);
  for (const RidgeRow& row : rows) {
    if (row.series != series) continue;
    const std::string value =
        concave ? fmt::format("{:g}/{}", row.value, row.run) : fmt::format("{:g}", row.value);
    if (!row.refused.empty()) {
      text +=
          fmt::format("| {} | | | | | | | | | | | | | | | | refused: {} |\n", value, row.refused);
      continue;
    }
    const RidgeTimes& t = row.list;
    text += fmt::format(
        "| {} | {} | {} | {:.3g} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} "
        "|\n",
        value, row.edges, row.concave, row.area, ms(t.start), ms(t.first), ms(t.follow), ms(t.thin),
        ms(t.total()), t.checked, t.found, t.kept, ms(row.tree.total()), ms(row.crossing.total()),
        row.crossing.found, row.crossing.kept, row.failure.empty() ? "" : "FAILED: " + row.failure);
  }
  return text;
}

std::string report_text(const std::vector<RidgeRow>& rows, const RidgeBenchOptions& options) {
  return fmt::format(
      "Milliseconds of one thread, of each phase the least of {}; {:g} pixels along a unit of "
      "length.\nThe columns without another name are the report's own way: sorted list, rule "
      "`difference`, 5 degrees.\n\n"
      "## Exponents beside the report's claims (Figs. 19 to 30, Table I)\n\n{}\n"
      "## Number of edges (Figs. 19 to 23)\n\n{}\n## Area (Figs. 24 to 28)\n\n{}\n"
      "## Number of holes (Fig. 30)\n\n{}\n"
      "## Number and distribution of concave vertices (Fig. 32)\n\nA concave vertices in all, B "
      "next to each other.\n\n{}",
      counted(static_cast<std::uint64_t>(options.rounds), "round"), options.per_unit,
      claims_table(rows), rows_table(rows, "edges"), rows_table(rows, "area"),
      rows_table(rows, "holes"), rows_table(rows, "concave"));
}

std::string report_csv(const std::vector<RidgeRow>& rows) {
  std::string text = "series,value,run,edges,area,concave,refused,failure";
  for (const char* way : {"list", "tree", "crossing"})
    for (const char* column : {"start", "first", "follow", "thin", "checked", "found", "kept"})
      text += fmt::format(",{}_{}", way, column);
  text += "\n";
  for (const RidgeRow& row : rows) {
    text += fmt::format("{},{},{},{},{},{},{},{}", row.series, row.value, row.run, row.edges,
                        row.area, row.concave, row.refused, row.failure);
    for (const Way& way : ways) {
      const RidgeTimes& t = way.of(row);
      text += fmt::format(",{},{},{},{},{},{},{}", t.start, t.first, t.follow, t.thin, t.checked,
                          t.found, t.kept);
    }
    text += "\n";
  }
  return text;
}

std::vector<Plot> report_plots(const std::vector<RidgeRow>& rows) {
  std::vector<Plot> plots;
  const auto positive = [](Points points, double shift) {
    std::erase_if(points, [](const auto& p) { return !(p.second > 0); });
    for (auto& p : points) p.first += shift;
    // Above 20 every other one is enough on a logarithmic axis.
    std::erase_if(points, [](const auto& p) {
      return !(p.first > 0) || (p.first > 20 && std::fmod(p.first, 2) == 1);
    });
    return points;
  };
  for (const Claim& claim : claims) {
    const bool holes = std::string(claim.series) == "holes";
    Plot plot{
        fmt::format("Fig. {}: {} against {}", claim.figure, phases[claim.phase].name, claim.series),
        holes ? "holes + 1" : claim.series,
        "seconds",
        {}};
    for (const Way& way : ways)
      plot.series.push_back(
          {plots.empty() ? way.name : "",  // the same in all plots
           positive(points_of(rows, claim.series, way, phases[claim.phase]), holes ? 1 : 0)});
    plots.push_back(std::move(plot));
  }
  Plot concave{"Fig. 32: total against concave vertices", "concave vertices", "seconds", {}};
  for (std::uint64_t run = 1; run <= 5; ++run) {
    Series series{fmt::format("sets of {}", run), {}};
    for (const RidgeRow& row : rows)
      if (row.series == "concave" && row.run == run && row.refused.empty())
        series.points.emplace_back(row.value, row.list.total());
    if (!series.points.empty()) concave.series.push_back(std::move(series));
  }
  plots.push_back(std::move(concave));
  return plots;
}

struct RidgeBenchArguments {
  RidgeBenchOptions options;
  std::string output;
  bool quiet = false;
};

Result<int> run_ridge(const RidgeBenchArguments& arguments) {
  constexpr char formats[] = ".svg .csv";
  Status writable = check_output(arguments.output, {}, formats, {}, false);
  if (!writable) return std::move(writable).error();
  RidgeBenchOptions options = arguments.options;
  if (options.quick) options.rounds = 1;
  const bool shown = error_is_terminal() && !arguments.quiet;
  const std::vector<RidgeRow> rows = run_ridge_experiments(
      options,
      shown ? [](const std::string& name) { say("{}\n", name); } : [](const std::string&) {});
  if (!arguments.output.empty()) {
    Status written = std::filesystem::path(arguments.output).extension() == ".svg"
                         ? write_plots(arguments.output, report_plots(rows))
                         : io::write_text(arguments.output, report_csv(rows));
    if (!written) return std::move(written).error();
  }
  Status printed = print(report_text(rows, options));
  if (!printed) return std::move(printed).error();
  const bool passed = std::all_of(rows.begin(), rows.end(),
                                  [](const RidgeRow& row) { return row.failure.empty(); });
  return passed ? exit_success : exit_failed_verdict;
}

}  // namespace

Command add_ridge_bench(CLI::App& bench) {
  auto arguments = std::make_shared<RidgeBenchArguments>();
  CLI::App* ridge = bench.add_subcommand(
      "ridge",
      "Ridge following: the experiments of Volkmann and St. Clair, Medial Axis\n"
      "Transform using Ridge Following (1987), Section IV.");
  ridge->add_option("-o,--output", arguments->output, "Plots (.svg) or all numbers (.csv).")
      ->option_text("FILE");
  ridge
      ->add_option("--rounds", arguments->options.rounds,
                   "The least time of so many rounds counts (default: 5).")
      ->check(in_range(1, 1000, true))
      ->option_text("N");
  ridge
      ->add_option("--per-unit", arguments->options.per_unit,
                   "Pixels along a unit of length (default: 20); most shapes are about six\n"
                   "units wide.")
      ->check(in_range(2.0, 1000.0, true))
      ->option_text("N");
  ridge->add_flag("--quick", arguments->options.quick, "One round of few shapes.");
  ridge->add_flag("--quiet,-q", arguments->quiet, "No progress on standard error.");
  ridge->footer(
      "Everything runs on one thread. Exit status 1: the two searches found different\n"
      "pixels, or an axis had another number of cycles than its shape has holes.\n"
      "\n"
      "Examples:\n"
      "  medial bench ridge --quick\n"
      "  medial bench ridge -o ridge.svg");
  return {ridge, [arguments] { return run_ridge(*arguments); }};
}

}  // namespace medial::cli
