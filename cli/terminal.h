#pragma once

// Signals, the terminal, clocks and memory of the process.

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

/// Installs signal handlers: SIGINT, SIGTERM, SIGHUP and SIGPIPE remove unfinished files and end
/// the process silently with status 128 + the signal's number. Makes writing beyond the file size
/// limit an error instead of a signal.
void install_signal_handlers();

/// Occupies those of the descriptors 0 to 2 that the parent closed. Otherwise the next file opened
/// would get one of them, and messages would end up in it. Reading and writing there still fail.
void occupy_standard_descriptors();

bool error_is_terminal();

/// Writes to standard error. Ignores failures, such as a full device or a closed descriptor.
void say_text(const std::string& text);

/// The text as one line of valid UTF-8 without control characters, whatever bytes file names
/// contain. Keeps only the last line end.
std::string one_line(const std::string& text);

template <typename... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  say_text(one_line(fmt::format(format, std::forward<Arguments>(arguments)...)));
}

/// Disables every later Activity.
void be_quiet();

/// The peak memory of this process, in bytes.
std::uint64_t peak_bytes();

/// Seconds of processor time of this process, all threads together.
double processor_seconds();

/// Measures the seconds since its construction.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A progress bar on standard error. Appears after one second of work; the destructor wipes it.
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

/// A line on standard error that counts seconds while a file is read or written. Appears after one
/// second; the destructor wipes it.
class Activity {
 public:
  /// `doing`: "reading" or "writing". Does nothing if standard error is not a terminal, or after
  /// be_quiet().
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
