// SPDX-License-Identifier: MIT
// Runs clrt-foreign, the program that reads files with Assimp and OpenImageIO. Hostile files can
// crash these libraries. clrt-foreign is therefore a separate process with limits on time and
// memory. If it crashes, hangs or exhausts its memory, the read fails with one error message. The
// limits do not confine a library that a hostile file has taken over.
//
// The output of clrt-foreign is a sequence of records. Each record is a ForeignHead and its data.
//
// Invariant: clrt trusts no byte of the output. Readers check each size, index and number before
// they use it.
#pragma once

#include "base/file.h"

#include <limits.h>
#include <stdint.h>

typedef enum {
    FOREIGN_FILE = 1, // a ForeignHash and the path of an input file; the model file comes first
    FOREIGN_MATERIAL, // a ForeignMaterial
    FOREIGN_OBJECT,   // the name of an object in the next part that has an invalid vertex
    FOREIGN_PART,     // a binary PLY file; ForeignHead.number is the index of its material
    FOREIGN_NOTE,     // a message about omitted data
    FOREIGN_PICTURE,  // a StoredImage and its values
    FOREIGN_FAILURE,  // the reason why there is no model or picture; the last record
    FOREIGN_END       // no data; the last record of a complete stream
} ForeignKind;

typedef struct {
    uint32_t kind, number;
    uint64_t size; // number of bytes that follow
} ForeignHead;

typedef struct {
    const char *library; // for messages
    const char *program; // NULL for this build's clrt-foreign
    double seconds;      // limit of wall time
    size_t bytes;        // limit of the output
} ForeignReader;

// Stores the path of clrt's file `name`, and returns whether the file was found. Searches the
// folder of the running program first, where a build tree has the file. Then tries the path
// `installed`, relative to this folder, and then the folder of clrt's library, which other programs
// such as Python may load. Never searches the current folder, which may contain anybody's files. If
// no place has the file, stores "" or the last path that was tried.
#define COMPANION_PATH_SIZE (2 * PATH_MAX)
bool foreign_companion(char path[COMPANION_PATH_SIZE], const char *name, const char *installed);

// Puts `substitute` in place of characters that are not printable ASCII, because a terminal could
// interpret these characters. `size` is the length of `text`.
void foreign_make_printable(char *text, size_t size, char substitute);

// Runs clrt-foreign and collects its output in *stream. The arguments of clrt-foreign are `words`,
// in which NULL marks unused entries at the end. clrt-foreign gets the environment with which this
// process was started. Any thread may call foreign_run, even while another thread changes the
// environment. On failure, returns false and stores the reason in *cause, without the name of the
// file. The caller frees *stream.
#define FOREIGN_WORDS 3
bool foreign_run(File *stream, const ForeignReader *reader, const char *const words[FOREIGN_WORDS],
                 Error *cause);
