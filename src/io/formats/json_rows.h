#pragma once

#include <fmt/format.h>
#include <simdjson.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/formats/json_number.h"
#include "io/text_source.h"
#include "medial/axis.h"
#include "medial/document.h"
#include "medial/error.h"

// What the readers of medial's own JSON have in common: rows of numbers, and errors.

namespace medial::io {

namespace json = simdjson::ondemand;

/// Thrown while a file is read, and caught in read_document().
struct Malformed {
  std::string text;
};

/// Thrown alike.
struct TooNew {
  std::uint64_t version;
};

inline void demand(bool condition, const char* text) {
  if (!condition) throw Malformed{text};
}

template <class Integer>
Integer integer(json::value value) {
  const std::uint64_t number = value.get_uint64();
  demand(number <= static_cast<std::uint64_t>(std::numeric_limits<Integer>::max()),
         "a whole number is too large");
  return static_cast<Integer>(number);
}

inline double number(json::value value) {
  const double result = nearest_double(value);
  demand(std::isfinite(result), "a number is not finite");
  return result;
}

inline std::string text_of(json::value value) {
  return std::string(std::string_view(value.get_string()));
}

/// Appends the pairs of texts of an array; `otherwise`: the error where one is not a pair.
inline void read_attributes(json::value value, const char* otherwise, Attributes& attributes) {
  for (json::value element : value.get_array()) {
    std::vector<std::string> words;
    for (json::value word : element.get_array()) words.push_back(text_of(word));
    demand(words.size() == 2, otherwise);
    attributes.emplace_back(std::move(words[0]), std::move(words[1]));
  }
}

/// Walks along a row of numbers.
class Row {
 public:
  explicit Row(json::value value)
      : array_(value.get_array()), next_(array_.begin()), end_(array_.end()) {}

  bool more() { return next_ != end_; }
  template <class Integer>
  Integer index() {
    const auto result = integer<Integer>(value());
    ++next_;
    return result;
  }
  /// An index, or no_site for -1.
  std::uint32_t index_or_none() {
    const std::int64_t number = value().get_int64();
    demand(number >= -1 && number < no_site, "a whole number is out of its range");
    ++next_;
    return number < 0 ? no_site : static_cast<std::uint32_t>(number);
  }
  double real() {
    const double result = number(value());
    ++next_;
    return result;
  }
  Vec2 point() {
    const double x = real();
    return {x, real()};
  }
  void end() { demand(!more(), "a row is too long"); }

 private:
  json::value value() {
    demand(more(), "a row is too short");
    return *next_;
  }
  json::array array_;
  simdjson::simdjson_result<json::array_iterator> next_;
  simdjson::simdjson_result<json::array_iterator> end_;
};

/// Calls read(element) for the elements of an array.
template <class Read>
void for_each(json::value array, Read read) {
  for (json::value element : array.get_array()) read(element);
}

/// Appends read(element) for the elements of an array.
template <class T, class Read>
void append_all(json::value array, std::vector<T>& values, Read read) {
  for_each(array, [&](json::value element) { values.push_back(read(element)); });
}

/// What is read of a member of an object.
template <class Read>
struct Member {
  std::string_view name;
  Read read;
};
template <class Read>
Member(const char*, Read) -> Member<Read>;

/// Reads the members of an object that are known, in their order in the file.
template <class Object, class... Reads>
void read_members(Object object, const Member<Reads>&... known) {
  for (json::field field : object) {
    const std::string_view key = field.unescaped_key();
    json::value content = field.value();
    static_cast<void>(((key == known.name && (known.read(content), true)) || ...));
  }
}

/// Reads a file: its version, a whole number from 1 to `newest`, its items, and what else is known.
template <class Item, class ReadItem, class... Reads>
std::vector<Item> read_items(json::document& document, const char* version, std::uint64_t newest,
                             const ReadItem& read_item, const Member<Reads>&... others) {
  std::vector<Item> items;
  bool versioned = false, itemized = false;
  read_members(document.get_object(),
               Member{version,
                      [&](json::value content) {
                        const auto found = integer<std::uint64_t>(content);
                        if (found > newest) throw TooNew{found};
                        demand(found > 0, "there is no version 0");
                        versioned = true;
                      }},
               Member{"items",
                      [&](json::value content) {
                        append_all(content, items, read_item);
                        itemized = true;
                      }},
               others...);
  demand(document.current_location().error() != simdjson::SUCCESS,
         "there is more after the last bracket");
  demand(versioned, "the version is missing");
  demand(itemized, "the items are missing");
  return items;
}

inline SiteKind site_kind(std::uint32_t code) {
  demand(code <= static_cast<std::uint32_t>(SiteKind::arc), "an unknown kind of site");
  return static_cast<SiteKind>(code);
}

inline NodeKind node_kind(std::uint32_t code) {
  demand(code <= static_cast<std::uint32_t>(NodeKind::branching), "an unknown kind of node");
  return static_cast<NodeKind>(code);
}

/// The rest of the row of a site of this kind, of which `first` is the first number.
inline Site read_site(Row& row, SiteKind kind, double first) {
  Site site;
  site.start = {first, row.real()};
  site.end = row.point();
  site.ring = row.index<std::uint32_t>();
  site.vertex = row.index<std::uint32_t>();
  if (kind == SiteKind::arc) site.bulge = row.real();
  row.end();
  demand(site.kind() == kind, "a site is not of its kind");
  return site;
}

inline Node read_node(json::value value) {
  Row row(value);
  Node node;
  node.disk.center = row.point();
  node.disk.radius = row.real();
  node.component = row.index<std::uint32_t>();
  node.kind = node_kind(row.index<std::uint32_t>());
  row.end();
  demand(node.disk.radius >= 0, "a node's radius is negative");
  return node;
}

/// Whether a text begins like an object whose first member has this name, in quotes.
inline bool begins_with_member(std::string_view text, std::string_view name) {
  const auto accept = [&text](std::string_view word) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
  };
  return accept("{") && accept(name) && accept(":");
}

/// What read(document) makes of a file, or the error that it threw, with the line. Errors:
/// unreadable, malformed, unsupported (a version above `newest`), too_large (4 GiB or more).
template <class Read>
auto read_document(TextSource& source, int newest, const Read& read)
    -> Result<decltype(read(std::declval<json::document&>()))> {
  constexpr std::size_t longest = simdjson::SIMDJSON_MAXSIZE_BYTES - simdjson::SIMDJSON_PADDING - 1;
  std::string bytes;
  bytes.reserve(std::min(source.length_hint(), longest) + simdjson::SIMDJSON_PADDING);
  source.read_all(bytes, longest);
  if (source.failure()) return *source.failure();
  if (bytes.size() > longest) {
    return source.error(ErrorCode::too_large, "the file has 4 GiB or more");
  }
  bytes.reserve(bytes.size() + simdjson::SIMDJSON_PADDING);

  const json::document* open = nullptr;
  const auto malformed = [&](const std::string& what) {
    Error error = source.error(ErrorCode::malformed, what);
    const char* at = nullptr;
    if (open != nullptr) {
      auto location = const_cast<json::document*>(open)->current_location();
      if (location.error() == simdjson::SUCCESS) at = location.value_unsafe();
    }
    error.place.line.reset();
    if (at >= bytes.data() && at <= bytes.data() + bytes.size()) {
      error.place.line = 1 + std::count(static_cast<const char*>(bytes.data()), at, '\n');
    }
    return error;
  };
  json::parser parser;
  json::document document;
  try {
    const simdjson::padded_string_view view(bytes.data(), bytes.size(), bytes.capacity());
    if (const auto code = parser.iterate(view).get(document); code != simdjson::SUCCESS) {
      return malformed(simdjson::error_message(code));
    }
    open = &document;
    return read(document);
  } catch (const Malformed& problem) {
    return malformed(problem.text);
  } catch (const TooNew& found) {
    return source.error(ErrorCode::unsupported,
                        fmt::format("version {} of the format; this program reads up to {}",
                                    found.version, newest));
  } catch (const simdjson::simdjson_error& problem) {
    return malformed(problem.what());
  }
}

}  // namespace medial::io
