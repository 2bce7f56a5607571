// medial nest: how two shapes interlock.

#include <fmt/format.h>

#include <memory>
#include <numbers>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/compute.h"
#include "medial/features.h"

namespace medial::cli {
namespace {

struct NestArguments : FileArguments {
  std::string other;
  double gap = 0;
  std::uint64_t best = 5;
  bool no_mirror = false;
};

/// The first feature of a file.
Result<ShapeItem> first_shape(const InputOptions& input, const CommonOptions& common) {
  auto loaded = load_shapes(input, common);
  if (!loaded) return std::move(loaded).error();
  if (loaded->file.items.empty()) return no_shape(input.path);
  return std::move(loaded->file.items.front());
}

/// The fixed shape with the axis of its bays, and the other one in its place with its own axis.
Result<Document<AxisItem>> picture_of(const Shape& fixed, const Shape& moving,
                                      const Placement& at) {
  Options around;
  around.exterior = true;
  auto outer = compute(fixed, around);
  if (!outer) return std::move(outer).error();
  auto moved = placed(moving, at);
  if (!moved) return std::move(moved).error();
  auto inner = compute(*moved);
  if (!inner) return std::move(inner).error();
  Document<AxisItem> file;
  file.items.push_back({fixed, std::move(outer).value(), {}});
  file.items.push_back({std::move(moved).value(), std::move(inner).value(), {}});
  return file;
}

Json json_of(const Placement& at) {
  return {{"angle", at.angle * 180 / std::numbers::pi},
          {"mirrored", at.mirrored},
          {"move", {{"x", at.move.x}, {"y", at.move.y}}},
          {"bay", {{"x", at.bay.x}, {"y", at.bay.y}}},
          {"saved", at.saved},
          {"gap", at.gap}};
}

std::string line_of(const Placement& at) {
  return fmt::format("{:>10.4g} {:>9.4f} {:>8} {:>12.6g} {:>12.6g} {:>12.6g} {:>12.6g} {:>10.3g}\n",
                     at.saved, at.angle * 180 / std::numbers::pi, at.mirrored ? "yes" : "no",
                     at.move.x, at.move.y, at.bay.x, at.bay.y, at.gap);
}

Result<int> run_nest(const NestArguments& arguments) {
  Phases phases;
  const std::string formats = io::formats_of(io::DocumentKind::axes);
  Status writable = check_output(arguments, formats);
  if (writable)
    writable = check_output(arguments.output, arguments.format, formats, arguments.other, false);
  if (!writable) return std::move(writable).error();
  const auto& [input, other, common] = std::tie(arguments.input, arguments.other, arguments.common);
  const auto fixed = first_shape(first_input(input, other), common);
  if (!fixed) return fixed.error();
  const auto moving = first_shape(second_input(input, other), common);
  if (!moving) return moving.error();
  phases.end("read");
  const auto found =
      nest(fixed->shape, moving->shape, arguments.gap, !arguments.no_mirror, arguments.best);
  if (!found) return found.error();
  phases.end("nest");
  if (found->empty())
    return error_at(ErrorCode::empty, arguments.input.path,
                    "no placement was found that saves area; the search is local");
  Json list = Json::array();
  std::string text =
      fmt::format("{:>10} {:>9} {:>8} {:>12} {:>12} {:>12} {:>12} {:>10}\n", "saved", "degrees",
                  "mirrored", "move x", "move y", "bay x", "bay y", "gap");
  for (const Placement& at : *found) {
    list.push_back(json_of(at));
    text += line_of(at);
  }
  const Status written =
      write_output(arguments, phases, [&](const std::string& path, const std::string& format) {
        const auto file = picture_of(fixed->shape, moving->shape, found->front());
        if (!file) return Status(file.error());
        return io::write_axes(path, format, *file, write_options(arguments));
      });
  if (!written) return written.error();
  const bool silent = arguments.common.quiet || arguments.output == "-";
  return finish(arguments.common,
                {{"input", arguments.input.path},
                 {"other", arguments.other},
                 {"placements", std::move(list)}},
                phases, silent ? std::string() : text);
}

}  // namespace

Command make_nest_command(CLI::App& program) {
  auto arguments = std::make_shared<NestArguments>();
  CLI::App* command =
      program.add_subcommand("nest", "Place a shape so that it interlocks with another one.");
  add_input_options(*command, arguments->input, "OTHER",
                    "A file with the shape that is rotated and moved. Both files contribute their\n"
                    "first feature, which must be connected.",
                    arguments->other);
  add_output_options(*command, *arguments, io::formats_of(io::DocumentKind::axes));
  add_picture_options(*command, arguments->write);
  add_value(*command, "--gap", arguments->gap, "D", in_range(0, 1e300, true),
            "The least distance between the shapes, in units of the input (default: 0).");
  add_value(*command, "--best", arguments->best, "N", in_range(1, 100),
            "The number of placements, those that save most first (default: 5).");
  command->add_flag("--no-mirror", arguments->no_mirror, "Do not mirror the shape.");
  add_common_options(*command, arguments->common);
  command->footer(
      "Bays are branches of the axis around a shape, peninsulas branches of the axis inside.\n"
      "`saved` is the sum of the areas of the two convex hulls minus that of the common\n"
      "hull. A placement mirrors (x to -x), rotates about the origin, then moves. The output\n"
      "shows the first one: INPUT with the axis of its bays, and OTHER in its place.\n"
      "\n"
      "Examples:\n"
      "  medial nest frame.dxf bracket.dxf\n"
      "  medial nest part.svg part.svg --gap 2 -o pair.png");
  return command_of(command, arguments, run_nest);
}

}  // namespace medial::cli
