#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace medial::io {

/// A text with its ASCII letters in lower case.
inline std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The name of a file's format: the one asked for or, if none is, the extension of the path. In
/// lower case and without a dot; empty if there is no extension.
inline std::string format_name(const std::string& path, const std::string& asked = {}) {
  std::string format =
      lower_case(asked.empty() ? std::filesystem::path(path).extension().string() : asked);
  if (format.starts_with('.')) format.erase(0, 1);
  return format;
}

}  // namespace medial::io
