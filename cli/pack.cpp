// medial pack, medial unpack: axes as compact codes of shapes.

#include <fmt/format.h>

#include <array>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/io/read.h"
#include "medial/io/write.h"

namespace medial::cli {
namespace {

constexpr char pack_formats[] = ".mpk";

struct PackArguments : FileArguments {
  double error = 1e-3;
  bool absolute = false;
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

/// The shares of the error for rounding and pruning. All are tried for the shortest pack; large
/// packs take the first, as the others differ by a few per cent only.
constexpr std::array<std::pair<double, double>, 3> settings{{{0.3, 0.9}, {0.2, 0.9}, {0.4, 0.85}}};
constexpr std::size_t large_pack = 32768;  // bytes

Result<int> finish_pack(const PackArguments& arguments, Json object, const Phases& phases,
                        const std::string& line) {
  std::string text;
  if (arguments.output != "-" && !arguments.common.quiet) {
    text = line + "\n";
    if (arguments.compare)
      for (const auto& [name, value] : object["compare"].items())
        text += fmt::format("  {:<28}{:>10}\n", name, value.dump());
  }
  return finish(arguments.common, std::move(object), phases, text);
}

/// The sizes of the boundary to compare: packed in the same way, and as text.
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
  const InputOptions& input = arguments.input;
  Phases phases;
  auto image = io::read_image(input.path, input.source.read.image);
  if (!image) return std::move(image).error();
  phases.end("read");
  io::PackFile file;
  file.kind = io::PackKind::squares;
  file.y_down = true;
  SquareReport report;
  const double error = arguments.absolute ? arguments.error : 0;
  if (!(error >= 0 && error <= 65535)) return invalid_option("--error is not a number of pixels");
  file.code = encode_squares(image->image, static_cast<std::uint32_t>(error), &report);
  auto bytes = io::pack_bytes(file);
  if (!bytes) return std::move(bytes).error();
  phases.end("pack");
  if (Status written = io::write_pack(arguments.output, *bytes); !written)
    return std::move(written).error();
  Json object = {{"input", input.path},
                 {"output", arguments.output},
                 {"bytes", bytes->size()},
                 {"squares", report.squares},
                 {"missing_pixels", report.missing},
                 {"pixels", image->image.count()}};
  if (arguments.compare) object["compare"] = Json::object();
  return finish_pack(
      arguments, std::move(object), phases,
      fmt::format("{}: {} bytes, {}, {} missing", input.path, bytes->size(),
                  counted(report.squares, "square"), counted(report.missing, "pixel")));
}

/// The shortest of the packs of these axes within an error.
struct Packed {
  std::vector<std::uint8_t> bytes;
  PackReport report;
};

Result<Packed> pack_axes(Document<AxisItem>& axes, double bound) {
  std::vector<MedialAxis> all;
  for (AxisItem& item : axes.items) all.push_back(std::move(item.axis));
  Packed shortest;
  for (const auto& [quantum, prune] : settings) {
    PackReport report;
    auto code = encode_axes(all, {bound, quantum, prune}, &report);
    if (!code) return std::move(code).error();
    io::PackFile file;
    file.code = std::move(code).value();
    file.crs_wkt = axes.crs_wkt;
    file.unit = axes.unit;
    file.y_down = axes.y_down;
    auto bytes = io::pack_bytes(file);
    if (!bytes) return std::move(bytes).error();
    if (shortest.bytes.empty() || bytes->size() < shortest.bytes.size())
      shortest = {std::move(bytes).value(), report};
    if (shortest.bytes.size() > large_pack) break;
  }
  return shortest;
}

Result<int> run_pack(const PackArguments& arguments) {
  const std::string &input = arguments.input.path, &output = arguments.output;
  Status writable =
      check_output(output, output == "-" ? "mpk" : "", pack_formats, input, arguments.common.json);
  if (!writable) return std::move(writable).error();
  if (!arguments.absolute && arguments.error >= 1)
    return invalid_option(
        fmt::format("--error {} is a share of the diagonal, which has to be below 1; with "
                    "--absolute it is in units of the input",
                    arguments.error));
  if (arguments.squares) return pack_squares(arguments);
  auto axes = load_axes(arguments.input, arguments.common);
  if (!axes) return std::move(axes).error();
  if (axes->file.items.empty()) return no_shape(input);
  const double bound =
      arguments.absolute ? arguments.error : arguments.error * extent_of(axes->file);
  const auto packed = pack_axes(axes->file, bound);
  if (!packed) return packed.error();
  axes->phases.end("pack");
  const auto& [bytes, report] = *packed;
  if (Status written = io::write_pack(output, bytes); !written) return std::move(written).error();
  Json object = {{"input", input},
                 {"output", output},
                 {"bytes", bytes.size()},
                 {"error", bound},
                 {"disks", report.disks},
                 {"lines", report.lines},
                 {"quantum", report.quantum},
                 {"features", axes->file.items.size()}};
  if (arguments.compare) object["compare"] = compare_boundary(axes->file, bound);
  return finish_pack(arguments, std::move(object), axes->phases,
                     fmt::format("{}: {} bytes, {} within {:.6g}", input, bytes.size(),
                                 counted(report.disks, "disk"), bound));
}

Result<int> unpack_squares(const FileArguments& arguments, const ShapeCode& code) {
  Status writable = check_output(arguments, image_formats);
  if (!writable) return std::move(writable).error();
  auto image = decode_squares(code);
  if (!image) {
    image.error().place.file = arguments.input.path;
    return std::move(image).error();
  }
  if (!arguments.output.empty()) {
    Status written = io::write_image(arguments.output, arguments.format, *image, {});
    if (!written) return std::move(written).error();
    if (!arguments.common.json) return exit_success;
  }
  Status printed = print(Json{{"input", arguments.input.path},
                              {"width", image->width()},
                              {"height", image->height()},
                              {"pixels", image->count()}});
  if (!printed) return std::move(printed).error();
  return exit_success;
}

Result<int> run_unpack(const FileArguments& arguments) {
  const InputOptions& input = arguments.input;
  LoadedAxes axes;
  auto pack = io::read_pack(input.path);
  if (!pack) return std::move(pack).error();
  if (pack->kind == io::PackKind::squares) return unpack_squares(arguments, pack->code);
  Status writable = check_output(arguments, io::formats_of(io::DocumentKind::axes));
  if (!writable) return std::move(writable).error();
  std::vector<std::string> notes;
  auto native = io::native_of(*pack, &notes);
  if (!native) {
    native.error().place.file = input.path;
    return std::move(native).error();
  }
  if (!arguments.common.quiet)
    for (const std::string& note : notes) say("medial: {}: note: {}\n", input.path, note);
  axes.file = std::move(native).value();
  axes.phases.end("read");
  return finish_axes(axes, arguments);
}

}  // namespace

Command make_pack_command(CLI::App& program) {
  auto arguments = std::make_shared<PackArguments>();
  CLI::App* command =
      program.add_subcommand("pack", "Write axes as a compact code of their shapes.");
  add_input_options(*command, arguments->input);
  add_output_option(*command, arguments->output, "PACK REQUIRED",
                    "The pack: .mpk; - is standard output.")
      ->required();
  CLI::Option* error =
      add_value(*command, "--error", arguments->error, "E", in_range(0, 1e300),
                "The largest change of the shape, as a share of the diagonal, below 1 (default:\n"
                "0.001).");
  command
      ->add_flag("--absolute", arguments->absolute,
                 "--error is in units of the input, or with --squares in pixels.")
      ->needs(error);
  command->add_flag("--squares", arguments->squares,
                    "For an image: maximal squares of pixels instead; lossless, or with\n"
                    "--error N --absolute at most N pixels away.");
  command->add_flag("--compare", arguments->compare,
                    "Also print the size of the boundary: within the same error, coded alike;\n"
                    "and as text compressed by zstd.");
  add_common_options(*command, arguments->common);
  command->footer(
      "A pack holds disks along the branches that matter, as integers, compressed by zstd.\n"
      "The union of the unpacked disks and the shape are within the error of each other.\n"
      "\n"
      "Examples:\n"
      "  medial pack leaf.svg -o leaf.mpk --error 0.002 --compare\n"
      "  medial axis plan.wkt -o - --format json | medial pack - -o plan.mpk\n"
      "  medial pack scan.png -o scan.mpk --squares");
  return command_of(command, arguments, run_pack);
}

Command make_unpack_command(CLI::App& program) {
  auto arguments = std::make_shared<FileArguments>();
  CLI::App* command =
      program.add_subcommand("unpack", "Read packs back: axes and shapes, or images.");
  command->add_option("PACK", arguments->input.path, "A pack; - is standard input.")
      ->required()
      ->option_text("REQUIRED");
  add_output_option(*command, arguments->output, "OUTPUT",
                    fmt::format("The output file for the axis and its shape: {};\n"
                                "from a pack of squares, for the image: {}.",
                                io::formats_of(io::DocumentKind::axes), image_formats));
  add_format_option(*command, arguments->format, "default: json");
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "Examples:\n"
      "  medial unpack leaf.mpk -o leaf.svg\n"
      "  medial unpack plan.mpk -o - --format json | medial info -\n"
      "  medial unpack scan.mpk -o scan.png");
  return command_of(command, arguments, run_unpack);
}

}  // namespace medial::cli
