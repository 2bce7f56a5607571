#include "io/formats/dxf_text.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace medial::io {

namespace {

constexpr std::size_t longest_drawing = std::size_t{1} << 32U;  // bytes
constexpr std::size_t longest_line = 256;  // what is kept of a text; dxflib stops at 1,024
constexpr std::array<std::string_view, 9> structure{
    "SECTION", "ENDSEC", "TABLE", "ENDTAB", "LAYER", "BLOCK", "ENDBLK", "SEQEND", "VERTEX"};
constexpr std::array<std::string_view, 9> entities{
    "POINT", "LINE", "ARC", "CIRCLE", "ELLIPSE", "POLYLINE", "SPLINE", "INSERT", "LWPOLYLINE"};
constexpr std::array<std::string_view, 3> sections{"TABLES", "BLOCKS", "ENTITIES"};

template <class List>
bool lists(const List& list, std::string_view word) {
  return std::ranges::find(list, word) != list.end();
}

std::string_view trimmed_line(std::string_view text) {
  const auto space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && space(text.front())) text.remove_prefix(1);
  while (!text.empty() && space(text.back())) text.remove_suffix(1);
  return text;
}

/// Lines of a text, one after the other.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  std::optional<std::string_view> next() {
    if (rest_.empty()) return std::nullopt;
    ++line_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return trimmed_line(line);
  }
  std::uint64_t line() const { return line_; }

 private:
  std::string_view rest_;
  std::uint64_t line_ = 0;
};

/// Codes of coordinates, lengths, angles, weights and bulges.
bool is_real(int code) { return code >= 10 && code <= 59; }

/// Codes that tell how many numbers follow.
bool is_count(std::string_view entity, int code) {
  if (entity == "LWPOLYLINE") return code == 90;
  return entity == "SPLINE" && code >= 72 && code <= 74;
}

template <class Integer>
std::optional<Integer> whole_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Integer value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

class Filter {
 public:
  Filter(const TextSource& source, std::string_view text)
      : source_(source), lines_(text), most_(static_cast<std::int64_t>(text.size() / 2)) {}

  Result<DxfText> run() {
    bool ended = false;
    while (const auto code_line = lines_.next()) {
      const auto code = whole_number<int>(*code_line);
      if (!code) {
        if (code_line->empty() && ended) continue;
        return error(ErrorCode::malformed,
                     fmt::format("'{}' is not a group code", shown(*code_line)));
      }
      const auto value = lines_.next();
      if (!value) return error(ErrorCode::malformed, "a group code without a value");
      if (ended || *code == 999) continue;
      if (*code == 0) {
        if (*value == "EOF") ended = true;
        begin(*value);
      } else if (*code == 9) {
        variable_ = *value;
      } else if (*code == 70 && section_ == "HEADER" && variable_ == "$INSUNITS") {
        result_.units = whole_number<int>(*value).value_or(0);
      } else if (*code == 2 && name_ == "SECTION" && section_.empty()) {
        section_ = *value;
        if (lists(sections, section_)) put(0, "SECTION");
      }
      if (!kept()) continue;
      if (Status status = check(*code, *value); !status) return status.error();
      if (!(name_ == "SECTION" && *code == 0)) put(*code, *value);
    }
    if (!ended) return error(ErrorCode::malformed, "the drawing ends without its end mark");
    result_.text += "0\nEOF\n";
    return std::move(result_);
  }

 private:
  Error error(ErrorCode code, std::string text) const {
    Error result = source_.error(code, std::move(text));
    result.place.line = lines_.line();
    return result;
  }
  static std::string shown(std::string_view text) { return std::string(text.substr(0, 40)); }

  void begin(std::string_view name) {
    name_ = name;
    if (name == "SECTION") section_.clear();
    if (!lists(structure, name) && !lists(entities, name) && section_ == "ENTITIES" &&
        name != "EOF") {
      ++result_.others[std::string(name.substr(0, 40))];
    }
  }
  bool kept() const {
    if (!lists(sections, section_)) return false;
    if (section_ == "TABLES" && (name_ == "TABLE" || name_ == "ENDTAB")) return true;
    return lists(structure, name_) || lists(entities, name_);
  }

  Status check(int code, std::string_view value) const {
    if (is_count(name_, code)) {
      const auto count = whole_number<std::int64_t>(value);
      if (!count || *count < 0 || *count > most_) {
        return error(ErrorCode::malformed, fmt::format("'{}' is not a count", shown(value)));
      }
    }
    if (!is_real(code)) return success();
    std::string text(value);
    std::ranges::replace(text, ',', '.');
    const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* end = text.data() + text.size();
    double number = 0;
    const auto [stop, problem] = fast_float::from_chars(begin, end, number);
    if (problem != std::errc() || stop != end || begin == end) {
      return error(ErrorCode::malformed, fmt::format("'{}' is not a number", shown(value)));
    }
    if (!std::isfinite(number)) {
      return error(ErrorCode::not_finite, fmt::format("'{}' is not finite", shown(value)));
    }
    return success();
  }

  void put(int code, std::string_view value) {
    fmt::format_to(std::back_inserter(result_.text), "{}\n{}\n", code,
                   value.substr(0, longest_line));
  }

  const TextSource& source_;
  Lines lines_;
  std::int64_t most_;
  std::string section_;
  std::string name_;
  std::string variable_;  ///< of the header
  DxfText result_;
};

}  // namespace

bool begins_like_dxf(std::string_view text) {
  Lines lines(text);
  while (const auto code = lines.next()) {
    const auto value = lines.next();
    if (!value) return false;
    if (*code == "999") continue;
    return *code == "0" && *value == "SECTION";
  }
  return false;
}

Result<DxfText> read_dxf_text(TextSource& source) {
  std::string text;
  source.read_all(text, longest_drawing);
  if (source.failure()) return *source.failure();
  if (text.size() >= longest_drawing) {
    return source.error(ErrorCode::too_large, "the drawing has 4 GiB or more");
  }
  if (text.starts_with("AutoCAD Binary DXF")) {
    return source.error(ErrorCode::unsupported, "binary drawings are not read; save it as text");
  }
  return Filter(source, text).run();
}

}  // namespace medial::io
