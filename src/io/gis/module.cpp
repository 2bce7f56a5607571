#include "io/modules.h"

namespace medial::io {

extern "C" {
extern const GisModule medial_gis_table;
const GisModule medial_gis_table{MEDIAL_STAMP,    formats_at_hand, describe_crs, describe_crs,
                                 degrees_of_unit, output_crs_of,   urn_of_crs,   project_to_local,
                                 note_stretch,    make_valid,      read_image,   build_info};
}

}  // namespace medial::io
