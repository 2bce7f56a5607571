#pragma once

// What the commands share: their arguments, and how errors and objects are printed.

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "cli/terminal.h"
#include "medial/compute.h"
#include "medial/error.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/shape.h"

namespace medial::cli {

using Json = nlohmann::ordered_json;

/// Exit statuses. An interrupted run exits with 128 + the signal's number.
constexpr int exit_success = 0;
constexpr int exit_failed_verdict = 1;
constexpr int exit_error = 2;

/// Where shapes come from.
struct InputOptions {
  std::string path;           ///< of a file; with a text, of the font
  std::string font;           ///< as given
  std::string repair;         ///< the name of source.read.repair
  std::string close;          ///< source.read.close as text
  bool whole_smooth = false;  ///< --smooth-contour was given: of images the whole axis
  io::SourceOptions source;
};

/// What every command takes.
struct CommonOptions {
  int threads = 0;                     ///< 0: all of the machine
  double tolerance = 0;                ///< relative to the diagonal; 0: the library's default
  std::optional<double> corner_angle;  ///< degrees; nothing: what suits the kind of input
  double chord = io::WriteOptions{}.chord;
  bool stats = false;
  bool json = false;
  bool quiet = false;
};

/// The arguments of a command that reads shapes and may write a file.
struct FileArguments {
  InputOptions input;
  CommonOptions common;
  std::string output;  ///< a path; - for standard output; or empty
  std::string format;
  io::WriteOptions write;
};

/// Each adds its options to a command; what they refer to must live as long as the command.
/// `second` is the name of a second file that the command requires after INPUT, with the string
/// that it fills.
void add_input_options(CLI::App& command, InputOptions& input);
void add_input_options(CLI::App& command, InputOptions& input, const std::string& second_name,
                       const std::string& second_help, std::string& second);
void add_common_options(CLI::App& command, CommonOptions& common);
/// -o and --format, for outputs of `formats`; without -o such a command prints its summary only.
/// `piped` says which format -o - has.
void add_output_options(CLI::App& command, FileArguments& arguments, const std::string& formats,
                        const std::string& piped = "default: json");
/// --output-layer and --overwrite.
void add_layer_options(CLI::App& command, io::WriteOptions& write);
/// -o alone, with this help, for a file of this kind; and --format, with the format of -o -.
CLI::Option* add_output_option(CLI::App& command, std::string& output, const std::string& kind,
                               const std::string& help);
void add_format_option(CLI::App& command, std::string& format, const std::string& piped);
/// --threads, and --stats, --json and --quiet; both are part of the common options.
void add_threads_option(CLI::App& command, int& threads);
void add_report_options(CLI::App& command, CommonOptions& common);
/// --threshold and --invert.
void add_image_options(CLI::App& command, io::ImageOptions& options);
void add_picture_options(CLI::App& command, io::WriteOptions& write);
/// --simplify, for commands that write axes as lines.
void add_simplify_option(CLI::App& command, io::WriteOptions& write);
/// --width alone. Its help gives the default, which is what `width` holds.
void add_width_option(CLI::App& command, double& width);
/// --fit, which replaces boundaries by smooth curves as they are read.
void add_fit_option(CLI::App& command, InputOptions& input);
/// --exterior, with this help, and --margin. Returns the former.
CLI::Option* add_exterior_options(CLI::App& command, Options& options, const std::string& help);

/// A number in [low, high]; NaN is in no range. Help texts show the range unless `quiet`.
CLI::Validator in_range(double low, double high, bool quiet = false);
/// A finite number above 0.
CLI::Validator a_positive_number();
/// A number about which `complaint` has nothing to say; what it says follows the number in the
/// error.
CLI::Validator a_number(std::function<std::string(double)> complaint,
                        const std::string& range = {});
/// What the name of a file must be: not empty.
CLI::Validator a_name();
/// Digits that make a 64-bit number; CLI11 by itself takes -1 for the largest.
CLI::Validator a_whole_number();

/// Adds an option with one value, which help texts call `value`.
template <class T>
CLI::Option* add_value(CLI::App& command, const std::string& name, T& variable, const char* value,
                       const CLI::Validator& check, const std::string& help) {
  return command.add_option(name, variable, help)->check(check)->option_text(value);
}
/// Adds an option for one of several names.
template <class T>
CLI::Option* add_choice(CLI::App& command, const std::string& name, T& variable,
                        const std::vector<std::pair<std::string, T>>& choices,
                        const std::string& help) {
  std::vector<std::string> names;
  for (const auto& [choice, meaning] : choices) names.push_back(choice);
  const auto take = [&variable, choices](const std::string& chosen) {
    for (const auto& [choice, meaning] : choices)
      if (choice == chosen) variable = meaning;
  };
  return command.add_option_function<std::string>(name, take, help)
      ->check(CLI::IsMember(names))
      ->option_text("NAME");
}
/// Adds an option for numbers with commas between them: `count` of them, or for 0 one or more.
CLI::Option* add_list_option(CLI::App& command, const std::string& name, std::size_t count,
                             const std::function<void(const std::vector<double>&)>& take,
                             const std::string& help);

/// Groups of options that many commands share.
inline constexpr std::string_view input_group = "Input", curve_group = "Curves",
                                  picture_group = "Pictures", common_group = "Common options";

/// The options that are added while it lives form a group of help texts.
class OptionGroup {
 public:
  OptionGroup(CLI::App& command, std::string_view name);
  ~OptionGroup();
  OptionGroup(const OptionGroup&) = delete;
  OptionGroup& operator=(const OptionGroup&) = delete;

 private:
  CLI::App& command_;
  CLI::OptionDefaults before_;
};

/// Checks that `path` can be written later, before any long work: a known format, a directory that
/// takes files, nothing there but a regular file that may be replaced, and not the input itself.
/// An empty path is no output, which is always possible. With `json` standard output is taken.
/// `known_formats` lists extensions, separated by anything that is neither letter nor digit.
Status check_output(const std::string& path, const std::string& format,
                    const std::string& known_formats, const std::string& input, bool json);
Status check_output(const FileArguments& arguments, const std::string& known_formats);
bool has_extension(const std::string& path, const std::string& known_formats);
/// Whether what is written has one of these formats.
bool writes_one_of(const FileArguments& arguments, const std::string& known_formats);

/// Whether two paths name one file, which need not exist.
bool name_one_file(const std::string& path, const std::string& other);
/// Options for writing: --chord is a common one.
io::WriteOptions write_options(const FileArguments& arguments);

/// An error of a file as a whole.
Error error_at(ErrorCode code, const std::string& file, std::string text);

/// The formats of images in black and white.
inline constexpr char image_formats[] = ".png .tif .pbm";

/// The error of a command line that asks for something impossible.
Error invalid_option(std::string text);
/// That a file holds no shape, for commands that need one: --skip-invalid may leave none.
Error no_shape(const std::string& file);

/// {"error": {"code": ..., "text": ..., "place": {...}}}
Json to_json(const Error& error);
Json to_json(const ShapeReport& report);
Json to_json(const ArcReport& report);
Json to_json(const Box& box);

/// Prints an error as one line on standard error and, on request, as an object on standard output.
/// Returns exit_error.
int report_error(const Error& error, bool json, const std::string& hint = {});

/// Prints to standard output. An output that takes no more is an error (unwritable).
Status print(const std::string& text);
Status print(const Json& object);

/// The members of an object as a table, one on each line; objects inside are indented. Names and
/// values say it all: "seconds", "precision_retries", "peak_bytes".
std::string table(const Json& object);
/// Lines of a name and a value.
class Rows {
 public:
  explicit Rows(int width) : width_(width) {}
  void add(std::string_view name, const std::string& value);
  void add(std::string_view name, std::uint64_t count);
  const std::string& text() const { return text_; }

 private:
  int width_;  ///< of the names
  std::string text_;
};

/// The phases of a run, by the clock and by the processor.
class Phases {
 public:
  /// Ends a phase, which began with the end of the one before.
  void end(const std::string& name);
  /// The seconds of all phases, or of one.
  double seconds() const;
  double seconds(const std::string& name) const { return seconds_.value(name, 0.0); }
  const Json& by_clock() const { return seconds_; }
  const Json& by_processor() const { return processor_; }

 private:
  Stopwatch watch_;
  double processor_begin_ = processor_seconds();
  Json seconds_ = Json::object(), processor_ = Json::object();
};

/// The end of a command: prints the object for --json, or the text on standard output unless it is
/// empty. --stats adds the costs, which are seconds by phase, threads, memory and `more`: as
/// members of the object, or as a table on standard error. Returns the status.
Result<int> finish(const CommonOptions& common, Json object, const Phases& phases,
                   const std::string& text, const Json& more = {}, int status = exit_success);
/// The same for a command that writes a file, with a line that ends with the seconds of all phases:
/// on standard output where there is no other output, and else only on a terminal.
Result<int> finish(const FileArguments& arguments, Json object, const Phases& phases,
                   const std::string& line, const Json& more = {});
/// Whether that would print anything.
bool is_talkative(const FileArguments& arguments);

/// {name: value, ...}
Json to_json(const Attributes& attributes);
/// {"x": ..., "y": ..., "r": ...}
Json to_json(const Disk& disk);

/// What build_shape() mended, as "2 repeated points, 1 reversed ring"; empty if nothing.
std::string describe(const ShapeReport& report);
/// "2 points, 1 ring" of the counts that are not 0, each with its noun and plural.
struct CountedNoun {
  std::uint64_t count;
  const char *noun, *plural = "";
};
std::string enumerate(std::span<const CountedNoun> counts);

/// "1 edge", "2 edges"; `plural` where an s does not do.
std::string counted(std::uint64_t count, const std::string& noun, const std::string& plural = {});

/// The name of a coordinate reference system given as WKT: "WGS 84"; empty for none.
std::string crs_name(const std::string& wkt);

}  // namespace medial::cli
