#include "io/formats/svg_style.h"

#include <algorithm>
#include <array>

#include "io/formats/svg_document.h"

namespace medial::io {

namespace {

constexpr std::string_view white_space = " \t\r\n\f";
constexpr std::array<std::string_view, 4> known_properties{"fill", "fill-rule", "display",
                                                           "visibility"};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(white_space);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(white_space) - first + 1);
}

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_' || static_cast<unsigned char>(c) >= 0x80;
}

/// Blanks in place of comments and of `<!--` and `-->`.
std::string without_comments(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    std::size_t length = 1;
    if (text.starts_with("/*")) {
      const std::size_t end = text.find("*/", 2);
      length = end == std::string_view::npos ? text.size() : end + 2;
    } else if (text.starts_with("<!--")) {
      length = 4;
    } else if (text.starts_with("-->")) {
      length = 3;
    }
    result += length == 1 ? text.front() : ' ';
    text.remove_prefix(length);
  }
  return result;
}

/// Finds the first of `wanted` outside of strings and brackets; returns the end if there is none.
std::size_t find_outside(std::string_view text, std::string_view wanted) {
  char quote = 0;
  std::size_t depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\') {
      ++i;
    } else if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (depth == 0 && wanted.find(c) != std::string_view::npos) {
      return i;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '{' || c == '(' || c == '[') {
      ++depth;
    } else if ((c == '}' || c == ')' || c == ']') && depth > 0) {
      --depth;
    }
  }
  return text.size();
}

bool has_class(const std::string& classes, std::string_view wanted) {
  for (std::size_t from = 0; (from = classes.find(wanted, from)) != std::string::npos; ++from) {
    const std::size_t to = from + wanted.size();
    const auto is_end = [&](std::size_t i) {
      return white_space.find(classes[i]) != std::string::npos;
    };
    if ((from == 0 || is_end(from - 1)) && (to == classes.size() || is_end(to))) return true;
  }
  return false;
}

std::string_view name_of(const xmlNode* node) { return reinterpret_cast<const char*>(node->name); }

}  // namespace

bool SvgStyleSheet::Compound::matches(const xmlNode* node) const {
  if (!name.empty() && name != name_of(node)) return false;
  for (const std::string& id : ids)
    if (attribute(node, "id") != id) return false;
  if (classes.empty()) return true;
  const std::string own = attribute(node, "class");
  return std::all_of(classes.begin(), classes.end(),
                     [&](const std::string& wanted) { return has_class(own, wanted); });
}

/// Whether the first `count` parts of a selector hold for an element and those that it is in. Of
/// descendants the nearest is tried, then those further out.
bool SvgStyleSheet::matches(const std::vector<Compound>& selector, std::size_t count,
                            const xmlNode* node, std::size_t& tried) {
  if (++tried > most_tries) return false;
  const Compound& last = selector[count - 1];
  if (!last.matches(node)) return false;
  if (count == 1) return true;
  for (const xmlNode* outer = node->parent; outer != nullptr && outer->type == XML_ELEMENT_NODE;
       outer = outer->parent) {
    if (matches(selector, count - 1, outer, tried)) return true;
    if (last.child_of_before || tried > most_tries) return false;
  }
  return false;
}

bool SvgStyleSheet::read_selector(std::string_view text, std::vector<Compound>& selector) {
  bool child = false;
  while (!(text = trimmed(text)).empty()) {
    if (text.front() == '>') {
      if (child || selector.empty()) return false;
      child = true;
      text.remove_prefix(1);
      continue;
    }
    Compound& compound = selector.emplace_back();
    compound.child_of_before = child;
    child = false;
    const std::size_t length = std::min(text.size(), text.find_first_of(" \t\r\n\f>"));
    std::string_view part = text.substr(0, length);
    text.remove_prefix(length);
    if (part.front() == '*') {
      part.remove_prefix(1);
      if (!part.empty() && part.front() != '.' && part.front() != '#') return false;
    }
    while (!part.empty()) {
      const char kind = part.front();
      const bool named = kind == '.' || kind == '#';
      if (named) part.remove_prefix(1);
      const auto end = std::find_if_not(part.begin(), part.end(), is_name_character);
      const std::string name(part.begin(), end);
      if (name.empty()) return false;
      part.remove_prefix(name.size());
      if (kind == '.') {
        compound.classes.push_back(name);
      } else if (kind == '#') {
        compound.ids.push_back(name);
      } else {
        compound.name = name;
      }
    }
  }
  return !child && !selector.empty();
}

void SvgStyleSheet::add_rule(std::string_view selectors, std::string_view body) {
  constexpr std::size_t longest_value = 64;
  Values normal, important;
  bool says_something = false;
  while (!body.empty()) {
    const std::size_t end = find_outside(body, ";");
    const std::string_view declaration = body.substr(0, end);
    body.remove_prefix(std::min(body.size(), end + 1));
    const std::size_t colon = declaration.find(':');
    if (colon == std::string_view::npos) continue;
    const auto* const property = std::find(known_properties.begin(), known_properties.end(),
                                           trimmed(declaration.substr(0, colon)));
    std::string_view value = trimmed(declaration.substr(colon + 1));
    if (property == known_properties.end() || value.size() > longest_value) continue;
    const auto i = static_cast<std::size_t>(property - known_properties.begin());
    const std::size_t mark = value.rfind('!');
    const bool is_important =
        mark != std::string_view::npos && trimmed(value.substr(mark + 1)) == "important";
    if (is_important) value = trimmed(value.substr(0, mark));
    (is_important ? important : normal)[i] = value;
    says_something = true;
  }
  if (!says_something) return;
  for (bool more = true; more;) {
    const std::size_t end = find_outside(selectors, ",");
    more = end < selectors.size();
    Rule rule;
    if (!read_selector(selectors.substr(0, end), rule.selector)) {
      ++left_out_;
    } else {
      constexpr std::size_t much = 1000;  // more classes than a selector has
      for (const Compound& compound : rule.selector)
        rule.specificity += much * much * compound.ids.size() + much * compound.classes.size() +
                            (compound.name.empty() ? 0 : 1);
      rule.normal = normal;
      rule.important = important;
      const Compound& last = rule.selector.back();
      by_key_[!last.ids.empty()       ? '#' + last.ids[0]
              : !last.classes.empty() ? '.' + last.classes[0]
                                      : last.name]
          .push_back(rules_.size());
      rules_.push_back(std::move(rule));
    }
    if (more) selectors.remove_prefix(end + 1);
  }
}

void SvgStyleSheet::add(std::string_view raw) {
  const std::string owned = without_comments(raw);
  std::string_view text = owned;
  while (!(text = trimmed(text)).empty()) {
    const std::size_t begin = find_outside(text, text.front() == '@' ? ";{" : "{");
    if (begin == text.size()) return;
    const std::string_view selectors = text.substr(0, begin);
    const bool block = text[begin] == '{';
    text.remove_prefix(begin + 1);
    if (!block) continue;
    const std::size_t end = find_outside(text, "}");
    if (selectors.front() != '@') add_rule(selectors, text.substr(0, end));
    text.remove_prefix(std::min(text.size(), end + 1));
  }
}

std::string SvgStyleSheet::style_of(const xmlNode* node, std::size_t& tried) const {
  std::vector<std::size_t> found;
  const auto look_up = [&](const std::string& key) {
    const auto rules = by_key_.find(key);
    if (rules == by_key_.end()) return;
    for (const std::size_t rule : rules->second)
      if (matches(rules_[rule].selector, rules_[rule].selector.size(), node, tried))
        found.push_back(rule);
  };
  look_up("");
  look_up(std::string(name_of(node)));
  if (const std::string id = attribute(node, "id"); !id.empty()) look_up('#' + id);
  const std::string classes = attribute(node, "class");
  for (std::string_view rest = trimmed(classes); !rest.empty(); rest = trimmed(rest)) {
    const std::size_t length = std::min(rest.size(), rest.find_first_of(white_space));
    look_up('.' + std::string(rest.substr(0, length)));
    rest.remove_prefix(length);
  }
  std::sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(rules_[a].specificity, a) < std::pair(rules_[b].specificity, b);
  });
  std::array<std::string_view, 4> normal, important;
  for (const std::size_t rule : found)
    for (std::size_t i = 0; i < normal.size(); ++i) {
      if (!rules_[rule].normal[i].empty()) normal[i] = rules_[rule].normal[i];
      if (!rules_[rule].important[i].empty()) important[i] = rules_[rule].important[i];
    }
  const std::string own = attribute(node, "style");
  return declarations_of(normal) + own + (own.empty() ? "" : ";") + declarations_of(important);
}

std::string SvgStyleSheet::declarations_of(const std::array<std::string_view, 4>& values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!values[i].empty())
      text.append(known_properties[i]).append(":").append(values[i]).append(";");
  return text;
}

}  // namespace medial::io
