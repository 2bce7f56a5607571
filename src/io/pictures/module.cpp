#include "io/modules.h"

namespace medial::io {

extern "C" {
extern const DrawModule medial_draw_module;
const DrawModule medial_draw_module{formats, read_text};
}

}  // namespace medial::io
