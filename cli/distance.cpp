// medial distance: the exact distance of every pixel of an image.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "medial/raster.h"

namespace medial::cli {
namespace {

constexpr char grid_formats[] = ".tif .png .pgm";

struct DistanceArguments {
  std::string input;
  std::string output;
  io::ImageOptions image;
  io::DistanceFormat format;
  DistanceOptions options;
  bool cracks = false;
  CommonOptions common;
};

Result<int> run_distance(const DistanceArguments& arguments) {
  if (arguments.output == "-")
    return invalid_option(fmt::format("-o needs the name of an image: {}", grid_formats));
  Status writable = check_output(arguments.output, {}, grid_formats, arguments.input, false);
  if (!writable) return std::move(writable).error();
  Phases phases;
  auto file = io::read_image(arguments.input, arguments.image);
  if (!file) return std::move(file).error();
  phases.end("read");
  if (!arguments.common.quiet)
    for (const std::string& note : file->notes)
      say("medial: {}: note: {}\n", arguments.input, note);
  DistanceOptions options = arguments.options;
  options.to = arguments.cracks ? DistanceTo::cracks : DistanceTo::pixels;
  options.threads = arguments.common.threads;
  auto distances = distance_transform(file->image, options);
  if (!distances) return std::move(distances).error();
  phases.end("distance");
  if (!arguments.output.empty()) {
    Status written = io::write_distances(arguments.output, *distances, *file, arguments.format);
    if (!written) return std::move(written).error();
  }
  phases.end("write");

  const auto largest = std::ranges::max_element(distances->squared);
  const auto at = static_cast<std::size_t>(largest - distances->squared.begin());
  const auto x = static_cast<std::uint32_t>(at % distances->width);
  const auto y = static_cast<std::uint32_t>(at / distances->width);
  const double deepest = distances->at(x, y);
  const Topology parts = topology(file->image);
  const double pixels = static_cast<double>(distances->squared.size());
  Json object = {{"input", arguments.input},
                 {"width", distances->width},
                 {"height", distances->height},
                 {"foreground", file->image.count()},
                 {"components", parts.components},
                 {"holes", parts.holes},
                 {"largest", {{"x", x}, {"y", y}, {"distance", nullptr}}}};
  if (std::isfinite(deepest)) object["largest"]["distance"] = deepest;
  return finish(arguments.common, std::move(object), phases,
                fmt::format("{} x {} pixels, {} foreground: {}, {}; largest distance: {:.10g} "
                            "at pixel ({}, {})\n",
                            distances->width, distances->height, file->image.count(),
                            counted(parts.components, "component"), counted(parts.holes, "hole"),
                            deepest, x, y),
                {{"nanoseconds_per_pixel", 1e9 * phases.seconds("distance") / pixels}});
}

}  // namespace

Command make_distance_command(CLI::App& program) {
  auto arguments = std::make_shared<DistanceArguments>();
  CLI::App* command =
      program.add_subcommand("distance", "Measure each pixel's distance to the background.");
  command
      ->add_option("IMAGE", arguments->input,
                   "A binary image: PNG, TIFF, GeoTIFF, PGM or PBM, or a ROS map (.yaml); - is\n"
                   "standard input.")
      ->required()
      ->check(a_name())
      ->option_text(" ");
  add_output_option(*command, arguments->output, "IMAGE",
                    fmt::format("The output file; its extension selects the format:\n{}\n"
                                ".tif has 32 bits per pixel, the others 16.",
                                grid_formats));
  add_image_options(*command, arguments->image);
  command->add_flag("--squared", arguments->format.squared,
                    "Write squared distances, which are integers.");
  add_value(*command, "--scale", arguments->format.scale, "S", in_range(1e-6, 1e6, true),
            "Multiply distances by this; formats of 16 bits round to the\n"
            "nearest integer (default: 1).");
  command->add_flag("--cracks", arguments->cracks,
                    "Measure to the boundary of the pixels' squares, not to the centre of\n"
                    "the nearest background pixel.");
  command->add_flag("!--open", arguments->options.outside_is_background,
                    "Pixels outside the image are not background.");
  add_threads_option(*command, arguments->common.threads);
  add_report_options(*command, arguments->common);
  command->footer(
      "Distances are Euclidean, exact, and in pixels, from centre to centre.\n"
      "\n"
      "Examples:\n"
      "  medial distance horse.png --invert -o distance.tif\n"
      "  medial distance scan.pbm -o distance.png --scale 100");
  return command_of(command, arguments, run_distance);
}

}  // namespace medial::cli
