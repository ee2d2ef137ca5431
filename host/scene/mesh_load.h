// SPDX-License-Identifier: MIT
// A mesh file -> objects of a scene.
#pragma once

#include "base/file.h"
#include "mesh/normals.h"
#include "mesh/ply.h"
#include "scene/scene.h"

#define NO_CREASE (-2)

// The outputs of clrt-foreign for the files of a scene, kept so that each file is read once. An
// output that would bring the total above FOREIGN_KEPT_MOST bytes is not kept, so every statement
// that names the same file reads it again.
#define FOREIGN_KEPT_MOST ((size_t)256 << 20)
typedef struct {
    char *path;
    File stream;
} KeptFile;
typedef struct {
    ARRAY(KeptFile) files;
    size_t size;
} KeptFiles;

void mesh_load_free_kept(KeptFiles *files);

typedef struct {
    MeshObject object;         // properties of the file's objects, without meshes
    bool is_flat;              // ignores the file's normals
    double crease_degrees;     // for missing normals: an angle, CREASE_BY_SHAPE, or NO_CREASE to
                               // compute none
    bool takes_own_materials;  // shows the materials and colors of the file if it has any
    uint32_t colored_material; // the material of meshes whose files define colors, but no material
    bool is_plain_ply;         // for `ply_file`, which reads only PLY and has no transforms
    bool is_tolerant;          // PlySource::is_tolerant
    KeptFiles *kept;           // outputs for other formats; borrowed; NULL keeps none
} MeshLoadOptions;

// Adds an object with the mesh of `file`, the contents of the PLY file at `path`. Adds `path` to
// the inputs.
bool mesh_load_ply(Scene *scene, const File *file, const char *path, const MeshLoadOptions *options,
                   Error *error);

// Adds an object for each part of the file at `path`, and the file's materials if
// options->takes_own_materials. The inputs receive the paths of all files that clrt-foreign has
// read. On failure, returns false with a message that names the file.
bool mesh_load_foreign(Scene *scene, const char *path, const MeshLoadOptions *options,
                       Error *error);

// Drops or computes the normals of the scene's objects from index `first` on. Does nothing if
// options->is_tolerant, because clrt check reports the vertices of the file. On failure, returns
// false with a message that names the file.
bool mesh_load_normals(const Scene *scene, size_t first, const MeshLoadOptions *options,
                       Error *error);
