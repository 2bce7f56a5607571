// Shapes as paths of SVG, and the row of the format.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "base/arc.h"
#include "io/formats/svg.h"
#include "io/ring_text.h"
#include "medial/document.h"

namespace medial::io {

namespace {

/// Calls edge(BulgeArc) for the edges of a loop in their order.
template <class Visit>
void for_each_edge(const Shape& shape, std::size_t loop, const Visit& visit) {
  const auto points = shape.loop(loop);
  for (std::size_t k = 0; k < points.size(); ++k)
    visit(BulgeArc{points[k], points[k + 1 < points.size() ? k + 1 : 0],
                   shape.bulge(shape.loop_begin[loop] + k)});
}

/// The attributes of the outermost element, in the units that SVG knows.
std::string physical_size(Unit unit, Vec2 size) {
  if (unit != Unit::millimetre && unit != Unit::centimetre && unit != Unit::inch) return {};
  return fmt::format(" width=\"{0:.9g}{2}\" height=\"{1:.9g}{2}\"", size.x, size.y, name_of(unit));
}

void put_svg(OutputStream& out, const Document<ShapeItem>& file) {
  Box box = Box::nothing();
  for (const ShapeItem& item : file.items)
    if (!item.shape.points.empty()) box.add(bounding_box(item.shape));
  if (box.is_nothing()) box = {};
  const double margin = 0.02 * diagonal(box);
  const Vec2 size = box.high - box.low + 2 * margin * Vec2{1, 1};
  const double top = file.y_down ? box.low.y - margin : -box.high.y - margin;
  // Without a width of the picture a unit stays a unit when it is read again.
  out.put(fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\"{} viewBox=\"{:.9g} {:.9g} {:.9g} {:.9g}\">\n",
      physical_size(file.unit, size), box.low.x - margin, top, size.x, size.y));
  out.put(fmt::format(
      "<g{} fill=\"#f1f1ec\" fill-rule=\"evenodd\" stroke=\"#404045\" stroke-width=\"{:.3g}\" "
      "stroke-linejoin=\"round\">\n",
      file.y_down ? "" : " transform=\"scale(1 -1)\"", 1.5e-3 * std::max(size.x, size.y)));
  for (const ShapeItem& item : file.items) {
    out.put("<path d=\"");
    for (std::size_t i = 0; i < item.shape.loop_count(); ++i) {
      bool started = false;
      for_each_edge(item.shape, i, [&](const BulgeArc& arc) {
        if (!started) {
          out.put('M');
          put_point(out, arc.start, ' ');
          started = true;
        }
        if (arc.bulge == 0) {
          out.put('L');
        } else {
          const double radius = 1 / std::abs(curvature(arc));
          out.put('A');
          out.put(radius);
          out.put(' ');
          out.put(radius);
          out.put(arc.bulge > 0 ? " 0 0 1 " : " 0 0 0 ");
        }
        put_point(out, arc.end, ' ');
      });
      out.put("Z\n");
    }
    out.put("\"/>\n");
  }
  out.put("</g>\n</svg>\n");
}

/// Whether a text begins like a document of SVG, in UTF-8 or UTF-16.
bool begins_like_svg(std::string_view text) {
  std::string letters;  // of UTF-16: every other byte of a tag's is 0
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    std::copy_if(text.begin() + 2, text.end(), std::back_inserter(letters),
                 [](char byte) { return byte != 0; });
    text = letters;
  }
  const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == std::string_view::npos || text[first] != '<') return false;
  return text.find("<svg") != std::string_view::npos;
}

Status write_svg(Target& target, const ShapesOutput& output) {
  put_svg(*target.out, output.document);
  return success();
}

}  // namespace

Format svg_format() {
  Format format = Format{".svg"}.writes<ShapesOutput>(write_svg);
  format.also_read = ".svgz";
  format.read = read_svg;
  format.sniff = begins_like_svg;
  return format;
}

}  // namespace medial::io
