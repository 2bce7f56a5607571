#include "medial/io/read.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "io/dxf_reader.h"
#include "io/dxf_text.h"
#include "io/format_name.h"
#include "io/gdal_reader.h"
#include "io/gdal_support.h"
#include "io/guarded.h"
#include "io/native.h"
#include "io/place.h"
#include "io/repair.h"
#include "io/svg_reader.h"
#include "io/text_reader.h"
#include "medial/raster.h"
#include "medial/io/projection.h"

namespace medial::io {

namespace {

constexpr std::size_t sniffed = 4096;
constexpr std::size_t longest_stream = std::size_t{1} << 32U;  // what GDAL gets through memory

enum class Format : std::uint8_t { wkt, xy, csv, svg, dxf, native, json, gdal };

Format format_of_name(std::string name) {
  name = lower_case(std::move(name));
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  if (name.ends_with(".wkt")) return Format::wkt;
  if (name.ends_with(".svg") || name.ends_with(".svgz")) return Format::svg;
  if (name.ends_with(".dxf")) return Format::dxf;
  if (name.ends_with(".txt") || name.ends_with(".xy")) return Format::xy;
  if (name.ends_with(".csv")) return Format::csv;
  if (name.ends_with(".json") || name.ends_with(".geojson")) return Format::json;
  return Format::gdal;
}

Format format_of_text(std::string_view text) {
  if (begins_like_native(text)) return Format::native;
  if (begins_like_wkt(text)) return Format::wkt;
  if (begins_like_svg(text)) return Format::svg;
  if (begins_like_dxf(text)) return Format::dxf;
  if (begins_like_xy(text)) return Format::xy;
  return Format::gdal;
}

Result<Document<Feature>> read_native_dataset(TextSource& source) {
  Result<Document<AxisItem>> file = read_native(source);
  if (!file) return file.error();
  Document<Feature> dataset = dataset_of(std::move(*file));
  read_crs_of_wkt(std::string(dataset.crs_wkt), dataset);
  return dataset;
}

Error nothing_to_close(const std::string& path) {
  return {ErrorCode::invalid_option, "this format has no loose curves to close", in_file(path)};
}

Result<Document<Feature>> read_own(TextSource& source, Format format, const std::string& path,
                                   const ReadOptions& options) {
  if (options.close && format != Format::dxf) return nothing_to_close(path);
  if ((!options.layer.empty() && format != Format::dxf) || !options.where.empty()) {
    return Error{ErrorCode::invalid_option,
                 "this format has no layers and no attributes to choose by", in_file(path)};
  }
  if (format == Format::wkt) return read_wkt(source, options.loose);
  if (format == Format::xy) return read_xy(source, options.loose);
  if (format == Format::svg) return read_svg(source, options.loose);
  if (format == Format::dxf) {
#ifdef MEDIAL_DXF
    return read_dxf(source, options.layer, options.close, options.loose);
#else
    return Error{ErrorCode::unsupported, "this program was built without DXF", in_file(path)};
#endif
  }
  return read_native_dataset(source);
}

/// GDAL's name of a file: compressed files are read through.
std::string gdal_name(const std::string& path) {
  const std::string name = lower_case(path);
  if (name.starts_with("/vsi")) return path;
  if (name.ends_with(".gz")) return "/vsigzip/" + path;
  if (name.ends_with(".zip") && !name.ends_with(".shz") && !name.ends_with(".kmz")) {
    return "/vsizip/" + path;
  }
  return path;
}

/// The outline of an image's foreground as one feature.
Result<Document<Feature>> read_outline(const std::string& path, const ReadOptions& options) {
  if (!options.layer.empty() || !options.where.empty() || options.close ||
      options.repair != RepairRule::none) {
    return Error{ErrorCode::invalid_option,
                 "an image has no layers, and nothing to close or repair", in_file(path)};
  }
  Result<ImageFile> file = read_image(path, options.image);
  if (!file) return file.error();
  const PixelPlacement& t = file->placement;
  const auto place = [&t, placed = file->placed()](std::vector<Vec2>& points) {
    if (!placed) return;
    for (Vec2& p : points) p = {t[0] + p.x * t[1] + p.y * t[2], t[3] + p.x * t[4] + p.y * t[5]};
  };
  Document<Feature> dataset;
  Feature feature;
  if (options.smooth_contour) {
    Result<std::vector<Contour>> contours = smooth_outline(file->image);
    if (!contours) return contours.error();
    feature.contours = std::move(*contours);
    for (Contour& contour : feature.contours) place(contour.points);
  } else {
    Result<std::vector<Ring>> rings = pixel_outline(file->image);
    if (!rings) return rings.error();
    feature.rings = std::move(*rings);
    for (Ring& ring : feature.rings) place(ring.points);
  }
  dataset.items.push_back(std::move(feature));
  dataset.crs_wkt = std::move(file->crs_wkt);
  dataset.geographic = file->geographic;
  dataset.y_down = !file->placed();
  dataset.notes = std::move(file->notes);
  const bool square = t[2] == 0 && t[4] == 0 && std::abs(t[1]) == std::abs(t[5]);
  if (square && !options.project) dataset.pixel = std::abs(t[1]);
  return dataset;
}

Result<Document<Feature>> read_any(const std::string& path, const ReadOptions& options) {
  if (is_image(path)) return read_outline(path, options);
  if (path == "-") {
    Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
    if (!source) return source.error();
    const Format format = format_of_text((*source)->lookahead(sniffed));
    if (format != Format::gdal) return read_own(**source, format, path, options);
    if (options.close) return nothing_to_close(path);
    std::string bytes;
    (*source)->read_all(bytes, longest_stream);
    if (bytes.size() > longest_stream) {
      return Error{ErrorCode::too_large, "more than 4 GiB on standard input", in_file(path)};
    }
    if ((*source)->failure()) return *(*source)->failure();
    if (bytes.empty()) return Error{ErrorCode::empty, "there is nothing to read", in_file(path)};
    return read_gdal_bytes(bytes, path, options);
  }
  Format format = format_of_name(path);
  if (format == Format::csv) {
    // Places and no more: blocks of vertices. What has other columns is GDAL's.
    Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
    if (!source) return source.error();
    const bool plain = has_two_columns((*source)->lookahead(sniffed));
    if ((*source)->failure()) return *(*source)->failure();
    format = plain && options.layer.empty() && options.where.empty() ? Format::xy : Format::gdal;
  }
  if (options.close && (format == Format::gdal || format == Format::json)) {
    return nothing_to_close(path);
  }
  if (format == Format::gdal) {
    struct stat status {};
    const bool special = path.starts_with("/vsi") || path.find(':') != std::string::npos;
    if (!special && stat(path.c_str(), &status) != 0) {
      return Error{ErrorCode::unreadable, fmt::format("cannot open: {}", std::strerror(errno)),
                   in_file(path)};
    }
    return read_gdal(gdal_name(path), path, options);
  }
  Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
  if (!source) return source.error();
  if (format != Format::json) return read_own(**source, format, path, options);
  if (begins_like_native((*source)->lookahead(sniffed))) {
    return read_own(**source, Format::native, path, options);
  }
  if ((*source)->failure()) return *(*source)->failure();
  return read_gdal(gdal_name(path), path, options);
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

std::optional<Error> find_not_finite(const Document<Feature>& dataset) {
  const auto error = [](std::size_t feature, std::size_t ring, std::size_t vertex,
                        const char* text) {
    Error result{ErrorCode::not_finite, text, in_feature(feature)};
    result.place.ring = ring;
    result.place.vertex = vertex;
    return result;
  };
  const auto look_at = [&](std::size_t i, const auto& lines) -> std::optional<Error> {
    for (std::size_t k = 0; k < lines.size(); ++k) {
      if (auto at = not_finite(lines[k].points))
        return error(i, k, *at, "a coordinate is not a finite number");
      if (auto at = not_finite(lines[k].bulges))
        return error(i, k, *at, "a bulge is not a finite number");
    }
    return std::nullopt;
  };
  for (std::size_t i = 0; i < dataset.items.size(); ++i) {
    const Feature& feature = dataset.items[i];
    if (auto bad = look_at(i, feature.rings)) return bad;
    if (auto bad = look_at(i, feature.chains)) return bad;
    for (std::size_t k = 0; k < feature.contours.size(); ++k) {
      const Contour& contour = feature.contours[k];
      if (auto at = not_finite(contour.points)) {
        return error(i, k, *at, "a control point is not a finite number");
      }
      if (auto at = not_finite(contour.weights)) {
        return error(i, k, *at, "a weight is not a finite number");
      }
      for (const CurvePiece& piece : contour.pieces) {
        if (!std::isfinite(piece.bulge)) {
          return error(i, k, piece.first, "a bulge is not a finite number");
        }
      }
    }
  }
  return std::nullopt;
}

bool has_curves(const Feature& feature) {
  return !feature.contours.empty() ||
         std::ranges::any_of(feature.rings, [](const Ring& ring) { return !ring.bulges.empty(); });
}

void drop_empty_features(Document<Feature>& dataset) {
  const auto has_no_point = [](const Feature& feature) {
    return std::ranges::all_of(feature.rings,
                               [](const Ring& ring) { return ring.points.empty(); }) &&
           std::ranges::all_of(
               feature.contours,
               [](const Contour& contour) { return contour.pieces.empty() && !contour.open; }) &&
           feature.chains.empty();
  };
  const std::size_t dropped = std::erase_if(dataset.items, has_no_point);
  if (dropped > 0 && !dataset.items.empty()) {
    dataset.notes.push_back(fmt::format("{} features are empty and were left out", dropped));
  }
}

Result<Document<Feature>> finish(Document<Feature> dataset, const ReadOptions& options) {
  if (auto error = find_not_finite(dataset)) return *error;
  drop_empty_features(dataset);
  if (dataset.items.empty())
    return Error{ErrorCode::empty, options.loose ? "there is nothing" : "there is no polygon", {}};
  if (options.project) {
    if (Status status = project_to_local(dataset); !status) return status.error();
  }
  if (options.repair != RepairRule::none) {
    for (std::size_t i = 0; i < dataset.items.size(); ++i) {
      if (has_curves(dataset.items[i])) continue;  // see ReadOptions
      Status status = repair(dataset.items[i], i, options.repair, dataset.notes);
      if (!status) return status.error();
    }
  }
  return dataset;
}

Result<Document<AxisItem>> read_native_path(const std::string& path) {
  Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
  if (!source) return source.error();
  if (!begins_like_native((*source)->lookahead(sniffed))) {
    return (*source)->error(ErrorCode::malformed, "this is no JSON of medial's own");
  }
  return read_native(**source);
}

}  // namespace

Result<Document<Feature>> read_dataset(const std::string& path, const ReadOptions& options) {
  return guarded(path, [&]() -> Result<Document<Feature>> {
    Result<Document<Feature>> dataset = read_any(path, options);
    if (!dataset) return dataset;
    return finish(std::move(*dataset), options);
  });
}

bool is_native(const std::string& path) {
  const Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
  return source && begins_like_native((*source)->lookahead(sniffed));
}

Result<Document<AxisItem>> read_native(const std::string& path) {
  return guarded(path, [&] { return read_native_path(path); });
}

bool is_voronoi(const std::string& path) {
  const Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
  return source && begins_like_voronoi((*source)->lookahead(sniffed));
}

Result<Document<VoronoiItem>> read_voronoi(const std::string& path) {
  return guarded(path, [&]() -> Result<Document<VoronoiItem>> {
    Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
    if (!source) return source.error();
    return read_voronoi(**source);
  });
}

}  // namespace medial::io
