#include "io/text_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

#include "io/gdal_support.h"

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
  curved,
  point,
  multipoint,
  line,
  multiline,
  curve,  ///< open, with arcs
  other
};

Kind kind_of(std::string_view name) {
  if (name == "POLYGON") return Kind::polygon;
  if (name == "MULTIPOLYGON") return Kind::multipolygon;
  if (name == "GEOMETRYCOLLECTION") return Kind::collection;
  constexpr std::array<std::string_view, 3> curved{"CURVEPOLYGON", "MULTISURFACE", "TRIANGLE"};
  if (std::ranges::find(curved, name) != curved.end()) return Kind::curved;
  if (name == "POINT") return Kind::point;
  if (name == "MULTIPOINT") return Kind::multipoint;
  if (name == "LINESTRING" || name == "LINEARRING") return Kind::line;
  if (name == "MULTILINESTRING") return Kind::multiline;
  if (name == "CIRCULARSTRING" || name == "COMPOUNDCURVE" || name == "MULTICURVE")
    return Kind::curve;
  constexpr std::array<std::string_view, 2> other{"TIN", "POLYHEDRALSURFACE"};
  if (std::ranges::find(other, name) != other.end()) return Kind::other;
  return Kind::unknown;
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

class WktReader {
 public:
  WktReader(TextSource& source, bool loose) : source_(source), loose_(loose) {}

  Result<Document<Feature>> read() {
    for (;;) {
      skip_separators();
      if (source_.peek() < 0) break;
      Feature feature;
      feature.id = static_cast<std::int64_t>(feature_);
      if (Status status = read_feature(feature); !status) return located(status.error());
      dataset_.items.push_back(std::move(feature));
      ++feature_;
    }
    if (source_.failure()) return *source_.failure();
    if (others_ > 0) {
      const bool polygons = std::ranges::any_of(dataset_.items, [](const Feature& feature) {
        return !feature.rings.empty() || !feature.chains.empty();
      });
      if (!polygons) {
        return Error{ErrorCode::unsupported,
                     fmt::format("no polygons, only other geometries ({} of them)", others_),
                     {}};
      }
      dataset_.notes.push_back(
          fmt::format("{} geometries are no polygons and were left out", others_));
    }
    return std::move(dataset_);
  }

 private:
  Error located(Error error) const {
    error.place.feature = feature_;
    return error;
  }

  static Error at_vertex(Error error, std::size_t vertex) {
    error.place.vertex = vertex;
    return error;
  }

  Error expected(std::string_view what) {
    const std::string found = source_.next_as_text();
    return source_.error(ErrorCode::malformed,
                         fmt::format("expected {} but found {}", what, found));
  }

  void skip_separators() {
    for (source_.skip_space(); source_.peek() == ';'; source_.skip_space()) source_.skip();
  }

  /// Goes past `c` if it is next, after blanks.
  bool accept(char c) {
    source_.skip_space();
    if (source_.peek() != c) return false;
    source_.skip();
    return true;
  }

  /// A word in capitals; empty if there is none.
  std::string read_word() {
    source_.skip_space();
    std::string word;
    while (word.size() < longest_word && is_letter(source_.peek())) {
      word.push_back(upper(source_.peek()));
      source_.skip();
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

  Status read_srid() {
    source_.skip();  // '='
    double code = 0;
    source_.skip_space();
    constexpr int largest = std::numeric_limits<int>::max();
    if (source_.read_number(code) != TextSource::Number::read || !(code >= 0 && code <= largest) ||
        code != std::floor(code)) {
      return expected("a whole number after SRID=");
    }
    if (!accept(';')) return expected("';' after the SRID");
    if (srid_ && *srid_ != static_cast<int>(code)) {
      return source_.error(ErrorCode::unsupported, "two coordinate reference systems in one file");
    }
    if (!srid_) {
      srid_ = static_cast<int>(code);
      read_crs_of_epsg(*srid_, dataset_);
    }
    return success();
  }

  Status read_feature(Feature& feature) {
    std::uint64_t depth = 0;  // of collections: a number instead of recursion
    for (;;) {
      std::string name = read_word();
      if (name == "SRID" && depth == 0 && source_.peek() == '=') {
        if (Status status = read_srid(); !status) return status;
        name = read_word();
      }
      name = without_dimension(name);
      const Kind kind = kind_of(name);
      if (kind == Kind::unknown) {
        if (name.empty()) return expected("the name of a geometry");
        return source_.error(ErrorCode::malformed, fmt::format("'{}' names no geometry", name));
      }
      Result<bool> body = open_body();
      if (!body) return body.error();
      if (*body && kind == Kind::collection) {
        ++depth;
        continue;
      }
      if (*body) {
        if (Status status = read_body(kind, name, feature); !status) return status;
      }
      while (depth > 0 && !accept(',')) {
        if (!accept(')')) return expected("',' or ')'");
        --depth;
      }
      if (depth == 0) return success();
    }
  }

  /// Points and lines for a planar graph.
  Status read_loose(Kind kind, const std::string& name, Feature& feature) {
    const auto add_line = [&]() -> Status {
      Chain chain;
      Status status = read_points(chain.points);
      if (status) feature.chains.push_back(std::move(chain));
      return status;
    };
    if (kind == Kind::point || kind == Kind::line) return add_line();
    if (kind == Kind::curve) {
      std::string text = name + "(";
      if (Status status = read_balanced(&text); !status) return status;
      Status status = add_chains_of_wkt(text, feature.chains);
      if (!status) return source_.error(status.error().code, status.error().text);
      return status;
    }
    source_.skip_space();
    if (kind == Kind::multipoint && source_.peek() != '(' && !is_letter(source_.peek())) {
      std::vector<Vec2> points;  // without brackets of their own
      Status status = read_points(points);
      for (const Vec2 p : points) feature.chains.push_back({{p}});
      return status;
    }
    do {
      Result<bool> body = open_body();
      if (!body) return body.error();
      if (!*body) continue;
      if (Status status = add_line(); !status) return status;
    } while (accept(','));
    return accept(')') ? success() : Status(expected("',' or ')'"));
  }

  Status read_body(Kind kind, const std::string& name, Feature& feature) {
    if (loose_ && (kind == Kind::point || kind == Kind::multipoint || kind == Kind::line ||
                   kind == Kind::multiline || kind == Kind::curve))
      return read_loose(kind, name, feature);
    switch (kind) {
      case Kind::polygon:
        return read_polygon(feature.rings);
      case Kind::multipolygon:
        do {
          Result<bool> body = open_body();
          if (!body) return body.error();
          if (!*body) continue;
          if (Status status = read_polygon(feature.rings); !status) return status;
        } while (accept(','));
        return accept(')') ? success() : Status(expected("',' or ')'"));
      case Kind::curved: {
        std::string text = name + "(";
        if (Status status = read_balanced(&text); !status) return status;
        Status status = add_rings_of_wkt(text, feature.rings);
        if (!status) return source_.error(status.error().code, status.error().text);
        return status;
      }
      default:
        ++others_;
        return read_balanced(nullptr);
    }
  }

  /// Reads "ring, ring, ...)": the outer ring and its holes.
  Status read_polygon(std::vector<Ring>& rings) {
    RingRole role = RingRole::outer;
    do {
      Result<bool> body = open_body();
      if (!body) return body.error();
      if (!*body) continue;
      Ring& ring = rings.emplace_back();
      ring.role = role;
      role = RingRole::hole;
      if (Status status = read_points(ring.points); !status) {
        if (status.error().place.vertex) status.error().place.ring = rings.size() - 1;
        return status;
      }
    } while (accept(','));
    return accept(')') ? success() : Status(expected("',' or ')'"));
  }

  /// Reads "x y, x y, ...)".
  Status read_points(std::vector<Vec2>& points) {
    for (;;) {
      std::array<double, 4> ordinates{};
      std::size_t count = 0;
      int next = 0;
      do {
        source_.skip_space();
        if (count == ordinates.size()) return expected("',' or ')' after four numbers");
        switch (source_.read_number(ordinates[count])) {
          case TextSource::Number::read:
            break;
          case TextSource::Number::none:
            return expected("a number");
          case TextSource::Number::not_finite:
            return at_vertex(source_.error(ErrorCode::not_finite,
                                           count < 2 ? "a coordinate is not a finite number"
                                                     : "an ordinate is not a finite number"),
                             points.size());
          case TextSource::Number::too_long:
            return source_.error(ErrorCode::malformed, "a number is too long");
        }
        ++count;
        next = source_.peek();
        if (next > ' ' && next != ',' && next != ')') return expected("a blank, ',' or ')'");
        source_.skip_space();
        next = source_.peek();
      } while (next != ',' && next != ')');
      if (count < 2) return expected("a second coordinate");
      points.push_back({ordinates[0], ordinates[1]});
      source_.skip();
      if (next == ')') return success();
    }
  }

  /// Goes past the brackets that close what is open, and keeps the text if told to.
  Status read_balanced(std::string* text) {
    for (std::uint64_t depth = 1; depth > 0;) {
      const int next = source_.peek();
      if (next < 0) return expected("')'");
      if (next == '(') ++depth;
      if (next == ')') --depth;
      if (text != nullptr) text->push_back(static_cast<char>(next));
      source_.skip();
    }
    return success();
  }

  TextSource& source_;
  const bool loose_;
  Document<Feature> dataset_;
  std::uint64_t feature_ = 0;
  std::uint64_t others_ = 0;
  std::optional<int> srid_;
};

/// One line of plain text.
enum class Line : std::uint8_t { vertex, separator };

void skip_blanks(TextSource& source) {
  for (int c = source.peek(); c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\r';
       c = source.peek()) {
    source.skip();
  }
}

void skip_rest_of_line(TextSource& source) {
  for (int c = source.peek(); c >= 0 && c != '\n'; c = source.peek()) source.skip();
}

Result<double> read_coordinate(TextSource& source) {
  double value = 0;
  switch (source.read_number(value)) {
    case TextSource::Number::read:
      return value;
    case TextSource::Number::not_finite:
      return source.error(ErrorCode::not_finite, "a coordinate is not a finite number");
    case TextSource::Number::too_long:
      return source.error(ErrorCode::malformed, "a number is too long");
    default:
      break;
  }
  const std::string found = source.next_as_text();
  return source.error(ErrorCode::malformed, fmt::format("expected a number but found {}", found));
}

bool is_number_begin(char c) {
  return std::string_view("0123456789+-.").find(c) != std::string_view::npos;
}

/// The words of a line, between blanks, commas and semicolons.
std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view between = " \t\r,;\"";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(between); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(between, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(between, end);
  }
  return words;
}

/// The length of a first line that names two columns ("x,y") of numbers, with its end; 0 where
/// there is none.
std::size_t length_of_names(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return 0;
  const std::vector<std::string_view> words = words_of(text.substr(0, end));
  const bool named = words.size() == 2 && is_letter(words[0][0]) && is_letter(words[1][0]);
  const std::size_t next = text.find_first_not_of(" \t\r\n", end);
  return named && next != std::string_view::npos && is_number_begin(text[next]) ? end + 1 : 0;
}

/// Reads a line, but not its end. Requires that the text has not ended.
Result<Line> read_line(TextSource& source, Vec2& vertex) {
  skip_blanks(source);
  int next = source.peek();
  if (next < 0 || next == '\n' || next == '#') {
    skip_rest_of_line(source);
    return Line::separator;
  }
  Result<double> x = read_coordinate(source);
  if (!x) return x.error();
  next = source.peek();
  const bool blank = next == ' ' || next == '\t';
  skip_blanks(source);
  next = source.peek();
  if (next == ',' || next == ';') {
    source.skip();
    skip_blanks(source);
  } else if (!blank) {
    const std::string found = source.next_as_text();
    return source.error(ErrorCode::malformed,
                        fmt::format("expected a blank or ',' but found {}", found));
  }
  Result<double> y = read_coordinate(source);
  if (!y) return y.error();
  skip_blanks(source);
  next = source.peek();
  if (next == '#') skip_rest_of_line(source);
  if (next >= 0 && next != '\n' && next != '#') {
    const std::string found = source.next_as_text();
    return source.error(ErrorCode::malformed,
                        fmt::format("expected the end of the line but found {}", found));
  }
  vertex = {*x, *y};
  return Line::vertex;
}

}  // namespace

Result<Document<Feature>> read_wkt(TextSource& source, bool loose) {
  return WktReader(source, loose).read();
}

Result<Document<Feature>> read_xy(TextSource& source, bool loose) {
  Document<Feature> dataset;
  Feature feature;
  bool in_ring = false;
  constexpr std::size_t longest_header = 4096;
  for (std::size_t left = length_of_names(source.lookahead(longest_header)); left > 0; --left)
    source.skip();
  while (source.peek() >= 0) {
    Vec2 vertex;
    Result<Line> line = read_line(source, vertex);
    if (!line) {
      Error error = line.error();
      if (error.code == ErrorCode::not_finite) {
        error.place.ring = feature.rings.size() - (in_ring ? 1 : 0);
        error.place.vertex = in_ring ? feature.rings.back().points.size() : 0;
      }
      return error;
    }
    if (*line == Line::vertex) {
      if (!in_ring) feature.rings.emplace_back();
      feature.rings.back().points.push_back(vertex);
    }
    in_ring = *line == Line::vertex;
    if (source.peek() >= 0) source.skip();
  }
  if (source.failure()) return *source.failure();
  if (loose) {
    const bool list = feature.rings.size() == 1;
    for (Ring& ring : feature.rings) {
      if (!list)
        feature.chains.push_back({std::move(ring.points)});
      else
        for (const Vec2 p : ring.points) feature.chains.push_back({{p}});
    }
    feature.rings.clear();
  }
  dataset.items.push_back(std::move(feature));
  return dataset;
}

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

bool begins_like_xy(std::string_view text) {
  if (length_of_names(text) > 0) return true;
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && (is_number_begin(text[start]) || text[start] == '#');
}

bool has_two_columns(std::string_view text) {
  if (length_of_names(text) > 0) return true;
  const std::string_view line = text.substr(0, text.find('\n'));
  const auto words = words_of(line);
  return words.size() == 2 && is_number_begin(words[0][0]) && is_number_begin(words[1][0]);
}

}  // namespace medial::io
