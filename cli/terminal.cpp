#include "cli/terminal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "medial/io/write.h"

namespace medial::cli {
namespace {

constexpr char wipe_line[] = "\r\x1b[K";
constexpr double seconds_between_draws = 0.1;
constexpr int bar_width = 30;

// Whether the terminal shows a bar that a signal must wipe.
std::atomic<bool> bar_visible = false;
bool quiet = false;
static_assert(std::atomic<bool>::is_always_lock_free, "read in a signal handler");

extern "C" void end_quietly(int signal_number) {
  if (bar_visible.load()) {
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, wipe_line, sizeof wipe_line - 1);
  }
  io::remove_partial_files();
  // By the signal itself, so that a shell ends its loops, too.
  signal(signal_number, SIG_DFL);
  sigset_t own;
  sigemptyset(&own);
  sigaddset(&own, signal_number);
  pthread_sigmask(SIG_UNBLOCK, &own, nullptr);
  raise(signal_number);
  _exit(128 + signal_number);
}

}  // namespace

void install_signal_handlers() {
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    struct sigaction action {};
    // Signals that the parent ignores (nohup, background jobs) stay ignored, except SIGPIPE: a
    // closed pipe must end the process, which would otherwise compute a long output in vain.
    if (sigaction(signal_number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN &&
        signal_number != SIGPIPE) {
      continue;
    }
    action = {};
    action.sa_handler = end_quietly;
    sigfillset(&action.sa_mask);
    sigaction(signal_number, &action, nullptr);
  }
  signal(SIGXFSZ, SIG_IGN);  // writing beyond the limit of file sizes fails then: an error
}

void occupy_standard_descriptors() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor) {
    if (fcntl(descriptor, F_GETFD) != -1) continue;
    // This is the lowest free descriptor. Open it in the opposite mode, so that its use fails.
    if (open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY) == -1) return;
  }
}

void say_text(const std::string& text) {
  // Not by fmt::print, which throws if it cannot write.
  (void)std::fwrite(text.data(), 1, text.size(), stderr);
  (void)std::fflush(stderr);
}

std::string one_line(const std::string& text) {
  const std::string quoted =
      nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string line = nlohmann::json::parse(quoted).get<std::string>();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto byte = static_cast<unsigned char>(line[i]);
    const bool last = byte == '\n' && i + 1 == line.size();
    if ((byte < 0x20 && !last) || byte == 0x7f) line[i] = ' ';
    // U+0080 to U+009F begin commands, too.
    if (byte == 0xc2 && static_cast<unsigned char>(line[i + 1]) < 0xa0) line.replace(i, 2, " ");
  }
  return line;
}

bool error_is_terminal() { return isatty(STDERR_FILENO) == 1; }

void be_quiet() { quiet = true; }

std::uint64_t peak_bytes() {
  // On Linux getrusage() gives the caller's peak, if that was larger and it started us by vfork().
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::strtoull(line.c_str() + 6, nullptr, 10);
  struct rusage usage {};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
  return static_cast<std::uint64_t>(usage.ru_maxrss);
#else
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
#endif
}

double processor_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Progress::Progress(std::string label, bool shown) : label_(std::move(label)), shown_(shown) {}

Progress::~Progress() {
  if (!shown_ || !bar_visible.exchange(false)) return;
  std::fputs(wipe_line, stderr);
  std::fflush(stderr);
}

std::function<void(double)> Progress::callback() {
  if (!shown_) return {};
  return [this](double share) { redraw(std::clamp(share, 0.0, 1.0)); };
}

std::function<void(double, std::uint64_t)> Progress::counting_callback() {
  if (!shown_) return {};
  return [this](double share, std::uint64_t features) { redraw(share, features); };
}

void Progress::redraw(double share, std::uint64_t features) {
  const std::unique_lock lock(drawing_, std::try_to_lock);
  const double passed = watch_.seconds();
  if (!lock || passed < next_draw_) return;
  next_draw_ = passed + seconds_between_draws;
  std::string rate;
  if (features > 0 && share > 0)
    rate = fmt::format(", {:.3g} features/s, {:.0f} s left{:6}",
                       share * static_cast<double>(features) / passed, passed / share - passed, "");
  const int filled = static_cast<int>(std::lround(share * bar_width));
  bar_visible.store(true);
  say_text(fmt::format("\r{} [{:#<{}}{:.<{}}] {:3.0f} %{}", label_, "", filled, "",
                       bar_width - filled, 100 * share, rate));
}

Activity::Activity(const std::string& doing, const std::string& path) {
  if (quiet || path.empty() || !error_is_terminal()) return;
  const std::string name =
      path == "-" ? "standard " + std::string(doing == "reading" ? "input" : "output") : path;
  auto show = [this, text = one_line(fmt::format("medial: {} {}", doing, name))] {
    const Stopwatch watch;
    std::unique_lock lock(mutex_);
    for (double next = 1; !end_; next += 1) {
      const std::chrono::duration<double> left(next - watch.seconds());
      if (ended_.wait_for(lock, left, [this] { return end_; })) break;
      bar_visible.store(true);
      say_text(fmt::format("\r{} ... {:.0f} s", text, next));
    }
  };
  try {
    clock_ = std::thread(std::move(show));
  } catch (const std::system_error&) {  // the system refuses a thread: no clock
  }
}

Activity::~Activity() {
  if (!clock_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ended_.notify_one();
  clock_.join();
  if (!bar_visible.exchange(false)) return;
  std::fputs(wipe_line, stderr);
  std::fflush(stderr);
}

}  // namespace medial::cli
