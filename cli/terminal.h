#pragma once

// The process's surroundings: signals, the terminal, clocks and memory.

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace medial::cli {

/// From here on, SIGINT, SIGTERM, SIGHUP and SIGPIPE remove what is half written and end the
/// process with 128 + the signal's number, without a word. Writing beyond the limit of file sizes
/// becomes an error instead of a signal.
void install_signal_handlers();

/// Occupies descriptors 0 to 2 where the parent closed them: else the next file opened would get
/// one of them, and messages end up in it. Reading or writing there fails as before.
void occupy_standard_descriptors();

bool error_is_terminal();

/// Standard error takes what it can: a full device or a closed descriptor there changes nothing.
void say_text(const std::string& text);

/// One line of UTF-8, whatever names and bytes a file has brought into it, and nothing that a
/// terminal obeys. Only the last line end stays.
std::string one_line(const std::string& text);

template <typename... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  say_text(one_line(fmt::format(format, std::forward<Arguments>(arguments)...)));
}

/// From here on no Activity shows itself.
void be_quiet();

/// The largest memory this process has held, in bytes.
std::uint64_t peak_bytes();

/// Seconds of processor time of this process, all threads together.
double processor_seconds();

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A progress bar on standard error. It shows itself once work has lasted a second, and is wiped
/// when destroyed.
class Progress {
 public:
  /// A bar that is not `shown` costs nothing.
  Progress(std::string label, bool shown);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Takes the share in [0, 1] that is done, from any thread; empty if nothing is shown. The
  /// Progress must outlive it.
  std::function<void(double)> callback();
  /// The same for a known number of features: it also shows the rate and the time left.
  std::function<void(double, std::uint64_t)> counting_callback();

 private:
  void redraw(double share, std::uint64_t features = 0);

  std::string label_;
  bool shown_;
  Stopwatch watch_;
  std::mutex drawing_;
  double next_draw_ = 1.0;  ///< in seconds; guarded by drawing_
};

/// A line on standard error while a file is read or written: it shows itself once that has lasted a
/// second, and is wiped when destroyed. Nobody knows how long it will take, so it counts seconds.
class Activity {
 public:
  /// "reading", "writing". Costs nothing where standard error is no terminal, and after be_quiet().
  Activity(const std::string& doing, const std::string& path);
  ~Activity();
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool end_ = false;  ///< guarded by mutex_
  std::thread clock_;
};

}  // namespace medial::cli
