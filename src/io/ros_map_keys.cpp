#include "io/ros_map_keys.h"

#include <filesystem>
#include <sstream>

#include "io/text_source.h"
#include "medial/io/read.h"

namespace medial::io {

namespace {

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r'\"");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r'\"") + 1 - begin);
}

}  // namespace

bool is_ros_map(std::string_view path) { return path.ends_with(".yaml") || path.ends_with(".yml"); }

std::map<std::string, std::string> ros_map_keys(const std::string& text) {
  std::map<std::string, std::string> keys;
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    line = trimmed(line.substr(0, line.find(" #")));
    const auto colon = line.find(':');
    if (line.starts_with("- ")) {
      keys[last] += line.substr(1) + " ";
    } else if (!line.starts_with('#') && colon != std::string::npos) {
      last = trimmed(line.substr(0, colon));
      keys[last] = trimmed(line.substr(colon + 1));
    }
  }
  return keys;
}

std::string image_of_map(const std::string& path) {
  if (!is_ros_map(path)) return {};
  const auto source = TextSource::open(path);
  if (!source) return {};
  std::string text;
  (*source)->read_all(text, longest_ros_map);
  const std::string name = ros_map_keys(text)["image"];
  return name.empty() ? name : std::filesystem::path(path).replace_filename(name).string();
}

}  // namespace medial::io
