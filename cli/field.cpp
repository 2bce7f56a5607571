// medial field: the potential of a charged border, and its force lines.

#include "medial/field.h"

#include <memory>
#include <vector>

#include "cli/common.h"
#include "cli/costs.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"
#include "cli/verbs.h"
#include "medial/io/field.h"

namespace medial::cli {
namespace {

struct FieldSwitches {
  InputSwitches input;
  CommonSwitches common;
  std::string output;
  double order = 1;
  io::FieldPictureOptions picture;
};

Result<int> run_field(const FieldSwitches& switches) {
  Status writable = check_output(switches.output, {}, io::known_field_formats(),
                                 switches.input.path, switches.common.json);
  if (!writable) return std::move(writable).error();
  auto file = load_shapes(switches.input, switches.common.threads);
  if (!file) return std::move(file).error();
  print_notes(*file, switches.input, switches.common);
  const Stopwatch drawing;
  std::vector<PotentialField> fields;
  for (std::size_t i = 0; i < file->shapes.size(); ++i) {
    auto field = PotentialField::make(file->shapes[i], switches.order);
    if (!field) return at_feature(std::move(field).error(), switches.input.path, i);
    fields.push_back(std::move(field).value());
  }
  io::FieldPictureOptions picture = switches.picture;
  picture.y_down = file->y_down;
  Status written = io::write_field(switches.output, {}, file->shapes, fields, picture);
  if (!written) return std::move(written).error();
  const Json costs = costs_of(
      switches.common,
      {{"read", file->seconds_read}, {"shape", file->seconds_shape}, {"draw", drawing.seconds()}});
  if (switches.common.json) {
    Json object = {{"input", switches.input.path}, {"output", switches.output}};
    if (switches.common.stats) object.update(costs);
    Status printed = print(object);
    if (!printed) return std::move(printed).error();
  }
  print_costs(switches.common, costs);
  return exit_success;
}

}  // namespace

Verb make_field_verb(CLI::App& program) {
  auto switches = std::make_shared<FieldSwitches>();
  CLI::App* verb = program.add_subcommand(
      "field", "Draw the potential of a charged border and its force lines.");
  add_input_switches(*verb, switches->input);
  verb->add_option("-o,--output", switches->output,
                   "The picture; its extension tells the format: " + io::known_field_formats())
      ->required()
      ->check(a_name())
      ->option_text("PICTURE REQUIRED");
  verb->add_option("--order", switches->order, "The n of the potential 1 / r^n (default: 1).")
      ->check(in_range(1.0, 256.0, true))
      ->option_text("N");
  verb->add_option("--lines", switches->picture.lines,
                   "Force lines begin on a grid, so many along the longer side (default: 40).")
      ->check(in_range(0, 1000, true))
      ->option_text("N");
  add_width_switch(*verb, switches->picture.width);
  verb->add_flag("!--no-brightness", switches->picture.brightness, "Draw the lines only.");
  add_common_switches(*verb, switches->common);
  verb->footer(
      "The brighter a point, the lower is the potential, on a logarithmic scale. Force\n"
      "lines run along the force, into the valleys: `medial axis --method potential`\n"
      "follows these.\n"
      "\n"
      "Examples:\n"
      "  medial field plan.wkt -o field.png\n"
      "  medial field plan.wkt -o lines.svg --order 8 --no-brightness");
  return {verb, [switches] { return run_field(*switches); }};
}

}  // namespace medial::cli
