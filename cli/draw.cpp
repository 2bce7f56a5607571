// medial draw: a picture of shapes or of stored axes.

#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"

namespace medial::cli {
namespace {

constexpr char picture_formats[] = ".svg .pdf .png .ps";

struct DrawArguments : FileArguments {
  Options options;  ///< exterior and margin
};

Result<int> run_draw(const DrawArguments& arguments) {
  Status writable = check_output(arguments, picture_formats);
  if (!writable) return std::move(writable).error();
  auto axes = load_axes(arguments.input, arguments.common, 0, arguments.options);
  if (!axes) return std::move(axes).error();
  return finish_axes(*axes, arguments);
}

}  // namespace

Command make_draw_command(CLI::App& program) {
  auto arguments = std::make_shared<DrawArguments>();
  CLI::App* command = program.add_subcommand("draw", "Draw shapes and their medial axes.");
  add_input_options(*command, arguments->input);
  arguments->input.source.read.smooth_contour = false;  // the file's own contours
  add_output_option(*command, arguments->output, "PICTURE REQUIRED",
                    fmt::format("The picture; its extension selects the format: {}\n"
                                "- is standard output, see --format.",
                                picture_formats))
      ->required();
  add_format_option(*command, arguments->format, "for example svg");
  add_exterior_options(
      *command, arguments->options,
      "The axis of the exterior: around the shape, within a rectangle, and in holes.");
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "INPUT may be shapes, whose axes are then computed, or stored axes. The axis is\n"
      "coloured by radius. Vector pictures hold exact curves.\n"
      "\n"
      "Examples:\n"
      "  medial draw plan.json -o plan.pdf --disks 100 --nodes\n"
      "  medial draw country.wkt.gz -o country.png --width 3000\n"
      "  medial draw gear.json -o - --format svg --no-shape > gear.svg");
  return command_of(command, arguments, run_draw);
}

}  // namespace medial::cli
