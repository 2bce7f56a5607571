#include "support/environment.h"

namespace medial::test {

std::filesystem::path data_folder() {
  const char* folder = std::getenv("MEDIAL_DATA");
  return folder ? folder : MEDIAL_SOURCE_DIR "/../shared/data";
}

}  // namespace medial::test
