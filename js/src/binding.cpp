// Answers, errors and options of all calls.

#include "binding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace medial::js {
namespace {

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') result += '\\';
    if (static_cast<unsigned char>(letter) >= 0x20) {
      result += letter;
      continue;
    }
    std::array<char, 8> code{};
    std::snprintf(code.data(), code.size(), "\\u%04x", static_cast<unsigned>(letter));
    result += code.data();
  }
  return result + '"';
}

/// A number in JSON; null if it is not finite.
std::string literal(double value) {
  if (!std::isfinite(value)) return "null";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

}  // namespace

void Json::begin(std::string_view name) {
  if (text_.size() > 1) text_ += ',';
  text_ += quoted(name) + ":";
}
Json& Json::add(std::string_view name, double value) {
  begin(name);
  text_ += literal(value);
  return *this;
}
Json& Json::add(std::string_view name, std::string_view value) {
  begin(name);
  text_ += quoted(value);
  return *this;
}
Json& Json::add(std::string_view name, bool value) {
  begin(name);
  text_ += value ? "true" : "false";
  return *this;
}
Json& Json::add(std::string_view name, const std::vector<std::string>& values) {
  begin(name);
  text_ += '[';
  for (const std::string& value : values) {
    if (text_.back() != '[') text_ += ',';
    text_ += quoted(value);
  }
  text_ += ']';
  return *this;
}
Json& Json::add(std::string_view name, Vec2 p) {
  begin(name);
  text_ += "[" + literal(p.x) + "," + literal(p.y) + "]";
  return *this;
}

Answer& answer() {
  static Answer kept;
  return kept;
}

void answer_error(const Error& error) {
  Json json;
  json.add("code", name_of(error.code)).add("text", error.text);
  const auto add = [&](const char* name, const std::optional<std::uint64_t>& index) {
    if (index) json.add(name, number(*index));
  };
  add("feature", error.place.feature);
  add("ring", error.place.ring);
  add("vertex", error.place.vertex);
  if (error.place.point) json.add("point", *error.place.point);
  answer() = {{}, json.text()};
}

Named::Named(const char* text) {
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find(';'));
    rest.remove_prefix(std::min(rest.size(), one.size() + 1));
    const std::size_t sign = one.find('=');
    left_.emplace_back(one.substr(0, sign), one.substr(sign + 1));
  }
}

Named& Named::take(std::string_view name, std::string& to) {
  for (auto it = left_.begin(); it != left_.end(); ++it) {
    if (it->first != name) continue;
    to = it->second;
    left_.erase(it);
    break;
  }
  return *this;
}
bool Named::take_number(std::string_view name, double& to) {
  if (!has(name)) return false;
  std::string text;
  take(name, text);
  char* end = nullptr;
  to = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') refuse(ErrorCode::invalid_option, std::string(name) + " is a number");
  return true;
}
void Named::take_numbers(std::string_view name, std::span<double> to) {
  std::string text;
  take(name, text);
  const char* at = text.c_str();
  for (std::size_t i = 0; i < to.size(); ++i) {
    char* end = nullptr;
    to[i] = std::strtod(at, &end);
    if (end == at || *end != (i + 1 < to.size() ? ',' : '\0'))
      refuse(ErrorCode::invalid_option,
             std::string(name) + " is an array of " + std::to_string(to.size()) + " numbers");
    at = end + 1;
  }
}
bool Named::has(std::string_view name) const {
  return std::any_of(left_.begin(), left_.end(),
                     [&](const auto& one) { return one.first == name; });
}
Named& Named::take(std::string_view name, double& to) {
  take_number(name, to);
  return *this;
}
Named& Named::take(std::string_view name, bool& to) {
  if (!has(name)) return *this;
  std::string text;
  take(name, text);
  to = text == "true";
  if (!to && text != "false")
    refuse(ErrorCode::invalid_option, std::string(name) + " is true or false");
  return *this;
}
void Named::finish() const {
  if (!left_.empty())
    refuse(ErrorCode::invalid_option, "there is no option '" + left_.front().first + "'");
}

std::vector<Ring> rings_from(const double* coordinates, const std::uint32_t* begin,
                             std::size_t count, const std::uint8_t* roles, const double* bulges) {
  std::vector<Ring> rings(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto points = points_at(coordinates + 2 * begin[i], begin[i + 1] - begin[i]);
    rings[i].points.assign(points.begin(), points.end());
    if (roles != nullptr) rings[i].role = static_cast<RingRole>(roles[i]);
    if (bulges != nullptr) rings[i].bulges.assign(bulges + begin[i], bulges + begin[i + 1]);
  }
  return rings;
}

MEDIAL_JS std::size_t medial_tables() { return answer().tables.size(); }
MEDIAL_JS const double* medial_table(std::size_t i) { return answer().tables[i].data(); }
MEDIAL_JS std::size_t medial_table_size(std::size_t i) { return answer().tables[i].size(); }
MEDIAL_JS const char* medial_text() { return answer().text.c_str(); }
MEDIAL_JS void medial_clear() { answer() = {}; }

}  // namespace medial::js
