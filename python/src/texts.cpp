// Formats that are text: medial's own JSON, paths of SVG, G-code.

#include "binding.h"
#include "medial/io/write.h"

namespace medial::python {
namespace {

/// The text that write(destination) makes.
template <class Write>
std::string text_of(const Write& write) {
  std::string text;
  value_of(without_lock([&] { return write(io::Destination(&text)); }));
  return text;
}

std::string dumps(const AxisOf& self) {
  Document<AxisItem> document;
  document.items.push_back({*self.shape, self.axis, {}});
  document.items[0].axis.statistics = {};
  return text_of([&](const io::Destination& to) { return io::write_axes(to, "json", document); });
}

std::vector<std::unique_ptr<AxisOf>> loads(const nb::bytes& text) {
  const std::string_view all(text.c_str(), text.size());
  auto document = value_of(without_lock([&] { return io::read_native_text(all); }));
  std::vector<std::unique_ptr<AxisOf>> axes;
  for (AxisItem& item : document.items)
    axes.push_back(
        share(std::make_shared<const Shape>(std::move(item.shape)), std::move(item.axis)));
  return axes;
}

std::vector<Contour> path_contours(const std::string& path) {
  return value_of(without_lock([&] { return io::read_path_data(path); }));
}

using Moves = nb::ndarray<const double, nb::shape<-1, 4>, nb::c_contig, nb::device::cpu>;

/// The program of paths as carved() returns them, each as rows of x, y, z, bulge.
std::string gcode(const nb::dict& numbers, const std::vector<Moves>& paths, std::uint32_t passes,
                  const nb::dict& machine, bool y_down) {
  const auto number = [](const nb::dict& from, const char* name) {
    return nb::cast<double>(from[name]);
  };
  Document<io::CarveItem> document;
  document.unit = Unit::millimetre;
  document.y_down = y_down;
  Carving& carving = document.items.emplace_back().carving;
  carving.deepest = number(numbers, "deepest");
  carving.tip_radius = number(numbers, "tip_radius");
  carving.slope = number(numbers, "slope");
  carving.passes = passes;
  for (const Moves& moves : paths) {
    ToolPath& path = carving.paths.emplace_back();
    for (std::size_t i = 0; i < moves.shape(0); ++i) {
      const double* row = moves.data() + 4 * i;
      path.points.push_back({{row[0], row[1]}, row[2], row[3]});
    }
  }
  io::place(document, {0, 0});
  io::MachineOptions options;
  options.safe = number(machine, "safe");
  options.carving = {number(machine, "feed"), number(machine, "plunge"),
                     number(machine, "spindle")};
  options.post = nb::cast<std::string>(machine["post"]);
  return text_of(
      [&](const io::Destination& to) { return io::write_carving(to, "nc", document, options); });
}

}  // namespace

void bind_texts(nb::module_& module) {
  module.def("dumps", &dumps);
  module.def("loads", &loads);
  module.def("path_contours", &path_contours);
  module.def("gcode", &gcode);
}

}  // namespace medial::python
