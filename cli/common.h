#pragma once

// Shared by the commands: arguments, and printing of errors and objects.

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

/// Options of every command.
struct CommonOptions {
  int threads = 0;                     ///< 0: all of the machine
  double tolerance = 0;                ///< relative to the diagonal; 0: the library's default
  std::optional<double> corner_angle;  ///< degrees; nothing: Document::corner_angle
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

/// Each function adds options to a command. The variables that the options fill must outlive the
/// command. `second` receives the path of a second file, which the command requires after INPUT.
void add_input_options(CLI::App& command, InputOptions& input);
void add_input_options(CLI::App& command, InputOptions& input, const std::string& second_name,
                       const std::string& second_help, std::string& second);
void add_common_options(CLI::App& command, CommonOptions& common);
/// -o and --format, for outputs in `formats`. Without -o, such a command prints only its summary.
/// `piped` is the help's remark on the format of -o -.
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
/// --width alone. The default in its help is the value of `width`.
void add_width_option(CLI::App& command, double& width);
/// --fit, which replaces boundaries by smooth curves when they are read.
void add_fit_option(CLI::App& command, InputOptions& input);
/// --exterior, with this help, and --margin. Returns the former.
CLI::Option* add_exterior_options(CLI::App& command, Options& options, const std::string& help);

/// A number in [low, high]; NaN is in no range. Help texts show the range unless `quiet`.
CLI::Validator in_range(double low, double high, bool quiet = false);
/// A finite number above 0.
CLI::Validator a_positive_number();
/// A number for which `complaint` returns an empty string. Otherwise, the error is the number
/// followed by that string.
CLI::Validator a_number(std::function<std::string(double)> complaint,
                        const std::string& range = {});
/// A file name that is not empty.
CLI::Validator a_name();
/// A 64-bit number of digits only. CLI11 alone would accept -1 as the largest number.
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

/// Puts the options that are added during its lifetime into one group of the help.
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

/// Checks before any long work that `path` can be written later: the format is known, the directory
/// is writable, and an existing file is regular, writable and not the input. An empty path (no
/// output) always passes. With `json`, standard output is in use already. `known_formats` lists
/// extensions, separated by characters that are neither letters nor digits.
Status check_output(const std::string& path, const std::string& format,
                    const std::string& known_formats, const std::string& input, bool json);
Status check_output(const FileArguments& arguments, const std::string& known_formats);
bool has_extension(const std::string& path, const std::string& known_formats);
/// Whether the output is in one of these formats.
bool writes_one_of(const FileArguments& arguments, const std::string& known_formats);

/// Whether two paths name one file, which need not exist.
bool name_one_file(const std::string& path, const std::string& other);
/// The options for writing, with --chord from the common options.
io::WriteOptions write_options(const FileArguments& arguments);

/// An error of a file as a whole.
Error error_at(ErrorCode code, const std::string& file, std::string text);

/// The formats of images in black and white.
inline constexpr char image_formats[] = ".png .tif .pbm";

/// An invalid_option error.
Error invalid_option(std::string text);
/// The error for a file without a shape, for commands that need one. --skip-invalid can remove all.
Error no_shape(const std::string& file);

/// {"error": {"code": ..., "text": ..., "place": {...}}}
Json to_json(const Error& error);
Json to_json(const ShapeReport& report);
Json to_json(const ArcReport& report);
Json to_json(const Box& box);

/// Prints an error as one line on standard error and, on request, as an object on standard output.
/// Returns exit_error.
int report_error(const Error& error, bool json, const std::string& hint = {});

/// Prints to standard output. Errors: unwritable, for example on a full device.
Status print(const std::string& text);
Status print(const Json& object);

/// The members of an object as a table, one per line; members of nested objects are indented.
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

/// The duration of each phase of a run, in wall-clock and processor time.
class Phases {
 public:
  /// Ends the current phase, which began when the previous one ended.
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

/// Ends a command: prints the object with --json, or else the text, on standard output. With
/// --stats, adds the costs (seconds by phase, threads, memory and `more`): as members of the
/// object, or as a table on standard error. Returns the status.
Result<int> finish(const CommonOptions& common, Json object, const Phases& phases,
                   const std::string& text, const Json& more = {}, int status = exit_success);
/// The same for a command that writes a file. Adds the seconds of all phases to the line, and
/// prints it on standard output if there is no output file, or else on a terminal.
Result<int> finish(const FileArguments& arguments, Json object, const Phases& phases,
                   const std::string& line, const Json& more = {});
/// Whether finish() would print anything.
bool is_talkative(const FileArguments& arguments);

/// {name: value, ...}
Json to_json(const Attributes& attributes);
/// {"x": ..., "y": ..., "r": ...}
Json to_json(const Disk& disk);

/// The corrections of build_shape(), such as "2 repeated points, 1 reversed ring"; empty if none.
std::string describe(const ShapeReport& report);
/// Lists the counts that are not 0: "2 points, 1 ring".
struct CountedNoun {
  std::uint64_t count;
  const char *noun, *plural = "";
};
std::string enumerate(std::span<const CountedNoun> counts);

/// "1 edge", "2 edges". Pass `plural` for a noun whose plural is not formed by an s.
std::string counted(std::uint64_t count, const std::string& noun, const std::string& plural = {});

/// The name of a coordinate reference system given as WKT: "WGS 84"; empty for none.
std::string crs_name(const std::string& wkt);

}  // namespace medial::cli
