#pragma once

// Post-processors: templates of what stands around the moves of G-code.

#include <map>
#include <string>
#include <string_view>

#include "medial/error.h"

namespace medial::io {

enum class PostPart : std::uint8_t { start, tool, cut, end };

/// What stands for {name} in a template.
using PostValues = std::map<std::string, std::string>;

/// A text with the parts [start], [tool] (only where there are several), [cut] (before the moves of
/// each tool) and [end].
class PostTemplate {
 public:
  /// By the name of a known machine, or a text; empty: plain G-code. Errors: invalid_option.
  static Result<PostTemplate> make(const std::string& name_or_text);
  /// A part with its values. Lines of which nothing is left are left out.
  std::string fill(PostPart part, const PostValues& values) const;

 private:
  std::map<PostPart, std::string> parts_;
};

/// A text that may stand in a comment: letters, digits, and ._- for the rest.
std::string comment_of(std::string_view text);

}  // namespace medial::io
