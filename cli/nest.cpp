// medial nest: places a shape so that it interlocks with another one.

#include <fmt/format.h>

#include <array>
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

/// A file, whose features are tried in order.
struct ShapesInTurn {
  InputOptions input;
  Document<ShapeItem> file = {};
  std::vector<std::string> left_out = {};

  const Shape& shape() const { return file.items[left_out.size()].shape; }
  Status load(const CommonOptions& common) {
    auto loaded = load_shapes(input, common);
    if (!loaded) return std::move(loaded).error();
    file = std::move(loaded->file);
    return file.items.empty() ? Status(no_shape(input.path)) : success();
  }
  /// An error of the first shape.
  Error named(Error error) const {
    error.place.file = input.path;
    error.place.feature = file.index_of(left_out.size());
    return error;
  }
  /// Leaves the first shape out if its error and the options allow that, and there is another one.
  Status leave_out(Error error, const CommonOptions& common) {
    error.place.feature = file.index_of(left_out.size());
    if (!leave_out_feature(error, skips(input, left_out))) return named(std::move(error));
    if (left_out.size() < file.items.size()) return success();
    note_left_out(left_out, input, common);
    return no_shape(input.path);
  }
};

/// Placements of the first shapes that have axes.
Result<std::vector<Placement>> place(std::array<ShapesInTurn, 2>& files,
                                     const NestArguments& arguments) {
  while (true) {
    auto found = nest(files[0].shape(), files[1].shape(), arguments.gap, !arguments.no_mirror,
                      arguments.best);
    if (!found && found.error().place.feature) {
      ShapesInTurn& refused = files[*found.error().place.feature];
      if (Status next = refused.leave_out(found.error(), arguments.common); !next)
        return std::move(next).error();
      continue;
    }
    for (const ShapesInTurn& one : files) note_left_out(one.left_out, one.input, arguments.common);
    return found;
  }
}

/// The fixed shape with the axis of its bays, and the other shape, placed, with its own axis.
Result<Document<AxisItem>> picture_of(const std::array<ShapesInTurn, 2>& files,
                                      const Placement& at) {
  Options around;
  around.exterior = true;
  auto outer = compute(files[0].shape(), around);
  if (!outer) return files[0].named(std::move(outer).error());
  auto moved = placed(files[1].shape(), at);
  if (!moved) return files[1].named(std::move(moved).error());
  auto inner = compute(*moved);
  if (!inner) return files[1].named(std::move(inner).error());
  Document<AxisItem> file;
  file.items.push_back({files[0].shape(), std::move(outer).value(), {}});
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
  std::array files{ShapesInTurn{first_input(input, other)},
                   ShapesInTurn{second_input(input, other)}};
  for (ShapesInTurn& one : files)
    if (Status loaded = one.load(common); !loaded) return std::move(loaded).error();
  phases.end("read");
  const auto found = place(files, arguments);
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
        const auto file = picture_of(files, found->front());
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
  add_input_options(
      *command, arguments->input, "OTHER",
      "A file with the shape to rotate and move. Both files contribute their first\n"
      "feature, which must be connected; with --skip-invalid, the first that is connected\n"
      "and has an axis.",
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
