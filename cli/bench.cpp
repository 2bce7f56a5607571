// medial bench: published experiments, measured anew on this machine.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "cli/bench_biarc.h"
#include "cli/bench_brushfire.h"
#include "cli/bench_curve_axis.h"
#include "cli/bench_lee.h"
#include "cli/bench_potential.h"
#include "cli/bench_ridge.h"
#include "cli/bench_shapes.h"
#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "cli/plot.h"
#include "cli/terminal.h"

namespace medial::cli {
namespace {

struct BenchArguments {
  BiarcOptions biarc;
  std::string output;
  std::string shapes;  ///< a directory for the shapes as SVG
  bool quick = false;
  bool json = false;
  bool quiet = false;
};

struct AccuracyArguments {
  std::vector<std::string> images;
  io::ImageOptions reading;
  std::string output;
};

constexpr char plot_formats[] = ".svg .csv .json";

/// The rows of each shape, in order.
std::vector<std::vector<BiarcRow>> by_shape(const std::vector<BiarcRow>& rows) {
  std::vector<std::vector<BiarcRow>> groups;
  for (const BiarcRow& row : rows) {
    if (groups.empty() || groups.back().front().shape != row.shape) groups.emplace_back();
    groups.back().push_back(row);
  }
  return groups;
}

template <class Get>
std::vector<std::pair<double, double>> against_edges(const std::vector<BiarcRow>& rows,
                                                     const Get& get) {
  std::vector<std::pair<double, double>> points;
  for (const BiarcRow& row : rows) {
    if (row.edges > 0 && get(row) > 0)
      points.emplace_back(static_cast<double>(row.edges), get(row));
  }
  return points;
}

double axis_time(const BiarcRow& row) { return row.axis.processor; }
double conversion_time(const BiarcRow& row) { return row.conversion.processor; }
double certified_error(const BiarcRow& row) { return row.error; }

/// Microseconds an edge.
double per_edge(double seconds, const BiarcRow& row) {
  return row.edges == 0 ? 0 : 1e6 * seconds / static_cast<double>(row.edges);
}

std::string published_cell(const BiarcRow& row) {
  if (!row.published) return row.published_note;
  return fmt::format("{:.3f}{}", row.published->processor,
                     row.published_note.empty() ? "" : " (" + row.published_note + ")");
}

std::string exact_cell(const BiarcRow& row) {
  return row.exact ? fmt::format("{:.4f}", row.exact->processor) : row.exact_note;
}

std::string rows_table(const std::vector<BiarcRow>& rows) {
  std::string text =
      "| shape | tolerance | arcs | error | conversion s | build s | axis s | axis, wall s | "
      "conversion us/arc | build us/arc | axis us/arc | biarc-dc s | its conquer s | exact s | "
      "leaves | branchings | verified |\n"
      "| --- " +
      [] {
        std::string rule;
        for (int i = 0; i < 15; ++i) rule += "| ---: ";
        return rule;
      }() +
      "| --- |\n";
  for (const BiarcRow& row : rows) {
    text += fmt::format(
        "| {} | {:.0e} | {} | {:.2e} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {:.2f} | {:.2f} | "
        "{:.2f} | {} | {} | {} | {} | {} | {} |\n",
        row.shape, row.tolerance, row.edges, row.error, row.conversion.processor,
        row.building.processor, row.axis.processor, row.axis.wall,
        per_edge(row.conversion.processor, row), per_edge(row.building.processor, row),
        per_edge(row.axis.processor, row), published_cell(row),
        row.published ? fmt::format("{:.3f}", row.published_conquer) : "", exact_cell(row),
        row.leaves, row.branchings, row.failure.empty() ? "yes" : "NO: " + row.failure);
  }
  return text;
}

/// What each series says as a whole.
std::string series_table(const std::vector<BiarcRow>& rows, bool with_error) {
  std::string text = fmt::format(
      "| shape | {}conversion ~ n^p | axis ~ n^p | axis us/(arc log2 arcs), first to last |\n"
      "| --- {}| ---: | ---: | ---: |\n",
      with_error ? "error ~ n^p | " : "", with_error ? "| ---: " : "");
  for (const auto& group : by_shape(rows)) {
    const auto exponent = [&](const auto& get) {
      const auto points = against_edges(group, get);
      return points.size() < 2 ? std::string("-") : fmt::format("{:.2f}", fitted_exponent(points));
    };
    // Where tolerances are coarse, the number of arcs is that of the spirals, whatever the error.
    const auto error_exponent = [&] {
      auto points = against_edges(group, certified_error);
      const double twice = points.empty() ? 0 : 2 * points.front().first;
      std::erase_if(points, [&](const auto& point) { return point.first < twice; });
      return points.size() < 2 ? std::string("-") : fmt::format("{:.2f}", fitted_exponent(points));
    };
    const auto share = [](const BiarcRow& row) {
      return row.edges < 2 ? 0 : per_edge(axis_time(row), row) / std::log2(row.edges);
    };
    text += fmt::format("| {} | {}{} | {} | {:.4f} to {:.4f} |\n", group.front().shape,
                        with_error ? error_exponent() + " | " : "", exponent(conversion_time),
                        exponent(axis_time), share(group.front()), share(group.back()));
  }
  return text;
}

/// How often each base case of Figs. 5 and 6 was met.
std::string base_cases_table(const std::vector<BiarcRow>& rows) {
  std::string text = "| shape | tolerance | arcs |";
  std::string rule = "\n| --- | ---: | ---: |";
  for (char name = 'a'; name <= 'm'; ++name) {
    text += fmt::format(" {} |", name);
    rule += " ---: |";
  }
  text += " cap |";
  rule += " ---: |";
  text += rule + "\n";
  for (const BiarcRow& row : rows) {
    if (row.base_cases.empty()) continue;
    text += fmt::format("| {} | {:.0e} | {} |", row.shape, row.tolerance, row.edges);
    for (const std::uint64_t count : row.base_cases) text += fmt::format(" {} |", count);
    text += "\n";
  }
  return text;
}

std::string polygons_table(const std::vector<PolygonComparison>& rows) {
  std::string text =
      "| shape | edges | leaves of arcs | leaves of the polygon | error of arcs | error of the "
      "polygon | verified |\n| --- | ---: | ---: | ---: | ---: | ---: | --- |\n";
  for (const PolygonComparison& row : rows) {
    text += fmt::format("| {} | {} | {} | {} | {:.2e} | {:.2e} | {} |\n", row.shape, row.edges,
                        row.arc_leaves, row.polygon_leaves, row.arc_error, row.polygon_error,
                        row.failure.empty() ? "yes" : "NO: " + row.failure);
  }
  return text;
}

std::string report_text(const BiarcReport& report, int rounds) {
  return fmt::format(
      "Processor time of one thread, the least of {}; tolerance and error relative to the\n"
      "diagonal of the bounding box.\n\n"
      "## By tolerance (Table 1, Figs. 12, 15, 16)\n\n{}\n{}\n"
      "## Base cases of biarc-dc (Figs. 5, 6)\n\n{}\n"
      "## By size\n\n{}\n{}\n"
      "## Arcs and polygons (Fig. 13)\n\n{}",
      counted(static_cast<std::uint64_t>(rounds), "round"), rows_table(report.by_tolerance),
      series_table(report.by_tolerance, true), base_cases_table(report.by_tolerance),
      rows_table(report.by_size), series_table(report.by_size, false),
      polygons_table(report.polygons));
}

Json json_of(const Timing& timing) {
  return {{"processor", timing.processor}, {"wall", timing.wall}};
}

Json json_of(const BiarcRow& row) {
  Json object = {{"shape", row.shape},
                 {"tolerance", row.tolerance},
                 {"edges", row.edges},
                 {"straight", row.straight},
                 {"error", row.error},
                 {"seconds",
                  {{"conversion", json_of(row.conversion)},
                   {"build", json_of(row.building)},
                   {"axis", json_of(row.axis)}}},
                 {"leaves", row.leaves},
                 {"branchings", row.branchings},
                 {"passed", row.failure.empty()},
                 {"failure", row.failure},
                 {"biarc_dc_note", row.published_note},
                 {"base_cases", row.base_cases},
                 {"exact_note", row.exact_note},
                 {"exact_changes", row.exact_changes}};
  if (row.exact) object["seconds"]["exact"] = json_of(*row.exact);
  if (row.published) {
    object["seconds"]["biarc_dc"] = json_of(*row.published);
    object["seconds"]["biarc_dc_conquer"] = row.published_conquer;
  }
  return object;
}

Json json_of(const BiarcReport& report) {
  Json object = {{"passed", report.passed()},
                 {"by_tolerance", Json::array()},
                 {"by_size", Json::array()},
                 {"polygons", Json::array()}};
  for (const BiarcRow& row : report.by_tolerance) object["by_tolerance"].push_back(json_of(row));
  for (const BiarcRow& row : report.by_size) object["by_size"].push_back(json_of(row));
  for (const PolygonComparison& row : report.polygons) {
    object["polygons"].push_back({{"shape", row.shape},
                                  {"edges", row.edges},
                                  {"arc_leaves", row.arc_leaves},
                                  {"polygon_leaves", row.polygon_leaves},
                                  {"arc_error", row.arc_error},
                                  {"polygon_error", row.polygon_error},
                                  {"passed", row.failure.empty()},
                                  {"failure", row.failure}});
  }
  return object;
}

std::string report_csv(const BiarcReport& report) {
  std::string text =
      "series,shape,tolerance,edges,straight,error,conversion,conversion_wall,build,build_wall,"
      "axis,axis_wall,biarc_dc,exact,leaves,branchings,passed\n";
  const auto add = [&text](const char* series, const std::vector<BiarcRow>& rows) {
    for (const BiarcRow& row : rows) {
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", series, row.shape,
                          row.tolerance, row.edges, row.straight, row.error,
                          row.conversion.processor, row.conversion.wall, row.building.processor,
                          row.building.wall, row.axis.processor, row.axis.wall,
                          row.published ? fmt::format("{}", row.published->processor) : "",
                          row.exact ? fmt::format("{}", row.exact->processor) : "", row.leaves,
                          row.branchings, row.failure.empty());
    }
  };
  add("tolerance", report.by_tolerance);
  add("size", report.by_size);
  return text;
}

/// The time of so many microseconds an arc, over the arcs of all rows.
Series reference_line(const std::vector<BiarcRow>& rows, double microseconds,
                      const std::string& name) {
  const auto [least, most] = std::minmax_element(
      rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.edges < b.edges; });
  Series series{name, {}, true};
  for (const std::uint64_t edges : {least->edges, most->edges}) {
    const auto n = static_cast<double>(std::max<std::uint64_t>(edges, 1));
    series.points.emplace_back(n, 1e-6 * microseconds * n);
  }
  return series;
}

std::vector<Plot> report_plots(const BiarcReport& report) {
  Plot error{"Error against arcs (Fig. 12)", "arcs", "certified error / diagonal", {}};
  Plot time{"Time against arcs, by tolerance (Figs. 15, 16)", "arcs", "axis, seconds", {}};
  Plot size{"Time against arcs, by size at tolerance 1e-6", "arcs", "axis, seconds", {}};
  Plot conversion{"Boundary conversion against arcs", "arcs", "conversion, seconds", {}};
  for (const auto& group : by_shape(report.by_tolerance)) {
    const std::string& name = group.front().shape;
    error.series.push_back({name, against_edges(group, certified_error)});
    time.series.push_back({name, against_edges(group, axis_time)});
    conversion.series.push_back({name, against_edges(group, conversion_time)});
  }
  for (const auto& group : by_shape(report.by_size)) {
    size.series.push_back({group.front().shape, against_edges(group, axis_time)});
  }
  time.series.push_back(reference_line(report.by_tolerance, 1, "1 us an arc"));
  size.series.push_back(reference_line(report.by_size, 1, "1 us an arc"));
  conversion.series.push_back(reference_line(report.by_tolerance, 1.5, "1.5 us an arc"));
  return {error, time, conversion, size};
}

Status write_shapes(const std::string& directory) {
  std::error_code problem;
  std::filesystem::create_directories(directory, problem);
  if (problem) return error_at(ErrorCode::unwritable, directory, problem.message());
  for (const auto& [name, contours] : biarc_shapes()) {
    Status written = io::write_text((std::filesystem::path(directory) / (name + ".svg")).string(),
                                    svg_document(contours));
    if (!written) return written;
  }
  return success();
}

Result<int> run_biarc(const BenchArguments& arguments) {
  Status writable = check_output(arguments.output, {}, plot_formats, {}, false);
  if (!writable) return std::move(writable).error();
  if (!arguments.shapes.empty()) {
    Status written = write_shapes(arguments.shapes);
    if (!written) return std::move(written).error();
    return exit_success;
  }
  BiarcOptions options = arguments.biarc;
  if (arguments.quick) {
    options.rounds = 1;
    options.finest = std::min(options.finest, 3);
    options.largest = 4;
  }
  const bool shown = error_is_terminal() && !arguments.quiet;
  const BiarcReport report = run_biarc_experiments(
      options,
      shown ? [](const std::string& name) { say("{}\n", name); } : [](const std::string&) {});
  if (!arguments.output.empty()) {
    const std::string extension = std::filesystem::path(arguments.output).extension().string();
    Status written = extension == ".svg" ? write_plots(arguments.output, report_plots(report))
                     : extension == ".csv"
                         ? io::write_text(arguments.output, report_csv(report))
                         : io::write_text(arguments.output, json_of(report).dump(2) + "\n");
    if (!written) return std::move(written).error();
  }
  Status printed =
      arguments.json ? print(json_of(report)) : print(report_text(report, options.rounds));
  if (!printed) return std::move(printed).error();
  return report.passed() ? exit_success : exit_failed_verdict;
}

/// Files of shapes and the paper's regions; of each file the feature with the most vertices.
Result<int> run_potential(const std::vector<std::string>& files, const std::string& figures,
                          bool quiet) {
  if (!figures.empty()) {
    if (Status written = write_potential_figures(figures); !written)
      return std::move(written).error();
    return exit_success;
  }
  std::vector<std::pair<std::string, Shape>> shapes = potential_regions();
  for (const std::string& path : files) {
    InputOptions input;
    input.path = path;
    auto file = load_shapes(input, 0);
    if (!file) return std::move(file).error();
    const auto largest = std::max_element(
        file->shapes.begin(), file->shapes.end(),
        [](const Shape& a, const Shape& b) { return a.points.size() < b.points.size(); });
    if (largest != file->shapes.end())
      shapes.emplace_back(std::filesystem::path(path).stem().string(), std::move(*largest));
  }
  const bool shown = error_is_terminal() && !quiet;
  const PotentialReport report = run_potential_experiments(shapes, [&](const std::string& name) {
    if (shown) say("{}\n", name);
  });
  Status printed = print(report.text);
  if (!printed) return std::move(printed).error();
  return report.passed ? exit_success : exit_failed_verdict;
}

Result<int> run_accuracy(const AccuracyArguments& arguments) {
  Status writable = check_output(arguments.output, {}, ".svg .csv", {}, false);
  if (!writable) return std::move(writable).error();
  std::vector<AccuracyRow> rows;
  auto built_in = measure_accuracy("a shape like Fig. 14", figure_14());
  if (!built_in) return std::move(built_in).error();
  rows.push_back(std::move(built_in).value());
  for (const std::string& path : arguments.images) {
    const auto file = io::read_image(path, arguments.reading);
    if (!file) return file.error();
    auto row = measure_accuracy(std::filesystem::path(path).stem().string(), file->image);
    if (!row) {
      Error error = std::move(row).error();
      error.place.file = path;
      return error;
    }
    rows.push_back(std::move(row).value());
  }
  if (!arguments.output.empty()) {
    Status written = io::write_text(arguments.output, arguments.output.ends_with(".svg")
                                                          ? accuracy_drawing(rows.front())
                                                          : accuracy_csv(rows));
    if (!written) return std::move(written).error();
  }
  Status printed = print(accuracy_table(rows));
  if (!printed) return std::move(printed).error();
  return exit_success;
}

CLI::App* add_accuracy(CLI::App& bench, const std::shared_ptr<AccuracyArguments>& arguments) {
  CLI::App* command = bench.add_subcommand(
      "brushfire",
      "Axes of pixels, inverted: how many pixels differ (Volkmann and St. Clair 1987,\n"
      "Section II.B.3, Fig. 14), by brushfire, ridge following, and exactly.");
  command
      ->add_option("IMAGES", arguments->images, "Binary images beside the shape of Fig. 14's kind.")
      ->option_text(" ");
  add_image_options(*command, arguments->reading);
  command
      ->add_option("-o,--output", arguments->output,
                   "The built-in shape, its axes and what they become (.svg), or all numbers\n"
                   "(.csv).")
      ->check(a_name())
      ->option_text("FILE");
  command->footer(
      "Example:\n"
      "  medial bench brushfire horse.png -o figure14.svg");
  return command;
}

}  // namespace

Command make_bench_command(CLI::App& program) {
  auto arguments = std::make_shared<BenchArguments>();
  CLI::App* command = program.add_subcommand("bench", "Measure published experiments anew.");
  command->require_subcommand(1);
  // Its own: the label of the one that it inherits is the program's, too.
  auto formatter = std::make_shared<CLI::Formatter>();
  formatter->column_width(27);
  formatter->label("SUBCOMMAND", "EXPERIMENT");
  command->formatter(formatter);
  CLI::App* biarc = command->add_subcommand(
      "biarc",
      "Shapes bounded by curves: the experiments of Aichholzer et al., Medial Axis\n"
      "Computation for Planar Free-Form Shapes (2009), Section 5.");
  biarc
      ->add_option("-o,--output", arguments->output,
                   fmt::format("Plots (.svg) or all numbers: {}", plot_formats))
      ->check(a_name())
      ->option_text("FILE");
  biarc
      ->add_option("--rounds", arguments->biarc.rounds,
                   "The least time of so many rounds counts (default: 5).")
      ->check(in_range(1, 1000, true))
      ->option_text("N");
  biarc
      ->add_option("--tolerances", arguments->biarc.finest,
                   "How many tolerances, from 1e-3 down (default: 9).")
      ->check(in_range(1, 9, true))
      ->option_text("N");
  biarc
      ->add_option("--published-limit", arguments->biarc.published_limit,
                   "Most arcs for the paper's own method, biarc-dc (default: 200000).")
      ->option_text("ARCS");
  biarc
      ->add_option("--shapes", arguments->shapes,
                   "Only write the shapes into this directory, as SVG.")
      ->option_text("DIRECTORY");
  biarc->add_flag("--quick", arguments->quick, "One round of small shapes: does it run at all?");
  biarc->add_flag("--json", arguments->json, "Print one JSON object instead of tables.");
  biarc->add_flag("--quiet,-q", arguments->quiet, "No progress on standard error.");
  biarc->footer(
      "Everything runs on one thread. Each axis is verified once. Exit status 1: one\n"
      "was refused, or a shape had other leaves at another tolerance.\n"
      "\n"
      "Examples:\n"
      "  medial bench biarc --quick\n"
      "  medial bench biarc -o biarc.svg");
  CLI::App* potential = command->add_subcommand(
      "potential",
      "The generalised potential field: the experiments of Ahuja and Chuang (1997), and\n"
      "the distances to the exact axis against the order.");
  auto files = std::make_shared<std::vector<std::string>>();
  potential->add_option("INPUT", *files, "Further shapes; of each file, the largest one.")
      ->option_text("");
  auto figures = std::make_shared<std::string>();
  potential->add_option("--figures", *figures, "Only write Fig. 13 into this directory, as SVG.")
      ->option_text("DIRECTORY");
  potential->add_flag("--quiet,-q", arguments->quiet, "No progress on standard error.");
  potential->footer("Example:\n  medial bench potential data/plan.wkt data/gear.wkt");
  const Command ridge = add_ridge_bench(*command);
  const Command lee = add_lee_bench(*command);
  const Command curve_axis = add_curve_axis_bench(*command);
  auto accuracy = std::make_shared<AccuracyArguments>();
  const CLI::App* brushfire = add_accuracy(*command, accuracy);
  return {command,
          [arguments, files, figures, potential, ridge, lee, curve_axis, accuracy, brushfire] {
            if (brushfire->parsed()) return run_accuracy(*accuracy);
            return potential->parsed()        ? run_potential(*files, *figures, arguments->quiet)
                   : ridge.app->parsed()      ? ridge.run()
                   : lee.app->parsed()        ? lee.run()
                   : curve_axis.app->parsed() ? curve_axis.run()
                                              : run_biarc(*arguments);
          }};
}

}  // namespace medial::cli
