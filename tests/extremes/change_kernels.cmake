# SPDX-License-Identifier: MIT
# Copies the kernels with a change that they must tolerate. `contracted` allows the contraction of
# a * b + c. `coarse` makes reciprocals wrong by about 2 to 4 ulp. OpenCL allows 2.5 ulp on devices
# without correctly rounded division.
# Usage: cmake -DFOLDER=kernels -DOUTPUT=folder -DCHANGE=contracted|coarse -P change_kernels.cmake
if(CHANGE STREQUAL contracted)
  set(old "FP_CONTRACT OFF")
  set(new "FP_CONTRACT ON")
else()
  set(old "1[.]0f / ([a-z_.>-]+)([,;}])")
  set(new "(1.0f / \\1) * (1.0f + 0x1p-22f)\\2")
endif()
file(GLOB sources "${FOLDER}/*.cl" "${FOLDER}/*.h")
set(changed 0)
foreach(source IN LISTS sources)
  file(READ "${source}" text)
  if(text MATCHES "${old}")
    math(EXPR changed "${changed} + 1")
  endif()
  string(REGEX REPLACE "${old}" "${new}" text "${text}")
  get_filename_component(name "${source}" NAME)
  file(WRITE "${OUTPUT}/${name}" "${text}")
endforeach()
if(changed EQUAL 0)
  message(FATAL_ERROR "nothing in ${FOLDER} can be ${CHANGE}")
endif()
