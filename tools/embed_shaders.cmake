# SPDX-License-Identifier: MIT
# Turns NAME.glsl into the C string shader_NAME for each of NAMES. Included files replace #include.
# Usage: cmake -DFOLDER=shaders "-DNAMES=a b" -DOUTPUT=file.c -P embed_shaders.cmake
cmake_minimum_required(VERSION 3.25)
separate_arguments(NAMES)
set(source "// Made by tools/embed_shaders.cmake.\n#include \"view/draw/drawing.h\"\n")
foreach(name IN LISTS NAMES)
  file(READ "${FOLDER}/${name}.glsl" text)
  while(text MATCHES "#include \"([a-z]+).glsl\"\n")
    set(statement "${CMAKE_MATCH_0}")
    file(READ "${FOLDER}/${CMAKE_MATCH_1}.glsl" included)
    string(REPLACE "${statement}" "${included}" text "${text}")
  endwhile()
  string(HEX "${text}" bytes)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND source "const char shader_${name}[] = {${bytes}0};\n")
endforeach()
file(WRITE "${OUTPUT}" "${source}")
