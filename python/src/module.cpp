// The extension module: errors, threads, and all topics.

#include <cstdlib>

#include "binding.h"

namespace medial::python {
namespace {

template <class T>
nb::object number_or_none(const std::optional<T>& number) {
  return number ? nb::cast(*number) : nb::none();
}

nb::object point_or_none(const Place& place) {
  if (!place.point) return nb::none();
  if (place.z) return nb::make_tuple(place.point->x, place.point->y, *place.z);
  return nb::make_tuple(place.point->x, place.point->y);
}

/// Keeps bytes that are not UTF-8, as in file names, like os.fsdecode().
nb::object text_of(const std::string& text) {
  return nb::steal(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape"));
}

void raise(const Error& error) {
  const Place& place = error.place;
  const nb::object type = nb::module_::import_("medial._errors").attr("MedialError");
  const nb::object exception =
      type(text_of(error.text), name_of(error.code), number_or_none(place.feature),
           number_or_none(place.ring), number_or_none(place.vertex), point_or_none(place));
  PyErr_SetObject(type.ptr(), exception.ptr());
}

}  // namespace

NB_MODULE(_core, module) {
  // If a program still holds an object or a function when the interpreter ends, nanobind would
  // print a list.
  nb::set_leak_warnings(std::getenv("MEDIAL_LEAK_WARNINGS") != nullptr);
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Failure& failure) {
      raise(failure.error());
    }
  });
  module.def("effective_threads", &effective_threads, nb::arg("requested") = 0);
  module.def("methods", [] {
    nb::list list;
    for (const MethodInfo& info : methods()) {
      nb::dict row;
      row["name"] = info.name;
      row["summary"] = info.summary;
      row["exact"] = info.exact();
      row["exterior"] = info.exterior;
      row["threads"] = info.threads;
      list.append(row);
    }
    return list;
  });
  bind_shapes(module);
  bind_axes(module);
  bind_collections(module);
  bind_well_known_binary(module);
  bind_batches(module);
  bind_paths(module);
  bind_derived(module);
  bind_editing(module);
  bind_carving(module);
  bind_text(module);
  bind_features(module);
  bind_voronoi(module);
  bind_tiles(module);
  bind_images(module);
  bind_solids(module);
}

}  // namespace medial::python
