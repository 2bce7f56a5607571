#include "cli/stored_axes.h"

#include <algorithm>

#include "cli/terminal.h"
#include "medial/match.h"

namespace medial::cli {

Result<AxisFile> load_axes(const InputOptions& input, const CommonOptions& common, double specks,
                           const Options& options) {
  if (specks == 0 && input.text.empty() && io::is_native(input.path)) {
    const Stopwatch reading;
    auto native = [&input] {
      const Activity shown("reading", input.path);
      return io::read_native(input.path);
    }();
    if (!native) return std::move(native).error();
    // A file may hold shapes alone.
    const bool has_axes = std::ranges::any_of(
        native->items, [](const auto& item) { return !item.axis.nodes.empty(); });
    // A margin asks for axes of its own.
    const bool as_asked =
        !options.exterior ||
        (options.margin == 0 && std::ranges::all_of(native->items, [](const auto& item) {
           return item.axis.exterior > 0;
         }));
    if (as_asked && !holds_contours(*native) && (has_axes || native->items.empty())) {
      AxisFile file;
      file.native = std::move(native).value();
      file.statistics.threads = effective_threads(common.threads);
      file.seconds_read = reading.seconds();
      return file;
    }
  }
  auto shapes = load_shapes(input, common.threads);
  if (!shapes) return std::move(shapes).error();
  if (specks > 0)
    for (Shape& shape : shapes->shapes) shape = without_specks(shape, specks);
  print_notes(*shapes, input, common);
  return compute_axes(std::move(shapes).value(), input.path, common, options);
}

}  // namespace medial::cli
