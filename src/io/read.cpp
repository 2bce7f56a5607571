#include "medial/io/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/degrees.h"
#include "io/format.h"
#include "io/format_name.h"
#include "io/formats/json.h"
#include "io/guarded.h"
#include "io/place.h"
#include "io/reference_system.h"
#include "io/repair.h"
#include "medial/raster.h"

namespace medial::io {

namespace {

constexpr std::size_t sniffed = 4096;

/// The row that reads files of a name; null: GDAL knows better.
const Format* format_of_name(std::string name) {
  name = lower_case(std::move(name));
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  const std::string extension = format_name(name);
  const auto row = std::ranges::find_if(formats(), [&](const Format& format) {
    return format.read != nullptr && (lists_extension(format.extensions, extension) ||
                                      lists_extension(format.also_read, extension));
  });
  return row == formats().end() ? nullptr : &*row;
}

/// The row that reads a text by its first characters; null: GDAL may know better.
const Format* format_of_text(std::string_view text) {
  const auto row = std::ranges::find_if(
      formats(), [&](const Format& format) { return format.sniff && format.sniff(text); });
  return row == formats().end() ? nullptr : &*row;
}

/// The row that reads files that begin like this, whatever their name; null: none.
const Format* format_by_content(std::string_view beginning) {
  const auto row = std::ranges::find_if(formats(), [&](const Format& format) {
    return format.by_content && format.sniff(beginning);
  });
  return row == formats().end() ? nullptr : &*row;
}

/// The row that reads what no other does.
const Format* format_of_others() {
  const auto row = std::ranges::find_if(formats(), &Format::reads_others);
  return row == formats().end() ? nullptr : &*row;
}

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

Result<Document<Feature>> read_any(const std::string& path,
                                   const Result<std::shared_ptr<TextSource>>& source,
                                   const ReadOptions& options) {
  const std::string_view beginning = source ? (*source)->lookahead(sniffed) : std::string_view();
  if (is_font(beginning))
    return Error{ErrorCode::unsupported,
                 "this is a font, not a shape: --text TEXT --font FILE draws a text with it",
                 in_file(path)};
  const Format* format = path == "-" ? format_of_text(beginning) : format_of_name(path);
  // Plain text may hold what another format begins like.
  if (format != nullptr && lists_extension(format->extensions, "txt"))
    if (const Format* other = format_of_text(beginning)) format = other;
  if (const Format* image = format_by_content(beginning)) {
    format = image;
  } else if (format != nullptr && !source) {
    return source.error();
  } else if (format != nullptr && format->accepts != nullptr && !format->accepts(beginning)) {
    if ((*source)->failure()) return *(*source)->failure();
    format = nullptr;
  }
  if (format == nullptr && source && beginning.empty() && !(*source)->failure())
    return Error{ErrorCode::empty, "there is nothing to read", in_file(path)};
  if (format == nullptr || (format->gdal_chooses && refused(*format, options, path)))
    if (const Format* others = format_of_others()) format = others;
  if (format == nullptr)
    return Error{ErrorCode::unsupported, "this build has no GDAL and reads other formats only",
                 in_file(path)};
  if (const auto error = refused(*format, options, path)) return *error;
  return format->read({path, source ? *source : nullptr}, options);
}

std::optional<std::size_t> not_finite(const std::vector<Vec2>& points) {
  const auto bad = std::ranges::find_if(
      points, [](Vec2 p) { return !std::isfinite(p.x) || !std::isfinite(p.y); });
  if (bad == points.end()) return std::nullopt;
  return static_cast<std::size_t>(bad - points.begin());
}

std::optional<std::size_t> not_finite(const std::vector<double>& numbers) {
  const auto bad = std::ranges::find_if_not(numbers, [](double x) { return std::isfinite(x); });
  if (bad == numbers.end()) return std::nullopt;
  return static_cast<std::size_t>(bad - numbers.begin());
}

Error error_not_finite(std::size_t line, std::size_t vertex, const char* what) {
  Error error{ErrorCode::not_finite, fmt::format("{} is not a finite number", what), {}};
  error.place.ring = line;
  error.place.vertex = vertex;
  return error;
}

/// The first number of rings or of chains that is not finite.
template <class Lines>
std::optional<Error> not_finite_in(const Lines& lines) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (auto at = not_finite(lines[k].points)) return error_not_finite(k, *at, "a coordinate");
    if (auto at = not_finite(lines[k].bulges)) return error_not_finite(k, *at, "a bulge");
  }
  return std::nullopt;
}

std::optional<Error> not_finite_in(const std::vector<Contour>& contours) {
  for (std::size_t k = 0; k < contours.size(); ++k) {
    const Contour& contour = contours[k];
    if (auto at = not_finite(contour.points)) return error_not_finite(k, *at, "a control point");
    if (auto at = not_finite(contour.weights)) return error_not_finite(k, *at, "a weight");
    for (const CurvePiece& piece : contour.pieces)
      if (!std::isfinite(piece.bulge)) return error_not_finite(k, piece.first, "a bulge");
  }
  return std::nullopt;
}

Status check_finite(const Feature& feature, std::size_t index) {
  auto error = not_finite_in(feature.rings);
  if (!error) error = not_finite_in(feature.chains);
  if (!error) error = not_finite_in(feature.contours);
  if (!error) return success();
  error->place.feature = index;
  return *error;
}

/// Leaves the other features out; those that stay keep their numbers in the file. Returns how many
/// went.
std::size_t keep(Document<Feature>& document, const std::vector<bool>& kept) {
  const auto staying = static_cast<std::size_t>(std::ranges::count(kept, true));
  const std::size_t before = document.items.size();
  if (staying == before) return 0;
  std::vector<Feature> items;
  std::vector<std::uint64_t> indices;
  for (std::size_t i = 0; i < before; ++i) {
    if (!kept[i]) continue;
    indices.push_back(document.index_of(i));
    items.push_back(std::move(document.items[i]));
  }
  document.items = std::move(items);
  document.indices = std::move(indices);
  return before - staying;
}

/// Checks all features, or mends them. With `skip_invalid` those that fail are left out, with a
/// note each and one on all.
template <class Check>
Status check_each(Document<Feature>& document, bool skip_invalid, const Check& check) {
  std::vector<bool> valid;
  for (std::size_t i = 0; i < document.items.size(); ++i) {
    const Status status = check(document.items[i], document.index_of(i));
    if (!status && !skip_invalid) return status;
    valid.push_back(status.ok());
    if (!status) document.notes.push_back("left out: " + to_string(status.error()));
  }
  const std::size_t before = document.items.size(), dropped = keep(document, valid);
  if (dropped == 0) return success();
  if (document.items.empty())
    return Error{ErrorCode::empty, "no feature is valid, so nothing is left", {}};
  document.notes.push_back(
      fmt::format("{} of {} features are invalid and were left out", dropped, before));
  return success();
}

/// Polygons with rings that do not end where they began: noted, as build_shape() closes them.
void note_unclosed_rings(Document<Feature>& dataset) {
  std::size_t unclosed = 0;
  for (const Feature& feature : dataset.items)
    unclosed += static_cast<std::size_t>(std::ranges::count_if(feature.rings, [](const Ring& ring) {
      return (ring.role == RingRole::outer || ring.role == RingRole::hole) &&
             ring.points.size() > 2 && ring.points.front() != ring.points.back();
    }));
  if (unclosed > 0)
    dataset.notes.push_back(
        fmt::format("{} without its first point at the end, closed by a straight edge",
                    unclosed == 1 ? "1 ring is" : fmt::format("{} rings are", unclosed)));
}

/// The reference system that is asked for, or the one of the file if its numbers can be degrees.
Status settle_crs(Document<Feature>& dataset, const std::string& crs) {
  if (!crs.empty()) return describe_crs(crs, dataset);
  describe_crs(dataset);
  if (!dataset.geographic || can_be_degrees(dataset)) return success();
  dataset.crs_wkt.clear();
  dataset.geographic = false;
  dataset.unit = Unit::unknown;
  dataset.notes.push_back(
      "the coordinates are not degrees, whatever the format says: they are taken as plane "
      "coordinates without a reference system; --crs EPSG:n names theirs");
  return success();
}

bool has_curves(const Feature& feature) {
  return !feature.contours.empty() ||
         std::ranges::any_of(feature.rings, [](const Ring& ring) { return !ring.bulges.empty(); });
}

bool is_empty(const Feature& feature) {
  return feature.chains.empty() &&
         std::ranges::all_of(feature.rings, [](const Ring& one) { return one.points.empty(); }) &&
         std::ranges::all_of(feature.contours, [](const Contour& contour) {
           return contour.pieces.empty() && !contour.open;
         });
}

void drop_empty_features(Document<Feature>& document) {
  std::vector<bool> kept;
  for (const Feature& feature : document.items) kept.push_back(!is_empty(feature));
  const std::size_t dropped = keep(document, kept);
  if (dropped > 0 && !document.items.empty())
    document.notes.push_back(dropped == 1
                                 ? "1 feature is empty and was left out"
                                 : fmt::format("{} features are empty and were left out", dropped));
}

Result<Document<Feature>> finish(Document<Feature> document, const ReadOptions& options) {
  if (Status finite = check_each(document, options.skip_invalid, check_finite); !finite)
    return std::move(finite).error();
  drop_empty_features(document);
  if (document.items.empty())
    return Error{ErrorCode::empty,
                 options.loose ? "the file contains no geometry" : "there is no polygon",
                 {}};
  note_unclosed_rings(document);
  if (Status settled = settle_crs(document, options.crs); !settled) return settled.error();
  if (options.project) {
    if (Status status = project_to_local(document); !status) return status.error();
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

Result<Document<Feature>> read_document(const std::string& path, const ReadOptions& options) {
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
  return guarded(path, [&]() -> Result<Document<T>> {
    if (!source) return source.error();
    if (otherwise != nullptr && !sniff((*source)->lookahead(sniffed)))
      return (*source)->error(ErrorCode::malformed, otherwise);
    return read(**source);
  });
}

constexpr const char* no_native = "this is not one of medial's own JSON files";

bool begins(const std::string& path, Sniff sniff) {
  const Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
  return source && sniff((*source)->lookahead(sniffed));
}

}  // namespace

bool is_native(const std::string& path) { return begins(path, begins_like_native); }

Result<Document<AxisItem>> read_native(const std::string& path) {
  return read_json<AxisItem>(path, TextSource::open(path), begins_like_native, no_native,
                             read_native);
}

Result<Document<AxisItem>> read_native_text(std::string_view text) {
  return read_json<AxisItem>({}, TextSource::of(text), begins_like_native, no_native, read_native);
}

bool is_voronoi(const std::string& path) { return begins(path, begins_like_voronoi); }

Result<Document<VoronoiItem>> read_voronoi(const std::string& path) {
  return read_json<VoronoiItem>(path, TextSource::open(path), begins_like_voronoi, nullptr,
                                read_voronoi);
}

Result<TriangleMesh> read_mesh(const std::string& path) {
  const std::string extension = format_name(path);
  const Format* format = find_format(extension, DocumentKind::mesh);
  if (format == nullptr)
    return Error{ErrorCode::unsupported,
                 fmt::format("'{}' is not a mesh format; known are {}", extension,
                             formats_of(DocumentKind::mesh)),
                 in_file(path)};
  return guarded(path, [&]() -> Result<TriangleMesh> {
    Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
    if (!source) return source.error();
    return format->read_mesh({path, *source});
  });
}

}  // namespace medial::io
