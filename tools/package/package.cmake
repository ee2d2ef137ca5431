# SPDX-License-Identifier: MIT
# The other files of an installation, and the Debian packages. `cmake --workflow --preset package`
# builds the packages. Installing the package clrt compiles the general kernels for all users. Other
# kernels are compiled on first use.
set(folder ${CMAKE_BINARY_DIR}/package)
file(MAKE_DIRECTORY ${folder})
foreach(pair "CHANGELOG.md:changelog" "tools/package/changelog:changelog.Debian")
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 source)
  list(GET pair 1 name)
  add_custom_command(
    OUTPUT ${folder}/${name}.gz
    COMMAND gzip -9nc ${CMAKE_SOURCE_DIR}/${source} > ${folder}/${name}.gz
    DEPENDS ${CMAKE_SOURCE_DIR}/${source}
    VERBATIM)
  add_custom_target(compress_${name} ALL DEPENDS ${folder}/${name}.gz)
  add_dependencies(installable compress_${name})
  install(FILES ${folder}/${name}.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})
endforeach()
install(FILES README.md tools/package/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY tools/editors/vim/ DESTINATION ${CMAKE_INSTALL_DATADIR}/vim/vimfiles)

# Debian has no package request that the changelog could close. lintian -I makes three more remarks,
# all harmless. CPack's strip keeps the section .comment, and shlibs replaces a symbols file. The
# word "ment" is part of a word that the compiler has split.
file(WRITE ${folder}/clrt "clrt: initial-upload-closes-no-bugs\n")
install(FILES ${folder}/clrt DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides)

# Scenes without large models.
file(GLOB examples scenes/*.ply)
foreach(scene blinn_phong matte reflections silhouette simple)
  list(APPEND examples scenes/${scene}.scn)
endforeach()
install(FILES ${examples} DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The clrt authors")
# Packagers set their own name and address. The authors have no address.
set(CLRT_MAINTAINER "The clrt authors <nobody@clrt.invalid>" CACHE STRING
    "Name and address of the maintainer of the Debian packages")
set(CPACK_PACKAGE_CONTACT ${CLRT_MAINTAINER})
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "pocl-opencl-icd | opencl-icd")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS fonts-dejavu-core)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA
    "${CMAKE_SOURCE_DIR}/tools/package/postinst;${CMAKE_SOURCE_DIR}/tools/package/prerm")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME clrt)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "ray tracer on OpenCL with the same bits on every device
clrt traces scenes of triangle meshes and spheres with OpenCL kernels, on CPUs
and GPUs, to a file or in a window. The same scene and settings give the same
picture, bit for bit, on every device. No ray leaks between the triangles of a
closed mesh, and clrt check reports the faults of meshes.")
if(CLRT_WITH_LIBRARY)
  include(tools/package/library_package.cmake)
endif()
include(CPack)
