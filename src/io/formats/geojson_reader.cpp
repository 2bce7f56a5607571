// Collections of polygons in GeoJSON, feature by feature, as GDAL reads them: it takes ten times as
// long, since it makes an object of each number and reads the file twice. What is unusual is left
// to GDAL, so that all files mean what they mean there. The parser on demand does not look at what
// it skips, so nothing of a feature is skipped.

#include <simdjson.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

#include "io/formats/geojson.h"
#include "io/formats/json_number.h"
#include "io/place.h"
#include "io/text_source.h"

namespace medial::io {

namespace {

namespace json = simdjson::ondemand;

void usual(bool condition) {
  if (!condition) throw Unusual{};
}

/// The text of an object with a list of features: each of these, and its other members.
class CollectionText {
 public:
  explicit CollectionText(std::shared_ptr<TextSource> source) : source_(std::move(source)) {
    expect('{');
  }

  /// The next feature's text; false at the end, when all other members are known.
  bool next(std::string& feature) {
    while (!at_end_) {
      if (in_list_) {
        if (!ends_with(']', is_first_)) {
          feature.clear();
          take_value(feature);
          return true;
        }
        in_list_ = false;
      } else if (ends_with('}', !has_members_)) {
        at_end_ = true;
      } else {
        take_member();
      }
    }
    usual(source_->peek() < 0 && !source_->failure());
    return false;
  }
  const std::map<std::string, std::string>& members() const { return members_; }

 private:
  void expect(char c) {
    source_->skip_space();
    usual(source_->peek() == c);
    source_->skip();
    source_->skip_space();
  }

  /// Whether a list ends here; otherwise goes past the comma between two of its values.
  bool ends_with(char end, bool first) {
    source_->skip_space();
    if (source_->peek() == end) {
      expect(end);
      return true;
    }
    if (!first) expect(',');
    is_first_ = false;
    has_members_ = true;
    return false;
  }

  void take_member() {
    std::string key, value;
    take_value(key);
    usual(key[0] == '"' && key.find('\\') == std::string::npos);
    expect(':');
    if (key == "\"features\"") {
      usual(!members_.contains(key));
      members_[key];
      expect('[');
      in_list_ = is_first_ = true;
      return;
    }
    take_value(value);
    usual(members_.emplace(std::move(key), std::move(value)).second);
  }

  char take(std::string& text) {
    const int c = source_->peek();
    usual(c >= 0);
    text.push_back(static_cast<char>(c));
    source_->skip();
    return text.back();
  }
  void take_string(std::string& text) {
    for (char c = take(text); (c = take(text)) != '"';)
      if (c == '\\') take(text);
  }
  /// One value, whatever it is: its brackets match.
  void take_value(std::string& text) {
    std::size_t depth = 0;
    do {
      const int c = source_->peek();
      if (c == '"') {
        take_string(text);
      } else if (c == ',' || c == ':' ? depth == 0 : c < 0) {
        throw Unusual{};
      } else {
        take(text);
        if (c == '{' || c == '[') ++depth;
        if (c == '}' || c == ']') {
          usual(depth > 0);
          --depth;
        } else if (depth == 0 && c != '{' && c != '[') {
          take_word(text);
        }
      }
    } while (depth > 0);
  }
  /// The rest of a number or a word.
  void take_word(std::string& text) {
    for (int c = source_->peek(); c > ' ' && c != ',' && c != ']' && c != '}'; c = source_->peek())
      take(text);
  }

  std::shared_ptr<TextSource> source_;
  std::map<std::string, std::string> members_;
  bool in_list_ = false, is_first_ = true, has_members_ = false, at_end_ = false;
};

enum class Kind : std::uint8_t { none, whole, real, text, boolean };

/// A value, and how GDAL writes it where the column has this kind.
struct Property {
  std::string name, text;
  Kind kind = Kind::none;
  double number = 0;
};

std::string text_of(double number) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}

/// GDAL takes texts for dates and times that are anything like them.
bool may_be_date(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  constexpr std::string_view digits = "0123456789+-T";
  return !text.empty() && digits.find(text[0]) != std::string_view::npos &&
         text.find_first_of("-/:") != std::string_view::npos;
}

Property property_of(std::string_view name, json::value value) {
  Property property;
  property.name = name;
  switch (json::json_type(value.type())) {
    case json::json_type::number: {
      constexpr double exact = 1LL << 53;
      const bool whole = value.raw_json_token().find_first_of(".eE") == std::string_view::npos;
      property.kind = whole ? Kind::whole : Kind::real;
      property.number = nearest_double(value);
      usual(std::abs(property.number) < exact);
      if (whole) property.number += 0.0;  // no sign of 0
      property.text = whole ? std::to_string(static_cast<std::int64_t>(property.number))
                            : text_of(property.number);
      break;
    }
    case json::json_type::string:
      property.kind = Kind::text;
      property.text = std::string_view(value.get_string());
      usual(!may_be_date(property.text) && property.text.find('\0') == std::string::npos);
      break;
    case json::json_type::boolean:
      property.kind = Kind::boolean;
      property.text = bool(value.get_bool()) ? "1" : "0";
      break;
    case json::json_type::null:
      usual(bool(value.is_null()));
      break;
    default:
      throw Unusual{};
  }
  return property;
}

/// Whole numbers have no sign of 0; those beyond 64 bits are others to GDAL.
double coordinate_of(json::value value) {
  constexpr std::size_t fits = 18;
  const std::string_view text = value.raw_json_token();
  const double result = nearest_double(value);
  if (result != 0 && text.size() <= fits) return result;
  const bool whole = text.find_first_of(".eE") == std::string_view::npos;
  usual(!whole || text.size() <= fits);
  return whole ? result + 0.0 : result;
}

Ring ring_of(json::array positions, RingRole role) {
  Ring ring;
  ring.role = role;
  for (json::value position : positions) {
    std::array<double, 2> place{};
    std::size_t count = 0;
    for (json::value number : position.get_array()) {
      usual(count < 2);
      place[count++] = coordinate_of(number);
    }
    usual(count == 2);
    ring.points.push_back({place[0], place[1]});
  }
  usual(ring.points.size() >= 4 && ring.points.front() == ring.points.back());
  return ring;
}

void add_polygon(json::array polygon, std::vector<Ring>& rings) {
  RingRole role = RingRole::outer;
  for (json::value ring : polygon) {
    rings.push_back(ring_of(ring.get_array(), role));
    role = RingRole::hole;
  }
  usual(role == RingRole::hole);
}

void add_geometry(json::object geometry, std::vector<Ring>& rings) {
  int types = 0, lists = 0;
  for (json::field field : geometry) {
    const std::string_view key = field.unescaped_key();
    types += key == "type" ? 1 : 0;
    lists += key == "coordinates" ? 1 : 0;
    usual(key == "type" || key == "coordinates");
  }
  usual(types == 1 && lists == 1);
  geometry.reset();
  const std::string_view type = geometry.find_field_unordered("type").get_string();
  const bool several = type == "MultiPolygon";
  usual(several || type == "Polygon");
  json::array coordinates = geometry.find_field_unordered("coordinates").get_array();
  if (!several) return add_polygon(coordinates, rings);
  for (json::value polygon : coordinates) add_polygon(polygon.get_array(), rings);
  usual(!rings.empty());
}

/// A feature before the kinds of its columns are known.
struct ParsedFeature {
  std::vector<Ring> rings;
  std::vector<Property> properties;
};

ParsedFeature parse(json::parser& parser, std::string& text) {
  text.reserve(text.size() + simdjson::SIMDJSON_PADDING);
  json::document document =
      parser.iterate(simdjson::padded_string_view(text.data(), text.size(), text.capacity()));
  ParsedFeature feature;
  std::optional<Property> id;
  int types = 0, geometries = 0, lists = 0;
  for (json::field field : document.get_object()) {
    const std::string_view key = field.unescaped_key();
    if (key == "type") {
      usual(std::string_view(field.value().get_string()) == "Feature" && ++types == 1);
    } else if (key == "geometry") {
      usual(++geometries == 1);
      add_geometry(field.value().get_object(), feature.rings);
    } else if (key == "properties") {
      usual(++lists == 1);
      for (json::field property : field.value().get_object()) {
        const std::string_view name = property.unescaped_key();  // once, and before the value
        feature.properties.push_back(property_of(name, property.value()));
      }
    } else if (key == "id") {
      usual(!id);
      id = property_of(key, field.value());
      usual(id->kind == Kind::text);
    } else {
      usual(key == "bbox");
      for (json::value number : field.value().get_array()) nearest_double(number);
    }
  }
  usual(document.current_location().error() != simdjson::SUCCESS);
  usual(types == 1 && geometries == 1 && lists == 1);
  // GDAL makes a column of texts, and feature numbers of whole numbers, which it changes if twice.
  if (id) feature.properties.insert(feature.properties.begin(), std::move(*id));
  return feature;
}

/// The columns of all features, which have them in one order.
class Columns {
 public:
  void add(const std::vector<Property>& properties) {
    if (!std::exchange(any_, true)) {
      for (const Property& property : properties) columns_.emplace_back(property.name, Kind::none);
      for (const auto& [name, kind] : columns_)
        usual(std::ranges::count(columns_, name, [](const auto& c) { return c.first; }) == 1);
    }
    usual(properties.size() == columns_.size());
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      auto& [name, kind] = columns_[i];
      const Kind own = properties[i].kind;
      usual(properties[i].name == name);
      const auto is_number = [](Kind k) { return k == Kind::whole || k == Kind::real; };
      if (kind == Kind::none)
        kind = own;
      else if (is_number(kind) && is_number(own))
        kind = kind == Kind::real ? kind : own;
      else
        usual(own == Kind::none || own == kind);
    }
  }
  /// Real numbers as long as only whole ones were known of their columns.
  void settle(Attributes& attributes) const {
    for (auto& [name, text] : attributes) {
      const auto column = std::ranges::find(columns_, name, [](const auto& c) { return c.first; });
      if (column->second == Kind::real) text = text_of(std::strtod(text.c_str(), nullptr));
    }
  }
  std::vector<std::string> text_attributes() const {
    std::vector<std::string> names;
    for (const auto& [name, kind] : columns_)
      if (kind == Kind::text || kind == Kind::none) names.push_back(name);
    return names;
  }
  Attributes attributes_of(std::vector<Property> properties) const {
    Attributes attributes;
    for (std::size_t i = 0; i < properties.size(); ++i) {
      Property& own = properties[i];
      if (own.kind == Kind::none) continue;
      const bool as_real = own.kind == Kind::whole && columns_[i].second == Kind::real;
      attributes.emplace_back(std::move(own.name),
                              as_real ? text_of(own.number) : std::move(own.text));
    }
    return attributes;
  }

 private:
  std::vector<std::pair<std::string, Kind>> columns_;
  bool any_ = false;
};

/// Longitude and latitude as GDAL writes them.
constexpr const char* geographic =
    "GEOGCRS[\"WGS 84\",DATUM[\"World Geodetic System 1984\",ELLIPSOID[\"WGS 84\",6378137,"
    "298.257223563,LENGTHUNIT[\"metre\",1]]],PRIMEM[\"Greenwich\",0,ANGLEUNIT[\"degree\","
    "0.0174532925199433]],CS[ellipsoidal,2],AXIS[\"geodetic latitude (Lat)\",north,ORDER[1],"
    "ANGLEUNIT[\"degree\",0.0174532925199433]],AXIS[\"geodetic longitude (Lon)\",east,ORDER[2],"
    "ANGLEUNIT[\"degree\",0.0174532925199433]],ID[\"EPSG\",4326]]";

/// The only member of this name.
simdjson::dom::element only(simdjson::dom::object object, std::string_view key) {
  simdjson::dom::element found;
  int count = 0;
  for (const auto& member : object) {
    if (member.key != key) continue;
    found = member.value;
    ++count;
  }
  usual(count == 1);
  return found;
}

/// The reference system as well-known text, or as "EPSG:n".
std::string crs_of(const std::map<std::string, std::string>& members,
                   simdjson::dom::parser& parser) {
  const auto found = members.find("\"crs\"");
  if (found == members.end()) return geographic;
  const simdjson::dom::object crs = parser.parse(found->second);
  usual(std::string_view(only(crs, "type")) == "name");
  std::string_view name = only(only(crs, "properties"), "name");
  for (const std::string_view begin : {"urn:ogc:def:crs:EPSG::", "EPSG:"}) {
    if (!name.starts_with(begin)) continue;
    name.remove_prefix(begin.size());
    usual(!name.empty() && name.find_first_not_of("0123456789") == std::string_view::npos);
    return name == "4326" ? geographic : "EPSG:" + std::string(name);
  }
  usual(name == "urn:ogc:def:crs:OGC:1.3:CRS84");
  return geographic;
}

class GeojsonReader final : public FeatureReader {
 public:
  explicit GeojsonReader(std::string path) : path_(std::move(path)) { open(); }

  /// The first pass finds the columns' kinds and the reference system. Throws Unusual.
  Result<bool> read(std::size_t points, Document<Feature>& document) override {
    try {
      return read_usual(points, document);
    } catch (const Unusual&) {
      if (!is_known_) throw;
    } catch (const simdjson::simdjson_error&) {
      if (!is_known_) throw Unusual{};
    }
    return Error{ErrorCode::unreadable, "the file has changed while it was read", in_file(path_)};
  }
  bool begin_again() override {
    is_known_ = true;
    open();
    return true;
  }
  const Columns& columns() const { return columns_; }

 private:
  void open() {
    auto source = TextSource::open(path_);
    usual(source.ok());
    unit_ = plane_unit_of((*source)->lookahead(beginning_size));
    collection_.emplace(std::move(*source));
    count_ = 0;
    last_number_ = -1;
  }

  bool read_usual(std::size_t points, Document<Feature>& document) {
    for (std::size_t count = 0; count < points;) {
      if (!collection_->next(text_)) {
        if (!is_known_) finish_first();
        describe(document);
        document.text_attributes = columns_.text_attributes();
        return false;
      }
      ParsedFeature parsed = parse(parser_, text_);
      columns_.add(parsed.properties);
      Feature& feature = document.items.emplace_back();
      document.indices.push_back(static_cast<std::uint64_t>(count_));
      feature.id = number_of(parsed.properties, count_++);
      feature.rings = std::move(parsed.rings);
      feature.attributes = columns_.attributes_of(std::move(parsed.properties));
      count += point_count(feature);
    }
    if (is_known_) describe(document);
    return true;
  }

  void describe(Document<Feature>& document) const {
    document.crs_wkt = crs_;
    document.unit = unit_.value_or(Unit::unknown);
  }

  /// A whole "id" is the feature's number. GDAL changes those that come twice.
  std::int64_t number_of(const std::vector<Property>& properties, std::int64_t index) {
    const auto id = std::ranges::find(properties, "id", &Property::name);
    if (id == properties.end() || id->kind == Kind::text) return index;
    usual(id->kind == Kind::whole && id->number > last_number_);
    last_number_ = id->number;
    return static_cast<std::int64_t>(id->number);
  }

  /// All other members are known.
  void finish_first() {
    simdjson::dom::parser strict;
    const auto check = [&](const std::string& text) {
      usual(strict.parse(text).error() == simdjson::SUCCESS);
    };
    const auto& members = collection_->members();
    for (const auto& [key, value] : members) {
      check(key);
      if (key != "\"features\"") check(value);
    }
    const auto type = members.find("\"type\"");
    usual(type != members.end() && type->second == "\"FeatureCollection\"");
    crs_ = crs_of(members, strict);
    if (unit_) crs_.clear();
    usual(count_ > 0);
  }

  std::string path_, text_, crs_;
  std::optional<Unit> unit_;
  std::optional<CollectionText> collection_;
  json::parser parser_;
  Columns columns_;
  std::int64_t count_ = 0;
  double last_number_ = -1;
  bool is_known_ = false;  ///< what the first pass finds
};

}  // namespace

std::optional<Unit> plane_unit_of(std::string_view beginning) {
  const std::size_t end = beginning.find("\"features\"");
  const std::string_view head = beginning.substr(0, end);
  constexpr std::string_view key = "\"unit\"";
  const std::size_t at = head.find(key);
  if (end == std::string_view::npos || at == std::string_view::npos ||
      head.find("\"crs\"") != std::string_view::npos)
    return std::nullopt;
  const std::size_t open = head.find_first_not_of(" \t\r\n:", at + key.size());
  if (open == std::string_view::npos || head[open] != '"') return std::nullopt;
  const std::size_t close = head.find('"', open + 1);
  return close == std::string_view::npos ? std::nullopt
                                         : unit_of(head.substr(open + 1, close - open - 1));
}

std::unique_ptr<FeatureReader> open_geojson(const std::string& path) {
  try {
    return std::make_unique<GeojsonReader>(path);
  } catch (const Unusual&) {
    return nullptr;
  }
}

std::optional<Document<Feature>> read_geojson(const std::string& path) {
  try {
    GeojsonReader reader(path);
    auto document = read_to_end(reader);
    for (Feature& feature : document->items) reader.columns().settle(feature.attributes);
    return std::move(*document);
  } catch (const Unusual&) {
    return std::nullopt;
  }
}

}  // namespace medial::io
