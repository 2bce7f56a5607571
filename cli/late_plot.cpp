// Stands in for plot.cpp in the program: it is in the module of pictures, as it draws by Cairo.

#include <dlfcn.h>

#include "cli/plot.h"

namespace medial::cli {

Status write_plots(const std::string& path, const std::vector<Plot>& plots) {
  void* const library = dlopen(MEDIAL_DRAW_MODULE, RTLD_LAZY | RTLD_LOCAL);
  void* const function = library != nullptr ? dlsym(library, "medial_write_plots") : nullptr;
  if (function == nullptr)
    return Error{ErrorCode::unsupported,
                 "the part of medial for plots cannot be loaded; install medial again",
                 {}};
  return (*static_cast<decltype(&write_plots)*>(function))(path, plots);
}

}  // namespace medial::cli
