#include "medial/io/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/checks.h"
#include "io/degrees.h"
#include "io/format.h"
#include "io/format_name.h"
#include "io/formats/geojson.h"
#include "io/formats/json.h"
#include "io/guarded.h"
#include "io/image_kind.h"
#include "io/open.h"
#include "io/place.h"
#include "io/reference_system.h"
#include "io/repair.h"
#include "medial/raster.h"

namespace medial::io {

namespace {

constexpr std::size_t sniffed = 4096;

/// The first row that is wanted, one at hand if there is one; null: none.
template <class Wanted>
const Format* first_format(const Wanted& wanted) {
  const auto first = [&](const std::vector<Format>& rows) -> const Format* {
    const auto found = std::ranges::find_if(rows, wanted);
    return found != rows.end() ? &*found : nullptr;
  };
  if (const Format* row = first(formats_at_hand())) return row;
  const Result<const std::vector<Format>*> rows = formats_in(Module::gis);
  return rows ? first(**rows) : nullptr;
}

/// The row that reads files of a name; null: GDAL knows better.
const Format* format_of_name(std::string name) {
  name = lower_case(std::move(name));
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  const std::string extension = format_name(name);
  return first_format([&](const Format& format) {
    return format.read != nullptr && (lists_extension(format.extensions, extension) ||
                                      lists_extension(format.also_read, extension));
  });
}

/// The row that reads a text by its first characters; null: GDAL may know better.
const Format* format_of_text(std::string_view text) {
  for (const Format& format : formats_at_hand())
    if (format.sniff != nullptr && format.sniff(text)) return &format;
  return nullptr;
}

/// The row that reads images, whatever their name, if the file begins like one; null otherwise.
const Format* format_of_image(std::string_view beginning) {
  return begins_like_image(beginning) ? first_format(&Format::reads_images) : nullptr;
}

/// The row that reads what no other does.
const Format* format_of_others() { return first_format(&Format::reads_others); }

bool is_font(std::string_view beginning) {
  using namespace std::string_view_literals;
  constexpr std::array begins{"\0\1\0\0"sv,       "OTTO"sv,        "ttcf"sv,
                              "true\0"sv,         "wOFF"sv,        "wOF2"sv,
                              "%!PS-AdobeFont"sv, "%!FontType1"sv, "\x80\1"sv};
  return std::ranges::any_of(begins, [&](auto text) { return beginning.starts_with(text); });
}

std::optional<Error> refused(const Format& format, const ReadOptions& options,
                             const std::string& path) {
  const auto error = [&path](const char* text) {
    return Error{ErrorCode::invalid_option, text, in_file(path)};
  };
  if (options.close && !format.has_loose_curves)
    return error("this format has no loose curves to close");
  if ((!options.layer.empty() && !format.has_layers) ||
      (!options.where.empty() && !format.has_filters))
    return error("this format has no layers and no attributes to choose by");
  return std::nullopt;
}

/// The row that reads a file.
Result<const Format*> format_of(const std::string& path,
                                const Result<std::shared_ptr<TextSource>>& source,
                                const ReadOptions& options) {
  const std::string_view beginning = source ? (*source)->lookahead(sniffed) : std::string_view();
  if (is_font(beginning))
    return Error{ErrorCode::unsupported,
                 "this is a font, not a shape: --text TEXT --font FILE draws a text with it",
                 in_file(path)};
  if (beginning.starts_with("mpk\1"))
    return Error{ErrorCode::unsupported,
                 "this is a pack, which `medial unpack` reads: medial unpack FILE -o axis.json",
                 in_file(path)};
  if (const char* text = text_without_shape(beginning))
    return Error{ErrorCode::unsupported, text, in_file(path)};
  const bool is_nameless = source && ((*source)->is_stream() || format_name(path).empty());
  const Format* format = is_nameless ? format_of_text(beginning) : format_of_name(path);
  // Plain text may hold what another format begins like.
  if (format != nullptr && lists_extension(format->extensions, "txt"))
    if (const Format* other = format_of_text(beginning)) format = other;
  if (const Format* image = format_of_image(beginning)) {
    format = image;
  } else if (format != nullptr && !source) {
    return source.error();
  } else if (format != nullptr && format->accepts != nullptr && !format->accepts(beginning)) {
    if ((*source)->failure()) return *(*source)->failure();
    format = nullptr;
  }
  if (format == nullptr && source && beginning.empty() && !(*source)->failure())
    return Error{ErrorCode::empty, "there is nothing to read", in_file(path)};
  if (format == nullptr || (format->gdal_chooses && refused(*format, options, path))) {
    if (const auto rows = formats_in(Module::gis); !rows)
      return Error{rows.error().code, rows.error().text, in_file(path)};
    if (const Format* others = format_of_others()) format = others;
  }
  if (format == nullptr)
    return Error{ErrorCode::unsupported, "GDAL, which may read this, is not in this build",
                 in_file(path)};
  if (const auto error = refused(*format, options, path)) return *error;
  return format;
}

/// Whether a file may be plain GeoJSON, which is read faster here than by GDAL.
bool may_be_plain(const std::string& path, const Result<std::shared_ptr<TextSource>>& source,
                  const Format& format, const ReadOptions& options) {
  std::string name = lower_case(path);
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  const bool named = name.ends_with(".geojson") || name.ends_with(".json");
  const bool chooses = options.loose || !options.layer.empty() || !options.where.empty();
  return format.reads_others && named && !chooses && source && !(*source)->is_stream();
}

Result<Document<Feature>> read_any(const std::string& path,
                                   const Result<std::shared_ptr<TextSource>>& source,
                                   const ReadOptions& options) {
  const Result<const Format*> format = format_of(path, source, options);
  if (!format) return format.error();
  if (may_be_plain(path, source, **format, options))
    if (auto document = read_geojson(path)) return std::move(*document);
  return (*format)->read({path, source ? *source : nullptr}, options);
}

bool has_curves(const Feature& feature) {
  return !feature.contours.empty() ||
         std::ranges::any_of(feature.rings, [](const Ring& ring) { return !ring.bulges.empty(); });
}

/// The WKT of a reference system, without that of a transformation from it.
std::string_view without_transformation(std::string_view wkt) {
  constexpr std::string_view source = "SOURCECRS[";
  const std::size_t at = wkt.starts_with("BOUNDCRS[") ? wkt.find(source) : wkt.npos;
  if (at == wkt.npos) return wkt;
  wkt.remove_prefix(at + source.size());
  return wkt.substr(std::min(wkt.find_first_not_of(" \t\r\n"), wkt.size()));
}

/// Refuses heights and geocentric coordinates, judging by the WKT of their reference system.
Status check_plane(const DocumentInfo& document, ErrorCode code) {
  const std::string_view wkt = without_transformation(document.crs_wkt);
  // In WKT of 2015, longitudes and latitudes are GEODCRS, too.
  const std::string_view axes = wkt.substr(std::min(wkt.find("CS["), wkt.size()));
  const bool is_geocentric =
      wkt.starts_with("GEOCCS[") || (wkt.starts_with("GEOD") && axes.starts_with("CS[Cartesian,"));
  if (!is_geocentric && !wkt.starts_with("VERT")) return success();
  const std::size_t begin = wkt.find('"') + 1;  // of its name
  return Error{code,
               fmt::format("the reference system '{}' has neither plane coordinates nor longitudes "
                           "and latitudes: name that of x and y",
                           wkt.substr(begin, wkt.find('"', begin) - begin)),
               {}};
}

Result<Document<Feature>> finish(Document<Feature> document, const ReadOptions& options) {
  FeatureChecks checks(options);
  if (Status checked = checks.check(document); !checked) return std::move(checked).error();
  if (Status complete = checks.finish(document); !complete) return std::move(complete).error();
  const Extremes extremes = extremes_of(document);
  if (Status settled = settle_crs(document, options.crs, extremes.reach()); !settled)
    return settled.error();
  if (!options.project) {
    note_stretch(document, extremes);
  } else if (Status status = project_to_local(document); !status) {
    return status.error();
  }
  if (options.repair == RepairRule::make_valid) {
    Status repaired = check_each(document, options.skip_invalid, [&](Feature& feature, auto index) {
      if (has_curves(feature) || feature.filled) return success();  // see ReadOptions
      return make_valid(feature, index, document.notes);
    });
    if (!repaired) return std::move(repaired).error();
  }
  return document;
}

}  // namespace

Status settle_crs(Document<Feature>& dataset, const std::string& crs, Vec2 reach) {
  if (!crs.empty()) {
    Status named = describe_crs(crs, dataset);
    return named ? check_plane(dataset, ErrorCode::invalid_option) : named;
  }
  describe_crs(dataset);
  if (Status plane = check_plane(dataset, ErrorCode::unsupported); !plane) return plane;
  if (!dataset.geographic || can_be_angles(reach, degrees_of_unit(dataset.crs_wkt)))
    return success();
  dataset.crs_wkt.clear();
  dataset.geographic = false;
  dataset.unit = Unit::unknown;
  dataset.notes.push_back(
      "the coordinates are not degrees, whatever the format says: they are taken as plane "
      "coordinates without a reference system; --crs EPSG:n names theirs");
  return success();
}

Result<std::unique_ptr<FeatureReader>> open_features(const std::string& path,
                                                     const ReadOptions& options, bool unusual) {
  auto source = TextSource::open(path);
  const Result<const Format*> format = format_of(path, source, options);
  if (!format) return format.error();
  if (!unusual && may_be_plain(path, source, **format, options))
    if (auto reader = open_geojson(path)) return reader;
  if ((*format)->open == nullptr) return std::unique_ptr<FeatureReader>();
  return (*format)->open({path, source ? *source : nullptr}, options);
}

Result<Document<Feature>> read_document(const std::string& path, const ReadOptions& options) {
  const TextSource::Reading reading(path);
  return guarded(path, [&]() -> Result<Document<Feature>> {
    Result<Document<Feature>> document = read_any(path, TextSource::open(path), options);
    if (!document) return document;
    return finish(std::move(*document), options);
  });
}

Result<Document<Feature>> read_document_text(std::string_view text, const ReadOptions& options) {
  return guarded({}, [&]() -> Result<Document<Feature>> {
    Result<Document<Feature>> document = read_any("-", TextSource::of(text), options);
    if (!document) return document;
    return finish(std::move(*document), options);
  });
}

namespace {

/// What `read` makes of a file that begins as `sniff` says.
template <class T>
Result<Document<T>> read_json(const std::string& path,
                              const Result<std::shared_ptr<TextSource>>& source, Sniff sniff,
                              const char* otherwise, Result<Document<T>> (*read)(TextSource&)) {
  const TextSource::Reading reading(path);
  return guarded(path, [&]() -> Result<Document<T>> {
    if (!source) return source.error();
    if (otherwise != nullptr && !sniff((*source)->lookahead(sniffed)))
      return (*source)->error(ErrorCode::malformed, otherwise);
    return read(**source);
  });
}

constexpr const char* no_native =
    "this is not one of medial's own files, which -o NAME.json or NAME.safetensors writes";

bool begins_like_axes(std::string_view text) {
  return begins_like_native(text) || begins_like_safetensors(text);
}

Result<Document<AxisItem>> read_axes(TextSource& source) {
  auto axes = begins_like_safetensors(source.lookahead(sniffed)) ? read_safetensors(source)
                                                                 : read_native(source);
  if (!axes) return axes;
  if (axes->crs_wkt.starts_with("EPSG:")) describe_crs(*axes);
  if (Status plane = check_plane(*axes, ErrorCode::unsupported); !plane) return plane.error();
  axes->geographic = axes->crs_wkt.starts_with("GEOG");  // GEOGCRS, in WKT 1 GEOGCS
  if (axes->items.empty()) axes->notes.emplace_back(no_feature);
  return axes;
}

bool begins(const std::string& path, Sniff sniff) {
  const Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
  return source && sniff((*source)->lookahead(sniffed));
}

}  // namespace

bool is_native(const std::string& path) { return begins(path, begins_like_axes); }

Result<Document<AxisItem>> read_native(const std::string& path, const ReadOptions& options) {
  if (!options.layer.empty() || !options.where.empty() || !options.crs.empty() || options.project ||
      options.close || options.repair != RepairRule::none)
    return Error{ErrorCode::invalid_option,
                 "layer, where, repair, crs, project and close are not for medial's own format",
                 in_file(path)};
  return read_json<AxisItem>(path, TextSource::open(path), begins_like_axes, no_native, read_axes);
}

Result<Document<AxisItem>> read_native_text(std::string_view text) {
  return read_json<AxisItem>({}, TextSource::of(text), begins_like_axes, no_native, read_axes);
}

bool is_voronoi(const std::string& path) { return begins(path, begins_like_voronoi); }

Result<Document<VoronoiItem>> read_voronoi(const std::string& path) {
  return read_json<VoronoiItem>(path, TextSource::open(path), begins_like_voronoi, nullptr,
                                read_voronoi);
}

Result<TriangleMesh> read_mesh(const std::string& path) {
  const std::string extension = format_name(path);
  const Result<const Format*> found = find_format(extension, DocumentKind::mesh);
  if (!found) return Error{found.error().code, found.error().text, in_file(path)};
  const Format* format = *found;
  if (format == nullptr)
    return Error{ErrorCode::unsupported,
                 fmt::format("'{}' is not a mesh format; known are {}", extension,
                             formats_of(DocumentKind::mesh)),
                 in_file(path)};
  const TextSource::Reading reading(path);
  return guarded(path, [&]() -> Result<TriangleMesh> {
    Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
    if (!source) return source.error();
    return format->read_mesh({path, *source});
  });
}

}  // namespace medial::io
