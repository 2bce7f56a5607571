#include "io/modules.h"

namespace medial::io {

extern "C" {
extern const DrawModule medial_draw_table;
const DrawModule medial_draw_table{MEDIAL_STAMP, formats, read_text};
}

}  // namespace medial::io
