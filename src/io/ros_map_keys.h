#pragma once

#include <map>
#include <string>
#include <string_view>

namespace medial::io {

constexpr std::size_t longest_ros_map = 1 << 20;  ///< of the text, in characters

/// Whether a file is called like a map of ROS.
bool is_ros_map(std::string_view path);

/// The lines `key: value` of a map, without comments. Lines `- value` are a list of the last key.
std::map<std::string, std::string> ros_map_keys(const std::string& text);

}  // namespace medial::io
