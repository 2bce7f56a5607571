// medial tiles: the axis of a large shape, tile by tile.

#include "medial/tiles.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"
#include "medial/threads.h"

namespace medial::cli {
namespace {

struct TilesArguments : FileArguments {
  std::uint64_t tiles = 0;
};

/// The levels of a quadtree with `tiles` leaves; for 0, with about 2^16 edges in each.
int levels_for(std::uint64_t tiles, std::size_t edges) {
  constexpr std::uint64_t in_leaf = 1 << 16;
  const std::uint64_t wanted = tiles > 0 ? tiles : std::max<std::uint64_t>(edges / in_leaf, 4);
  int levels = 0;
  while (levels < 10 && (std::uint64_t{1} << (2 * levels)) < wanted) ++levels;
  return levels;
}

/// Adds the rows of one shape to the totals, level by level from the root.
void add_to(std::vector<TileLevel>& sum, const std::vector<TileLevel>& rows) {
  if (sum.size() < rows.size()) sum.resize(rows.size());
  for (std::size_t level = 0; level < rows.size(); ++level) {
    sum[level].tiles += rows[level].tiles;
    sum[level].edges += rows[level].edges;
    sum[level].most = std::max(sum[level].most, rows[level].most);
    sum[level].axis += rows[level].axis;
  }
}

/// Rewords an error of the library about levels or arcs in terms of --tiles and commands.
std::string in_words_of_the_command(std::string text) {
  constexpr std::string_view levels = "use fewer levels";
  if (const std::size_t at = text.find(levels); at != std::string::npos)
    text.replace(at, levels.size(), "use fewer tiles");
  if (text.find("straight edges only") != std::string::npos)
    text += ": medial rebuild INPUT --polygon -o OUTPUT.wkt";
  return text;
}

/// From the leaves to the root, for --json and as a table.
std::pair<Json, std::string> report_of(const std::vector<TileLevel>& levels) {
  Json list = Json::array();
  std::string text =
      fmt::format("{:>7} {:>10} {:>12} {:>12} {:>12}\n", "level", "tiles", "edges", "most", "axis");
  for (std::size_t level = levels.size(); level-- > 0;) {
    const TileLevel& row = levels[level];
    list.push_back({{"level", level},
                    {"tiles", row.tiles},
                    {"edges", row.edges},
                    {"most", row.most},
                    {"axis", row.axis}});
    text += fmt::format("{:>7} {:>10} {:>12} {:>12} {:>12}\n", level, row.tiles, row.edges,
                        row.most, row.axis);
  }
  return {std::move(list), std::move(text)};
}

Result<int> run_tiles(const TilesArguments& arguments) {
  Status writable = check_output(arguments, io::formats_of(io::DocumentKind::axes));
  if (!writable) return std::move(writable).error();
  const CommonOptions& common = arguments.common;
  auto shapes = load_shapes(arguments.input, common);
  if (!shapes) return std::move(shapes).error();
  std::vector<TileLevel> levels;
  // One shape after another, each on all threads.
  const int threads = effective_threads(common.threads);
  const auto compute_one = [&](std::size_t i, int) -> Result<AxisItem> {
    ShapeItem& item = shapes->file.items[i];
    Progress progress("tiles", error_is_terminal() && !common.quiet);
    Options options = engine_options(common, threads, shapes->file.corner_angle);
    options.progress = progress.callback();
    std::vector<TileLevel> rows;
    auto axis = compute_in_tiles(item.shape, levels_for(arguments.tiles, item.shape.points.size()),
                                 options, &rows);
    if (!axis) {
      axis.error().text = in_words_of_the_command(std::move(axis.error().text));
      return std::move(axis).error();
    }
    add_to(levels, rows);
    return AxisItem{std::move(item.shape), std::move(axis).value(), std::move(item.attributes)};
  };
  std::vector<std::string> left_out;
  auto computed = map_features<AxisItem>(shapes->file, weights_of(shapes->file), 1, compute_one,
                                         skips(arguments.input, left_out));
  if (!computed) {
    computed.error().place.file = arguments.input.path;
    return std::move(computed).error();
  }
  note_left_out(left_out, arguments.input, common);
  LoadedAxes axes{std::move(computed).value(), {}, shapes->report, std::move(shapes->phases)};
  axes.phases.end("tiles");
  Status written =
      write_output(arguments, axes.phases, [&](const std::string& path, const std::string& format) {
        return io::write_axes(path, format, axes.file, write_options(arguments));
      });
  if (!written) return std::move(written).error();
  auto [list, text] = report_of(levels);
  Json object = to_json(summarize(axes.file));
  object["input"] = arguments.input.path;
  object["unit"] = name_of(axes.file.unit);
  object["levels"] = std::move(list);
  const bool silent = common.quiet || !arguments.output.empty();
  return finish(common, std::move(object), axes.phases, silent ? std::string() : text);
}

}  // namespace

Command make_tiles_command(CLI::App& program) {
  auto arguments = std::make_shared<TilesArguments>();
  CLI::App* command = program.add_subcommand("tiles", "Compute medial axes in independent tiles.");
  add_input_options(*command, arguments->input);
  add_output_options(*command, *arguments, io::formats_of(io::DocumentKind::axes));
  command
      ->add_option("--tiles", arguments->tiles,
                   "The number of tiles, from 1 to 1048576, rounded up to a power of four\n"
                   "(default: about 65,536 edges in each, at least 4).")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 20))
      ->option_text("N");
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "Each tile loads the edges in its window and keeps the part of the axis whose disks\n"
      "lie inside. Only edges that other disks can still touch move on to the parent tile,\n"
      "up to the root. The axis is that of `medial axis`, up to rounding and the order of\n"
      "nodes and edges. For shapes of straight edges.\n"
      "\n"
      "Without -o, prints one row per level: the number of tiles with edges, of boundary\n"
      "edges in all and in the largest, and of axis edges finished there.\n"
      "\n"
      "Examples:\n"
      "  medial tiles coast.wkt.gz -o coast.json\n"
      "  medial tiles coast.wkt.gz --tiles 1024 --json | jq '.levels[]'");
  return command_of(command, arguments, run_tiles);
}

}  // namespace medial::cli
