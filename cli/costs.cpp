#include "cli/costs.h"

#include <fmt/format.h>

#include <cstdio>

#include "cli/pipeline.h"
#include "cli/terminal.h"

namespace medial::cli {

Json costs_of(const CommonOptions& common, Json seconds) {
  return {{"seconds", std::move(seconds)},
          {"threads", effective_threads(common.threads)},
          {"peak_bytes", peak_bytes()}};
}

void print_costs(const CommonOptions& common, const Json& costs) {
  if (common.stats && !common.json) say_text(table(costs));
}

Status tell(const CommonOptions& common, const std::string& output, Json object, const Json& costs,
            const std::string& line) {
  print_costs(common, costs);
  if (common.json) {
    if (common.stats) object.update(costs);
    return print(object);
  }
  if (output.empty()) return print(line);
  if (error_is_terminal() && !common.quiet) say_text(line);
  return success();
}

}  // namespace medial::cli
