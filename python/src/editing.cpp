// Axes that follow edits of their shapes.

#include "binding.h"

namespace medial::python {
namespace {

/// The records with these numbers, from a function of the editor.
template <class T, class Get>
Bytes those(const Values<std::int64_t>& numbers, const char* missing, const Get& get) {
  std::vector<T> found;
  for (const std::int64_t number : span_of(numbers)) {
    const bool fits = number >= 0 && number < std::int64_t{no_site};
    const std::optional<T> one = fits ? get(static_cast<std::uint32_t>(number)) : std::nullopt;
    if (!one) throw nb::index_error(missing);
    found.push_back(*one);
  }
  return records_of(std::move(found));
}

nb::tuple change_of(Result<AxisChange> result) {
  const AxisChange change = value_of(std::move(result));
  const auto numbers = [](const std::vector<std::uint32_t>& from) {
    return array_of(std::vector<std::int64_t>(from.begin(), from.end()));
  };
  return nb::make_tuple(numbers(change.removed_nodes), numbers(change.removed_edges),
                        numbers(change.added_nodes), numbers(change.added_edges), change.vertex,
                        change.everything);
}

/// A ring from interleaved x and y, and the bulges of its edges or none.
Ring ring_of(const Values<double>& points, const Values<double>& bulges) {
  const std::span<const double> xy = span_of(points), own = span_of(bulges);
  Ring ring;
  for (std::size_t i = 0; i + 1 < xy.size(); i += 2) ring.points.push_back({xy[i], xy[i + 1]});
  ring.bulges.assign(own.begin(), own.end());
  return ring;
}

std::unique_ptr<AxisOf> axis_of(const Editor& self) {
  return share(std::make_shared<const Shape>(self.shape()), self.axis());
}

}  // namespace

void bind_editing(nb::module_& module) {
  // Only one thread at a time may edit. Edits hold the interpreter's lock, or in Python without
  // one, the object's lock.
  const nb::lock_self lock;
  nb::class_<Editor>(module, "Editor")
      .def(
          "move",
          [](Editor& self, std::uint32_t vertex, std::array<double, 2> to) {
            return change_of(self.move(vertex, {to[0], to[1]}));
          },
          lock)
      .def(
          "insert",
          [](Editor& self, std::uint32_t before, std::array<double, 2> point) {
            return change_of(self.insert(before, {point[0], point[1]}));
          },
          lock)
      .def(
          "remove",
          [](Editor& self, std::uint32_t vertex) { return change_of(self.remove(vertex)); }, lock)
      .def(
          "set_bulge",
          [](Editor& self, std::uint32_t vertex, double bulge) {
            return change_of(self.set_bulge(vertex, bulge));
          },
          lock)
      .def(
          "insert_loop",
          [](Editor& self, const Values<double>& points, const Values<double>& bulges) {
            return change_of(self.insert_loop(ring_of(points, bulges)));
          },
          lock)
      .def(
          "remove_loop",
          [](Editor& self, std::uint32_t vertex) { return change_of(self.remove_loop(vertex)); },
          lock)
      .def(
          "move_loop",
          [](Editor& self, std::uint32_t vertex, std::array<double, 2> by) {
            return change_of(self.move_loop(vertex, {by[0], by[1]}));
          },
          lock)
      .def(
          "undo", [](Editor& self) { return change_of(self.undo()); }, lock)
      .def(
          "copy", [](const Editor& self) { return Editor(self); }, lock)
      .def(
          "vertex",
          [](const Editor& self, std::uint32_t number) -> std::optional<std::array<double, 2>> {
            const std::optional<Vec2> place = self.vertex(number);
            if (!place) return std::nullopt;
            return std::array{place->x, place->y};
          },
          lock)
      .def(
          "bulge", [](const Editor& self, std::uint32_t vertex) { return self.bulge(vertex); },
          lock)
      .def(
          "nodes",
          [](const Editor& self, const Values<std::int64_t>& numbers) {
            return those<Node>(numbers, "there is no such node",
                               [&](std::uint32_t i) { return self.node(i); });
          },
          lock)
      .def(
          "edges",
          [](const Editor& self, const Values<std::int64_t>& numbers) {
            return those<Edge>(numbers, "there is no such edge",
                               [&](std::uint32_t i) { return self.edge(i); });
          },
          lock)
      .def(
          "sites",
          [](const Editor& self, const Values<std::int64_t>& numbers) {
            return those<Site>(numbers, "there is no such site",
                               [&](std::uint32_t i) { return self.site(i); });
          },
          lock)
      .def("axis", &axis_of, lock);
  module.def("editor_of", [](const ShapeOf& of, const Options& options) {
    return value_of(without_lock([&] { return Editor::make(*of.shape, options); }));
  });
}

}  // namespace medial::python
