// medial pack, medial unpack: axes as compact codes of shapes.

#include "medial/io/pack.h"

#include <fmt/format.h>

#include <array>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "cli/stored_axes.h"
#include "cli/terminal.h"

namespace medial::cli {
namespace {

constexpr char pack_formats[] = ".mpk";

struct PackArguments {
  InputOptions input;
  CommonOptions common;
  std::string output;
  double error = 1e-3;
  bool units = false;
  bool squares = false;
  bool compare = false;
};

/// The diagonal of all shapes together.
double extent_of(const Document<AxisItem>& file) {
  Box all = Box::nothing();
  for (const AxisItem& item : file.items)
    if (!item.shape.points.empty()) all.add(bounding_box(item.shape));
  return all.is_nothing() ? 0 : diagonal(all);
}

/// How the error is shared out: the shortest of these, or the first one where that is large: of
/// large packs the others make a difference of some hundredths.
constexpr std::array<std::pair<double, double>, 3> settings{{{0.3, 0.9}, {0.2, 0.9}, {0.4, 0.85}}};
constexpr std::size_t large_pack = 32768;  // bytes

Status tell(const PackArguments& arguments, Json object, const std::string& line) {
  if (arguments.common.json) return print(object);
  if (arguments.output != "-") {
    if (arguments.common.quiet) return success();
    std::string text = line + "\n";
    if (arguments.compare)
      for (const auto& [name, value] : object["compare"].items())
        text += fmt::format("  {:<28}{:>10}\n", name, value.dump());
    return print(text);
  }
  return success();
}

/// The boundary, packed in the same way and as it was: to compare.
Json compare_boundary(const Document<AxisItem>& file, double error) {
  std::vector<Shape> shapes;
  std::string text;
  for (const AxisItem& item : file.items) {
    shapes.push_back(item.shape);
    for (const Vec2 p : item.shape.points) text += fmt::format("{:.17g} {:.17g},", p.x, p.y);
  }
  Json object = Json::object();
  const auto code = encode_boundary(shapes, error);
  if (code) object["boundary_within_error"] = io::compressed_size(*code);
  object["boundary_text"] = text.size();
  object["boundary_text_zstd"] =
      io::compressed_size({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  return object;
}

Result<int> pack_squares(const PackArguments& arguments) {
  auto image = io::read_image(arguments.input.path, arguments.input.read.image);
  if (!image) return std::move(image).error();
  io::PackFile file;
  file.kind = io::PackKind::squares;
  file.y_down = true;
  SquareReport report;
  const double error = arguments.units ? arguments.error : 0;
  if (!(error >= 0 && error <= 65535)) return invalid_option("--error is no number of pixels");
  file.code = encode_squares(image->image, static_cast<std::uint32_t>(error), &report);
  auto bytes = io::pack_bytes(file);
  if (!bytes) return std::move(bytes).error();
  if (Status written = io::write_pack(arguments.output, *bytes); !written)
    return std::move(written).error();
  Json object = {{"input", arguments.input.path},    {"output", arguments.output},
                 {"bytes", bytes->size()},           {"squares", report.squares},
                 {"missing_pixels", report.missing}, {"pixels", image->image.count()}};
  if (arguments.compare) object["compare"] = Json::object();
  Status told =
      tell(arguments, object,
           fmt::format("{}: {} bytes, {}, {} missing", arguments.input.path, bytes->size(),
                       counted(report.squares, "square"), counted(report.missing, "pixel")));
  if (!told) return std::move(told).error();
  return exit_success;
}

Result<int> run_pack(const PackArguments& arguments) {
  const auto& [input, common, output, error, units, squares, compare] = arguments;
  if (output.empty()) return invalid_option("-o needs the name of a pack");
  Status writable =
      check_output(output, output == "-" ? "mpk" : "", pack_formats, input.path, common.json);
  if (!writable) return std::move(writable).error();
  if (squares) return pack_squares(arguments);
  auto axes = load_axes(input, common);
  if (!axes) return std::move(axes).error();
  const Stopwatch watch;
  const double size = extent_of(axes->native);
  const double bound = units ? error : error * size;
  std::vector<MedialAxis> all;
  for (AxisItem& item : axes->native.items) all.push_back(std::move(item.axis));
  std::vector<std::uint8_t> bytes;
  PackReport report;
  for (const auto& [quantum, prune] : settings) {
    PackReport one;
    auto code = encode_axes(all, {bound, quantum, prune}, &one);
    if (!code) return std::move(code).error();
    io::PackFile file;
    file.code = std::move(code).value();
    file.crs_wkt = axes->native.crs_wkt;
    file.y_down = axes->native.y_down;
    auto packed = io::pack_bytes(file);
    if (!packed) return std::move(packed).error();
    if (bytes.empty() || packed->size() < bytes.size()) {
      bytes = std::move(packed).value();
      report = one;
    }
    if (bytes.size() > large_pack) break;
  }
  const double seconds = watch.seconds();
  if (Status written = io::write_pack(output, bytes); !written) return std::move(written).error();
  Json object = {{"input", input.path},       {"output", output},
                 {"bytes", bytes.size()},     {"error", bound},
                 {"disks", report.disks},     {"lines", report.lines},
                 {"quantum", report.quantum}, {"features", all.size()}};
  if (compare) object["compare"] = compare_boundary(axes->native, bound);
  if (common.stats) object.update({{"seconds", seconds}, {"peak_bytes", peak_bytes()}});
  Status told = tell(arguments, object,
                     fmt::format("{}: {} bytes, {} within {:.6g}", input.path, bytes.size(),
                                 counted(report.disks, "disk"), bound));
  if (!told) return std::move(told).error();
  return exit_success;
}

struct UnpackArguments {
  InputOptions input;
  CommonOptions common;
  std::string output;
  std::string format;
  io::WriteOptions write;
};

Result<int> run_unpack(const UnpackArguments& arguments) {
  const auto& [input, common, output, format, write] = arguments;
  const Stopwatch reading;
  auto pack = io::read_pack(input.path);
  if (!pack) return std::move(pack).error();
  if (pack->kind == io::PackKind::squares) {
    Status writable = check_output(output, format, image_formats, input.path, common.json);
    if (!writable) return std::move(writable).error();
    auto image = decode_squares(pack->code);
    if (!image) {
      Error error = std::move(image).error();
      error.place.file = input.path;
      return error;
    }
    if (!output.empty()) {
      Status written = io::write_image(output, *image, {});
      if (!written) return std::move(written).error();
    }
    if (common.json || output.empty()) {
      Status printed = print(Json{{"input", input.path},
                                  {"width", image->width()},
                                  {"height", image->height()},
                                  {"pixels", image->count()}});
      if (!printed) return std::move(printed).error();
    }
    return exit_success;
  }
  Status writable =
      check_output(output, format, io::formats_of(io::DocumentKind::axes), input.path, common.json);
  if (!writable) return std::move(writable).error();
  std::vector<std::string> notes;
  auto native = io::native_of(*pack, &notes);
  if (!native) {
    Error error = std::move(native).error();
    error.place.file = input.path;
    return error;
  }
  if (!common.quiet)
    for (const std::string& note : notes) say("medial: {}: note: {}\n", input.path, note);
  AxisFile file;
  file.native = std::move(native).value();
  file.statistics.threads = 1;
  file.seconds_read = reading.seconds();
  return write_and_tell(file, input, common, output, format, write);
}

}  // namespace

Command make_pack_command(CLI::App& program) {
  auto arguments = std::make_shared<PackArguments>();
  CLI::App* command =
      program.add_subcommand("pack", "Write axes as a compact code of their shapes.");
  add_input_options(*command, arguments->input);
  command->add_option("-o,--output", arguments->output, "The pack: .mpk; - is standard output.")
      ->required()
      ->check(a_name())
      ->option_text("PACK REQUIRED");
  CLI::Option* error =
      command
          ->add_option("--error", arguments->error,
                       "How far the shape may change, as a share of the diagonal (default: 0.001).")
          ->check(in_range(0, 1e300))
          ->option_text("E");
  command
      ->add_flag("--units", arguments->units,
                 "--error is in units of the input; of --squares, in pixels.")
      ->needs(error);
  command->add_flag("--squares", arguments->squares,
                    "Of an image: maximal squares of pixels instead; without loss, or with\n"
                    "--error N --units at most N pixels away.");
  command->add_flag("--compare", arguments->compare,
                    "Tell what the boundary takes: within the same error, coded alike; and as\n"
                    "text, through zstd.");
  add_common_options(*command, arguments->common);
  command->footer(
      "A pack holds disks along the branches that matter, in whole numbers, compressed\n"
      "by zstd. Unpacked, their union lies within the error of the shape, and the shape\n"
      "within the error of it.\n"
      "\n"
      "Examples:\n"
      "  medial pack leaf.svg -o leaf.mpk --error 0.002 --compare\n"
      "  medial axis plan.wkt -o - --format json | medial pack - -o plan.mpk\n"
      "  medial pack scan.png -o scan.mpk --squares");
  return {command, [arguments] { return run_pack(*arguments); }};
}

Command make_unpack_command(CLI::App& program) {
  auto arguments = std::make_shared<UnpackArguments>();
  CLI::App* command =
      program.add_subcommand("unpack", "Read packs back: axes and shapes, or images.");
  command->add_option("PACK", arguments->input.path, "A pack; - is standard input.")
      ->required()
      ->option_text("REQUIRED");
  command
      ->add_option("-o,--output", arguments->output,
                   fmt::format("Where to write the axis and its shape: {};\n"
                               "of a pack of squares the image: {}.",
                               io::formats_of(io::DocumentKind::axes), image_formats))
      ->check(a_name())
      ->option_text("OUTPUT");
  command->add_option("--format", arguments->format, "The format of -o - (default: json).")
      ->option_text("NAME");
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "Examples:\n"
      "  medial unpack leaf.mpk -o leaf.svg\n"
      "  medial unpack plan.mpk -o - --format json | medial info -\n"
      "  medial unpack scan.mpk -o scan.png");
  return {command, [arguments] { return run_unpack(*arguments); }};
}

}  // namespace medial::cli
