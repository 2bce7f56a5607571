// Plain text: the coordinates of a vertex per line.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "io/coordinate_names.h"
#include "io/format_name.h"
#include "io/formats/text.h"

namespace medial::io {

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// One line of plain text.
enum class Line : std::uint8_t { vertex, separator };

Error instead_of(TextSource& source, const char* what) {
  const std::string found = source.next_as_text();
  return source.error(ErrorCode::malformed, fmt::format("expected {} but found {}", what, found));
}

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
  return instead_of(source, "a number");
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

/// A first line that names two columns ("x,y") of numbers.
struct Names {
  std::size_t length = 0;  ///< with the end of the line; 0 where there is no such line
  std::string first, second;
};

Names names_of(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return {};
  const std::vector<std::string_view> words = words_of(text.substr(0, end));
  const bool named = words.size() == 2 && is_letter(words[0][0]) && is_letter(words[1][0]);
  const std::size_t next = text.find_first_not_of(" \t\r\n", end);
  if (!named || next == std::string_view::npos) return {};
  const auto values = words_of(text.substr(next, text.find('\n', next) - next));
  if (values.size() < 2 || !is_number_begin(values[0][0]) || !is_number_begin(values[1][0]))
    return {};
  return {end + 1, std::string(words[0]), std::string(words[1])};
}

bool is_one_of(const std::string& name, std::string_view names) {
  return std::ranges::count(words_of(names), std::string_view(lower_case(name))) > 0;
}

/// Passes over a first line of names. Returns whether the first column holds y, and adds a note
/// where the names do not say which does.
bool read_names(TextSource& source, std::vector<std::string>& notes) {
  constexpr std::size_t longest = 4096;
  const auto [length, first, second] = names_of(source.lookahead(longest));
  for (std::size_t left = length; left > 0; --left) source.skip();
  const bool y_first = is_one_of(first, y_names) && is_one_of(second, x_names);
  const bool x_first = is_one_of(first, x_names) && is_one_of(second, y_names);
  if (length > 0 && !y_first && !x_first)
    notes.push_back(fmt::format("the columns '{}' and '{}' were taken as x and y", first, second));
  return y_first;
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
    return instead_of(source, "a blank or ','");
  }
  Result<double> y = read_coordinate(source);
  if (!y) return y.error();
  skip_blanks(source);
  next = source.peek();
  if (next == '#') skip_rest_of_line(source);
  if (next >= 0 && next != '\n' && next != '#') return instead_of(source, "the end of the line");
  vertex = {*x, *y};
  return Line::vertex;
}

}  // namespace

Result<Document<Feature>> read_xy(TextSource& source, bool loose) {
  Document<Feature> dataset;
  Feature feature;
  bool in_ring = false;
  const bool y_first = read_names(source, dataset.notes);
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
      if (y_first) std::swap(vertex.x, vertex.y);
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

bool begins_like_xy(std::string_view text) {
  if (names_of(text).length > 0) return true;
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && (is_number_begin(text[start]) || text[start] == '#');
}

bool has_two_columns(std::string_view text) {
  if (names_of(text).length > 0) return true;
  const std::string_view line = text.substr(0, text.find('\n'));
  const auto words = words_of(line);
  return words.size() == 2 && is_number_begin(words[0][0]) && is_number_begin(words[1][0]);
}

}  // namespace medial::io
