// Stands in for pictures/ and gis/ in the command line: loads them from shared modules when
// something first needs them.

#include <dlfcn.h>

#include <string_view>

#include "io/modules.h"
#include "io/place.h"

namespace medial::io {

namespace {

template <class Table>
struct Loaded {
  const Table* module = nullptr;
  std::string failure;
};

/// A module is never unloaded: GDAL keeps threads and handlers.
template <class Table>
Loaded<Table> load(const char* part, const char* file, const char* symbol) {
  const std::string name = std::string("the part of medial for ") + part;
  void* const library = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr)
    return {nullptr, name + " cannot be loaded: install medial again (" + dlerror() + ")"};
  const auto* const module = static_cast<const Table*>(dlsym(library, symbol));
  if (module == nullptr || std::string_view(module->stamp) != MEDIAL_STAMP)
    return {nullptr, name + " (" + file + ") is of another build of medial: install medial again"};
  return {module, {}};
}

/// Loaded once each, by the first thread that asks.
const Loaded<GisModule>& loaded() {
  static const auto once =
      load<GisModule>("GIS formats and images", MEDIAL_GIS_MODULE, gis_module_name);
  return once;
}
const Loaded<DrawModule>& loaded_to_draw() {
  static const auto once =
      load<DrawModule>("pictures, meshes and fonts", MEDIAL_DRAW_MODULE, draw_module_name);
  return once;
}

template <class Table>
Error missing(const Loaded<Table>& loaded) {
  return {ErrorCode::unsupported, loaded.failure, {}};
}

/// What a function of the module returns; an error where there is no module.
template <class Function, class... Arguments>
auto in_module(Function GisModule::*function, Arguments&&... arguments)
    -> decltype((loaded().module->*function)(arguments...)) {
  const GisModule* const module = loaded().module;
  if (module == nullptr) return missing(loaded());
  return (module->*function)(std::forward<Arguments>(arguments)...);
}

Format table_format(std::string_view extension, Growing growing) {
  using enum DocumentKind;
  Format format =
      Format{extension}.announces(Module::gis, {axes, shapes, voronoi, offsets, features, layers});
  format.growing = growing;
  return format;
}

}  // namespace

Result<const std::vector<Format>*> formats_in(Module module) {
  const auto rows_of = [](const auto& late) -> Result<const std::vector<Format>*> {
    if (late.module == nullptr) return missing(late);
    return &late.module->formats();
  };
  return module == Module::gis ? rows_of(loaded()) : rows_of(loaded_to_draw());
}

// What formats_of() lists; the rows of the module do it.

Format with_pictures(Format format) {
  using enum DocumentKind;
  return format.announces(Module::drawing,
                          {axes, shapes, voronoi, layers, offsets, carving, features, field});
}
Format png_format() {
  return with_pictures(Format{".png"}).announces(Module::drawing, {DocumentKind::voxels});
}
Format with_meshes(Format format) {
  return format.announces(Module::drawing, {DocumentKind::mesh});
}
Format gpkg_format() { return table_format(".gpkg", Growing::none); }
Format shp_format() { return table_format(".shp", Growing::branches); }
Format fgb_format() { return table_format(".fgb", Growing::branches); }
Format with_rasters(Format format) {
  return format.announces(Module::gis, {DocumentKind::distances, DocumentKind::image});
}
Format tif_format() { return with_rasters(Format{".tif .tiff"}); }
Format pgm_format() { return Format{".pgm"}.announces(Module::gis, {DocumentKind::distances}); }
Format pbm_format() { return Format{".pbm"}.announces(Module::gis, {DocumentKind::image}); }
Format ros_map_format() { return {}; }
Format image_format() { return {}; }
Format gdal_format() { return {}; }

Result<Document<Feature>> read_text(const std::string& text, const std::string& font, double size) {
  const DrawModule* const module = loaded_to_draw().module;
  if (module == nullptr) return missing(loaded_to_draw());
  return module->read_text(text, font, size);
}

void describe_crs(DocumentInfo& document) {
  if (document.crs_wkt.empty()) return;
  if (const GisModule* const module = loaded().module)
    module->describe(document);
  else
    document.notes.push_back(loaded().failure);
}

Status describe_crs(const std::string& name, DocumentInfo& document) {
  return in_module(&GisModule::describe_by_name, name, document);
}

double degrees_of_unit(const std::string& crs_wkt) {
  return crs_wkt.empty() || loaded().module == nullptr ? 1
                                                       : loaded().module->degrees_of_unit(crs_wkt);
}

Result<OutputCrs> output_crs_of(const std::string& crs_wkt, Unit unit) {
  if (crs_wkt.empty()) return OutputCrs{crs_wkt, unit, nullptr};
  return in_module(&GisModule::output_crs_of, crs_wkt, unit);
}

std::string urn_of_crs(const std::string& crs_wkt) {
  if (crs_wkt.empty() || loaded().module == nullptr) return {};
  return loaded().module->urn_of_crs(crs_wkt);
}

Status project_to_local(Document<Feature>& document) {
  return in_module(&GisModule::project_to_local, document);
}

void note_stretch(DocumentInfo& document, const Extremes& extremes) {
  if (!document.crs_wkt.empty() && loaded().module != nullptr)
    loaded().module->note_stretch(document, extremes);
}

Status make_valid(Feature& feature, std::size_t index, std::vector<std::string>& notes) {
  return in_module(&GisModule::make_valid, feature, index, notes);
}

Result<ImageFile> read_image(const std::string& path, const ImageOptions& options) {
  return in_module(&GisModule::read_image, path, options);
}

Attributes drawing_libraries() {
  const DrawModule* const module = loaded_to_draw().module;
  if (module == nullptr) return {{"Cairo", "FAILS: " + loaded_to_draw().failure}};
  return module->drawing_libraries();
}

BuildInfo build_info() {
  if (loaded().module != nullptr) return loaded().module->build_info();
  BuildInfo info;
  info.libraries = drawing_libraries();
  info.libraries.emplace_back("GDAL", "FAILS: " + loaded().failure);
  return info;
}

}  // namespace medial::io
