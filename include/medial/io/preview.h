#pragma once

#include <span>
#include <string>
#include <vector>

#include "medial/axis.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial::io {

/// One of several pictures of the same shapes: with other axes in them.
struct PreviewPanel {
  std::string title;
  std::vector<MedialAxis> axes;
};

/// Draws the shapes once for each panel, in rows, each with its axes and its title below. By the
/// extension of `path`: .svg .pdf .png .ps. Errors: unsupported, invalid_option (width),
/// unwritable.
Status write_preview(const std::string& path, const std::string& format,
                     std::span<const Shape> shapes, std::span<const PreviewPanel> panels,
                     double width, bool y_down);

/// The extensions write_preview() takes, for help texts.
std::string known_preview_formats();

}  // namespace medial::io
