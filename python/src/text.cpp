// Files and texts in the formats that medial::text reads and writes.

#include <nanobind/stl/variant.h>

#include <charconv>
#include <functional>
#include <variant>

#include "binding.h"
#include "io/checks.h"
#include "io/drawing.h"
#include "medial/io/write.h"

namespace medial::python {
namespace {

/// The name of a file, in the system's encoding.
using Path = nb::bytes;
std::string text_of(const Path& path) { return {path.c_str(), path.size()}; }

/// All rings of some features: points, the first point of each ring, roles, bulges (none:
/// straight), contours.
nb::tuple tuple_of(std::vector<Feature> features) {
  std::vector<Vec2> points;
  std::vector<double> bulges;
  std::vector<std::int64_t> begin{0};
  std::vector<std::uint8_t> roles;
  std::vector<Contour> contours;
  bool arcs = false;
  for (Feature& feature : features) {
    for (const Ring& ring : feature.rings) {
      points.insert(points.end(), ring.points.begin(), ring.points.end());
      arcs = arcs || !ring.bulges.empty();
      bulges.insert(bulges.end(), ring.bulges.begin(), ring.bulges.end());
      bulges.resize(points.size());
      roles.push_back(static_cast<std::uint8_t>(ring.role));
      begin.push_back(static_cast<std::int64_t>(points.size()));
    }
    std::ranges::move(feature.contours, std::back_inserter(contours));
  }
  nb::object curved = nb::none();
  if (arcs) curved = nb::cast(array_of(std::move(bulges)));
  return nb::make_tuple(rows_of<double>(std::move(points)), array_of(std::move(begin)),
                        array_of(std::move(roles)), curved, contours);
}

nb::tuple rings_of_text(const std::string& text) {
  Document<Feature> read =
      value_of(without_lock([&] { return io::read_document_text(text, io::ReadOptions{}); }));
  return tuple_of(std::move(read.items));
}

/// The options of reading, by their names in Python.
io::SourceOptions reading(const std::optional<std::string>& repair,
                          std::optional<double> arc_tolerance, double fit, const std::string& layer,
                          std::optional<double> close, const std::string& unit, int threads) {
  if (close && !(*close >= 0)) refuse(ErrorCode::invalid_option, "close must be a distance, or 0");
  io::SourceOptions options;
  options.read.repair = options.load.repair = repair_from(repair);
  options.read.layer = layer;
  options.read.close = close;
  options.load.arcs.tolerance = arc_tolerance;
  options.load.fit = fit;
  options.load.threads = threads;
  const auto wanted = unit_of(unit);
  if (!unit.empty() && !wanted)
    throw Failure({ErrorCode::invalid_option, "unit must be one of " + unit_names(), {}});
  if (wanted) options.units.wanted = *wanted;
  return options;
}

/// Shapes with their attributes, and notes.
nb::tuple shapes_of(
    const std::function<Result<Document<ShapeItem>>(const std::atomic<bool>*)>& load) {
  Document<ShapeItem> loaded = value_of(run(long_work, load));
  nb::list shapes;
  for (ShapeItem& item : loaded.items)
    shapes.append(nb::make_tuple(ShapeOf{std::make_shared<const Shape>(std::move(item.shape))},
                                 item.attributes));
  return nb::make_tuple(shapes, loaded.notes);
}

/// The shapes of a file, or of a text in the font at `path`.
nb::tuple shapes_of_file(const Path& file, const std::string& text, io::SourceOptions options) {
  options.text = text;
  const std::string path = text_of(file);
  return shapes_of([&](const std::atomic<bool>* cancel) {
    options.load.cancel = cancel;
    return io::load_shapes(path, options);
  });
}

/// The result of read_document() for a drawing.
Result<Document<ShapeItem>> load_drawing(const io::Drawing& drawing,
                                         const io::SourceOptions& options) {
  Result<Document<Feature>> features = io::features_of(drawing, options.read);
  if (!features) return std::move(features).error();
  io::FeatureChecks checks(options.read);
  Status status = checks.check(*features);
  if (status) status = checks.finish(*features);
  if (status) status = convert_units(*features, options.units);
  if (!status) return std::move(status).error();
  return load_shapes(std::move(features).value(), options.load);
}

nb::tuple shapes_of_drawing(const io::Drawing& drawing, io::SourceOptions options) {
  return shapes_of([&](const std::atomic<bool>* cancel) {
    options.load.cancel = cancel;
    return load_drawing(drawing, options);
  });
}

Vec2 vec2_of(const std::array<double, 2>& p) { return {p[0], p[1]}; }
std::vector<Vec2> copied(const Coordinates& coordinates) {
  const auto points = points_of(coordinates);
  return {points.begin(), points.end()};
}
std::vector<double> copied(const Values<double>& values) {
  return {values.data(), values.data() + values.shape(0)};
}

/// Entities as ezdxf reads them.
void bind_drawing(nb::module_& module) {
  using Point = std::array<double, 2>;
  nb::class_<io::Drawing>(module, "Drawing")
      .def(nb::init<>())
      .def_rw("units", &io::Drawing::units)
      .def("layer",
           [](io::Drawing& self, const std::string& name, bool hidden) {
             self.layers.insert(name);
             if (hidden) self.hidden.insert(name);
           })
      .def("begin_block", [](io::Drawing& self, const std::string& name,
                             Point base) { self.begin_block(name, vec2_of(base)); })
      .def("end_block", &io::Drawing::end_block)
      .def("leave_out", [](io::Drawing& self, const std::string& name) { ++self.left_out[name]; })
      .def("begin_entity", &io::Drawing::begin_entity)
      .def("point", [](io::Drawing& self, Point p) { self.add_point(vec2_of(p)); })
      .def("line",
           [](io::Drawing& self, Point a, Point b) { self.add_line(vec2_of(a), vec2_of(b)); })
      .def("circle", [](io::Drawing& self, Point center,
                        double radius) { self.add_circle(vec2_of(center), radius); })
      .def("arc", [](io::Drawing& self, Point center, double radius, double begin,
                     double end) { self.add_arc(vec2_of(center), radius, begin, end); })
      .def("ellipse",
           [](io::Drawing& self, Point center, Point major, double ratio, double begin,
              double end) { self.add_ellipse(vec2_of(center), vec2_of(major), ratio, begin, end); })
      .def("polyline",
           [](io::Drawing& self, const Coordinates& points, const Values<double>& bulges,
              bool closed) {
             if (points.shape(0) != bulges.shape(0))
               refuse(ErrorCode::malformed, "a bulge goes with each point");
             self.add_polyline(copied(points), copied(bulges), closed);
           })
      .def("spline",
           [](io::Drawing& self, std::uint32_t degree, const Values<double>& knots,
              const Coordinates& points, const Values<double>& weights, bool closed) {
             value_of(
                 self.add_spline(degree, copied(knots), copied(points), copied(weights), closed));
           })
      .def("copies", [](io::Drawing& self, const std::string& block, Point place, Point scale,
                        double angle, std::array<int, 2> counts, Point steps) {
        self.add_copies({block, vec2_of(place), scale[0], scale[1], angle, counts[0], counts[1],
                         steps[0], steps[1]});
      });
  module.def("shapes_of_drawing", &shapes_of_drawing, nb::arg("drawing"), nb::arg("reading"));
}

/// The shortest text that writers of tables recognize as this number.
std::string shortest(double number) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return {text.data(), end};
}

/// Attributes from Python: texts, and numbers to be written as texts.
using Given = std::vector<std::pair<std::string, std::variant<double, std::string>>>;

Attributes attributes_of(const Given& given) {
  Attributes attributes;
  for (const auto& [name, value] : given) {
    const auto* const number = std::get_if<double>(&value);
    attributes.emplace_back(name, number ? shortest(*number) : std::get<std::string>(value));
  }
  return attributes;
}

/// The shape, the axis and the attributes of each item of a native file.
nb::list native(Result<Document<AxisItem>> file) {
  nb::list list;
  for (AxisItem& item : value_of(std::move(file)).items) {
    if (item.shape.points.empty() && !item.contours.empty())
      refuse(ErrorCode::unsupported, "the file has curves without an axis: medial.read() takes it");
    auto shape = std::make_shared<const Shape>(std::move(item.shape));
    auto axis = share(std::move(shape), std::move(item.axis), item.part);
    list.append(nb::make_tuple(std::move(axis), item.attributes));
  }
  return list;
}

/// The destination of a document: a file, or without a path a text.
class Output {
 public:
  explicit Output(const std::optional<Path>& path) {
    if (path) path_ = text_of(*path);
  }
  io::Destination destination() {
    return path_ ? io::Destination(*path_) : io::Destination(&text_);
  }
  /// The text, or None if a file was written.
  nb::object result(Status written) {
    value_of(std::move(written));
    return path_ ? nb::none() : nb::object(nb::str(text_.data(), text_.size()));
  }

 private:
  std::optional<std::string> path_;
  std::string text_;
};

nb::object write_axis(const AxisOf& self, const Given& attributes, const std::optional<Path>& path,
                      const std::string& format, double chord, double simplify) {
  Output output(path);
  io::WriteOptions options;
  options.chord = chord;
  options.simplify = simplify;
  return output.result(without_lock([&] {
    Document<AxisItem> file;
    file.items.push_back({*self.shape, self.axis, attributes_of(attributes), {}, self.part});
    return io::write_axes(output.destination(), format, file, options);
  }));
}

nb::object write_shape(const ShapeOf& self, const Given& attributes,
                       const std::optional<Path>& path, const std::string& format, double chord) {
  Output output(path);
  io::WriteOptions options;
  options.chord = chord;
  return output.result(without_lock([&] {
    Document<ShapeItem> file;
    file.items.push_back({*self.shape, attributes_of(attributes), {}});
    return io::write_shapes(output.destination(), format, file, options);
  }));
}

/// The program of one tool, or of an end mill and a V-bit, in millimetres or inches.
nb::object write_carving(const CarvingOf& self, const std::optional<Path>& path,
                         const std::string& format, const std::array<double, 2>& zero, bool y_down,
                         bool inches, const io::MachineOptions& machine) {
  Output output(path);
  return output.result(without_lock([&] {
    Document<io::CarveItem> file;
    file.unit = inches ? Unit::inch : Unit::millimetre;
    file.y_down = y_down;
    file.items.push_back({*self.shape, self.carving, self.clearing});
    io::place(file, {zero[0], zero[1]});
    return io::write_carving(output.destination(), format, file, machine);
  }));
}

}  // namespace

void bind_text(nb::module_& module) {
  module.def("rings_of_text", &rings_of_text);
  module.def("contours_of_path",
             [](const std::string& text) { return value_of(io::read_path_data(text)); });
  nb::class_<io::SourceOptions>(module, "Reading");
  module.def("reading", &reading, nb::arg("repair").none(), nb::arg("arc_tolerance").none(),
             nb::arg("fit"), nb::arg("layer"), nb::arg("close").none(), nb::arg("unit"),
             nb::arg("threads"));
  module.def("shapes_of_file", &shapes_of_file, nb::arg("path"), nb::arg("text"),
             nb::arg("reading"));
  bind_drawing(module);
  module.def("native_of_file", [](const Path& path) {
    return native(without_lock([name = text_of(path)] { return io::read_native(name); }));
  });
  module.def("native_of_text", [](const nb::bytes& text) {
    const std::string_view all(text.c_str(), text.size());
    return native(without_lock([&] { return io::read_native_text(all); }));
  });
  module.def("write_axis", &write_axis, nb::arg("axis"), nb::arg("attributes"),
             nb::arg("path").none(), nb::arg("format"), nb::arg("chord"), nb::arg("simplify"));
  module.def("write_shape", &write_shape, nb::arg("shape"), nb::arg("attributes"),
             nb::arg("path").none(), nb::arg("format"), nb::arg("chord"));
  nb::class_<io::MachineOptions>(module, "Machine")
      .def("__init__",
           [](io::MachineOptions* self, double safe, double rapid, std::array<double, 3> carving,
              std::array<double, 3> clearing, const std::string& post) {
             new (self) io::MachineOptions;
             self->safe = safe;
             self->rapid = rapid;
             self->carving = {carving[0], carving[1], carving[2]};
             self->clearing = {clearing[0], clearing[1], clearing[2]};
             self->post = post;
           });
  module.def("write_carving", &write_carving, nb::arg("carving"), nb::arg("path").none(),
             nb::arg("format"), nb::arg("zero"), nb::arg("y_down"), nb::arg("inches"),
             nb::arg("machine"));
}

}  // namespace medial::python
