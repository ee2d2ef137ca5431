# SPDX-License-Identifier: MIT
# Joins the kernel files, in the order given, into one C array.  Includes among them are dropped,
# and a #line before each makes build logs name the real file and line.
# Usage: cmake -DFOLDER=kernels -DFILES=a;b -DOUTPUT=file.c -P embed.cmake
set(joined "")
foreach(file IN LISTS FILES)
  file(READ "${FOLDER}/${file}" text)
  string(REGEX REPLACE "#include \"[a-z_.]+\"" "" text "${text}")
  string(APPEND joined "#line 1 \"${file}\"\n${text}")
endforeach()
string(HEX "${joined}" bytes)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "(................................................................................)" "\\1\n" bytes "${bytes}")
file(WRITE "${OUTPUT}" "// Made by tools/embed.cmake.\n#include <stddef.h>\nextern const char kernel_source[];\nextern const size_t kernel_source_size;\nconst char kernel_source[] = {\n${bytes}0};\nconst size_t kernel_source_size = sizeof kernel_source - 1;\n")
