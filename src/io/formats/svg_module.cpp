#include <libxml/xmlversion.h>

#include "io/modules.h"

namespace medial::io {

Attributes svg_libraries() { return {{"libxml2", LIBXML_DOTTED_VERSION}}; }

extern "C" {
extern const SvgModule medial_svg_table;
const SvgModule medial_svg_table{MEDIAL_STAMP, svg_libraries, read_svg};
}

}  // namespace medial::io
