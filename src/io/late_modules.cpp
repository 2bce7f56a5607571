// Stands in for pictures/, gis/ and the reader of SVG in the command line: loads them from shared
// modules when something first needs them.

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
Loaded<Table> load() {
  const std::string name = std::string("the part of medial for ") + Table::part;
  void* const library = dlopen(Table::file, RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr)
    return {nullptr, name + " cannot be loaded: install medial again (" + dlerror() + ")"};
  const auto* const module = static_cast<const Table*>(dlsym(library, Table::symbol));
  if (module == nullptr || std::string_view(module->stamp) != MEDIAL_STAMP)
    return {nullptr,
            name + " (" + Table::file + ") is of another build of medial: install medial again"};
  return {module, {}};
}

/// Loaded once each, by the first thread that asks.
template <class Table = GisModule>
const Loaded<Table>& loaded() {
  static const Loaded<Table> once = load<Table>();
  return once;
}

template <class Table>
Error missing() {
  return {ErrorCode::unsupported, loaded<Table>().failure, {}};
}

/// What a function of a module returns; an error where there is no module.
template <class Table, class Function, class... Arguments>
auto in_module(Function Table::*function, Arguments&&... arguments)
    -> decltype((loaded<Table>().module->*function)(arguments...)) {
  const Table* const module = loaded<Table>().module;
  if (module == nullptr) return missing<Table>();
  return (module->*function)(std::forward<Arguments>(arguments)...);
}

template <class Table>
Result<const std::vector<Format>*> rows_of() {
  const Table* const module = loaded<Table>().module;
  if (module == nullptr) return missing<Table>();
  return &module->formats();
}

template <class Table>
Attributes libraries_of(const char* first) {
  const Table* const module = loaded<Table>().module;
  if (module == nullptr) return {{first, "FAILS: " + loaded<Table>().failure}};
  return module->libraries();
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
  return module == Module::gis ? rows_of<GisModule>() : rows_of<DrawModule>();
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
  return in_module(&DrawModule::read_text, text, font, size);
}

Result<Document<Feature>> read_svg(const Input& input, const ReadOptions& options) {
  return in_module(&SvgModule::read_svg, input, options);
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

Attributes svg_libraries() { return libraries_of<SvgModule>("libxml2"); }
Attributes drawing_libraries() { return libraries_of<DrawModule>("Cairo"); }

BuildInfo build_info() {
  if (loaded().module != nullptr) return loaded().module->build_info();
  BuildInfo info;
  for (const Attributes& part : {svg_libraries(), drawing_libraries()})
    info.libraries.insert(info.libraries.end(), part.begin(), part.end());
  info.libraries.emplace_back("GDAL", "FAILS: " + loaded().failure);
  return info;
}

}  // namespace medial::io
