// Meshes as tables of vertices and faces: PLY and OFF. Assimp reads both as well, but crashes on
// damaged ones, and it holds coordinates in single precision.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/predicates.h"
#include "base/vec3.h"
#include "io/formats/meshes.h"
#include "shape/limits.h"

namespace medial::io {
namespace {

/// No table is allotted for more items than this before they are read.
constexpr std::uint64_t most_reserved = std::uint64_t{1} << 16U;
constexpr std::uint64_t most_items = std::uint64_t{1} << 31U;
/// Cutting a polygon takes time in the square of its corners.
constexpr std::uint64_t most_corners = 1024;

// ---- Polygons.

/// What a file holds: vertices, and polygons one after the other.
struct Polygons {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> sides;  ///< of each polygon
};

/// A polygon in the plane of two coordinates in which it is largest, counter-clockwise.
std::vector<Vec2> flattened(const std::vector<Vec3>& vertices,
                            const std::vector<std::uint32_t>& corners) {
  Vec3 normal;
  const Vec3 origin = vertices[corners[0]];
  for (std::size_t i = 2; i < corners.size(); ++i)
    normal = normal + cross(vertices[corners[i - 1]] - origin, vertices[corners[i]] - origin);
  int across = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(normal[axis]) > std::abs(normal[across])) across = axis;
  int u = (across + 1) % 3, v = (across + 2) % 3;
  if (normal[across] < 0) std::swap(u, v);
  std::vector<Vec2> points;
  for (const std::uint32_t corner : corners)
    points.push_back({vertices[corner][u], vertices[corner][v]});
  return points;
}

/// Cuts a polygon of more than three corners into triangles, ear by ear. Cutting an ear off makes
/// ears of its neighbours only, where a polygon does not cross or touch itself; others are looked
/// through again some times, then cut anyhow. O(n^2).
class EarCutter {
 public:
  EarCutter(const std::vector<Vec3>& vertices, const std::vector<std::uint32_t>& corners)
      : points_(flattened(vertices, corners)), next_(points_.size()), before_(points_.size()) {
    const std::size_t n = points_.size();
    for (std::size_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      before_[i] = (i + n - 1) % n;
    }
  }

  void cut(const std::vector<std::uint32_t>& corners,
           std::vector<std::array<std::uint32_t, 3>>& faces) {
    int searches = 8;
    std::vector<bool> ears(points_.size(), false);
    std::size_t at = 0;
    for (std::size_t left = points_.size(); left >= 3; --left) {
      const auto go_to_ear = [&] {
        for (std::size_t steps = 0; steps < left && !ears[at]; ++steps) at = next_[at];
        return ears[at];
      };
      if (!go_to_ear() && searches > 0) {
        --searches;
        for (std::size_t steps = 0; steps < left; ++steps, at = next_[at]) ears[at] = is_ear(at);
        go_to_ear();
      }
      const std::size_t last = before_[at], on = next_[at];
      faces.push_back({corners[last], corners[at], corners[on]});
      next_[last] = on;
      before_[on] = last;
      ears[last] = is_ear(last);
      ears[on] = is_ear(on);
      at = on;
    }
  }

 private:
  bool is_ear(std::size_t i) const {
    const std::size_t last = before_[i], on = next_[i];
    const Vec2 a = points_[last], b = points_[i], c = points_[on];
    if (orientation(a, b, c) <= 0) return false;
    for (std::size_t k = next_[on]; k != last; k = next_[k]) {
      const Vec2 p = points_[k];
      if (orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0)
        return false;
    }
    return true;
  }

  std::vector<Vec2> points_;
  std::vector<std::size_t> next_, before_;  ///< of the corners that are left
};

Result<TriangleMesh> mesh_of(Polygons table, const TextSource& source) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> polygon;
  auto corner = table.corners.begin();
  for (std::size_t i = 0; i < table.sides.size(); ++i) {
    polygon.assign(corner, corner + table.sides[i]);
    corner += table.sides[i];
    for (const std::uint32_t index : polygon) {
      if (index < table.vertices.size()) continue;
      return source.error(
          ErrorCode::malformed,
          fmt::format("face {} refers to a vertex that does not exist: {}", i, index));
    }
    if (polygon.size() == 3) mesh.faces.push_back({polygon[0], polygon[1], polygon[2]});
    if (polygon.size() <= 3) continue;
    // No mesh with such coordinates becomes a solid, and deciding on them takes long.
    for (const std::uint32_t index : polygon)
      for (int axis = 0; axis < 3; ++axis)
        if (!is_within_limits(table.vertices[index][axis]))
          return source.error(ErrorCode::unsupported,
                              fmt::format("face {} has a coordinate beyond 1e100 in size, or below "
                                          "1e-100",
                                          i));
    EarCutter(table.vertices, polygon).cut(polygon, mesh.faces);
  }
  if (mesh.faces.empty()) return source.error(ErrorCode::empty, "holds no face");
  mesh.vertices = std::move(table.vertices);
  return mesh;
}

// ---- Text.

Error expected(TextSource& source, const char* what) {
  const std::string found = source.next_as_text();
  return source.error(ErrorCode::malformed, fmt::format("expected {}, found {}", what, found));
}

Result<double> read_value(TextSource& source, const char* what) {
  double value = 0;
  switch (source.read_number(value)) {
    case TextSource::Number::read:
      return value;
    case TextSource::Number::not_finite:
      return source.error(ErrorCode::not_finite, fmt::format("{} is not finite", what));
    default:
      return expected(source, what);
  }
}

/// A number as a count or an index below 2^31.
Result<std::uint32_t> whole(double value, const TextSource& source, const char* what) {
  if (!(value >= 0 && value < static_cast<double>(most_items)) || value != std::floor(value))
    return source.error(ErrorCode::malformed,
                        fmt::format("{} is not a whole number below 2^31", what));
  return static_cast<std::uint32_t>(value);
}

Result<std::uint32_t> read_whole(TextSource& source, const char* what) {
  auto value = read_value(source, what);
  if (!value) return std::move(value).error();
  return whole(*value, source, what);
}

/// The rest of a line, without its end, at most `most` characters of it.
std::string rest_of_line(TextSource& source) {
  constexpr std::size_t most = 4096;
  std::string line;
  for (int c = source.peek(); c >= 0 && c != '\n'; c = source.peek()) {
    if (c != '\r' && line.size() < most) line += static_cast<char>(c);
    source.skip();
  }
  if (source.peek() == '\n') source.skip();
  return line;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream words(line);
  return {std::istream_iterator<std::string>(words), {}};
}

// ---- PLY.

enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
  std::string name;
  Type type = Type::float32;
  Type count = Type::uint8;
  bool list = false;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  explicit PlyReader(TextSource& source) : source_(source) {}

  Result<TriangleMesh> read() {
    if (Status status = read_header(); !status) return status.error();
    for (const Element& element : elements_) {
      // Without properties there is nothing to read, however many there are.
      if (element.properties.empty()) continue;
      const std::uint64_t some = std::min(element.count, most_reserved);
      if (element.name == "vertex") table_.vertices.reserve(some);
      if (element.name == "face") table_.sides.reserve(some);
      for (std::uint64_t i = 0; i < element.count; ++i)
        if (Status status = read_item(element); !status) return status.error();
    }
    return mesh_of(std::move(table_), source_);
  }

 private:
  enum class Form : std::uint8_t { text, little_endian, big_endian };

  Error malformed(const std::string& text) const {
    return source_.error(ErrorCode::malformed, text);
  }

  static std::optional<Type> type_of(const std::string& name) {
    constexpr std::array<std::array<std::string_view, 2>, 8> names{{{"char", "int8"},
                                                                    {"uchar", "uint8"},
                                                                    {"short", "int16"},
                                                                    {"ushort", "uint16"},
                                                                    {"int", "int32"},
                                                                    {"uint", "uint32"},
                                                                    {"float", "float32"},
                                                                    {"double", "float64"}}};
    for (std::size_t i = 0; i < names.size(); ++i)
      if (name == names[i][0] || name == names[i][1]) return static_cast<Type>(i);
    return std::nullopt;
  }

  Status read_header() {
    if (rest_of_line(source_) != "ply") return malformed("a PLY file begins with 'ply'");
    bool has_format = false;
    for (;;) {
      if (source_.peek() < 0) return malformed("the header has no end");
      const std::vector<std::string> words = words_of(rest_of_line(source_));
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format" && words.size() == 3) {
        if (words[1] != "ascii" && words[1] != "binary_little_endian" &&
            words[1] != "binary_big_endian")
          return malformed("an unknown format of PLY");
        form_ = words[1] == "ascii"                  ? Form::text
                : words[1] == "binary_little_endian" ? Form::little_endian
                                                     : Form::big_endian;
        has_format = true;
      } else if (words[0] == "element" && words.size() == 3) {
        Element& element = elements_.emplace_back();
        element.name = words[1];
        const std::string& digits = words[2];
        if (digits.size() > 10 || digits.find_first_not_of("0123456789") != std::string::npos)
          return malformed("a count in the header is not a number below 2^31");
        element.count = std::stoull(digits);
        if (element.count >= most_items)
          return malformed("a count in the header is not a number below 2^31");
      } else if (words[0] == "property" && !elements_.empty()) {
        Property property;
        property.list = words.size() == 5 && words[1] == "list";
        if (words.size() != 3 && !property.list)
          return malformed("a property without a type and a name");
        const auto type = type_of(words[words.size() - 2]);
        const auto count = property.list ? type_of(words[2]) : Type::uint8;
        if (!type || !count) return malformed("a property of an unknown type");
        property.name = words.back();
        property.type = *type;
        property.count = *count;
        elements_.back().properties.push_back(property);
      } else {
        return malformed("a line of the header that PLY does not have");
      }
    }
    if (!has_format) return malformed("the header does not name the format");
    return success();
  }

  template <class T>
  static double as(const std::array<char, 8>& bytes) {
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return static_cast<double>(value);
  }

  Result<double> read_number(Type type) {
    if (form_ == Form::text) {
      source_.skip_space();
      return read_value(source_, "a number");
    }
    constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
    const std::size_t size = sizes[static_cast<std::size_t>(type)];
    const std::string_view ahead = source_.lookahead(size);
    if (ahead.size() < size) return malformed("the file ends too early");
    std::array<char, 8> bytes{};
    const bool same =
        (form_ == Form::little_endian) == (std::endian::native == std::endian::little);
    if (same)
      std::copy(ahead.begin(), ahead.end(), bytes.begin());
    else
      std::reverse_copy(ahead.begin(), ahead.end(), bytes.begin());
    for (std::size_t i = 0; i < size; ++i) source_.skip();
    switch (type) {
      case Type::int8:
        return as<std::int8_t>(bytes);
      case Type::uint8:
        return as<std::uint8_t>(bytes);
      case Type::int16:
        return as<std::int16_t>(bytes);
      case Type::uint16:
        return as<std::uint16_t>(bytes);
      case Type::int32:
        return as<std::int32_t>(bytes);
      case Type::uint32:
        return as<std::uint32_t>(bytes);
      case Type::float32:
        return as<float>(bytes);
      case Type::float64:
        break;
    }
    return as<double>(bytes);
  }

  Status read_item(const Element& element) {
    Vec3 point;
    const bool vertex = element.name == "vertex", face = element.name == "face";
    for (const Property& property : element.properties) {
      const auto number = read_number(property.list ? property.count : property.type);
      if (!number) return number.error();
      if (!property.list) {
        for (int axis = 0; axis < 3; ++axis) {
          if (!vertex || property.name != std::string(1, static_cast<char>('x' + axis))) continue;
          if (!std::isfinite(*number))
            return source_.error(ErrorCode::not_finite, "a coordinate is not finite");
          point[axis] = *number;
        }
        continue;
      }
      const auto count = whole(*number, source_, "the length of a list");
      if (!count) return count.error();
      const bool corners =
          face && (property.name == "vertex_indices" || property.name == "vertex_index");
      if (corners && *count > most_corners)
        return source_.error(ErrorCode::unsupported, "a face has more than 1024 corners");
      for (std::uint32_t k = 0; k < *count; ++k) {
        const auto value = read_number(property.type);
        if (!value) return value.error();
        if (!corners) continue;
        const auto index = whole(*value, source_, "the index of a vertex");
        if (!index) return index.error();
        table_.corners.push_back(*index);
      }
      if (corners) table_.sides.push_back(*count);
    }
    if (vertex) table_.vertices.push_back(point);
    return success();
  }

  TextSource& source_;
  Form form_ = Form::text;
  std::vector<Element> elements_;
  Polygons table_;
};

// ---- OFF.

/// Past blanks, ends of lines and comments.
void skip_to_token(TextSource& source) {
  for (source.skip_space(); source.peek() == '#'; source.skip_space()) rest_of_line(source);
}

/// Whether that is [ST][C][N]OFF.
bool is_plain_off(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  return word == "OFF";
}

/// An OFF file, text, with or without colours and normals, which are passed over. Unsupported are
/// binary ones and those of other dimensions.
Result<TriangleMesh> read_off(const Input& input) {
  TextSource& source = *input.source;
  constexpr std::size_t longest_word = 8;
  skip_to_token(source);
  std::string word;
  for (int c = source.peek(); c > ' ' && word.size() < longest_word; c = source.peek()) {
    word += static_cast<char>(c);
    source.skip();
  }
  if (!is_plain_off(word)) {
    if (word.ends_with("OFF"))
      return source.error(ErrorCode::unsupported, "an OFF file that is not in three dimensions");
    return source.error(ErrorCode::malformed, "an OFF file begins with 'OFF'");
  }
  skip_to_token(source);
  if (source.peek() == 'B')
    return source.error(ErrorCode::unsupported, "a binary OFF file; text is read");
  std::array<std::uint32_t, 2> counts = {};  // a third one, of edges, is of no use
  for (std::uint32_t& count : counts) {
    skip_to_token(source);
    const auto value = read_whole(source, "a count");
    if (!value) return value.error();
    count = *value;
  }
  rest_of_line(source);
  Polygons table;
  table.vertices.reserve(std::min<std::uint64_t>(counts[0], most_reserved));
  table.sides.reserve(std::min<std::uint64_t>(counts[1], most_reserved));
  for (std::uint32_t i = 0; i < counts[0]; ++i) {
    Vec3& point = table.vertices.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      skip_to_token(source);
      const auto value = read_value(source, "a coordinate");
      if (!value) return value.error();
      point[axis] = *value;
    }
    rest_of_line(source);  // colours, normals
  }
  for (std::uint32_t i = 0; i < counts[1]; ++i) {
    skip_to_token(source);
    const auto count = read_whole(source, "the number of a face's corners");
    if (!count) return count.error();
    if (*count > most_corners)
      return source.error(ErrorCode::unsupported, "a face has more than 1024 corners");
    for (std::uint32_t k = 0; k < *count; ++k) {
      skip_to_token(source);
      const auto index = read_whole(source, "the index of a vertex");
      if (!index) return index.error();
      table.corners.push_back(*index);
    }
    table.sides.push_back(*count);
    rest_of_line(source);
  }
  return mesh_of(std::move(table), source);
}

}  // namespace

Result<TriangleMesh> read_ply(const Input& input) { return PlyReader(*input.source).read(); }

Format off_format() {
  Format format{".off"};
  format.read_mesh = read_off;
  return format;
}

}  // namespace medial::io
