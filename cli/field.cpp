// medial field: the potential of a charged border, and its force lines.

#include "medial/field.h"

#include <memory>
#include <vector>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/costs.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"
#include "medial/io/write.h"

namespace medial::cli {
namespace {

struct FieldArguments {
  InputOptions input;
  CommonOptions common;
  std::string output;
  double order = 1;
  io::FieldPictureOptions picture;
};

Result<int> run_field(const FieldArguments& arguments) {
  Status writable = check_output(arguments.output, {}, io::formats_of(io::DocumentKind::field),
                                 arguments.input.path, arguments.common.json);
  if (!writable) return std::move(writable).error();
  auto file = load_shapes(arguments.input, arguments.common.threads);
  if (!file) return std::move(file).error();
  print_notes(*file, arguments.input, arguments.common);
  const Stopwatch drawing;
  std::vector<PotentialField> fields;
  for (std::size_t i = 0; i < file->shapes.size(); ++i) {
    auto field = PotentialField::make(file->shapes[i], arguments.order);
    if (!field) return at_feature(std::move(field).error(), arguments.input.path, i);
    fields.push_back(std::move(field).value());
  }
  io::FieldPictureOptions picture = arguments.picture;
  picture.y_down = file->y_down;
  Status written = io::write_field(arguments.output, {}, file->shapes, fields, picture);
  if (!written) return std::move(written).error();
  const Json costs = costs_of(
      arguments.common,
      {{"read", file->seconds_read}, {"shape", file->seconds_shape}, {"draw", drawing.seconds()}});
  if (arguments.common.json) {
    Json object = {{"input", arguments.input.path}, {"output", arguments.output}};
    if (arguments.common.stats) object.update(costs);
    Status printed = print(object);
    if (!printed) return std::move(printed).error();
  }
  print_costs(arguments.common, costs);
  return exit_success;
}

}  // namespace

Command make_field_command(CLI::App& program) {
  auto arguments = std::make_shared<FieldArguments>();
  CLI::App* command = program.add_subcommand(
      "field", "Draw the potential of a charged border and its force lines.");
  add_input_options(*command, arguments->input);
  command
      ->add_option(
          "-o,--output", arguments->output,
          "The picture; its extension tells the format: " + io::formats_of(io::DocumentKind::field))
      ->required()
      ->check(a_name())
      ->option_text("PICTURE REQUIRED");
  command->add_option("--order", arguments->order, "The n of the potential 1 / r^n (default: 1).")
      ->check(in_range(1.0, 256.0, true))
      ->option_text("N");
  command
      ->add_option("--lines", arguments->picture.lines,
                   "Force lines begin on a grid, so many along the longer side (default: 40).")
      ->check(in_range(0, 1000, true))
      ->option_text("N");
  add_width_option(*command, arguments->picture.width);
  command->add_flag("!--no-brightness", arguments->picture.brightness, "Draw the lines only.");
  add_common_options(*command, arguments->common);
  command->footer(
      "The brighter a point, the lower is the potential, on a logarithmic scale. Force\n"
      "lines run along the force, into the valleys: `medial axis --method potential`\n"
      "follows these.\n"
      "\n"
      "Examples:\n"
      "  medial field plan.wkt -o field.png\n"
      "  medial field plan.wkt -o lines.svg --order 8 --no-brightness");
  return {command, [arguments] { return run_field(*arguments); }};
}

}  // namespace medial::cli
