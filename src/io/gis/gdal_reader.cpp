// Whatever vector formats GDAL reads.

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include "io/format.h"
#include "io/format_name.h"
#include "io/gis/gdal_support.h"
#include "io/place.h"

namespace medial::io {

namespace {

/// Whether one of GDAL's vector drivers claims the extension of a name.
bool known_extension(const std::string& name) {
  const std::string extension = CPLGetExtension(name.c_str());
  if (extension.empty()) return false;
  GDALDriverManager* manager = GetGDALDriverManager();
  for (int i = 0; i < manager->GetDriverCount(); ++i) {
    GDALDriver* driver = manager->GetDriver(i);
    if (driver->GetMetadataItem(GDAL_DCAP_VECTOR) == nullptr) continue;
    const char* known = driver->GetMetadataItem(GDAL_DMD_EXTENSIONS);
    if (known == nullptr) continue;
    const CPLStringList words(CSLTokenizeString(known));
    if (words.FindString(extension.c_str()) >= 0) return true;
  }
  return false;
}

std::string utf8(const char* text) {
  if (text == nullptr) return {};
  if (CPLIsUTF8(text, -1)) return text;
  char* ascii = CPLForceToASCII(text, -1, '?');
  std::string result = ascii;
  CPLFree(ascii);
  return result;
}

std::string field_text(const OGRFeature& feature, int field) {
  const OGRFieldDefn* definition = feature.GetFieldDefnRef(field);
  if (definition->GetType() != OFTReal) return utf8(feature.GetFieldAsString(field));
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), feature.GetFieldAsDouble(field));
  return {text.data(), end.ptr};
}

std::string layer_names(GDALDataset& source) {
  std::vector<std::string> names;
  for (const OGRLayer* layer : source.GetLayers()) {
    names.push_back(utf8(const_cast<OGRLayer*>(layer)->GetName()));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

template <class Line>
void swap_axes(Line& line) {
  for (Vec2& point : line.points) std::swap(point.x, point.y);
  for (double& bulge : line.bulges) bulge = -bulge;
}

class GdalReader {
 public:
  GdalReader(std::string shown, const ReadOptions& options)
      : shown_(std::move(shown)), options_(options) {}

  Result<Document<Feature>> read(const std::string& name) {
    register_gdal();
    const GdalMessages messages;
    const unsigned flags = GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
    // Tables: points by columns of these names, where there is no column of geometries.
    constexpr std::array<const char*, 3> columns{"X_POSSIBLE_NAMES=x,lon,long,longitude,easting",
                                                 "Y_POSSIBLE_NAMES=y,lat,latitude,northing",
                                                 nullptr};
    const bool table = lower_case(name).ends_with(".csv");
    const GDALDatasetUniquePtr source(
        GDALDataset::Open(name.c_str(), flags, nullptr, table ? columns.data() : nullptr));
    if (!source) return cannot_open(name, messages.failure());
    Result<OGRLayer*> layer = choose_layer(*source);
    if (!layer) return layer.error();
    if (!options_.where.empty() &&
        (*layer)->SetAttributeFilter(options_.where.c_str()) != OGRERR_NONE) {
      return error(ErrorCode::invalid_option, fmt::format("the filter '{}' does not work: {}",
                                                          options_.where, messages.failure()));
    }
    read_crs(**layer);
    read_features(**layer);
    if (!messages.failure().empty()) return error(ErrorCode::malformed, messages.failure());
    for (const std::string& warning : messages.warnings()) dataset_.notes.push_back(warning);
    return summarised();
  }

 private:
  Error error(ErrorCode code, std::string text) const {
    return Error{code, std::move(text), in_file(shown_)};
  }

  Error cannot_open(const std::string& name, const std::string& failure) const {
    std::error_code ignored;
    if (std::filesystem::is_directory(name, ignored))
      return error(ErrorCode::unsupported, "this is a directory: name a file in it");
    const bool known = known_extension(name) || GDALIdentifyDriverEx(name.c_str(), GDAL_OF_VECTOR,
                                                                     nullptr, nullptr) != nullptr;
    if (known) {
      return error(ErrorCode::malformed,
                   failure.empty() ? "the content is not what the format says" : failure);
    }
    return error(
        ErrorCode::unsupported,
        "this is neither an image nor a drawing nor one of the vector formats that GDAL knows; "
        "medial axis --help lists what is read");
  }

  Result<OGRLayer*> choose_layer(GDALDataset& source) {
    if (source.GetLayerCount() == 0) return error(ErrorCode::empty, "the file has no layer");
    if (!options_.layer.empty()) {
      OGRLayer* layer = source.GetLayerByName(options_.layer.c_str());
      if (layer != nullptr) return layer;
      return error(ErrorCode::invalid_option, fmt::format("there is no layer '{}', but: {}",
                                                          options_.layer, layer_names(source)));
    }
    OGRLayer* layer = source.GetLayer(0);
    if (layer == nullptr) return error(ErrorCode::malformed, "the first layer cannot be read");
    if (source.GetLayerCount() > 1) {
      dataset_.notes.push_back(fmt::format("layer '{}' was read, out of: {}",
                                           utf8(layer->GetName()), layer_names(source)));
    }
    return layer;
  }

  void read_crs(OGRLayer& layer) {
    const OGRSpatialReference* reference = layer.GetSpatialRef();
    if (reference == nullptr) return;
    set_crs(*reference, dataset_);
    const std::vector<int>& axes = reference->GetDataAxisToSRSAxisMapping();
    latitude_first_ =
        axes.size() >= 2 && axes[0] == 1 && axes[1] == 2 &&
        (reference->EPSGTreatsAsLatLong() || reference->EPSGTreatsAsNorthingEasting());
  }

  void read_features(OGRLayer& layer) {
    std::int64_t index = 0;
    for (const OGRFeatureUniquePtr& source : layer) {
      const OGRGeometry* geometry = source->GetGeometryRef();
      Feature feature;
      feature.id = source->GetFID() == OGRNullFID ? index : source->GetFID();
      ++index;
      if (geometry == nullptr) {
        ++without_geometry_;
        continue;
      }
      const std::uint64_t others = counts_.others;
      if (options_.loose)
        add_loose(*geometry, feature, counts_);
      else
        add_rings(*geometry, feature.rings, counts_);
      if (feature.rings.empty() && feature.chains.empty() && counts_.others > others) continue;
      if (latitude_first_) {
        std::ranges::for_each(feature.rings, swap_axes<Ring>);
        std::ranges::for_each(feature.chains, swap_axes<Chain>);
      }
      for (int i = 0; i < source->GetFieldCount(); ++i) {
        if (!source->IsFieldSetAndNotNull(i)) continue;
        feature.attributes.emplace_back(utf8(source->GetFieldDefnRef(i)->GetNameRef()),
                                        field_text(*source, i));
      }
      dataset_.items.push_back(std::move(feature));
    }
  }

  Result<Document<Feature>> summarised() {
    if (dataset_.items.empty()) {
      if (counts_.others > 0) {
        return error(
            ErrorCode::unsupported,
            fmt::format("no polygons, only other geometries ({} of them)", counts_.others));
      }
      return error(ErrorCode::empty, options_.where.empty() ? "no feature with a geometry"
                                                            : "no feature passes the filter");
    }
    if (counts_.others > 0) {
      dataset_.notes.push_back(
          fmt::format("{} geometries are not polygons and were left out", counts_.others));
    }
    if (without_geometry_ > 0) {
      dataset_.notes.push_back(
          fmt::format("{} features have no geometry and were left out", without_geometry_));
    }
    return std::move(dataset_);
  }

  std::string shown_;
  const ReadOptions& options_;
  Document<Feature> dataset_;
  GeometryCounts counts_;
  std::uint64_t without_geometry_ = 0;
  bool latitude_first_ = false;
};

/// A file that lies in memory.
Result<Document<Feature>> read_bytes(const Input& input, const ReadOptions& options) {
  constexpr std::size_t longest_stream = std::size_t{1} << 32U;
  std::string bytes;
  input.source->read_all(bytes, longest_stream);
  const auto error = [&input](ErrorCode code, const char* text) {
    return Error{code, text, in_file(input.path)};
  };
  if (bytes.size() > longest_stream)
    return error(ErrorCode::too_large, "more than 4 GiB on standard input");
  if (input.source->failure()) return *input.source->failure();
  if (bytes.empty()) return error(ErrorCode::empty, "there is nothing to read");
  const MemoryFile file(bytes);
  if (file.name().empty()) return error(ErrorCode::unreadable, "cannot be kept in memory");
  return GdalReader(input.path, options).read(file.name());
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

Result<Document<Feature>> read_vectors(const Input& input, const ReadOptions& options) {
  if (input.path == "-") return read_bytes(input, options);
  struct stat status {};
  const bool special = input.path.starts_with("/vsi") || input.path.find(':') != std::string::npos;
  if (!special && stat(input.path.c_str(), &status) != 0) {
    return Error{ErrorCode::unreadable, fmt::format("cannot open: {}", std::strerror(errno)),
                 in_file(input.path)};
  }
  return GdalReader(input.path, options).read(gdal_name(input.path));
}

}  // namespace

Format gdal_format() {
  Format format;
  format.read = read_vectors;
  format.has_layers = format.has_filters = format.reads_others = true;
  return format;
}

}  // namespace medial::io
