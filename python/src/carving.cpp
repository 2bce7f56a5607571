// Tool paths: carving with a V-bit or an end mill, clearing before a V-bit, tabs.

#include "binding.h"

namespace medial::python {
namespace {

/// Moves options by name into `options`, and refuses those that carve() does not have.
CarveOptions carve_options(const nb::dict& given) {
  CarveOptions options;
  for (const auto& [key, value] : given) {
    const std::string name = nb::cast<std::string>(key);
    double* const to = name == "angle"        ? &options.angle
                       : name == "depth"      ? &options.depth
                       : name == "tool"       ? &options.tool
                       : name == "tip"        ? &options.tip
                       : name == "pass_depth" ? &options.pass_depth
                       : name == "step"       ? &options.step
                       : name == "chord"      ? &options.chord
                       : name == "ramp"       ? &options.ramp
                       : name == "cleared"    ? &options.cleared
                                              : nullptr;
    if (to == nullptr) throw nb::type_error(("carve() has no option '" + name + "'").c_str());
    *to = option_as<double>(value, name);
  }
  return options;
}

/// The number of tabs, their width and height.
struct TabsGiven {
  TabOptions options;
  double width = 0, height = 0;
};

Result<Tabs> tabs_for(const AxisOf& self, const TabsGiven& given, const CarveOptions& options) {
  if (given.options.count == 0 && !(given.options.spacing > 0)) return Tabs{};
  const double bottom = clearing_before(options, 0, 0).depth;
  const auto invalid = [](const char* text) { return Error{ErrorCode::invalid_option, text, {}}; };
  if (!(bottom > 0)) return invalid("tabs need a depth: how thick the material is");
  const double height = given.height > 0 ? given.height : std::min(2.0, bottom / 2);
  if (height >= bottom) return invalid("tab_height is below the depth");
  auto lines = place_tabs(*self.shape, self.axis, given.options);
  if (!lines) return std::move(lines).error();
  return Tabs{std::move(lines).value(), given.width, bottom - height};
}

std::unique_ptr<CarvingOf> carved(const AxisOf& self, const nb::dict& given,
                                  double clear_pass_depth, std::uint32_t tabs, double tab_spacing,
                                  double tab_width, double tab_height) {
  CarveOptions options = carve_options(given);
  auto result = std::make_unique<CarvingOf>(CarvingOf{self.shape, {}, {}});
  Status done = run(self.axis.edges.size(), [&](const std::atomic<bool>*) -> Status {
    auto left = tabs_for(self, {{tabs, tab_spacing}, tab_width, tab_height}, options);
    if (!left) return std::move(left).error();
    options.tabs = std::move(left).value();
    auto carving = carve(self.axis, options);
    if (!carving) return std::move(carving).error();
    result->carving = std::move(carving).value();
    if (!(options.cleared > 0)) return success();
    auto clearing = carve(self.axis, clearing_before(options, options.cleared, clear_pass_depth));
    if (!clearing) return std::move(clearing).error();
    result->clearing = std::move(clearing).value();
    return success();
  });
  value_of(std::move(done));
  return result;
}

/// The kind and the pass of each path, and its rows of x, y, z, bulge.
nb::list paths_of(const Carving& carving) {
  nb::list paths;
  constexpr std::array<const char*, 5> kinds{"clearing", "wall", "groove", "ramp", "plunge"};
  for (const ToolPath& path : carving.paths)
    paths.append(nb::make_tuple(kinds[static_cast<std::size_t>(path.kind)], path.pass,
                                rows_of<double>(path.points)));
  return paths;
}

nb::dict numbers_of(const Carving& carving) {
  nb::dict numbers;
  numbers["deepest"] = carving.deepest;
  numbers["flat_from"] = carving.flat_from;
  numbers["tip_radius"] = carving.tip_radius;
  numbers["slope"] = carving.slope;
  numbers["step"] = carving.step;
  numbers["cut_length"] = carving.cut_length;
  numbers["travel_length"] = carving.travel_length;
  return numbers;
}

/// The middles of tabs, as rows of three points.
Array<double, 2> tabs_of(const CarvingOf& self) {
  std::vector<TabLine> lines = self.carving.tabs.lines;
  return rows_of<double>(std::move(lines));
}

}  // namespace

void bind_carving(nb::module_& module) {
  nb::class_<CarvingOf>(module, "Carving")
      .def("paths", [](const CarvingOf& self) { return paths_of(self.carving); })
      .def("clearing", [](const CarvingOf& self) { return paths_of(self.clearing); })
      .def("numbers", [](const CarvingOf& self) { return numbers_of(self.carving); })
      .def("tabs", &tabs_of);
  module.def("carved", &carved, nb::arg("axis"), nb::arg("given"), nb::arg("clear_pass_depth"),
             nb::arg("tabs"), nb::arg("tab_spacing"), nb::arg("tab_width"), nb::arg("tab_height"));
}

}  // namespace medial::python
