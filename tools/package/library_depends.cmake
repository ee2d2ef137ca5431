# SPDX-License-Identifier: MIT
# CPack runs this file. dpkg-shlibdeps finds the packages of the libraries that libclrt links to.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
file(WRITE ${CPACK_CLRT_WORK_FOLDER}/debian/control
     "Source: clrt\n\nPackage: libclrt0\nArchitecture: any\n")
execute_process(
  COMMAND dpkg-shlibdeps -O ${CPACK_CLRT_LIBRARY}
  WORKING_DIRECTORY ${CPACK_CLRT_WORK_FOLDER}
  OUTPUT_VARIABLE answer ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "^shlibs:Depends=|\n" "" linked_to "${answer}")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "pocl-opencl-icd | opencl-icd, ${linked_to}")
