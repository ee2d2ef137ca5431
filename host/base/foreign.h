// SPDX-License-Identifier: MIT
// Runs clrt-foreign, the program that reads files with Assimp and OpenImageIO. Hostile files can
// crash these libraries, so clrt-foreign has limited time, memory and file size, and clrt checks
// every byte of its output. These limits do not confine a library that a file has taken over. The
// output is a sequence of records, each a head and data. If clrt-foreign crashes, hangs or exhausts
// memory, clrt prints one error message.
#pragma once

#include "base/child_process.h"

#include <stdint.h>

typedef enum {
    FOREIGN_FILE = 1, // a ForeignHash and the path of an input file; the model file comes first
    FOREIGN_MATERIAL, // a ForeignMaterial
    FOREIGN_PART,     // a binary PLY file; number is the index of its material
    FOREIGN_NOTE,     // a message about omitted parts
    FOREIGN_PICTURE,  // a StoredImage and its values
    FOREIGN_FAILURE,  // the reason why there is no model or picture; the last record
    FOREIGN_END       // no bytes; the last record of a complete stream
} ForeignKind;

typedef struct {
    uint32_t kind, number;
    uint64_t size; // number of bytes that follow
} ForeignHead;

typedef struct {
    const char *library; // for messages
    const char *program; // NULL for this build's clrt-foreign
    ChildLimits limits;
} ForeignReader;

// Replaces all but printable ASCII, because a terminal could interpret other characters.
void foreign_make_printable(char *text, size_t size, char substitute);

// Runs clrt-foreign with up to FOREIGN_WORDS words, the rest being NULL, and collects its output.
// On failure returns false and the reason without the name of the file. The caller frees stream.
#define FOREIGN_WORDS 3
bool foreign_run(File *stream, const ForeignReader *reader, const char *const words[FOREIGN_WORDS],
                 Error *cause);
