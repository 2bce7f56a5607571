// medial_bench: medial::compute() beside Boost.Polygon's Voronoi diagram and CGAL's segment
// Delaunay graph; same run, same inputs, one thread, medians. Prints Markdown, or JSON.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "peers.h"
#include "report.h"

using namespace medial::bench;

int main(int argc, char** argv) {
  bool json = false;
  bool quick = false;
  bool alone = false;
  int rounds = 5;
  std::size_t cgal_limit = 100000;
  double time_limit = 900;
  std::vector<std::string> only;
  CLI::App app{
      "Compares medial with Boost.Polygon and CGAL: the same inputs, one thread, medians."};
  app.add_flag("--json", json, "print one JSON object instead of tables");
  app.add_flag("--quick", quick, "small inputs and one round: does it run at all?");
  app.add_flag("--alone", alone, "leave the peers out");
  app.add_option("--only", only, "only inputs whose name contains this; may be repeated");
  app.add_option("--rounds", rounds, "rounds a median is taken of")->check(CLI::PositiveNumber);
  app.add_option("--cgal-limit", cgal_limit, "largest input for CGAL (a tenth on smooth ones)");
  app.add_option("--time-limit", time_limit, "seconds for all rounds of one program on one input")
      ->check(CLI::PositiveNumber);
  std::string method_name = "disks";
  app.add_option("--method", method_name, "the method of medial: disks (default), lee")
      ->check(CLI::IsMember({"disks", "lee"}));
  CLI11_PARSE(app, argc, argv);
  const auto method = *medial::method_from(method_name);
  if (quick) rounds = 1;

  std::vector<Row> rows;
  bool all_well = true;
  if (!json) std::fputs(header_lines().c_str(), stdout);
  for (const Input& input : inputs(quick)) {
    const auto asked_for = [&](const std::string& part) {
      return input.name.find(part) != std::string::npos;
    };
    if (!only.empty() && std::none_of(only.begin(), only.end(), asked_for)) continue;
    Row row;
    row.input = input;
    row.medial = measure_medial(input, method, rounds, time_limit, row.medial_note);
    // An absent coastline is skipped with its note; anything else that fails is a failure.
    const bool lee_refuses =
        method_name == "lee" && row.medial_note.find("hole") != row.medial_note.npos;
    if (!row.medial && input.family != Family::coast && !lee_refuses) all_well = false;
    if (row.medial && !alone) {
      row.boost = measure_peer(input, run_boost, rounds, time_limit, row.boost_note);
      std::string unstretched_note;  // the same as the other's, if any
      row.boost_unstretched =
          measure_peer(input, run_boost_unstretched, rounds, time_limit, unstretched_note);
      if (row.boost_unstretched && row.boost_unstretched->seconds < 0) {
        row.boost_unstretched.reset();
      }
      const bool smooth = input.family == Family::smooth || input.family == Family::regular;
      if (input.vertices > (smooth ? cgal_limit / 10 : cgal_limit)) {
        row.cgal_note = "left out, too slow (see --cgal-limit)";
      } else {
        // CGAL takes seconds where the others take milliseconds: fewer rounds tell the same.
        row.cgal = measure_peer(input, run_cgal, std::min(rounds, smooth ? 1 : 3), time_limit,
                                row.cgal_note);
      }
    }
    if (!json) {
      std::fputs(line_of(row).c_str(), stdout);
      std::fflush(stdout);
    }
    rows.push_back(std::move(row));
  }
  std::fputs((json ? json_of(rows) : summary_of(rows)).c_str(), stdout);
  return all_well ? 0 : 1;
}
