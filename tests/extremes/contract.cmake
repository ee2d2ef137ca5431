# SPDX-License-Identifier: MIT
# Copies the kernels with contraction switched on, for the test that they do not rest on it being
# off.  Usage: cmake -DFOLDER=kernels -DOUTPUT=folder -P contract.cmake
file(GLOB sources "${FOLDER}/*.cl" "${FOLDER}/*.h")
set(switched 0)
foreach(source IN LISTS sources)
  file(READ "${source}" text)
  string(FIND "${text}" "FP_CONTRACT OFF" place)
  if(NOT place EQUAL -1)
    math(EXPR switched "${switched} + 1")
  endif()
  string(REPLACE "FP_CONTRACT OFF" "FP_CONTRACT ON" text "${text}")
  get_filename_component(name "${source}" NAME)
  file(WRITE "${OUTPUT}/${name}" "${text}")
endforeach()
if(switched EQUAL 0)
  message(FATAL_ERROR "no kernel in ${FOLDER} has the pragma FP_CONTRACT OFF")
endif()
