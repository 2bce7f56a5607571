# What `cmake --install` puts in place: the libraries with their headers, the command line with its
# manual page, and what find_package(medial) and pkg-config need to find them again.
include(CMakePackageConfigHelpers)

set(MEDIAL_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/medial)

# A static library passes its dependencies on to whoever links it.
if(BUILD_SHARED_LIBS)
  set(MEDIAL_PKGCONFIG_PRIVATE Requires.private)
else()
  set(MEDIAL_PKGCONFIG_PRIVATE Requires)
endif()

if(MEDIAL_TBB)
  set(MEDIAL_PKGCONFIG_THREADS " tbb")
endif()
if(MEDIAL_HAS_GMP)
  set(MEDIAL_PKGCONFIG_EXACT " mpfr gmp")
endif()
if(MEDIAL_DXF)
  set(MEDIAL_PKGCONFIG_DXF " dxflib")
endif()
if(MEDIAL_MESH)
  set(MEDIAL_PKGCONFIG_MESH " assimp")
endif()
if(SHAPELIB_FOUND)
  set(MEDIAL_PKGCONFIG_SHAPELIB " shapelib")
endif()

# Relative, so that the installed tree may be moved.
file(RELATIVE_PATH MEDIAL_PREFIX_FROM_PKGCONFIG
     ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})

# Installs one library with the headers below include/medial${headers}, and how to find it.
function(medial_install target headers)
  set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION}
                        SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
                        DEFINE_SYMBOL "")  # shared or static, the same objects: ccache has them
  string(REPLACE _ - name ${target})  # medial-io: of the files that describe it
  install(TARGETS ${target} EXPORT ${name}-targets)
  file(GLOB header_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/medial${headers}/*.h)
  install(FILES ${header_files} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/medial${headers})
  install(EXPORT ${name}-targets NAMESPACE medial:: DESTINATION ${MEDIAL_CMAKE_DIR})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

medial_install(medial "")
if(MEDIAL_IO)
  medial_install(medial_io /io)
  install(FILES ${PROJECT_SOURCE_DIR}/docs/medial.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/medial-config.cmake.in
                              ${PROJECT_BINARY_DIR}/medial-config.cmake
                              INSTALL_DESTINATION ${MEDIAL_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/medial-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/medial-config.cmake
              ${PROJECT_BINARY_DIR}/medial-config-version.cmake
        DESTINATION ${MEDIAL_CMAKE_DIR})
