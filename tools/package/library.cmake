# SPDX-License-Identifier: MIT
# Builds libclrt, which offers the stages below the command line through one header, clrt.h.
# Installs files for pkg-config and CMake. The library exports only the functions of clrt.h.
set_target_properties(clrt_core clrt_cl PROPERTIES POSITION_INDEPENDENT_CODE ON)

file(GLOB library_sources CONFIGURE_DEPENDS host/library/*.c)
add_library(clrt_library SHARED ${library_sources})
set(library_map ${CMAKE_SOURCE_DIR}/host/library/clrt.map)
set_target_properties(
  clrt_library PROPERTIES OUTPUT_NAME clrt EXPORT_NAME clrt VERSION ${PROJECT_VERSION} SOVERSION 0
                          PUBLIC_HEADER host/library/clrt.h LINK_DEPENDS ${library_map})
target_compile_definitions(clrt_library PRIVATE CLRT_VERSION="${PROJECT_VERSION}")
target_include_directories(
  clrt_library PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/host/library>
                      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
# Compilers then vectorize comparisons of doubles. No value changes, and no code reads exception flags.
set_source_files_properties(${CMAKE_SOURCE_DIR}/host/library/ray_batch.c
                            PROPERTIES COMPILE_OPTIONS -fno-trapping-math)
target_link_libraries(clrt_library PRIVATE clrt_cl)
add_dependencies(installable clrt_library)
target_link_options(clrt_library PRIVATE -Wl,--version-script=${library_map})

# Debian splits a library into a package for running programs and a package for building them.
install(TARGETS clrt_library EXPORT clrt
        LIBRARY COMPONENT library NAMELINK_COMPONENT development
        PUBLIC_HEADER COMPONENT development)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/clrt)
install(EXPORT clrt FILE clrtConfig.cmake NAMESPACE clrt:: DESTINATION ${package_folder}
        COMPONENT development)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/clrtConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
# The prefix is relative to the file's folder, so that an installed tree can be moved.
file(RELATIVE_PATH prefix_of_pkgconfig ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig
     ${CMAKE_INSTALL_PREFIX})
configure_file(tools/package/clrt.pc.in clrt.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/clrtConfigVersion.cmake DESTINATION ${package_folder}
        COMPONENT development)
install(FILES ${CMAKE_BINARY_DIR}/clrt.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT development)
install(FILES tests/library/picture.c DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples
        COMPONENT development)

# The Python package has the library, its header and clrt-foreign beside its modules
# (pyproject.toml).
if(CLRT_PYTHON_WHEEL)
  install(FILES $<TARGET_FILE:clrt_library> DESTINATION clrt RENAME libclrt.so.0 COMPONENT python)
  install(FILES host/library/clrt.h DESTINATION clrt COMPONENT python)
  install(TARGETS clrt-foreign DESTINATION clrt COMPONENT python)
endif()
