#include "io/formats/gcode_posts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "medial/io/write.h"

namespace medial::io {
namespace {

struct KnownPost {
  const char* name;
  const char* text;
};
// G91.1 makes I and J relative to the start of an arc, G64 P bounds how far corners are cut.
constexpr std::array<KnownPost, 4> known{
    {{"plain",
      "[start]\n{header}\n{units} G90 G17 G94\n"
      "[tool]\n{stop}\nM0 (tool {tool}: {description})\n"
      "[cut]\n{spindle}\nG0 Z{safe}\n"
      "[end]\n{stop}\nM2\n"},
     {"linuxcnc",
      "[start]\n{header}\n{units} G90 G91.1 G17 G94 G40 G49\n"
      "G64 P{tolerance}\n"
      "[tool]\n{stop}\nT{tool} M6 ({description})\nG43\n"
      "[cut]\n{spindle}\nG0 Z{safe}\n"
      "[end]\n{stop}\nM2\n"},
     {"grbl",
      "[start]\n{header}\n{units} G90 G17 G94\n"
      "[tool]\n{stop}\nM0 (tool {tool}: {description})\n"
      "[cut]\n{spindle}\nG0 Z{safe}\n"
      "[end]\n{stop}\nM30\n"},
     {"mach3",
      "[start]\n{header}\n{units} G90 G91.1 G17 G94 G40 G49 G80\n"
      "[tool]\n{stop}\nM6 T{tool} ({description})\nG43 H{tool}\n"
      "[cut]\n{spindle}\nG0 Z{safe}\n"
      "[end]\n{stop}\nM30\n"}}};
constexpr std::array<std::string_view, 4> part_names{"[start]", "[tool]", "[cut]", "[end]"};
constexpr std::array<std::string_view, 8> value_names{"header",      "units", "tolerance", "safe",
                                                      "description", "tool",  "spindle",   "stop"};

/// The first name in braces that is not a value; empty if there is none.
std::string_view unknown_name(std::string_view text) {
  for (std::size_t open = text.find('{'); open != std::string_view::npos;
       open = text.find('{', open + 1)) {
    const std::size_t close = text.find('}', open);
    if (close == std::string_view::npos) break;
    const std::string_view name = text.substr(open + 1, close - open - 1);
    if (std::ranges::find(value_names, name) == value_names.end()) return name;
  }
  return {};
}

/// A line with {name} replaced.
std::string filled(std::string_view line, const PostValues& values) {
  std::string out;
  while (!line.empty()) {
    const std::size_t open = std::min(line.find('{'), line.size());
    out += line.substr(0, open);
    line.remove_prefix(open);
    const std::size_t close = line.find('}');
    if (close == std::string_view::npos) break;
    const auto found = values.find(std::string(line.substr(1, close - 1)));
    out += found == values.end() ? std::string(line.substr(0, close + 1)) : found->second;
    line.remove_prefix(close + 1);
  }
  return out.append(line);
}

/// Calls visit(line) for each line of a text.
template <class Visit>
void for_each_line(std::string_view text, const Visit& visit) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    visit(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

Result<PostTemplate> PostTemplate::make(const std::string& name_or_text) {
  std::string text = name_or_text.empty() ? "plain" : name_or_text;
  for (const KnownPost& post : known)
    if (text == post.name) text = post.text;
  if (const std::string_view unknown = unknown_name(text); !unknown.empty())
    return Error{ErrorCode::invalid_option,
                 fmt::format("a G-code template has no value {{{}}}; there are {{{}}}", unknown,
                             fmt::join(value_names, "}, {")),
                 {}};
  PostTemplate result;
  std::string* part = nullptr;
  for_each_line(text, [&](std::string_view line) {
    for (std::size_t i = 0; i < part_names.size(); ++i)
      if (line == part_names[i]) {
        part = &result.parts_[static_cast<PostPart>(i)];
        return;
      }
    if (part != nullptr) part->append(line).push_back('\n');
  });
  for (std::size_t i = 0; i < part_names.size(); ++i)
    if (!result.parts_.contains(static_cast<PostPart>(i)))
      return Error{
          ErrorCode::invalid_option,
          fmt::format("the G-code template has no section {}; it needs {}, each name on its own "
                      "line",
                      part_names[i], fmt::join(part_names, " ")),
          {}};
  // The first move goes across at the height that this part leaves the tool at.
  if (result.parts_[PostPart::cut].find("{safe}") == std::string::npos)
    return Error{ErrorCode::invalid_option,
                 "the section [cut] of a G-code template must lift the tool: G0 Z{safe}",
                 {}};
  return result;
}

std::string PostTemplate::fill(PostPart part, const PostValues& values) const {
  std::string out;
  for_each_line(parts_.at(part), [&](std::string_view line) {
    const std::string text = filled(line, values);
    if (!text.empty()) out += text + '\n';
  });
  return out;
}

std::string comment_of(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-') c = '_';
  return out;
}

std::string post_names() {
  std::string names;
  for (const KnownPost& post : known) names += (names.empty() ? "" : ", ") + std::string(post.name);
  return names;
}

}  // namespace medial::io
