// Well-known text.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

#include "io/axis_samples.h"
#include "io/formats/text.h"
#include "io/ring_text.h"
#include "io/voronoi_parts.h"

namespace medial::io {

namespace {

constexpr std::size_t longest_word = 64;

bool is_letter(int c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

char upper(int c) { return static_cast<char>(std::toupper(c)); }

/// What to do with a geometry, by its name.
enum class Kind : std::uint8_t {
  unknown,
  polygon,
  multipolygon,
  collection,
  curve_polygon,
  multisurface,
  point,
  multipoint,
  line,
  multiline,
  circular,
  compound,
  multicurve,
  other
};

Kind kind_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, Kind>, 16> kinds{
      {{"POLYGON", Kind::polygon},
       {"MULTIPOLYGON", Kind::multipolygon},
       {"GEOMETRYCOLLECTION", Kind::collection},
       {"CURVEPOLYGON", Kind::curve_polygon},
       {"MULTISURFACE", Kind::multisurface},
       {"TRIANGLE", Kind::polygon},
       {"POINT", Kind::point},
       {"MULTIPOINT", Kind::multipoint},
       {"LINESTRING", Kind::line},
       {"LINEARRING", Kind::line},
       {"MULTILINESTRING", Kind::multiline},
       {"CIRCULARSTRING", Kind::circular},
       {"COMPOUNDCURVE", Kind::compound},
       {"MULTICURVE", Kind::multicurve},
       {"TIN", Kind::other},
       {"POLYHEDRALSURFACE", Kind::other}}};
  const auto* const found =
      std::ranges::find(kinds, name, &std::pair<std::string_view, Kind>::first);
  return found == kinds.end() ? Kind::unknown : found->second;
}

/// Takes the letters Z, M or ZM off the end of a name such as POLYGONZM.
std::string without_dimension(const std::string& name) {
  for (const std::string_view suffix : {"ZM", "Z", "M"}) {
    if (!name.ends_with(suffix)) continue;
    std::string base = name.substr(0, name.size() - suffix.size());
    if (kind_of(base) != Kind::unknown) return base;
  }
  return name;
}

class WktReader final : public FeatureReader {
 public:
  WktReader(std::shared_ptr<TextSource> source, bool loose)
      : source_(std::move(source)), loose_(loose) {}

  Result<bool> read(std::size_t points, Document<Feature>& document) override {
    dataset_ = &document;
    for (std::size_t count = 0; count < points;) {
      skip_separators();
      if (source_->peek() < 0) return finish();
      Feature feature;
      feature.id = static_cast<std::int64_t>(feature_);
      if (Status status = read_feature(feature); !status) return located(status.error());
      polygons_ = polygons_ || !feature.rings.empty() || !feature.chains.empty();
      count += point_count(feature);
      document.items.push_back(std::move(feature));
      document.indices.push_back(feature_++);
    }
    return true;
  }

 private:
  Result<bool> finish() {
    if (source_->failure()) return *source_->failure();
    if (others_ > 0 && !polygons_) return without_polygons(others_);
    if (others_ > 0) dataset_->notes.push_back(note_of_others(others_));
    return false;
  }

  Error located(Error error) const {
    error.place.feature = feature_;
    return error;
  }

  static Error at_vertex(Error error, std::size_t vertex) {
    error.place.vertex = vertex;
    return error;
  }

  Error expected(std::string_view what) {
    const std::string found = source_->next_as_text();
    return source_->error(ErrorCode::malformed,
                          fmt::format("expected {} but found {}", what, found));
  }

  void skip_separators() {
    for (source_->skip_space(); source_->peek() == ';'; source_->skip_space()) source_->skip();
  }

  /// Goes past `c` if it is next, after blanks.
  bool accept(char c) {
    source_->skip_space();
    if (source_->peek() != c) return false;
    source_->skip();
    return true;
  }

  /// A word in capitals; empty if there is none.
  std::string read_word() {
    source_->skip_space();
    std::string word;
    while (word.size() < longest_word && is_letter(source_->peek())) {
      word.push_back(upper(source_->peek()));
      source_->skip();
    }
    return word;
  }

  /// Goes past Z, M or ZM, then past `(` or EMPTY. True: something follows in brackets.
  Result<bool> open_body() {
    for (;;) {
      if (accept('(')) return true;
      const std::string word = read_word();
      if (word == "EMPTY") return false;
      if (word != "Z" && word != "M" && word != "ZM") return expected("'(' or EMPTY");
    }
  }

  /// Reads "body, body, ...)" by `read`, which is not called for EMPTY.
  template <class Read>
  Status read_list(const Read& read) {
    do {
      Result<bool> body = open_body();
      if (!body) return body.error();
      if (!*body) continue;
      if (Status status = read(); !status) return status;
    } while (accept(','));
    return accept(')') ? success() : Status(expected("',' or ')'"));
  }

  Status read_srid() {
    source_->skip();  // '='
    double code = 0;
    source_->skip_space();
    constexpr int largest = std::numeric_limits<int>::max();
    if (source_->read_number(code) != TextSource::Number::read || !(code >= 0 && code <= largest) ||
        code != std::floor(code)) {
      return expected("a whole number after SRID=");
    }
    if (!accept(';')) return expected("';' after the SRID");
    if (srid_ && *srid_ != static_cast<int>(code)) {
      return source_->error(ErrorCode::unsupported, "two coordinate reference systems in one file");
    }
    if (!srid_) {
      srid_ = static_cast<int>(code);
      dataset_->crs_wkt = fmt::format("EPSG:{}", *srid_);
    }
    return success();
  }

  Status read_feature(Feature& feature) {
    std::uint64_t depth = 0;  // of collections: a number instead of recursion
    for (;;) {
      std::string name = read_word();
      if (name == "SRID" && depth == 0 && source_->peek() == '=') {
        if (Status status = read_srid(); !status) return status;
        name = read_word();
      }
      name = without_dimension(name);
      const Kind kind = kind_of(name);
      if (kind == Kind::unknown) {
        if (name.empty()) return expected("the name of a geometry");
        return source_->error(ErrorCode::malformed, fmt::format("'{}' names no geometry", name));
      }
      Result<bool> body = open_body();
      if (!body) return body.error();
      if (*body && kind == Kind::collection) {
        ++depth;
        continue;
      }
      if (*body) {
        if (Status status = read_body(kind, feature); !status) return status;
      }
      while (depth > 0 && !accept(',')) {
        if (!accept(')')) return expected("',' or ')'");
        --depth;
      }
      if (depth == 0) return success();
    }
  }

  /// Points and lines for a planar graph.
  Status read_loose(Kind kind, Feature& feature) {
    const auto add_curve = [&](Kind one) -> Status {
      Ring line;
      Status status = read_curve(one, line);
      if (status && !line.points.empty())
        feature.chains.push_back({std::move(line.points), std::move(line.bulges), false});
      return status;
    };
    const auto add_line = [&] { return add_curve(Kind::line); };
    if (kind == Kind::point) return add_line();
    if (kind == Kind::multicurve) return read_named_list(Kind::line, add_curve);
    if (is_curve(kind)) return add_curve(kind);
    source_->skip_space();
    if (kind == Kind::multipoint && source_->peek() != '(' && !is_letter(source_->peek())) {
      std::vector<Vec2> points;  // without brackets of their own
      Status status = read_points(points);
      for (const Vec2 p : points) feature.chains.push_back({{p}});
      return status;
    }
    return read_list(add_line);
  }

  static bool is_curve(Kind kind) {
    return kind == Kind::line || kind == Kind::circular || kind == Kind::compound;
  }

  /// Reads "element, element, ...)" by `read(kind)`; elements without a name are of the kind
  /// `bare`.
  template <class Read>
  Status read_named_list(Kind bare, const Read& read) {
    do {
      const std::string word = without_dimension(read_word());
      if (word == "EMPTY") continue;
      const bool named = !word.empty() && word != "Z" && word != "M" && word != "ZM";
      const Kind kind = named ? kind_of(word) : bare;
      if (kind == Kind::unknown)
        return source_->error(ErrorCode::malformed, fmt::format("'{}' names no geometry", word));
      Result<bool> body = open_body();
      if (!body) return body.error();
      if (!*body) continue;
      if (Status status = read(kind); !status) return status;
    } while (accept(','));
    return accept(')') ? success() : Status(expected("',' or ')'"));
  }

  /// Appends a line, a circular string, or several of them end to end.
  Status read_curve(Kind kind, Ring& ring) {
    if (kind == Kind::compound)
      return read_named_list(Kind::line, [&](Kind part) {
        return part == Kind::compound ? Status(expected("a line or an arc"))
                                      : read_curve(part, ring);
      });
    if (!is_curve(kind)) return expected("a line or an arc");
    std::vector<Vec2> points;
    if (Status status = read_points(points); !status) return status;
    if (kind == Kind::circular && points.size() % 2 == 0)
      return source_->error(ErrorCode::malformed, "a circular string has an even number of points");
    constexpr double rounding = 1e-14;
    if (!ring.points.empty() &&
        distance(ring.points.back(), points[0]) > rounding * norm(points[0]))
      return source_->error(ErrorCode::malformed, "the parts of a compound curve do not join");
    add_piece(points, kind == Kind::circular, ring);
    return success();
  }

  Status read_curve_polygon(std::vector<Ring>& rings) {
    RingRole role = RingRole::outer;
    return read_named_list(Kind::line, [&](Kind kind) {
      Ring& ring = rings.emplace_back();
      ring.role = std::exchange(role, RingRole::hole);
      return read_curve(kind, ring);
    });
  }

  Status read_surface(Kind kind, std::vector<Ring>& rings) {
    if (kind == Kind::polygon) return read_polygon(rings);
    return kind == Kind::curve_polygon ? read_curve_polygon(rings) : Status(expected("a polygon"));
  }

  Status read_body(Kind kind, Feature& feature) {
    if (loose_ && (kind == Kind::point || kind == Kind::multipoint || kind == Kind::multiline ||
                   kind == Kind::multicurve || is_curve(kind)))
      return read_loose(kind, feature);
    switch (kind) {
      case Kind::polygon:
        return read_polygon(feature.rings);
      case Kind::multipolygon:
        return read_list([&] { return read_polygon(feature.rings); });
      case Kind::curve_polygon:
        return read_curve_polygon(feature.rings);
      case Kind::multisurface:
        return read_named_list(Kind::polygon,
                               [&](Kind part) { return read_surface(part, feature.rings); });
      default:
        ++others_;
        return skip_balanced();
    }
  }

  /// Reads "ring, ring, ...)": the outer ring and its holes.
  Status read_polygon(std::vector<Ring>& rings) {
    RingRole role = RingRole::outer;
    return read_list([&]() -> Status {
      Ring& ring = rings.emplace_back();
      ring.role = role;
      role = RingRole::hole;
      Status status = read_points(ring.points);
      if (!status && status.error().place.vertex) status.error().place.ring = rings.size() - 1;
      return status;
    });
  }

  /// Reads "x y, x y, ...)".
  Status read_points(std::vector<Vec2>& points) {
    for (;;) {
      std::array<double, 4> ordinates{};
      std::size_t count = 0;
      int next = 0;
      do {
        source_->skip_space();
        if (count == ordinates.size()) return expected("',' or ')' after four numbers");
        switch (source_->read_number(ordinates[count])) {
          case TextSource::Number::read:
            break;
          case TextSource::Number::none:
            return expected("a number");
          case TextSource::Number::not_finite:
            return at_vertex(source_->error(ErrorCode::not_finite,
                                            count < 2 ? "a coordinate is not a finite number"
                                                      : "an ordinate is not a finite number"),
                             points.size());
          case TextSource::Number::too_long:
            return source_->error(ErrorCode::malformed, "a number is too long");
        }
        ++count;
        next = source_->peek();
        if (next > ' ' && next != ',' && next != ')') return expected("a blank, ',' or ')'");
        source_->skip_space();
        next = source_->peek();
      } while (next != ',' && next != ')');
      if (count < 2) return expected("a second coordinate");
      points.push_back({ordinates[0], ordinates[1]});
      source_->skip();
      if (next == ')') return success();
    }
  }

  /// Goes past the brackets that close what is open.
  Status skip_balanced() {
    for (std::uint64_t depth = 1; depth > 0;) {
      const int next = source_->peek();
      if (next < 0) return expected("')'");
      if (next == '(') ++depth;
      if (next == ')') --depth;
      source_->skip();
    }
    return success();
  }

  const std::shared_ptr<TextSource> source_;
  const bool loose_;
  Document<Feature>* dataset_ = nullptr;  ///< that is being filled
  std::uint64_t feature_ = 0;
  std::uint64_t others_ = 0;
  bool polygons_ = false;  ///< whether there was one
  std::optional<int> srid_;
};

bool begins_like_wkt(std::string_view text) {
  std::string word;
  for (const char c : text) {
    if (!is_letter(c)) {
      if (word.empty() && std::isspace(static_cast<unsigned char>(c))) continue;
      if (word == "SRID") return c == '=';
      break;
    }
    word.push_back(upper(c));
  }
  return kind_of(without_dimension(word)) != Kind::unknown;
}

Result<std::unique_ptr<FeatureReader>> open_wkt(const Input& input, const ReadOptions& options) {
  return std::unique_ptr<FeatureReader>(new WktReader(input.source, options.loose));
}

Result<Document<Feature>> read_wkt(const Input& input, const ReadOptions& options) {
  WktReader reader(input.source, options.loose);
  auto document = read_to_end(reader);
  if (document && document->items.empty())  // it may have been cut off
    return input.source->error(ErrorCode::empty, "there is no geometry");
  return document;
}

// Writing.

/// What put(element) writes for each element, in brackets: (a, b).
template <class Range, class Put>
void put_bracketed(OutputStream& out, const Range& range, const Put& put) {
  const char* separator = "(";
  for (const auto& element : range) {
    out.put(separator);
    separator = ", ";
    put(element);
  }
  out.put(')');
}

/// Points in their places of the output.
void put_placed(Target& target, std::vector<Vec2> points) {
  target.place(points);
  put_wkt_points(*target.out, points);
}

/// A MULTILINESTRING of branches per item.
Status write_wkt(Target& target, const AxesOutput& output) {
  for (const AxisItem& item : output.document.items) {
    const auto all = branches(item.axis);
    target.out->put(all.empty() ? "MULTILINESTRING EMPTY\n" : "MULTILINESTRING ");
    if (all.empty()) continue;
    const double chord = chord_of(item, output.options);
    std::vector<Vec2> line;
    put_bracketed(*target.out, all, [&](const Branch& branch) {
      line_of(item.axis, branch, chord, output.options.simplify, line);
      put_placed(target, line);
    });
    target.out->put('\n');
  }
  return success();
}

/// Polygons, each a list of rings. Circular strings do not survive a projection: of longitudes and
/// latitudes there are chords.
void put_polygons(Target& target, const std::vector<std::vector<Ring>>& polygons, bool curved,
                  bool single, double chord) {
  OutputStream& out = *target.out;
  const auto put_polygon = [&](const std::vector<Ring>& polygon) {
    if (curved) out.put("CURVEPOLYGON ");
    put_bracketed(out, polygon, [&](const Ring& ring) {
      curved ? put_wkt_curve(out, ring) : put_placed(target, chords_of(ring, chord));
    });
  };
  if (single) {
    if (!curved) out.put("POLYGON ");
    put_polygon(polygons[0]);
  } else {
    out.put(curved ? "MULTISURFACE " : "MULTIPOLYGON ");
    put_bracketed(out, polygons, put_polygon);
  }
  out.put('\n');
}

Status write_wkt(Target& target, const ShapesOutput& output) {
  for (const ShapeItem& item : output.document.items) {
    const auto parts = polygons_of(item.shape);
    if (parts.empty())
      target.out->put("POLYGON EMPTY\n");
    else
      put_polygons(target, parts, has_arcs(item.shape) && !target.crs.changes_points(),
                   parts.size() == 1, chord_of(item, output.options));
  }
  return success();
}

/// The regions of each clearance of an item.
Status write_wkt(Target& target, const OffsetsOutput& output) {
  const bool curved = !output.options.chords && !target.crs.changes_points();
  for (const OffsetItem& item : output.document.items) {
    const auto& regions = item.offsets.regions;
    const double chord = chord_of(item, output.options);
    for (std::size_t begin = 0, end = 0; begin < regions.size(); begin = end) {
      std::vector<std::vector<Ring>> level;
      for (; end < regions.size() && regions[end].clearance == regions[begin].clearance; ++end)
        level.push_back(regions[end].rings);
      put_polygons(target, level, curved, false, chord);
    }
  }
  return success();
}

/// A polygon for each face, in the order of the sites.
Status write_wkt(Target& target, const VoronoiOutput& output) {
  for (const VoronoiItem& item : output.document.items) {
    const double chord = chord_of(item, output.options);
    for (std::uint32_t k = 0; k < item.diagram.sites.size(); ++k) {
      std::vector<Vec2> ring = ring_of_face(item.diagram, k, chord);
      target.out->put(ring.empty() ? "POLYGON EMPTY\n" : "POLYGON (");
      if (ring.empty()) continue;
      put_placed(target, std::move(ring));
      target.out->put(")\n");
    }
  }
  return success();
}

Status write_wkt(Target& target, const LayersOutput& output) {
  OutputStream& out = *target.out;
  for (const Layer& layer : output.document.items) {
    const bool polygons = layer.kind == LayerKind::polygons;
    for (const LayerFeature& feature : layer.features) {
      if (!polygons) {
        out.put(layer.kind == LayerKind::disks ? "POINT " : "LINESTRING ");
        put_placed(target, feature.parts[0]);
      } else {
        out.put("POLYGON ");
        put_bracketed(out, feature.parts, [&](std::vector<Vec2> ring) {
          if (ring.front() != ring.back()) ring.push_back(ring.front());
          put_placed(target, std::move(ring));
        });
      }
      out.put('\n');
    }
  }
  return success();
}

}  // namespace

Format wkt_format() {
  Format format{".wkt"};
  format.read = read_wkt;
  format.open = open_wkt;
  format.sniff = begins_like_wkt;
  format.geographic = format.in_parts = true;
  return format.writes<AxesOutput, ShapesOutput, OffsetsOutput, VoronoiOutput, LayersOutput>(
      write_wkt, write_wkt, write_wkt, write_wkt, write_wkt);
}

}  // namespace medial::io
