#include "cli/common.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <system_error>

#include "medial/document.h"
#include "medial/threads.h"

namespace medial::cli {
namespace {

namespace fs = std::filesystem;

// Limits of options, so that no value needs more memory than a machine has.
constexpr double smallest_chord = 1e-9;
constexpr double largest_tolerance = 1e-3;
constexpr double smallest_arc_tolerance = 1e-13;
constexpr double largest_arc_tolerance = 0.1;
constexpr int most_disks = 1'000'000;
constexpr double narrowest_picture = 16;
constexpr double widest_picture = 8000;  // what medial::io draws

/// Checks a value for Options::tolerance.
CLI::Validator a_tolerance() {
  return a_number(
      [](double value) {
        return value > 0 && value <= largest_tolerance
                   ? std::string()
                   : fmt::format(" is not in (0, {:g}]", largest_tolerance);
      },
      fmt::format("(0 - {:g}]", largest_tolerance));
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The extension of a file, without its dot.
std::string extension_of(const std::string& path) {
  const std::string extension = lower(fs::path(path).extension().string());
  return extension.empty() ? extension : extension.substr(1);
}

bool lists(const std::string& formats, const std::string& wanted) {
  if (wanted.empty()) return false;
  std::string word;
  for (const char c : formats + ' ') {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      word += c;
    } else {
      if (word == wanted) return true;
      word.clear();
    }
  }
  return false;
}

/// With --text the font replaces INPUT; then the first word is the second file.
void settle_input(InputOptions& input, const std::string& second_name, std::string* second) {
  if (input.source.text.empty()) {
    if (!input.font.empty()) throw CLI::RequiresError("--font", "--text");
    if (input.path.empty()) throw CLI::RequiredError("INPUT");
  } else {
    if (input.font.empty()) throw CLI::RequiresError("--text", "--font");
    if (second != nullptr && second->empty()) std::swap(input.path, *second);
    if (!input.path.empty()) throw CLI::ExcludesError("INPUT", "--text");
    input.path = input.font;
  }
  if (second != nullptr && second->empty()) throw CLI::RequiredError(second_name);
  if (second != nullptr && *second == "-" && input.path == "-")
    throw CLI::ValidationError("INPUT and " + second_name + " cannot both be standard input");
}

void add_curve_options(CLI::App& command, InputOptions& input) {
  const OptionGroup group(command, curve_group);
  command
      .add_option("--text", input.source.text,
                  "Instead of INPUT: the outlines of this text; each character is a feature.")
      ->check(CLI::Validator(
          [](const std::string& text) {
            return text.empty() ? "the text is empty" : std::string();
          },
          ""))
      ->option_text("TEXT");
  command.add_option("--font", input.font, "The font file of --text.")->option_text("FILE");
  add_value(command, "--font-size", input.source.font_size, "S", a_positive_number(),
            "The em size of the letters, in --units (default: font units).")
      ->needs("--font");
  ArcOptions& arcs = input.source.load.arcs;
  add_value(command, "--arc-tolerance", arcs.tolerance, "T",
            in_range(smallest_arc_tolerance, largest_arc_tolerance),
            "Replace curves by arcs within this fraction of the diagonal of the\n"
            "bounding box (default: 1e-6; with --font a 64th of a font unit). Arcs and\n"
            "straight edges stay exact.");
  command
      .add_option_function<double>(
          "--arc-tolerance-absolute",
          [&arcs](double tolerance) {
            arcs.tolerance = tolerance;
            arcs.relative = false;
          },
          "The same in units of the input.")
      ->check(a_positive_number())
      ->excludes("--arc-tolerance")
      ->option_text("T");
  command
      .add_flag("--close{all}", input.close,
                "Loose curves (DXF): join ends that are at most GAP apart, in units of\n"
                "the input (default: 1e-6 of the diagonal), and leave out curves that stay\n"
                "open; without GAP, close every open curve.")
      ->disable_flag_override(false)
      ->each([&input](const std::string& text) {
        double gap = std::numeric_limits<double>::infinity();
        if (text != "all" && (!CLI::detail::lexical_cast(text, gap) || !(gap >= 0))) {
          throw CLI::ValidationError("--close", text + " is not a distance");
        }
        input.source.read.close = gap;
      });
}

CLI::Option* add_unit(CLI::App& command, const char* name, Unit& unit, const std::string& help) {
  const auto check = [](const std::string& text) {
    return unit_of(text) ? std::string() : fmt::format("'{}' is not one of {}", text, unit_names());
  };
  return command
      .add_option_function<std::string>(
          name, [&unit](const std::string& text) { unit = *unit_of(text); }, help)
      ->check(CLI::Validator(check, ""))
      ->option_text("UNIT");
}

void add_unit_options(CLI::App& command, UnitOptions& units) {
  const OptionGroup group(command, "Units");
  add_unit(command, "--units", units.given,
           "The unit of lengths in the input; overrides the file's:\n" + unit_names() + ".");
  add_unit(command, "--output-units", units.wanted,
           "Convert to these units after reading; other options use them, too.");
  add_value(command, "--scale", units.scale, "S", in_range(1e-9, 1e9, true),
            "Scale the input by this factor (default: 1).");
  add_value(command, "--pixel-size", units.pixel_size, "L", a_positive_number(),
            "Images: the side of a pixel, in --units (default: 1, or with --output-units\n"
            "derived from the file's dots per inch).");
}

void add_outline_options(CLI::App& command, InputOptions& input) {
  input.source.read.smooth_contour = true;
  CLI::Option* smooth =
      command.add_flag("--smooth-contour", input.whole_smooth,
                       "Images: keep all branches of the axis of the smooth curve within half a\n"
                       "pixel of the pixels' boundary (default: `axis` and `prune` keep what a\n"
                       "person would draw).");
  command
      .add_flag("!--pixel-outline", input.source.read.smooth_contour,
                "Images: use the exact boundary of the pixels, with a branch at each step.")
      ->excludes(smooth);
}

}  // namespace

OptionGroup::OptionGroup(CLI::App& command, std::string_view name)
    : command_(command), before_(*command.option_defaults()) {
  command.option_defaults()->group(std::string(name));
}

OptionGroup::~OptionGroup() { *command_.option_defaults() = std::move(before_); }

void add_input_options(CLI::App& command, InputOptions& input, const std::string& second_name,
                       const std::string& second_help, std::string& second) {
  add_input_options(command, input);
  command.add_option(second_name, second, second_help)->option_text(" ");
  command.parse_complete_callback([&command, &input, &second, second_name] {
    if (command.remaining_size() == 0) settle_input(input, second_name, &second);
  });
}

void add_input_options(CLI::App& command, InputOptions& input) {
  // Let CLI11 report unknown words before a missing INPUT.
  command.parse_complete_callback([&command, &input] {
    if (command.remaining_size() == 0) settle_input(input, {}, nullptr);
  });
  io::ReadOptions& read = input.source.read;
  command
      .add_option("INPUT", input.path,
                  "Shapes: any vector file that GDAL reads, .svg, .dxf, .wkt, plain `x y`\n"
                  "text, medial's own .json and .safetensors, all also with .gz; an image\n"
                  "(PNG, JPEG, BMP, WebP, GIF, TIFF, GeoTIFF, PGM, PBM) or the .yaml of a\n"
                  "ROS map; or - for standard input.")
      ->option_text(" ");
  const OptionGroup group(command, input_group);
  command.add_option("--layer", read.layer, "Read this layer (default: the first).")
      ->option_text("NAME");
  command
      .add_option("--where", read.where,
                  "Read only the features that satisfy this SQL condition,\n"
                  "for example \"population > 1000\".")
      ->option_text("SQL");
  // A flag that carries a value: as an option, `--repair FILE` would take the file for the rule.
  static const std::map<std::string, RepairRule> rules = {{"make-valid", RepairRule::make_valid},
                                                          {"even-odd", RepairRule::even_odd},
                                                          {"non-zero", RepairRule::non_zero}};
  command
      .add_flag("--repair{make-valid}", input.repair,
                "Repair crossing or overlapping rings by make-valid (the default rule),\n"
                "even-odd or non-zero instead of refusing them; a note says what changed.")
      ->disable_flag_override(false)
      ->check(CLI::IsMember({"make-valid", "even-odd", "non-zero"}).description(""))
      ->each([&read](const std::string& rule) { read.repair = rules.at(rule); });
  command.add_flag("--skip-invalid", read.skip_invalid,
                   "Leave out invalid features, and those that cannot be computed, instead\n"
                   "of refusing the file; notes say why, and how many.");
  command
      .add_option("--crs", read.crs,
                  "The reference system of the coordinates; overrides the file's own.")
      ->option_text("EPSG:N");
  command.add_flag("--project", read.project,
                   "Longitudes and latitudes, or Web Mercator and the like: compute in a\n"
                   "suitable local projection, in metres. GIS formats, .wkt and .csv get\n"
                   "the coordinates of the input again; radii and lengths stay in metres.");
  add_image_options(command, read.image);
  command.add_flag("--labels", read.image.labels,
                   "Images: make one feature of the pixels of each value above 0.");
  add_outline_options(command, input);
  add_curve_options(command, input);
  add_unit_options(command, input.source.units);
}

void add_image_options(CLI::App& command, io::ImageOptions& options) {
  command
      .add_option("--threshold", options.threshold,
                  "Images: pixels of at least this value are foreground (default: half of\n"
                  "the format's range, such as 128 for 8 bits).")
      ->check(in_range(-1e300, 1e300, true))
      ->option_text("VALUE");
  command.add_flag("--invert", options.invert,
                   "Images: pixels below the threshold are foreground instead.");
}

CLI::Option* add_output_option(CLI::App& command, std::string& output, const std::string& kind,
                               const std::string& help) {
  return command.add_option("-o,--output", output, help)->check(a_name())->option_text(kind);
}

void add_format_option(CLI::App& command, std::string& format, const std::string& piped) {
  command.add_option("--format", format, fmt::format("The format of -o - ({}).", piped))
      ->option_text("NAME");
}

void add_layer_options(CLI::App& command, io::WriteOptions& write) {
  command
      .add_option("--output-layer", write.layer,
                  "The name of the layer in a .gpkg; others are called NAME_nodes and so on.")
      ->check(a_name())
      ->option_text("NAME");
  command.add_flag(
      "--overwrite", write.overwrite,
      "Replace medial's layers of the same name in a .gpkg, or that of --output-layer.");
}

void add_output_options(CLI::App& command, FileArguments& arguments, const std::string& formats,
                        const std::string& piped) {
  add_output_option(
      command, arguments.output, "OUTPUT",
      fmt::format("The output file; its extension selects the format:\n{}\n"
                  "- is standard output, see --format. Without -o, only a summary is\n"
                  "printed.",
                  formats));
  if (lists(formats, "gpkg")) add_layer_options(command, arguments.write);
  add_format_option(command, arguments.format, piped);
}

void add_threads_option(CLI::App& command, int& threads) {
  const OptionGroup group(command, common_group);
  add_value(command, "--threads", threads, "N", in_range(0, most_threads),
            "The number of threads (default: 0, all of the machine). The result\n"
            "is the same, byte for byte.");
}

void add_report_options(CLI::App& command, CommonOptions& common) {
  const OptionGroup group(command, common_group);
  command.add_flag("--stats", common.stats,
                   "Report times in seconds, counts and memory: as a table on standard error,\n"
                   "or with --json within the object on standard output.");
  command.add_flag("--json", common.json,
                   "Print one JSON object on standard output, also for errors.");
  command.add_flag("--quiet", common.quiet, "Print only errors: no warnings, notes or progress.");
}

void add_common_options(CLI::App& command, CommonOptions& common) {
  add_threads_option(command, common.threads);
  const OptionGroup group(command, common_group);
  add_value(command, "--tolerance", common.tolerance, "T", a_tolerance(),
            "The largest distance between a disk and a site that it touches, as a fraction\n"
            "of the diagonal of the bounding box, at most 1e-3 (default: 4e-15, in verify\n"
            "1e-14, or more if the coordinates are not that precise; by default, a small\n"
            "component of a polygon uses a tolerance for its own size).");
  add_value(command, "--corner-angle", common.corner_angle, "A", in_range(0, 10),
            "Treat a convex joint with an arc as smooth, not as a corner, if it turns by less\n"
            "than this angle, in degrees, at most 10 (default: 4 for fonts, 1 for .svg, else\n"
            "0.01).");
  add_value(command, "--chord", common.chord, "C", in_range(smallest_chord, 1),
            "In formats that store curves as points, the largest distance between a chord and\n"
            "its curve, as a fraction of the diagonal of the bounding box (default: 1e-3).");
  add_report_options(command, common);
}

void add_width_option(CLI::App& command, double& width) {
  const OptionGroup group(command, picture_group);
  add_value(command, "--width", width, "W", in_range(narrowest_picture, widest_picture),
            fmt::format("Width of a picture, in pixels (.png) or points of 1/72 inch\n"
                        "(.svg .pdf .ps) (default: {:g}).",
                        width));
}

void add_picture_options(CLI::App& command, io::WriteOptions& write) {
  add_width_option(command, write.width);
  const OptionGroup group(command, picture_group);
  add_value(command, "--disks", write.disks, "N", in_range(0, most_disks),
            "Draw about N maximal disks, spread over the axis (default: 0).");
  command.add_flag("--contacts", write.contacts, "Draw the foot points of the nodes' disks.");
  command.add_flag("--nodes", write.nodes,
                   "Draw the nodes, by kind; .gpkg and graphs also get those inside branches.");
  command.add_flag("!--no-shape", write.shape, "Leave out the shape.");
}

void add_fit_option(CLI::App& command, InputOptions& input) {
  add_value(command, "--fit", input.source.load.fit, "D", a_positive_number(),
            "First replace every boundary by a smooth curve within this distance, in units\n"
            "of the input: a least-squares spline with few knots.");
}

void add_simplify_option(CLI::App& command, io::WriteOptions& write) {
  add_value(command, "--simplify", write.simplify, "E", a_positive_number(),
            "Simplify lines in GIS formats, .wkt and graphs to within E of the axis, in units\n"
            "of the input (default: see --chord). End points do not move.");
}

CLI::Option* add_exterior_options(CLI::App& command, Options& options, const std::string& help) {
  CLI::Option* exterior = command.add_flag("--exterior", options.exterior, help);
  add_value(command, "--margin", options.margin, "D", a_positive_number(),
            "The distance from the shape's bounding box to that rectangle, in units of\n"
            "the input (default: half of the box's longer side).")
      ->needs(exterior);
  return exterior;
}

CLI::Validator a_number(std::function<std::string(double)> complaint, const std::string& range) {
  return CLI::Validator(
      [complaint = std::move(complaint)](const std::string& text) {
        double value = 0;
        if (!CLI::detail::lexical_cast(text, value))
          return fmt::format("'{}' is not a number", text);
        const std::string found = complaint(value);
        return found.empty() ? found : text + found;
      },
      range);
}

CLI::Validator in_range(double low, double high, bool quiet) {
  const std::string range = fmt::format("[{:g} - {:g}]", low, high);
  return a_number(
      [=](double value) { return value >= low && value <= high ? "" : " is not in " + range; },
      quiet ? std::string() : range);
}

CLI::Validator a_positive_number() {
  return a_number([](double value) {
    return value > 0 && std::isfinite(value) ? "" : " is not a finite number above 0";
  });
}

namespace {

/// Numbers separated by commas; nothing if one is missing or not a number.
std::optional<std::vector<double>> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t at = 0;;) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    double value = 0;
    const std::string word = CLI::detail::trim_copy(text.substr(at, comma - at));
    if (word.empty() || !CLI::detail::lexical_cast(word, value)) return std::nullopt;
    numbers.push_back(value);
    if (comma == text.size()) return numbers;
    at = comma + 1;
  }
}

}  // namespace

CLI::Option* add_list_option(CLI::App& command, const std::string& name, std::size_t count,
                             const std::function<void(const std::vector<double>&)>& take,
                             const std::string& help) {
  const auto check = [count](const std::string& text) {
    const auto numbers = numbers_of(text);
    const std::string wanted =
        count == 0 ? std::string("numbers") : fmt::format("{} numbers", count);
    if (!numbers || (count > 0 && numbers->size() != count))
      return fmt::format("'{}' is not {} separated by commas", text, wanted);
    return std::string();
  };
  return command
      .add_option_function<std::string>(
          name, [take](const std::string& text) { take(*numbers_of(text)); }, help)
      ->check(CLI::Validator(check, ""));
}

CLI::Validator a_name() {
  return CLI::Validator(
      [](const std::string& text) { return text.empty() ? "a name is missing" : std::string(); },
      "");
}

CLI::Validator a_whole_number() {
  return CLI::Validator(
      [](const std::string& text) {
        std::uint64_t value = 0;
        const char* end = text.data() + text.size();
        const auto parsed = std::from_chars(text.data(), end, value);
        return parsed.ec == std::errc() && parsed.ptr == end
                   ? std::string()
                   : fmt::format("{} is not a whole number in [0, 2^64)", text);
      },
      "");
}

namespace {

/// Whether writing to this name overwrites the input: the file itself, a part of a shapefile, or
/// the image of a map.
bool is_read_with(const fs::path& target, const fs::path& input) {
  std::error_code ignored;
  const auto same = [&](const fs::path& a, const fs::path& b) {
    return fs::exists(a, ignored) && fs::equivalent(a, b, ignored);
  };
  if (input == "-") return false;
  if (same(target, input) || same(target, io::image_of_map(input.string()))) return true;
  if (lower(target.extension().string()) != ".shp") return false;
  return std::ranges::any_of(std::array{".shx", ".dbf", ".prj", ".cpg"}, [&](const char* part) {
    return same(fs::path(target).replace_extension(part), input);
  });
}

/// Checks a path that is not standard output.
Status check_file(const std::string& path, const std::string& known_formats,
                  const std::string& input) {
  const auto unwritable = [&path](std::string text) {
    return error_at(ErrorCode::unwritable, path, std::move(text));
  };
  const fs::path target(path);
  const std::string extension = extension_of(path);
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) return unwritable("is a directory");
  if (!lists(known_formats, extension)) {
    return error_at(ErrorCode::unsupported, path,
                    fmt::format("{}; use one of {}",
                                extension.empty() ? "an output needs an extension"
                                                  : "unknown output format: ." + extension,
                                known_formats));
  }
  const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(parent, ignored)) return unwritable("its directory does not exist");
  if (access(parent.c_str(), W_OK | X_OK) != 0)
    return unwritable(
        fmt::format("cannot create files in its directory ({})", std::strerror(errno)));
  if (is_read_with(target, input))
    return unwritable("is the input itself, or a part of it; write to another file");
  if (!fs::exists(target, ignored)) return success();
  if (!fs::is_regular_file(target, ignored)) return unwritable("exists and is not a regular file");
  if (access(target.c_str(), W_OK) != 0) return unwritable(std::strerror(errno));
  return success();
}

}  // namespace

bool name_one_file(const std::string& path, const std::string& other) {
  const auto whole = [](const std::string& name) {
    std::error_code ignored;
    return fs::weakly_canonical(fs::absolute(name, ignored), ignored);
  };
  return path == other || (!path.empty() && !other.empty() && whole(path) == whole(other));
}

bool has_extension(const std::string& path, const std::string& known_formats) {
  return lists(known_formats, extension_of(path));
}

bool writes_one_of(const FileArguments& arguments, const std::string& known_formats) {
  return lists(known_formats,
               arguments.output == "-" ? lower(arguments.format) : extension_of(arguments.output));
}

Status check_output(const std::string& path, const std::string& format,
                    const std::string& known_formats, const std::string& input, bool json) {
  if (path.empty() && format.empty()) return success();
  if (path != "-") {
    if (!format.empty())
      return invalid_option("--format is for -o -; a file's extension selects its format");
    return check_file(path, known_formats, input);
  }
  // A pipe gets medial's own format by default.
  const bool native = format.empty() && lists(known_formats, "json");
  if (format.empty() && !native)
    return invalid_option(fmt::format("-o - needs --format, for example --format {}",
                                      lists(known_formats, "csv")   ? "csv"
                                      : lists(known_formats, "svg") ? "svg"
                                                                    : "ply"));
  if (!native && !lists(known_formats, lower(format)))
    return error_at(ErrorCode::unsupported, {},
                    fmt::format("unknown format: {}; use one of {}", format, known_formats));
  return json ? invalid_option("--json and -o - both need standard output") : success();
}

namespace {

/// Refuses options of pictures for other files. Nodes are a layer of GeoPackages, too.
Status check_picture_options(const FileArguments& arguments) {
  const io::WriteOptions& write = arguments.write;
  const bool asked =
      write.disks > 0 || write.contacts || !write.shape || write.width != io::WriteOptions{}.width;
  const std::string& output = arguments.output;
  if ((write.overwrite || !write.layer.empty()) && !writes_one_of(arguments, "gpkg"))
    return invalid_option("--output-layer and --overwrite are for .gpkg");
  if ((!asked && !write.nodes && write.simplify == 0) || output.empty()) return success();
  if (write.simplify > 0 && writes_one_of(arguments, "json csv dxf svg pdf png ps"))
    return invalid_option(
        fmt::format("--simplify is for lines of GIS formats, .wkt and graphs; {} has the curves "
                    "themselves, or samples",
                    output == "-" ? arguments.format : output));
  if (writes_one_of(arguments, "svg pdf png ps")) return success();
  if (!asked && (!write.nodes || writes_one_of(arguments, "gpkg graphml nodelink edgelist")))
    return success();
  return invalid_option(fmt::format(
      "--disks, --contacts, --nodes, --no-shape and --width are for pictures, which {} is not",
      output));
}

}  // namespace

Status check_output(const FileArguments& arguments, const std::string& known_formats) {
  if (Status asked = check_picture_options(arguments); !asked) return asked;
  return check_output(arguments.output, arguments.format, known_formats, arguments.input.path,
                      arguments.common.json);
}

io::WriteOptions write_options(const FileArguments& arguments) {
  io::WriteOptions write = arguments.write;
  write.chord = arguments.common.chord;
  return write;
}

Error error_at(ErrorCode code, const std::string& file, std::string text) {
  Error error{code, std::move(text), {}};
  error.place.file = file;
  return error;
}

Error no_shape(const std::string& file) {
  return error_at(ErrorCode::empty, file, "contains no shape");
}

Error invalid_option(std::string text) {
  return Error{ErrorCode::invalid_option, std::move(text), {}};
}

Json to_json(const Error& error) {
  Json place = Json::object();
  if (!error.place.file.empty()) place["file"] = error.place.file;
  if (error.place.feature) place["feature"] = *error.place.feature;
  if (error.place.ring) place["ring"] = *error.place.ring;
  if (error.place.vertex) place["vertex"] = *error.place.vertex;
  if (error.place.face) place["face"] = *error.place.face;
  if (error.place.line) place["line"] = *error.place.line;
  if (error.place.point) {
    place["x"] = error.place.point->x;
    place["y"] = error.place.point->y;
    if (error.place.z) place["z"] = *error.place.z;
  }
  return {{"error", {{"code", name_of(error.code)}, {"text", error.text}, {"place", place}}}};
}

Json to_json(const ShapeReport& report) {
  return {
      {"closing_points", report.closing_points},   {"unclosed_rings", report.unclosed_rings},
      {"repeated_points", report.repeated_points}, {"collinear_points", report.collinear_points},
      {"reversed_rings", report.reversed_rings},   {"touching_vertices", report.touching_vertices},
      {"split_edges", report.split_edges},         {"crossings", report.crossings},
      {"dropped_rings", report.dropped_rings}};
}

Json to_json(const ArcReport& report) {
  return {{"pieces", report.pieces},       {"spirals", report.spirals},
          {"arcs", report.arcs},           {"segments", report.segments},
          {"tolerance", report.tolerance}, {"largest_error", report.largest_error}};
}

Json to_json(const Box& box) { return {box.low.x, box.low.y, box.high.x, box.high.y}; }

int report_error(const Error& error, bool json, const std::string& hint) {
  say("medial: {}{}\n", to_string(error), hint);
  if (json) (void)print(to_json(error));
  return exit_error;
}

Status print(const std::string& text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (written && std::fflush(stdout) == 0) return success();
  return error_at(ErrorCode::unwritable, "standard output", std::strerror(errno));
}

Status print(const Json& object) {
  // File names need not be UTF-8; the object must be.
  return print(object.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

std::string table(const Json& object) {
  std::string text;
  const auto rows = [&text](const Json& members, const std::string& indent,
                            const auto& self) -> void {
    for (const auto& [key, value] : members.items()) {
      std::string name = indent + key;
      std::replace(name.begin(), name.end(), '_', ' ');
      if (value.is_object()) {
        text += name + '\n';
        self(value, indent + "  ", self);
      } else if (value.is_number_float()) {
        text += fmt::format("{:<22}{:>14.6g}\n", name, value.template get<double>());
      } else {
        text += fmt::format("{:<22}{:>14}\n", name,
                            value.is_string() ? value.template get<std::string>() : value.dump());
      }
    }
  };
  rows(object, "", rows);
  return text;
}

void Rows::add(std::string_view name, const std::string& value) {
  text_ += fmt::format("{:<{}}{}\n", name, width_, value);
}

void Rows::add(std::string_view name, std::uint64_t count) { add(name, std::to_string(count)); }

void Phases::end(const std::string& name) {
  const double processor_now = processor_seconds();
  seconds_[name] = watch_.seconds();
  processor_[name] = processor_now - processor_begin_;
  watch_ = Stopwatch();
  processor_begin_ = processor_now;
}

double Phases::seconds() const {
  double sum = 0;
  for (const Json& phase : seconds_) sum += phase.get<double>();
  return sum;
}

Result<int> finish(const CommonOptions& common, Json object, const Phases& phases,
                   const std::string& text, const Json& more, int status) {
  Json costs;
  if (common.stats) {
    costs = {{"seconds", phases.by_clock()},
             {"processor", phases.by_processor()},
             {"threads", effective_threads(common.threads)},
             {"peak_bytes", peak_bytes()}};
    if (!more.is_null()) costs.update(more);
  }
  if (common.json && common.stats) object.update(costs);
  Status printed = success();
  if (common.json)
    printed = print(object);
  else if (!text.empty())
    printed = print(text);
  if (!printed) return std::move(printed).error();
  if (common.stats && !common.json) say_text(table(costs));
  return status;
}

Result<int> finish(const FileArguments& arguments, Json object, const Phases& phases,
                   const std::string& line, const Json& more) {
  const auto& [input, common, output, format, write] = arguments;
  std::string text;
  if (!common.json && !line.empty())
    text = fmt::format("{}; done in {:.3g} s", line, phases.seconds());
  if (output.empty()) {
    if (!text.empty()) text += '\n';
    return finish(common, std::move(object), phases, text, more);
  }
  if (!text.empty() && error_is_terminal() && !common.quiet)
    say("{} -> {}\n", text, output == "-" ? "standard output" : output);
  return finish(common, std::move(object), phases, {}, more);
}

bool is_talkative(const FileArguments& arguments) {
  const CommonOptions& common = arguments.common;
  return common.json || common.stats || arguments.output.empty() ||
         (error_is_terminal() && !common.quiet);
}

Json to_json(const Attributes& attributes) {
  Json object = Json::object();
  for (const auto& [name, value] : attributes) object[name] = value;
  return object;
}

Json to_json(const Disk& disk) {
  return {{"x", disk.center.x}, {"y", disk.center.y}, {"r", disk.radius}};
}

std::string enumerate(std::span<const CountedNoun> counts) {
  std::string text;
  for (const auto& [count, noun, plural] : counts)
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, noun, plural);
  return text;
}

std::string describe(const ShapeReport& report) {
  const CountedNoun counts[] = {{report.unclosed_rings, "unclosed ring"},
                                {report.repeated_points, "repeated point"},
                                {report.collinear_points, "collinear point"},
                                {report.reversed_rings, "reversed ring"},
                                {report.touching_vertices, "touching vertex", "touching vertices"},
                                {report.split_edges, "split edge"},
                                {report.crossings, "crossing"},
                                {report.dropped_rings, "dropped ring"}};
  return enumerate(counts);
}

std::string counted(std::uint64_t count, const std::string& noun, const std::string& plural) {
  if (count == 1) return "1 " + noun;
  return fmt::format("{} {}", count, plural.empty() ? noun + "s" : plural);
}

std::string crs_name(const std::string& wkt) {
  const auto begin = wkt.find('"');
  const auto end = begin == std::string::npos ? begin : wkt.find('"', begin + 1);
  return end == std::string::npos ? std::string() : wkt.substr(begin + 1, end - begin - 1);
}

}  // namespace medial::cli
