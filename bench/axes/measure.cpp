#include "measure.h"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <thread>
#include <type_traits>
#include <vector>

#include "clock.h"
#include "medial/compute.h"
#include "peak_memory.h"
#include "support/generate.h"

namespace medial::bench {

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Calls `body` in a child and returns what it returns. Nothing, with the reason, where the child
/// does not deliver within the limit.
template <class T>
std::optional<T> in_child(const std::function<std::optional<T>(std::string&)>& body, double limit,
                          std::string& why) {
  static_assert(std::is_trivially_copyable_v<T>);
  int ends[2];
  if (pipe(ends) != 0) {
    why = "no pipe";
    return std::nullopt;
  }
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    std::string reason;
    std::optional<T> value;
    try {
      value = body(reason);
    } catch (const std::exception& error) {  // a peer's, or out of memory
      reason = error.what();
    }
    const bool sent = value ? write(ends[1], &*value, sizeof(T)) == sizeof(T)
                            : write(ends[1], reason.data(),
                                    std::min<std::size_t>(reason.size(), sizeof(T) - 1)) >= 0;
    _exit(sent ? (value ? 0 : 1) : 2);
  }
  close(ends[1]);
  std::vector<char> buffer;
  pollfd ready{ends[0], POLLIN, 0};
  const double end = wall_seconds() + limit;
  bool late = false;
  for (;;) {
    const double left = end - wall_seconds();
    late = left <= 0 || poll(&ready, 1, static_cast<int>(1e3 * left) + 1) == 0;
    if (late) break;
    char part[512];
    const ssize_t count = read(ends[0], part, sizeof part);
    if (count <= 0) break;
    buffer.insert(buffer.end(), part, part + count);
  }
  close(ends[0]);
  if (late) kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  if (late) {
    why = "over the time limit";
  } else if (WIFSIGNALED(status)) {
    why = "died of signal " + std::to_string(WTERMSIG(status));
  } else if (WEXITSTATUS(status) != 0 || buffer.size() != sizeof(T)) {
    why.assign(buffer.begin(), buffer.end());
  } else {
    T value;
    std::copy(buffer.begin(), buffer.end(), reinterpret_cast<char*>(&value));
    return value;
  }
  return std::nullopt;
}

std::optional<MedialFigures> figures_of_medial(const std::vector<Ring>& rings, const Method& method,
                                               int rounds, std::string& why) {
  MedialFigures figures;
  // Small ones before: what the program itself needs, code and tables, is no memory of the input's.
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    if (const auto built = build_shape(test::random_integer_shape(seed).rings))
      static_cast<void>(compute(*built, {.method = method, .threads = 1}));
  }
  const PeakMemory memory;
  std::vector<double> shape;
  std::vector<double> one;
  std::vector<double> one_wall;
  std::vector<double> two_wall;
  std::vector<double> copies_wall;
  for (int round = 0; round < rounds; ++round) {
    double start = processor_seconds();
    const auto built = build_shape(rings);
    shape.push_back(processor_seconds() - start);
    if (!built) {
      why = to_string(built.error());
      return std::nullopt;
    }
    start = processor_seconds();
    double wall = wall_seconds();
    {
      const auto axis = compute(*built, {.method = method, .threads = 1});
      one.push_back(processor_seconds() - start);
      one_wall.push_back(wall_seconds() - wall);
      if (!axis) {
        why = to_string(axis.error());
        return std::nullopt;
      }
      if (round == 0) {
        // Only now, before the threads of others are started and memory comes from the heap again.
        figures.peak_bytes = memory.bytes();
        const Statistics& statistics = axis->statistics;
        figures.vertices = built->points.size();
        figures.queries_per_site =
            static_cast<double>(statistics.queries) / static_cast<double>(axis->sites.size());
        figures.precision_retries = static_cast<double>(statistics.precision_retries);
        figures.largest_residual = statistics.largest_residual / diagonal(bounding_box(*built));
      }
    }
    wall = wall_seconds();
    const auto axis = compute(*built, {.method = method, .threads = 2});
    two_wall.push_back(wall_seconds() - wall);
    if (!axis) {
      why = to_string(axis.error());
      return std::nullopt;
    }
    const auto copy = [&] { static_cast<void>(compute(*built, {.method = method, .threads = 1})); };
    wall = wall_seconds();
    std::thread other(copy);
    copy();
    other.join();
    copies_wall.push_back(wall_seconds() - wall);
  }
  figures.shape_seconds = median(shape);
  figures.seconds = median(one);
  figures.one_thread_wall = median(one_wall);
  figures.two_threads_wall = median(two_wall);
  figures.two_copies_wall = median(copies_wall);
  return figures;
}

}  // namespace

std::optional<MedialFigures> measure_medial(const Input& input, const Method& method, int rounds,
                                            double limit, std::string& why) {
  return in_child<MedialFigures>(
      [&](std::string& reason) -> std::optional<MedialFigures> {
        const auto rings = input.rings();
        if (rings) return figures_of_medial(*rings, method, rounds, reason);
        reason = to_string(rings.error());
        return std::nullopt;
      },
      limit, why);
}

std::optional<PeerFigures> measure_peer(const Input& input,
                                        const std::function<PeerRun(std::span<const Ring>)>& peer,
                                        int rounds, double limit, std::string& why) {
  return in_child<PeerFigures>(
      [&](std::string& reason) -> std::optional<PeerFigures> {
        const auto rings = input.rings();
        if (!rings) {
          reason = to_string(rings.error());
          return std::nullopt;
        }
        PeerFigures figures;
        std::vector<double> seconds;
        for (int round = 0; round < rounds; ++round) {
          const PeerRun run = peer(*rings);
          seconds.push_back(run.seconds);
          figures.left_out = static_cast<double>(run.left_out);
        }
        figures.seconds = median(seconds);
        return figures;
      },
      limit, why);
}

}  // namespace medial::bench
