// medial_papers: measures the experiments of the papers on this machine, and draws their figures.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <string>
#include <system_error>
#include <vector>

#include "papers/experiment.h"

namespace medial::papers {
namespace {

constexpr int exit_failed_check = 1, exit_error = 2;

struct Paper {
  const char* name;  ///< of its folder here and of its results
  Result<bool> (*run)(const Request& request);
};
constexpr std::array<Paper, 5> papers = {{{"lee_1982", run_lee_1982},
                                          {"volkmann_stclair_1987", run_volkmann_stclair_1987},
                                          {"shaked_bruckstein_1996", run_shaked_bruckstein_1996},
                                          {"ahuja_chuang_1997", run_ahuja_chuang_1997},
                                          {"aichholzer_2009", run_aichholzer_2009}}};

Result<bool> run(const Paper& paper, Request request) {
  request.to /= paper.name;
  std::error_code problem;
  std::filesystem::create_directories(request.to, problem);
  if (problem)
    return Error{ErrorCode::unwritable, request.to.string() + ": " + problem.message(), {}};
  const double begin = processor_seconds();
  Result<bool> passed = paper.run(request);
  if (passed) {
    fmt::print("{}: {} in {:.1f} s of processor time\n", request.to.string(),
               *passed ? "done" : "a check FAILED", processor_seconds() - begin);
    std::fflush(stdout);
  }
  return passed;
}

int run(int argc, char** argv) {
  CLI::App program(
      "Measures the experiments of the papers on this machine, and draws their figures:\n"
      "tables, numbers and pictures of each paper in a folder of its own.",
      "medial_papers");
  Request request;
  std::vector<std::string> names, known;
  for (const Paper& paper : papers) known.emplace_back(paper.name);
  program.add_option("PAPERS", names, "Default: all.")->check(CLI::IsMember(known));
  program.add_option("-o,--output", request.to, "The directory to write to.")->required();
  program.add_option("--files", request.files,
                     "Further shapes for ahuja_chuang_1997 (of each file the largest), further\n"
                     "images, or drawings (.svg) of the parts to pack, for volkmann_stclair_1987.");
  program
      .add_option("--rounds", request.rounds,
                  "How often to time; the least time counts (default: 3).")
      ->check(CLI::Range(1, 1000));
  program.add_flag("--quick", request.quick, "One round of few small shapes.");
  program.footer("Exit status: 0 done; 1 an axis failed a check; 2 an error.");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : exit_error;
  }
  if (request.quick) request.rounds = 1;
  bool all_passed = true;
  for (const Paper& paper : papers) {
    if (!names.empty() && std::find(names.begin(), names.end(), paper.name) == names.end())
      continue;
    const Result<bool> passed = run(paper, request);
    if (!passed) {
      fmt::print(stderr, "medial_papers: {}\n", to_string(passed.error()));
      return exit_error;
    }
    all_passed = all_passed && *passed;
  }
  return all_passed ? 0 : exit_failed_check;
}

}  // namespace
}  // namespace medial::papers

int main(int argc, char** argv) { return medial::papers::run(argc, argv); }
