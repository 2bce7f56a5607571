// Whatever vector formats GDAL reads.

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "io/coordinate_names.h"
#include "io/format.h"
#include "io/format_name.h"
#include "io/formats/geojson.h"
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

std::string in_encoding(const std::string& text, const char* from, const char* to) {
  char* bytes = CPLRecode(text.c_str(), from, to);
  std::string result = bytes;
  CPLFree(bytes);
  return result;
}

/// Text in UTF-8. Other bytes, of formats that name no encoding, are taken for the most common one;
/// `recoded` says so.
std::string utf8(const char* text, bool& recoded) {
  if (text == nullptr) return {};
  std::string bytes = text;
  if (CPLIsUTF8(text, -1)) return bytes;
  recoded = true;
  for (char& byte : bytes)  // that stand for no character
    if (std::string_view("\x81\x8d\x8f\x90\x9d").find(byte) != std::string_view::npos) byte = '?';
  return in_encoding(bytes, "CP1252", CPL_ENC_UTF8);
}
std::string utf8(const char* text) {
  bool ignored = false;
  return utf8(text, ignored);
}

std::string field_text(const OGRFeature& feature, int field, bool& recoded) {
  const OGRFieldDefn* definition = feature.GetFieldDefnRef(field);
  if (definition->GetType() != OFTReal) return utf8(feature.GetFieldAsString(field), recoded);
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), feature.GetFieldAsDouble(field));
  return {text.data(), end.ptr};
}

bool is_ascii(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return static_cast<signed char>(c) >= 0; });
}

/// Whether the first text of a layer that is not ASCII, of its fields' names and then of their
/// values, is not UTF-8 either.
bool names_no_encoding(OGRLayer& layer) {
  const OGRFeatureDefn& fields = *layer.GetLayerDefn();
  for (int i = 0; i < fields.GetFieldCount(); ++i)
    if (const char* name = fields.GetFieldDefn(i)->GetNameRef(); !is_ascii(name))
      return !CPLIsUTF8(name, -1);
  if (layer.TestCapability(OLCStringsAsUTF8)) return false;
  for (const OGRFeatureUniquePtr& feature : layer)
    for (int i = 0; i < fields.GetFieldCount(); ++i)
      if (fields.GetFieldDefn(i)->GetType() == OFTString)
        if (const char* value = feature->GetFieldAsString(i); !is_ascii(value))
          return !CPLIsUTF8(value, -1);
  return false;
}

/// A filter as the layer's text is encoded, which GDAL compares byte by byte. One that is not in
/// UTF-8 may be encoded like that already; one with characters that the encoding lacks, which
/// CPLRecode drops, is to find nothing.
std::string filter_for(OGRLayer& layer, const std::string& filter) {
  if (is_ascii(filter) || !CPLIsUTF8(filter.c_str(), -1) || !names_no_encoding(layer))
    return filter;
  const GdalMessages unheard;
  std::string bytes = in_encoding(filter, CPL_ENC_UTF8, "CP1252");
  return in_encoding(bytes, "CP1252", CPL_ENC_UTF8) == filter ? bytes : filter;
}

/// " name rank": what filters can ask for.
std::string fields_of(OGRLayer& layer) {
  std::string names;
  const OGRFeatureDefn& definition = *layer.GetLayerDefn();
  for (int i = 0; i < definition.GetFieldCount(); ++i)
    names.append(" ").append(utf8(definition.GetFieldDefn(i)->GetNameRef()));
  return names.empty() ? " none" : names;
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

bool is_gml(const std::string& name) {
  const GdalMessages unheard;
  GDALDriverH driver = GDALIdentifyDriverEx(name.c_str(), GDAL_OF_VECTOR, nullptr, nullptr);
  return driver != nullptr && std::string_view(GDALGetDriverShortName(driver)) == "GML";
}

class GdalReader final : public FeatureReader {
 public:
  GdalReader(std::string shown, const ReadOptions& options)
      : shown_(std::move(shown)), options_(options) {}

  ~GdalReader() override {
    const GdalMessages unheard;
    source_.reset();
  }

  Status open(const std::string& name) {
    name_ = name;
    register_gdal();
    const GdalMessages messages;
    const unsigned flags = GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
    // Tables: points by columns of these names, where there is no column of geometries.
    const std::string x = fmt::format("X_POSSIBLE_NAMES={}", x_names);
    const std::string y = fmt::format("Y_POSSIBLE_NAMES={}", y_names);
    const std::array<const char*, 4> columns{x.c_str(), y.c_str(), "KEEP_GEOM_COLUMNS=NO", nullptr};
    const std::array<const char*, 2> schema{"WRITE_GFS=NO", nullptr};  // not beside the file
    const char* const* choices = lower_case(name).ends_with(".csv") ? columns.data()
                                 : is_gml(name)                     ? schema.data()
                                                                    : nullptr;
    source_.reset(GDALDataset::Open(name.c_str(), flags, nullptr, choices));
    if (!source_) return cannot_open(name, messages.failure());
    Result<OGRLayer*> layer = choose_layer(*source_);
    if (!layer) return layer.error();
    layer_ = *layer;
    if (!options_.where.empty() &&
        layer_->SetAttributeFilter(filter_for(*layer_, options_.where).c_str()) != OGRERR_NONE) {
      return error(ErrorCode::invalid_option,
                   fmt::format("the filter '{}' does not work: {}; the fields are{}",
                               options_.where, messages.failure(), fields_of(*layer_)));
    }
    read_crs();
    read_text_attributes();
    layer_->ResetReading();
    return heard(messages);
  }

  /// A GeoJSON may name a unit instead of a reference system, for which GDAL takes WGS 84.
  void read_unit(std::string_view beginning) {
    if (std::string_view(source_->GetDriverName()) != "GeoJSON") return;
    const std::optional<Unit> unit = plane_unit_of(beginning);
    if (!unit) return;
    common_.crs_wkt.clear();
    common_.geographic = false;
    common_.unit = *unit;
  }

  Result<bool> read(std::size_t points, Document<Feature>& document) override {
    const GdalMessages messages;
    document.crs_wkt = common_.crs_wkt;
    document.geographic = common_.geographic;
    document.unit = common_.unit;
    document.text_attributes = common_.text_attributes;
    const bool more = read_features(points, document);
    if (Status fine = heard(messages); !fine) return std::move(fine).error();
    if (recoded_ && !std::exchange(recoded_noted_, true))
      common_.notes.push_back(
          "text that is not in UTF-8 is taken for Windows-1252 (Western Europe); the environment "
          "variable SHAPE_ENCODING names another encoding of shapefiles");
    if (!more)
      if (Status complete = finish(); !complete) return std::move(complete).error();
    std::ranges::move(common_.notes, std::back_inserter(document.notes));
    common_.notes.clear();
    return more;
  }

 private:
  Error error(ErrorCode code, std::string text) const {
    return Error{code, std::move(text), in_file(shown_)};
  }

  Error cannot_open(const std::string& name, const std::string& failure) const {
    std::error_code ignored;
    if (std::filesystem::is_directory(name, ignored))
      return error(ErrorCode::unreadable, "this is a directory: name a file in it");
    const bool known = known_extension(name) || GDALIdentifyDriverEx(name.c_str(), GDAL_OF_VECTOR,
                                                                     nullptr, nullptr) != nullptr;
    if (known) {
      return error(ErrorCode::malformed,
                   failure.empty() ? "the content is not what the format says" : said(failure));
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
      return error(ErrorCode::invalid_option,
                   fmt::format("there is no layer '{}'; the layers are: {}", options_.layer,
                               layer_names(source)));
    }
    OGRLayer* layer = source.GetLayer(0);
    if (layer == nullptr) return error(ErrorCode::malformed, "the first layer cannot be read");
    if (source.GetLayerCount() > 1) {
      common_.notes.push_back(fmt::format("layer '{}' was read; the file has the layers {}",
                                          utf8(layer->GetName()), layer_names(source)));
    }
    return layer;
  }

  void read_crs() {
    const OGRSpatialReference* reference = layer_->GetSpatialRef();
    if (reference == nullptr) return;
    set_crs(*reference, common_);
    const std::vector<int>& axes = reference->GetDataAxisToSRSAxisMapping();
    latitude_first_ =
        axes.size() >= 2 && axes[0] == 1 && axes[1] == 2 &&
        (reference->EPSGTreatsAsLatLong() || reference->EPSGTreatsAsNorthingEasting());
  }

  void read_text_attributes() {
    for (const std::string_view without_types : {"CSV", "KML", "LIBKML"})
      if (source_->GetDriverName() == without_types) return;
    const OGRFeatureDefn& fields = *layer_->GetLayerDefn();
    for (int i = 0; i < fields.GetFieldCount(); ++i)
      if (fields.GetFieldDefn(i)->GetType() == OFTString)
        common_.text_attributes.push_back(utf8(fields.GetFieldDefn(i)->GetNameRef()));
  }

  /// False at the end of the layer.
  bool read_features(std::size_t points, Document<Feature>& document) {
    for (std::size_t count = 0; count < points;) {
      const OGRFeatureUniquePtr source(layer_->GetNextFeature());
      if (source == nullptr) return false;
      const OGRGeometry* geometry = source->GetGeometryRef();
      Feature feature;
      const std::int64_t index = index_++;
      feature.id = source->GetFID() == OGRNullFID ? index : source->GetFID();
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
        feature.attributes.emplace_back(utf8(source->GetFieldDefnRef(i)->GetNameRef(), recoded_),
                                        field_text(*source, i, recoded_));
      }
      count += point_count(feature);
      any_ = true;
      document.items.push_back(std::move(feature));
      document.indices.push_back(static_cast<std::uint64_t>(index));
    }
    return true;
  }

  /// An error among the messages; its warnings become notes, each once.
  Status heard(const GdalMessages& messages) {
    if (!messages.failure().empty()) return error(ErrorCode::malformed, said(messages.failure()));
    for (const std::string& warning : messages.warnings())
      if (warnings_.insert(warning).second) common_.notes.push_back(said(warning));
    return success();
  }

  /// A message of GDAL: what it calls by a name of this program's own is the file.
  std::string said(std::string message) const {
    const std::size_t at = name_ == shown_ ? std::string::npos : message.find(name_);
    if (at != std::string::npos) message.replace(at, name_.size(), shown_);
    return message;
  }

  Status finish() {
    if (!any_) {
      if (counts_.others > 0) {
        const Error none = without_polygons(counts_.others);
        const bool is_first_of_many = options_.layer.empty() && source_->GetLayerCount() > 1;
        return error(none.code, !is_first_of_many
                                    ? none.text
                                    : fmt::format("the first layer has {}; --layer chooses "
                                                  "among {}",
                                                  none.text, layer_names(*source_)));
      }
      if (!options_.where.empty()) return error(ErrorCode::empty, "no feature passes the filter");
      if (without_geometry_ > 0) return error(ErrorCode::empty, "no feature with a geometry");
    }
    if (counts_.others > 0) common_.notes.push_back(note_of_others(counts_.others));
    if (without_geometry_ > 0) {
      common_.notes.push_back(
          without_geometry_ == 1
              ? "1 feature has no geometry and was left out"
              : fmt::format("{} features have no geometry and were left out", without_geometry_));
    }
    return success();
  }

  std::string shown_, name_;  ///< in messages, and for GDAL
  const ReadOptions options_;
  GDALDatasetUniquePtr source_;
  OGRLayer* layer_ = nullptr;
  Document<Feature> common_;  ///< what holds for all features, and notes to come
  std::set<std::string> warnings_;
  GeometryCounts counts_;
  std::int64_t index_ = 0;
  bool any_ = false;  ///< whether a feature has been read
  std::uint64_t without_geometry_ = 0;
  bool latitude_first_ = false;
  bool recoded_ = false, recoded_noted_ = false;  ///< attributes that are not in UTF-8
};

/// Whether a text begins with names of columns, among them one of geometries or two of coordinates.
bool begins_like_table(std::string_view text) {
  const char first = text.empty() ? '\0' : text[0];
  if (std::isalpha(static_cast<unsigned char>(first)) == 0 && first != '_' && first != '"')
    return false;
  constexpr std::string_view between = ",;\t|\" \r";
  std::string line(text.substr(0, text.find('\n')));
  if (line.find('\0') != std::string::npos) return false;
  line = lower_case(std::move(line));
  bool x = false, y = false;
  const auto is_one_of = [](std::string_view word, std::string_view names) {
    return fmt::format(",{},", names).find(fmt::format(",{},", word)) != std::string::npos;
  };
  for (std::size_t at = line.find_first_not_of(between); at != std::string::npos;) {
    const std::size_t end = std::min(line.find_first_of(between, at), line.size());
    const std::string_view word = std::string_view(line).substr(at, end - at);
    if (word == "wkt" || word.starts_with("_wkt")) return true;  // GDAL's names
    x = x || is_one_of(word, x_names);
    y = y || is_one_of(word, y_names);
    at = line.find_first_not_of(between, end);
  }
  return x && y;
}

/// Reads a stream, which GDAL gets as a file in memory. Tables it knows by their names alone.
Result<Document<Feature>> read_bytes(const Input& input, const ReadOptions& options) {
  constexpr std::size_t longest_stream = std::size_t{1} << 32U;
  std::string bytes;
  input.source->read_all(bytes, longest_stream);
  const auto error = [&input](ErrorCode code, const char* text) {
    return Error{code, text, in_file(input.path)};
  };
  if (bytes.size() > longest_stream)
    return error(ErrorCode::too_large, "more than 4 GiB in a stream");
  if (input.source->failure()) return *input.source->failure();
  if (bytes.empty()) return error(ErrorCode::empty, "there is nothing to read");
  const MemoryFile file(bytes, begins_like_table(bytes) ? ".csv" : "");
  if (file.name().empty()) return error(ErrorCode::unreadable, "cannot be kept in memory");
  GdalReader reader(input.path, options);
  if (Status opened = reader.open(file.name()); !opened) return std::move(opened).error();
  reader.read_unit(std::string_view(bytes).substr(0, beginning_size));
  return read_to_end(reader);
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

Result<std::unique_ptr<FeatureReader>> open_vectors(const Input& input,
                                                    const ReadOptions& options) {
  struct stat status {};
  const bool special = input.path.starts_with("/vsi") || input.path.find(':') != std::string::npos;
  const bool is_there = stat(input.path.c_str(), &status) == 0;
  if (!special && !is_there) {
    return Error{ErrorCode::unreadable, fmt::format("cannot open: {}", std::strerror(errno)),
                 in_file(input.path)};
  }
  if (!is_there) allow_network_for(input.path);
  auto reader = std::make_unique<GdalReader>(input.path, options);
  if (Status opened = reader->open(gdal_name(input.path)); !opened)
    return std::move(opened).error();
  if (input.source) reader->read_unit(input.source->lookahead(beginning_size));
  return std::unique_ptr<FeatureReader>(std::move(reader));
}

Result<Document<Feature>> read_vectors(const Input& input, const ReadOptions& options) {
  if (input.source && input.source->is_stream()) return read_bytes(input, options);
  auto reader = open_vectors(input, options);
  if (!reader) return std::move(reader).error();
  return read_to_end(**reader);
}

}  // namespace

Format gdal_format() {
  Format format;
  format.read = read_vectors;
  format.open = open_vectors;
  format.has_layers = format.has_filters = format.reads_others = true;
  return format;
}

}  // namespace medial::io
