// SPDX-License-Identifier: MIT
// Reads a model in any format of Assimp and writes the records of mesh/foreign_stream.h.
#pragma once

#include "base/array.h"
#include "base/file.h"
#include "mesh/foreign_stream.h"

#include <assimp/cfileio.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <stdio.h>

typedef struct {
    char *path;
    File file;
} OpenedFile;

// The files that Assimp may read for a model: the model file, and files in its folder or below.
// Each file is read completely, once. Assimp cannot write files.
typedef struct {
    struct aiFileIO interface; // passed to Assimp; its UserData points to this struct
    const char *model;         // the model's path, which includes a folder
    ARRAY(OpenedFile) opened;  // the files read so far; the model file is first
    size_t outside_count;      // number of requests for files outside of the folder
    char missing[256];         // path of the first material library that was not opened, or ""
} Files;

// Initializes files for the model at this path. The path must outlive files.
void files_init(Files *files, const char *model);

// Reads the model file. Returns false on failure.
bool files_open_model(Files *files, Error *error);

// Limits this process's memory, stack, time, child processes and open files. From now on, the
// process gains no privileges and writes no files.
void limits_take(void);

// Raises the memory limit for a file of `bytes` bytes, up to the overall limit.
void limits_allow_file(size_t bytes);

// Sends all records except FOREIGN_FAILURE. Returns false and the reason if the file has no model
// or the receiver is gone.
bool model_send(FILE *stream, Files *files, Error *error);

// Materials: the properties that clrt renders are two colors and an exponent.

// Returns false for a material that Assimp invents because the file has none.
bool material_is_given(const struct aiMaterial *material);

ForeignMaterial material_taken(const struct aiMaterial *material);

// Returns whether the material's color has a texture, which clrt does not render.
bool material_is_textured(const struct aiMaterial *material);

// Totals of a model's parts. A part is a run of triangles with one material, in the coordinates of
// the whole file.
typedef struct {
    size_t triangles;
    size_t others;    // faces that are points or lines
    bool is_textured; // the color of a part has a texture
    bool is_colored;  // a part's vertices have colors
} PartCounts;

// Sends every part after its material. keeps_normals is false for formats with facet normals, which
// the corners already determine.
bool parts_send(FILE *stream, const struct aiScene *scene, bool keeps_normals, PartCounts *counts,
                Error *error);

// Functions that write records. Only the stream's error state shows their failures.

void send_bytes(FILE *stream, ForeignKind kind, const void *bytes, size_t size);

// Sends a record of this kind with a text, shortened if too long.
__attribute__((format(printf, 3, 4))) void send_text(FILE *stream, ForeignKind kind,
                                                     const char *format, ...);

// Sends the hash of a file's `size` bytes, and its path.
void send_file(FILE *stream, const char *path, const void *bytes, size_t size);

void send_part(FILE *stream, const ForeignPart *part);
