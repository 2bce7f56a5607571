// Replaces plot.cpp in the program. plot.cpp draws by Cairo and is in the module of pictures.

#include <dlfcn.h>

#include <string_view>

#include "cli/plot.h"

namespace medial::cli {

Status write_plots(const std::string& path, const std::vector<Plot>& plots) {
  void* const library = dlopen(MEDIAL_DRAW_MODULE, RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr)
    return Error{
        ErrorCode::unsupported,
        std::string("the part of medial for plots cannot be loaded: install medial again (") +
            dlerror() + ")",
        {}};
  const auto* const module = static_cast<const PlotModule*>(dlsym(library, plot_module_name));
  if (module == nullptr || std::string_view(module->stamp) != MEDIAL_STAMP)
    return Error{ErrorCode::unsupported,
                 "the part of medial for plots (" MEDIAL_DRAW_MODULE
                 ") is of another build of medial: install medial again",
                 {}};
  return module->write_plots(path, plots);
}

}  // namespace medial::cli
