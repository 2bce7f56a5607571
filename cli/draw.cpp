// medial draw: a picture of shapes or of stored axes.

#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/stored_axes.h"

namespace medial::cli {
namespace {

constexpr char picture_formats[] = ".svg .pdf .png .ps";

struct DrawArguments {
  InputOptions input;
  CommonOptions common;
  std::string output;
  std::string format;
  io::WriteOptions write;
  Options options;  ///< exterior and margin
};

Result<int> run_draw(const DrawArguments& arguments) {
  const auto& [input, common, output, format, pictures, options] = arguments;
  if (output.empty()) return invalid_option("-o needs the name of a picture");
  Status writable = check_output(output, format, picture_formats, input.path, common.json);
  if (!writable) return std::move(writable).error();
  auto axes = load_axes(input, common, 0, options);
  if (!axes) return std::move(axes).error();
  return write_and_tell(*axes, input, common, output, format, pictures);
}

}  // namespace

Command make_draw_command(CLI::App& program) {
  auto arguments = std::make_shared<DrawArguments>();
  CLI::App* command = program.add_subcommand("draw", "Draw shapes and their medial axes.");
  add_input_options(*command, arguments->input);
  command
      ->add_option("-o,--output", arguments->output,
                   fmt::format("The picture; its extension tells the format: {}\n"
                               "- is standard output, see --format.",
                               picture_formats))
      ->required()
      ->check(a_name())
      ->option_text("PICTURE REQUIRED");
  command->add_option("--format", arguments->format, "The format of -o -, for example svg.")
      ->option_text("NAME");
  add_exterior_options(*command, arguments->options,
                       "The axis of what lies around the shape and in its holes, within a frame.");
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "INPUT may be shapes, whose axes are then computed, or medial's own .json, which\n"
      "is drawn as it stands. The axis is coloured by radius. Vector pictures hold exact\n"
      "curves.\n"
      "\n"
      "Examples:\n"
      "  medial draw plan.json -o plan.pdf --disks 100 --nodes\n"
      "  medial draw country.wkt.gz -o country.png --width 3000\n"
      "  medial draw gear.json -o - --format svg --no-shape > gear.svg");
  return {command, [arguments] { return run_draw(*arguments); }};
}

}  // namespace medial::cli
