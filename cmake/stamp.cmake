# MEDIAL_STAMP, which the program and its modules compare: they hand over structures by value, so all
# have to be built from the same headers.
file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/medial/*.h ${PROJECT_SOURCE_DIR}/include/medial/io/*.h
     ${PROJECT_SOURCE_DIR}/src/base/*.h ${PROJECT_SOURCE_DIR}/src/io/*.h ${PROJECT_SOURCE_DIR}/cli/plot.h)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${headers})
set(MEDIAL_STAMP ${PROJECT_VERSION})
foreach(header ${headers})
  file(SHA256 ${header} hash)
  string(APPEND MEDIAL_STAMP ${hash})
endforeach()
string(SHA256 MEDIAL_STAMP ${MEDIAL_STAMP})

# The sources that compare it, so that a new stamp compiles no others.
function(medial_stamp_sources)
  set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_DEFINITIONS MEDIAL_STAMP="${MEDIAL_STAMP}")
endfunction()
