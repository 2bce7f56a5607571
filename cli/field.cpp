// medial field: the potential of a charged border, and its force lines.

#include <memory>
#include <vector>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/io/write.h"
#include "medial/methods.h"

namespace medial::cli {
namespace {

struct FieldArguments : FileArguments {
  double order = 1;
  io::FieldPictureOptions picture;
};

Result<int> run_field(const FieldArguments& arguments) {
  Status writable = check_output(arguments, io::formats_of(io::DocumentKind::field));
  if (!writable) return std::move(writable).error();
  auto file = load_shapes(arguments.input, arguments.common);
  if (!file) return std::move(file).error();
  std::vector<Shape> shapes;
  std::vector<PotentialField> fields;
  std::vector<std::string> left_out;
  for (std::size_t i = 0; i < file->file.items.size(); ++i) {
    ShapeItem& item = file->file.items[i];
    auto field = PotentialField::make(item.shape, arguments.order);
    if (!field) {
      field.error().place.feature = file->file.index_of(i);
      if (leave_out_feature(field.error(), skips(arguments.input, left_out))) continue;
      return std::move(field).error();
    }
    fields.push_back(std::move(field).value());
    shapes.push_back(std::move(item.shape));
  }
  note_left_out(left_out, arguments.input, arguments.common);
  io::FieldPictureOptions picture = arguments.picture;
  picture.y_down = file->file.y_down;
  picture.unit = file->file.unit;
  Status written = io::write_field(arguments.output, {}, shapes, fields, picture);
  if (!written) return std::move(written).error();
  file->phases.end("draw");
  return finish(arguments.common, {{"input", arguments.input.path}, {"output", arguments.output}},
                file->phases, {});
}

}  // namespace

Command make_field_command(CLI::App& program) {
  auto arguments = std::make_shared<FieldArguments>();
  CLI::App* command = program.add_subcommand(
      "field", "Draw the potential of a charged border and its force lines.");
  add_input_options(*command, arguments->input);
  add_output_option(
      *command, arguments->output, "PICTURE REQUIRED",
      "The picture; its extension chooses the format: " + io::formats_of(io::DocumentKind::field))
      ->required();
  add_value(*command, "--order", arguments->order, "N", in_range(1.0, 256.0, true),
            "The n of the potential 1 / r^n (default: 1).");
  add_value(*command, "--lines", arguments->picture.lines, "N", in_range(0, 1000, true),
            "Force lines start on a grid with N along the longer side (default: 40).");
  add_width_option(*command, arguments->picture.width);
  command->add_flag("!--no-brightness", arguments->picture.brightness, "Draw the lines only.");
  add_common_options(*command, arguments->common);
  command->footer(
      "The brighter a point, the lower its potential, on a logarithmic scale. Force\n"
      "lines run along the force, into the valleys: `medial axis --method potential`\n"
      "follows these.\n"
      "\n"
      "Examples:\n"
      "  medial field plan.wkt -o field.png\n"
      "  medial field plan.wkt -o lines.svg --order 8 --no-brightness");
  return command_of(command, arguments, run_field);
}

}  // namespace medial::cli
