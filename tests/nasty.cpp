// The classes of shapes on which rounding decides, by the thousand: a table of what goes wrong.
//
//   medial_nasty [--class NAME] [--count N] [--from SEED] [--seconds N] [--oracle K]
//                [--planar edges|points|joints] [--threads N] [--method NAME] [--exact 1]
//                [--images 0] [--save FOLDER]
//
// Each shape is computed and verified, and so are its mirror image, its image under a quarter turn,
// under a power of two, and from another start, and with two threads: all must have one graph.
// --oracle K: every K-th shape is a small one, and if all its edges are straight its graph is
// compared with the true one (support/true_graph.h). --planar edges: planar graphs of the same
// edges, of which some are left out, and their Voronoi diagrams; points: with points beside them;
// joints: the classes of nasty_graph_classes() instead.
// --seconds: for each class. --images 0: no images, no second thread. --save: writes the first
// failures of each kind, made smaller. Exit status 1 if anything goes wrong.

#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "medial/medial.h"
#include "support/nasty_check.h"

namespace medial::test {
namespace {

using Clock = std::chrono::steady_clock;

struct Switches {
  std::string_view only, method, save, planar;
  std::uint64_t from = 0, count = 1000, seconds = 1U << 30U, oracle = 0;
  std::uint64_t threads = 1, exact = 0, images = 1;
};

std::string fixed_width(std::string_view text, std::size_t width) {
  std::string result(text);
  result.resize(std::max(width, result.size()), ' ');
  return result;
}

/// As a native file, arcs included.
std::string to_json(const Rings& rings) {
  std::string text;
  const auto add = [&](const char* format, double x, double y, double bulge) {
    char buffer[100];
    std::snprintf(buffer, sizeof buffer, format, x, y, bulge);
    text += buffer;
  };
  for (const Ring& ring : rings) {
    text += text.empty() ? "" : ", ";
    add("{\"start\": [%.17g, %.17g], \"pieces\": [", ring.points[0].x, ring.points[0].y, 0);
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      const Vec2 p = ring.points[(i + 1) % ring.points.size()];
      text += i == 0 ? "" : ", ";
      add("[\"arc\", %.17g, %.17g, %.17g]", p.x, p.y, i < ring.bulges.size() ? ring.bulges[i] : 0);
    }
    text += "]}";
  }
  return R"({"medial": 2, "items": [{"contours": [)" + text + "]}]}";
}

void save(const Switches& switches, const NastyClass& one, std::uint64_t seed, bool small,
          const Finding& finding, const NastyOptions& options) {
  const std::filesystem::path folder = std::filesystem::path(switches.save) / one.name;
  std::filesystem::create_directories(folder);
  Rings rings = nasty_shape(one, seed, small);
  if (finding.fault != Fault::loose) rings = smallest_like(rings, finding, options);
  const std::string name = std::string(name_of(finding.fault)) + "_" + std::to_string(seed);
  std::ofstream(folder / (name + (one.has_arcs ? ".json" : ".wkt")))
      << (one.has_arcs ? to_json(rings) : to_wkt(rings)) << "\n";
  std::ofstream(folder / "README", std::ios::app)
      << name << (small ? " (small)" : "") << ": " << finding.words << "\n";
}

/// The number of shapes of each fault; examine(i) finds that of shape i, and keep(i, finding) is
/// called for one after the other.
template <class Examine, class Keep>
Faults count_faults(const Switches& switches, Examine&& examine, Keep&& keep) {
  Faults faults;
  std::mutex mutex;
  std::atomic<std::uint64_t> next = 0;
  const auto end = Clock::now() + std::chrono::seconds(switches.seconds);
  const auto work = [&] {
    for (std::uint64_t i = next++; i < switches.count && Clock::now() < end; i = next++) {
      const Finding finding = examine(i);
      const std::lock_guard lock(mutex);
      faults.add(finding);
      keep(i, finding);
    }
  };
  std::vector<std::thread> threads;
  for (std::uint64_t i = 0; i < switches.threads; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  return faults;
}

Faults run(const Switches& switches, const NastyClass& one) {
  NastyOptions options{.exact = switches.exact != 0,
                       .images = switches.images != 0,
                       .planar = !switches.planar.empty(),
                       .points = switches.planar == "points"};
  if (!switches.method.empty()) options.method = *method_from(switches.method);
  std::map<Fault, int> saved;
  const auto is_small = [&](std::uint64_t i) {
    return switches.oracle != 0 && i % switches.oracle == 0;
  };
  const auto options_of = [&](std::uint64_t i) {
    NastyOptions own = options;
    own.oracle = is_small(i) && !one.has_arcs;
    return own;
  };
  return count_faults(
      switches,
      [&](std::uint64_t i) {
        return examine_nasty(one, switches.from + i, is_small(i), options_of(i));
      },
      [&](std::uint64_t i, const Finding& finding) {
        if (switches.save.empty() || finding.fault <= Fault::refused) return;
        constexpr int enough = 4;
        if (saved[finding.fault]++ < enough && !options.planar)
          save(switches, one, switches.from + i, is_small(i), finding, options_of(i));
      });
}

Faults run(const Switches& switches, const NastyGraphClass& one) {
  return count_faults(
      switches,
      [&](std::uint64_t i) {
        Finding finding = examine_nasty(nasty_graph(one, switches.from + i), NastyOptions{});
        finding.words = "seed " + std::to_string(switches.from + i) + ": " + finding.words;
        return finding;
      },
      [](std::uint64_t, const Finding&) {});
}

void print_head() {
  std::printf("%s", fixed_width("class", 10).c_str());
  for (const Fault fault : all_faults)
    std::printf(" %11.*s", static_cast<int>(name_of(fault).size()), name_of(fault).data());
  std::printf(" %11s\n", "compared");
}

void print_row(std::string_view name, const Faults& faults) {
  std::printf("%s", fixed_width(name, 10).c_str());
  for (const Fault fault : all_faults)
    std::printf(" %11llu", static_cast<unsigned long long>(faults.count(fault)));
  std::printf(" %11llu\n", static_cast<unsigned long long>(faults.compared));
  for (const auto& [fault, words] : faults.first)
    std::printf("  %s: %s\n", std::string(name_of(fault)).c_str(), words.c_str());
  std::fflush(stdout);
}

bool parse(int count, char** arguments, Switches& switches) {
  for (int i = 1; i < count; i += 2) {
    if (i + 1 == count) return false;
    const std::string_view name = arguments[i], text = arguments[i + 1];
    std::string_view* word = name == "--class"    ? &switches.only
                             : name == "--method" ? &switches.method
                             : name == "--save"   ? &switches.save
                             : name == "--planar" ? &switches.planar
                                                  : nullptr;
    std::uint64_t* value = name == "--from"      ? &switches.from
                           : name == "--count"   ? &switches.count
                           : name == "--seconds" ? &switches.seconds
                           : name == "--threads" ? &switches.threads
                           : name == "--oracle"  ? &switches.oracle
                           : name == "--exact"   ? &switches.exact
                           : name == "--images"  ? &switches.images
                                                 : nullptr;
    if (word != nullptr) {
      *word = text;
      continue;
    }
    if (value == nullptr) return false;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), *value);
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size()) return false;
  }
  return switches.threads > 0 && switches.threads <= 1024 &&
         (switches.planar.empty() || switches.planar == "edges" || switches.planar == "points" ||
          switches.planar == "joints") &&
         (switches.method.empty() || method_from(switches.method));
}

int run_all(const Switches& switches) {
  print_head();
  bool wrong = false, found = false;
  const auto run_class = [&](const auto& one) {
    if (!switches.only.empty() && one.name != switches.only) return;
    found = true;
    const Faults faults = run(switches, one);
    print_row(one.name, faults);
    wrong |= faults.wrong() > 0;
  };
  if (switches.planar == "joints")
    for (const NastyGraphClass& one : nasty_graph_classes()) run_class(one);
  else
    for (const NastyClass& one : nasty_classes()) run_class(one);
  return !found ? 2 : wrong ? 1 : 0;
}

}  // namespace
}  // namespace medial::test

int main(int count, char** arguments) {
  medial::test::Switches switches;
  if (!medial::test::parse(count, arguments, switches)) {
    std::fprintf(stderr,
                 "usage: medial_nasty [--class NAME] [--count N] [--from SEED] [--seconds N]\n"
                 "                    [--oracle K] [--planar edges|points|joints] [--threads N]\n"
                 "                    [--method NAME] [--exact 1] [--images 0] [--save FOLDER]\n");
    return 2;
  }
  return medial::test::run_all(switches);
}
