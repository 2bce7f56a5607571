// medial distance: the exact distance of every pixel of an image.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"
#include "medial/raster.h"

namespace medial::cli {
namespace {

constexpr char grid_formats[] = ".tif .png .pgm";

struct DistanceArguments {
  std::string input;
  std::string output;
  io::ImageOptions image;
  io::DistanceFormat format;
  bool cracks = false;
  bool open = false;
  int threads = 0;
  bool stats = false;
  bool json = false;
};

Result<int> run_distance(const DistanceArguments& arguments) {
  Status writable = check_output(arguments.output, {}, grid_formats, arguments.input, false);
  if (!writable) return std::move(writable).error();
  const Stopwatch reading;
  auto file = io::read_image(arguments.input, arguments.image);
  if (!file) return std::move(file).error();
  const double seconds_read = reading.seconds();

  const Stopwatch measuring;
  DistanceOptions options;
  options.to = arguments.cracks ? DistanceTo::cracks : DistanceTo::pixels;
  options.frame = !arguments.open;
  options.threads = arguments.threads;
  auto distances = distance_transform(file->image, options);
  if (!distances) return std::move(distances).error();
  const double seconds_distance = measuring.seconds();

  const Stopwatch writing;
  if (!arguments.output.empty()) {
    Status written = io::write_distances(arguments.output, *distances, *file, arguments.format);
    if (!written) return std::move(written).error();
  }
  const double seconds_write = writing.seconds();

  const auto largest = std::ranges::max_element(distances->squared);
  const auto at = static_cast<std::size_t>(largest - distances->squared.begin());
  const auto x = static_cast<std::uint32_t>(at % distances->width);
  const auto y = static_cast<std::uint32_t>(at / distances->width);
  const double deepest = distances->at(x, y);
  const Topology parts = topology(file->image);
  const double pixels = static_cast<double>(distances->squared.size());
  const Json costs = {
      {"seconds",
       {{"read", seconds_read}, {"distance", seconds_distance}, {"write", seconds_write}}},
      {"nanoseconds_per_pixel", 1e9 * seconds_distance / pixels},
      {"threads", effective_threads(arguments.threads)},
      {"peak_bytes", peak_bytes()}};
  Status printed = success();
  if (arguments.json) {
    Json object = {{"input", arguments.input},
                   {"width", distances->width},
                   {"height", distances->height},
                   {"foreground", file->image.count()},
                   {"components", parts.components},
                   {"holes", parts.holes},
                   {"largest", {{"x", x}, {"y", y}, {"distance", nullptr}}}};
    if (std::isfinite(deepest)) object["largest"]["distance"] = deepest;
    if (arguments.stats) object.update(costs);
    printed = print(object);
  } else {
    printed = print(fmt::format(
        "{} x {} pixels, {} foreground: {}, {}; largest distance: {:.10g} "
        "at pixel ({}, {})\n",
        distances->width, distances->height, file->image.count(),
        counted(parts.components, "component"), counted(parts.holes, "hole"), deepest, x, y));
    if (arguments.stats) say_text(table(costs));
  }
  if (!printed) return std::move(printed).error();
  return exit_success;
}

}  // namespace

Command make_distance_command(CLI::App& program) {
  auto arguments = std::make_shared<DistanceArguments>();
  CLI::App* command =
      program.add_subcommand("distance", "Measure each pixel's distance to the background.");
  command
      ->add_option("IMAGE", arguments->input,
                   "A binary image: PNG, TIFF, GeoTIFF, PGM or PBM; - is standard input.")
      ->required()
      ->check(a_name())
      ->option_text(" ");
  command
      ->add_option("-o,--output", arguments->output,
                   fmt::format("Where to write; the extension tells the format:\n{}\n"
                               ".tif has 32 bits a pixel, the others 16.",
                               grid_formats))
      ->check(a_name())
      ->option_text("IMAGE");
  add_image_options(*command, arguments->image);
  command->add_flag("--squared", arguments->format.squared,
                    "Write squared distances, which are whole numbers.");
  command
      ->add_option("--scale", arguments->format.scale,
                   "Write so many times the distance, in formats of 16 bits rounded to the\n"
                   "nearest whole number (default: 1).")
      ->check(in_range(1e-6, 1e6, true))
      ->option_text("S");
  command->add_flag("--cracks", arguments->cracks,
                    "Measure to the boundary of the pixels' squares, not to the centre of\n"
                    "the nearest background pixel.");
  command->add_flag("--open", arguments->open, "What lies outside of the image is no background.");
  command->add_option("--threads", arguments->threads, "Threads to use (default: 0, all).")
      ->check(in_range(0, 1024, true))
      ->option_text("N");
  command->add_flag("--stats", arguments->stats, "Tell times, counts and memory.");
  command->add_flag("--json", arguments->json, "Print one JSON object on standard output.");
  command->footer(
      "Distances are Euclidean, exact, and in pixels, from centre to centre.\n"
      "\n"
      "Examples:\n"
      "  medial distance horse.png --invert -o distance.tif\n"
      "  medial distance scan.pbm -o distance.png --scale 100");
  return {command, [arguments] { return run_distance(*arguments); }};
}

}  // namespace medial::cli
