#pragma once

// What the commands share: their arguments, and how errors and objects are printed.

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "medial/contour.h"
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
  std::string path;    ///< of a file; with a text, of the font
  std::string text;    ///< to be set in a font, instead of a file of shapes
  std::string font;    ///< as given; path tells it as well
  std::string repair;  ///< the name of read.repair
  std::string close;   ///< read.close as text
  io::ReadOptions read;
  ArcOptions arcs;
};

/// What every command takes.
struct CommonOptions {
  int threads = 0;             ///< 0: all of the machine
  double tolerance = 0;        ///< relative to the diagonal; 0: the library's default
  double corner_angle = 0.01;  ///< degrees
  double chord = io::WriteOptions{}.chord;
  bool stats = false;
  bool json = false;
  bool quiet = false;
};

/// Each adds its arguments to a command; what they refer to must live as long as the command.
/// `second` is the name of a second file that the command requires after INPUT, with the string
/// that it fills.
void add_input_options(CLI::App& command, InputOptions& input);
void add_input_options(CLI::App& command, InputOptions& input, const std::string& second_name,
                       const std::string& second_help, std::string& second);
void add_common_options(CLI::App& command, CommonOptions& common);
/// -o and --format, for outputs of `formats`; without -o such a command prints its summary only.
/// `piped` tells which format -o - has.
void add_output_options(CLI::App& command, std::string& output, std::string& format,
                        const std::string& formats, const std::string& piped = "default: json");
/// --threads, and --stats, --json and --quiet; both are part of the common arguments.
void add_threads_option(CLI::App& command, CommonOptions& common);
void add_report_options(CLI::App& command, CommonOptions& common);
/// --threshold and --invert.
void add_image_options(CLI::App& command, io::ImageOptions& options);
void add_picture_options(CLI::App& command, io::WriteOptions& write);
/// --width alone. Its help tells the default, which is what `width` holds.
void add_width_option(CLI::App& command, double& width);

/// A number in [low, high]; NaN is in no range. Help texts show the range unless `quiet`.
CLI::Validator in_range(double low, double high, bool quiet = false);
/// A finite number above 0.
CLI::Validator a_positive_number();
/// Adds a option for numbers with commas between them: `count` of them, or for 0 one or more.
CLI::Option* add_list_option(CLI::App& command, const std::string& name, std::size_t count,
                             const std::function<void(const std::vector<double>&)>& take,
                             const std::string& help);
/// What is wrong with a command line, in words for who typed it.
std::string explain(const CLI::ParseError& error, const CLI::App& command);
/// What the name of an output must be: not empty.
CLI::Validator a_name();
/// Digits that make a 64-bit number; CLI11 by itself takes -1 for the largest.
CLI::Validator a_whole_number();

/// Checks that `path` can be written later, before any long work: a known format, a directory that
/// takes files, nothing there but a regular file that may be replaced, and not the input itself.
/// An empty path is no output, which can always be had. With `json` standard output is taken.
/// `known_formats` lists extensions, separated by anything that is neither letter nor digit.
Status check_output(const std::string& path, const std::string& format,
                    const std::string& known_formats, const std::string& input, bool json);

/// An error of a file as a whole.
Error error_at(ErrorCode code, const std::string& file, std::string text);

/// The formats of images in black and white.
inline constexpr char image_formats[] = ".png .tif .pbm";

/// The error of a command line that asks for something impossible.
Error invalid_option(std::string text);

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

/// The members of an object as a table, one a line; objects inside are indented. Names and values
/// tell all: "seconds", "precision_retries", "peak_bytes".
std::string table(const Json& object);

/// What build_shape() mended, as "2 repeated points, 1 reversed ring"; empty if nothing.
std::string describe(const ShapeReport& report);
/// Adds up the reports of several features.
void add(ShapeReport& sum, const ShapeReport& part);
void add(ArcReport& sum, const ArcReport& part);

/// "1 edge", "2 edges"; `plural` where an s does not do.
std::string counted(std::uint64_t count, const std::string& noun, const std::string& plural = {});

/// The name of a coordinate reference system given as WKT: "WGS 84"; empty for none.
std::string crs_name(const std::string& wkt);

}  // namespace medial::cli
