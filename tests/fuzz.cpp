// Random polygons through build_shape, compute and verify, random edits of shapes, and mutated
// files through the readers, on all threads, for as long as one likes.
//
//   medial_fuzz [--from SEED] [--count N] [--seconds N] [--threads N]
//
// Each seed is one random_shape(seed), which must be verified, a few edits of one small shape,
// after each of which the axis must be that of compute(), and one small file with random mutations,
// which must be read or refused; what is read must be verified or refused, and packs must unpack or
// be refused, their shapes be built or have a note. One line for each failure: `shape SEED KIND:
// reason: WKT`, where the WKT is a small part of the shape that still fails, `edits SEED: reason`,
// or `file SEED NAME: reason: "bytes"`. --from SEED --count 1 repeats one. Exit status: 0; 1 where
// something failed, crashed or hung; 2 for a wrong call.

#include <unistd.h>

#include <atomic>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/medial.h"
#include "support/edits.h"
#include "support/examine.h"
#include "support/generate.h"

namespace medial::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// The current task of a thread, for the watchdog and for the signal handler.
struct Work {
  std::atomic<std::uint64_t> seed = 0;
  std::atomic<bool> file = false;     ///< at the seed's file, not at its shape
  std::atomic<Clock::rep> began = 0;  ///< 0: idle
};
thread_local const Work* own_work = nullptr;

/// Longer than any of these inputs takes, sanitizers and a busy machine included.
constexpr std::chrono::seconds longest{60};

void write_crash(int signal) {
  char text[100];
  const bool file = own_work != nullptr && own_work->file;
  const std::uint64_t seed = own_work != nullptr ? own_work->seed.load() : 0;
  const int length =
      std::snprintf(text, sizeof text, "%s %llu: crashed, signal %d\n", file ? "file" : "shape",
                    static_cast<unsigned long long>(seed), signal);
  const auto written = ::write(STDOUT_FILENO, text, static_cast<std::size_t>(length));
  ::_exit(written > 0 ? 1 : 2);
}

/// Printed lines of several threads do not mix.
void print_line(const std::string& line) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

std::string escaped_text(std::string_view bytes) {
  std::string text = "\"";
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    char escaped[8];
    if (c == '"' || c == '\\')
      std::snprintf(escaped, sizeof escaped, "\\%c", c);
    else if (byte < 32 || byte > 126)
      std::snprintf(escaped, sizeof escaped, "\\x%02x", byte);
    else
      std::snprintf(escaped, sizeof escaped, "%c", c);
    text += escaped;
  }
  return text + "\"";
}

// ---- Random polygons.

/// Returns whether the seed's shape is verified.
bool try_shape(std::uint64_t seed) {
  const RandomShape shape = random_shape(seed);
  const Outcome outcome = examine(shape.rings);
  if (outcome.verdict == Verdict::verified) return true;
  std::vector<Ring> smallest = shape.rings;
  if (outcome.verdict == Verdict::failed) {
    const std::string kind = kind_of_failure(outcome);
    constexpr std::size_t budget = 3000;
    smallest = reduced(
        shape.rings,
        [&](const std::vector<Ring>& rings) { return kind_of_failure(examine(rings)) == kind; },
        budget);
  }
  print_line("shape " + std::to_string(seed) + " " + shape.kind + ": " + outcome.reasons[0] + ": " +
             to_wkt(smallest));
  return false;
}

/// Returns whether the axis follows the seed's edits.
bool try_edits(std::uint64_t seed) {
  constexpr int edits = 4;
  const std::optional<std::string> fault =
      fault_of_edits(seed, edits, static_cast<EditKinds>(seed % 3));
  if (fault) print_line("edits " + std::to_string(seed) + ": " + *fault);
  return !fault;
}

// ---- Mutated files.

struct Sample {
  std::string name;  ///< of the file: its extension chooses the reader
  std::string bytes;
};

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void add_pack(const std::string& name, const io::PackFile& pack, std::vector<Sample>& samples) {
  const auto bytes = io::pack_bytes(pack);
  if (bytes) samples.push_back({name, {bytes->begin(), bytes->end()}});
}

/// Small valid files of every text format, made in `folder` where only a writer can make them.
std::vector<Sample> samples(const fs::path& folder) {
  const std::string polygon = "POLYGON ((0 0, 9 0, 9 6.5, 0 6, 0 0), (3 2, 3 4e0, 6 4, 6 2, 3 2))";
  std::vector<Sample> result{
      {"a.wkt", polygon + "\nPOLYGON ((-1.25 -3, 7 -3, 7 -1))\n"},
      {"b.wkt",
       "SRID=2056;MULTIPOLYGON Z (((0 0 1, 4 0 1, 4 2 1, 0 2 1, 0 0 1)),"
       " ((5 0 1, 6 0 1, 6 1 1)), EMPTY)"},
      {"c.txt", "# two rings\n0 0\n9 0\n9 6\n0 6\n\n3 2\n3 4\n6 4\n6 2\n"},
      {"d.xy", "0,0\n1e1,0\n+10;.5\n"},
      {"e.geojson",
       R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"name":"a"},)"
       R"("geometry":{"type":"Polygon","coordinates":[[[0,0],[9,0],[9,6],[0,6],[0,0]],)"
       R"([[3,2],[3,4],[6,4],[6,2],[3,2]]]}},{"type":"Feature","properties":null,"geometry":)"
       R"({"type":"MultiPolygon","coordinates":[[[[20,0],[24,0],[22,3],[20,0]]]]}}]})"}};

  Document<AxisItem> file;
  const Rings rings{ring_of({{0, 0}, {9, 0}, {9, 6}, {0, 6}}),
                    ring_of({{3, 2}, {3, 4}, {6, 4}, {6, 2}})};
  Result<Shape> shape = build_shape(rings);
  Result<MedialAxis> axis = compute(*shape);
  axis->statistics = {};  // seconds differ from run to run
  file.items.push_back({*shape, *axis, {{"name", "frame"}}});
  const fs::path native = folder / "native.json";
  if (io::write_axes(native.string(), "", file).ok()) result.push_back({"f.json", content(native)});
  const std::vector<MedialAxis> axes{*axis};
  io::PackFile pack;
  for (const double error : {1.0, 0.01}) {
    auto code = encode_axes(axes, {error});
    if (code) pack.code = std::move(*code);
    add_pack("g.mpk", pack, result);
  }
  Image image(40, 30);
  for (std::uint32_t y = 3; y < 25; ++y)
    for (std::uint32_t x = y / 2; x < 35; ++x) image.set(x, y);
  pack.kind = io::PackKind::squares;
  pack.code = encode_squares(image);
  add_pack("h.mpk", pack, result);
  return result;
}

/// Words that readers look for, and numbers at the ends of their ranges.
constexpr std::string_view words[] = {"NaN",
                                      "inf",
                                      "-1e309",
                                      "1e308",
                                      "1e-320",
                                      "1e150",
                                      "-0",
                                      "0.1",
                                      "4294967296",
                                      "-1",
                                      "1e999999",
                                      "00",
                                      "1.",
                                      ".",
                                      "(",
                                      ")",
                                      "((",
                                      "))",
                                      ",",
                                      ";",
                                      " ",
                                      "\n",
                                      "\n\n",
                                      "\t",
                                      "[",
                                      "]",
                                      "{",
                                      "}",
                                      ":",
                                      "\"",
                                      "\\",
                                      "\\u0000",
                                      "null",
                                      "true",
                                      "[]",
                                      "{}",
                                      "EMPTY",
                                      "POLYGON",
                                      "MULTIPOLYGON",
                                      "GEOMETRYCOLLECTION",
                                      "CURVEPOLYGON",
                                      "CIRCULARSTRING",
                                      "Z",
                                      "M",
                                      "ZM",
                                      "SRID=",
                                      "#",
                                      "\"coordinates\"",
                                      "\"type\"",
                                      "\"nodes\"",
                                      "\xff\xfe",
                                      "\xef\xbb\xbf"};

std::string mutated(const std::vector<Sample>& all, std::string bytes, Random& random) {
  const auto place = [&random](const std::string& text) {
    return static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(text.size())));
  };
  const auto length = [&random] {
    return static_cast<std::size_t>(random.power_of_ten(0, random.between(0, 3)));
  };
  for (std::int64_t i = random.integer(1, 5); i > 0; --i) {
    const std::size_t at = place(bytes);
    switch (random.integer(0, 7)) {
      case 0:
        if (at < bytes.size())
          bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^
                                        (1U << random.integer(0, 7)));
        break;
      case 1:
        if (at < bytes.size()) bytes[at] = static_cast<char>(random.integer(0, 255));
        break;
      case 2:
        bytes.erase(at, length());
        break;
      case 3:
        bytes.insert(at, bytes.substr(place(bytes), length()));
        break;
      case 4:
        bytes.resize(at);
        break;
      case 5: {
        const std::string& other = all[static_cast<std::size_t>(random.integer(
                                           0, static_cast<std::int64_t>(all.size()) - 1))]
                                       .bytes;
        bytes.insert(at, other.substr(place(other), length()));
        break;
      }
      case 6: {  // another digit: the file stays well-formed
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        if (digit != std::string::npos)
          bytes[digit] = static_cast<char>('0' + random.integer(0, 9));
        break;
      }
      default: {
        const std::string_view word =
            words[random.integer(0, static_cast<std::int64_t>(std::size(words)) - 1)];
        if (random.chance(0.5)) bytes.erase(at, length());
        bytes.insert(std::min(at, bytes.size()), word);
      }
    }
  }
  return bytes;
}

/// A pack whose streams are mutated behind the checksum.
std::string repacked(const std::vector<Sample>& all, const std::string& bytes, Random& random) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  auto pack = io::unpack_bytes({data, bytes.size()});
  if (!pack) return bytes;
  for (std::vector<std::uint8_t>& stream : pack->code) {
    if (random.chance(0.5)) continue;
    const std::string other = mutated(all, {stream.begin(), stream.end()}, random);
    stream.assign(other.begin(), other.end());
  }
  const auto again = io::pack_bytes(*pack);
  return again ? std::string(again->begin(), again->end()) : bytes;
}

std::optional<std::string> fault_of_pack(const std::string& path) {
  const auto pack = io::read_pack(path);
  if (!pack)
    return is_refusal(pack.error().code) ? std::nullopt : std::optional(to_string(pack.error()));
  if (pack->kind == io::PackKind::squares) {
    const auto image = decode_squares(pack->code);
    return image || is_refusal(image.error().code) ? std::nullopt
                                                   : std::optional(to_string(image.error()));
  }
  std::vector<std::string> notes;
  const auto native = io::native_of(*pack, &notes);
  if (!native)
    return is_refusal(native.error().code) ? std::nullopt
                                           : std::optional(to_string(native.error()));
  for (const AxisItem& item : native->items)
    if (item.shape.points.empty() && notes.empty()) return "no shape, and no note";
  return std::nullopt;
}

/// A text about what is wrong with reading a file, or none.
std::optional<std::string> fault_of_file(const std::string& path) {
  if (path.ends_with(".mpk")) return fault_of_pack(path);
  const auto dataset = io::read_document(path);
  if (!dataset && !is_refusal(dataset.error().code)) return to_string(dataset.error());
  if (dataset) {
    for (const Feature& feature : dataset->items) {
      const Outcome outcome = examine(feature.rings);
      if (outcome.verdict == Verdict::failed) return outcome.reasons[0];
    }
  }
  if (!io::is_native(path)) return std::nullopt;
  // Shapes and axes as a file has them, not as build_shape() and compute() make them: any verdict
  // is right.
  const auto native = io::read_native(path);
  if (!native && !is_refusal(native.error().code)) return to_string(native.error());
  if (!native) return std::nullopt;
  for (const AxisItem& item : native->items) {
    const Certificate certificate = verify(item.shape, item.axis, {.threads = 1});
    if (certificate.passed != certificate.failures.empty()) return "a verdict without reasons";
  }
  return std::nullopt;
}

/// The file of a seed.
Sample random_file(std::uint64_t seed, const std::vector<Sample>& all) {
  Random random(seed);
  const auto last = static_cast<std::int64_t>(all.size()) - 1;
  const Sample& sample = all[static_cast<std::size_t>(random.integer(0, last))];
  if (sample.name.ends_with(".mpk") && random.chance(0.8))
    return {sample.name, repacked(all, sample.bytes, random)};
  return {sample.name, mutated(all, sample.bytes, random)};
}

/// Returns whether the seed's file is taken rightly.
bool try_file(std::uint64_t seed, const std::vector<Sample>& all, const fs::path& folder) {
  const Sample sample = random_file(seed, all);
  const fs::path path = folder / (std::to_string(seed) + sample.name.substr(1));
  std::ofstream(path, std::ios::binary) << sample.bytes;
  const std::optional<std::string> fault = fault_of_file(path.string());
  fs::remove(path);
  if (fault)
    print_line("file " + std::to_string(seed) + " " + sample.name + ": " + *fault + ": " +
               escaped_text(sample.bytes));
  return !fault;
}

// ---- The run.

struct Switches {
  std::uint64_t from = 0;
  std::uint64_t count = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t seconds = std::numeric_limits<std::uint32_t>::max();
  std::uint64_t threads = std::max(1U, std::thread::hardware_concurrency());
};

int run(const Switches& switches) {
  std::string name = (fs::temp_directory_path() / "medial_fuzz_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) return 2;
  const fs::path folder = name;
  const std::vector<Sample> all = samples(folder);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) std::signal(signal, write_crash);

  const auto end = Clock::now() + std::chrono::seconds(switches.seconds);
  std::atomic<std::uint64_t> next = 0, failures = 0, running = switches.threads;
  std::vector<Work> works(switches.threads);
  std::vector<std::thread> threads;
  for (Work& work : works) {
    threads.emplace_back([&] {
      own_work = &work;
      for (;;) {
        const std::uint64_t i = next++;
        if (i >= switches.count || Clock::now() >= end) break;
        work.seed = switches.from + i;
        work.file = false;
        work.began = Clock::now().time_since_epoch().count();
        if (!try_shape(switches.from + i)) ++failures;
        if (!try_edits(switches.from + i)) ++failures;
        work.file = true;
        if (!try_file(switches.from + i, all, folder)) ++failures;
      }
      work.began = 0;
      --running;
    });
  }
  while (running > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    for (const Work& work : works) {
      const Clock::time_point began{Clock::duration(work.began)};
      if (work.began == 0 || Clock::now() - began < longest) continue;
      print_line((work.file ? "file " : "shape ") + std::to_string(work.seed) +
                 ": not done after " + std::to_string(longest.count()) + " seconds: " +
                 (work.file ? escaped_text(random_file(work.seed, all).bytes)
                            : to_wkt(random_shape(work.seed).rings)));
      std::_Exit(1);
    }
  }
  for (std::thread& thread : threads) thread.join();
  fs::remove_all(folder);
  const std::uint64_t done = std::min<std::uint64_t>(next, switches.count);
  std::printf("fuzz: seeds %llu to %llu, %llu failures\n",
              static_cast<unsigned long long>(switches.from),
              static_cast<unsigned long long>(switches.from + done - 1),
              static_cast<unsigned long long>(failures));
  return failures == 0 ? 0 : 1;
}

bool parse(int count, char** arguments, Switches& switches) {
  for (int i = 1; i < count; i += 2) {
    const std::string_view name = arguments[i];
    std::uint64_t* value = name == "--from"      ? &switches.from
                           : name == "--count"   ? &switches.count
                           : name == "--seconds" ? &switches.seconds
                           : name == "--threads" ? &switches.threads
                                                 : nullptr;
    if (value == nullptr || i + 1 == count) return false;
    const std::string_view text = arguments[i + 1];
    const auto read = std::from_chars(text.data(), text.data() + text.size(), *value);
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size()) return false;
  }
  return switches.threads > 0 && switches.threads <= 1024 &&
         switches.seconds <= std::numeric_limits<std::uint32_t>::max();
}

}  // namespace
}  // namespace medial::test

int main(int count, char** arguments) {
  medial::test::Switches switches;
  if (!medial::test::parse(count, arguments, switches)) {
    std::fprintf(stderr,
                 "usage: medial_fuzz [--from SEED] [--count N] [--seconds N] [--threads N]\n");
    return 2;
  }
  return medial::test::run(switches);
}
