# SPDX-License-Identifier: MIT
# The Debian packages of libclrt: one for running programs and one for building them. Their
# documents are not part of other installations.
list(APPEND CPACK_COMPONENTS_ALL library development)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS library)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libclrt0)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS clrt) # contains clrt-foreign, which reads models
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "pictures by the ray tracer clrt from other programs
libclrt traces scenes of triangle meshes and spheres with OpenCL kernels, on
CPUs and GPUs, into the memory of the program that it is part of, with the same
bits on every device.")
file(WRITE ${folder}/triggers "activate-noawait ldconfig\n")
file(WRITE ${folder}/shlibs "libclrt 0 libclrt0 (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${folder}/triggers;${folder}/shlibs")
# With SHLIBDEPS, CPack would add scripts that run ldconfig, although the file triggers already makes
# dpkg run it.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS OFF)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_SOURCE_DIR}/tools/package/library_depends.cmake)
set(CPACK_CLRT_LIBRARY ${CMAKE_BINARY_DIR}/libclrt.so.${PROJECT_VERSION})
set(CPACK_CLRT_WORK_FOLDER ${folder})

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libclrt-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "pictures by the ray tracer clrt: files for development
The header of libclrt, its files for pkg-config and CMake, and an example.")

foreach(pair library:libclrt0 development:libclrt-dev)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 component)
  list(GET pair 1 package)
  install(FILES ${folder}/changelog.gz ${folder}/changelog.Debian.gz tools/package/copyright
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component}
          EXCLUDE_FROM_ALL)
  file(WRITE ${folder}/${package} "${package}: initial-upload-closes-no-bugs\n")
  install(FILES ${folder}/${package} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
          COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
