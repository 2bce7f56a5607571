#pragma once

#include <libxml/tree.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace medial::io {

/// The rules of `<style>` elements that say what is filled and shown (CSS 2.1, Sections 4 to 6):
/// `fill`, `fill-rule`, `display` and `visibility`. A selector is a sequence of `*`, an element's
/// name, `.class` and `#id`, with blanks (descendants) or `>` (children) between; other selectors
/// and at-rules are left out, the former counted.
class SvgStyleSheet {
 public:
  /// Adds a style element's text; what is no rule is skipped up to the next that is.
  void add(std::string_view text);

  bool empty() const { return rules_.empty(); }
  /// Selectors of kinds not known here whose rules would say something of the above.
  std::size_t left_out() const { return left_out_; }

  /// What holds for an element, as a `style` attribute: by importance, then specificity, then
  /// order, with the element's own style between. Adds to `tried` how many pairs of a part of a
  /// selector and an element were compared, and gives up (with any result) beyond most_tries.
  std::string style_of(const xmlNode* node, std::size_t& tried) const;
  static constexpr std::size_t most_tries = 20'000'000;

 private:
  /// `rect.a#b`: what one element has to be.
  struct Compound {
    std::string name;  ///< empty: any
    std::vector<std::string> ids;
    std::vector<std::string> classes;
    bool child_of_before = false;  ///< `>` stands before it
    bool matches(const xmlNode* node) const;
  };
  /// A value for each of the known properties; empty: none. Short ones only.
  using Values = std::array<std::string, 4>;
  struct Rule {
    std::vector<Compound> selector;
    std::size_t specificity = 0;
    Values normal, important;
  };

  static bool read_selector(std::string_view text, std::vector<Compound>& selector);
  static bool matches(const std::vector<Compound>& selector, std::size_t count, const xmlNode* node,
                      std::size_t& tried);
  static std::string declarations_of(const std::array<std::string_view, 4>& values);
  void add_rule(std::string_view selectors, std::string_view body);

  std::vector<Rule> rules_;
  /// By what the selector's last part names: `#id`, `.class`, `name` or nothing.
  std::unordered_map<std::string, std::vector<std::size_t>> by_key_;
  std::size_t left_out_ = 0;
};

}  // namespace medial::io
