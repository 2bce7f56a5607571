#pragma once

// Shared by the experiments of the papers: the options of a run, the clock, files, fits.

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bench/clock.h"
#include "medial/error.h"

namespace medial::papers {

struct Request {
  std::filesystem::path to;        ///< an existing directory for tables and figures
  bool quick = false;              ///< few small shapes: does it run at all?
  int rounds = 3;                  ///< how often to time; the least time counts
  std::vector<std::string> files;  ///< further shapes (volkmann: images)
};

/// Each measures the experiments of one paper on one thread, and draws its figures. False if an
/// axis failed a check. Errors: unwritable, and those of reading files.
Result<bool> run_volkmann_stclair_1987(const Request& request);
Result<bool> run_lee_1982(const Request& request);
Result<bool> run_aichholzer_2009(const Request& request);
Result<bool> run_ahuja_chuang_1997(const Request& request);
Result<bool> run_shaked_bruckstein_1996(const Request& request);

/// A line on standard error, if that is a terminal.
void progress(const std::string& what);

/// Writes a file of the request's directory. Errors: unwritable.
Status write(const Request& request, const std::string& name, const std::string& text);

/// Runs the steps in their order, up to the first error.
template <class... Steps>
Status in_order(Steps&&... steps) {
  Status done = success();
  (void)((done = steps(), done.ok()) && ...);
  return done;
}

using bench::processor_seconds;

/// Runs work() several times, or once if it fails or takes a minute; keeps the last result and the
/// least time.
template <class Work>
auto timed(int rounds, double& least, const Work& work) {
  least = std::numeric_limits<double>::infinity();
  for (int round = 1;; ++round) {
    const double begin = processor_seconds();
    auto result = work();
    least = std::min(least, processor_seconds() - begin);
    if (round >= rounds || least > 60 || !result) return result;
  }
}

using Points = std::vector<std::pair<double, double>>;

/// The exponent p of y ~ x^p that fits best: least squares of the logarithms. Requires two
/// different x.
double fitted_exponent(const Points& points);

/// Pearson's correlation of x and y.
double correlation(const Points& points);

}  // namespace medial::papers
