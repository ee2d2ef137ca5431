// SPDX-License-Identifier: MIT
// A lone mesh file -> a whole scene. It has lights, a floor, and cameras that frame the mesh. The
// mesh is turned upright and is visible from both sides.
#pragma once

#include "scene/mesh_load.h"

typedef enum {
    NORMALS_AUTO,  // as NORMALS_SMOOTH with CREASE_BY_SHAPE
    NORMALS_FLAT,  // ignore the file's normals
    NORMALS_SMOOTH // compute the normals that the file lacks
} Normals;

// The options of scn_load. {0} suits most callers. Scene text sets up axes and normals by
// statements. For scene text, scn_load therefore fails unless `up` and `normals` are 0.
typedef struct {
    bool is_tolerant;      // reads PLY meshes with ply_parse_tolerantly
    UpAxis up;             // of a lone mesh file
    Normals normals;       // of a lone mesh file
    double crease_degrees; // an angle or CREASE_BY_SHAPE; used only with NORMALS_SMOOTH
} SceneLoadOptions;

// Returns whether the bytes are a PLY file. All other bytes are read as scene text.
bool mesh_scene_is_mesh(const char *bytes, size_t size);

// The scene text with which the scene of a lone mesh file begins: its background and materials.
extern const char mesh_scene_studio[];

// Adds the rest to a scene parsed from mesh_scene_studio: the mesh of a PLY file in memory or, if
// ply is NULL, of the file at path in another format, with the file's own materials. Adds the
// viewpoints three-quarter, front, right, back, left and top. z is up.
bool mesh_scene_fill(Scene *scene, const File *ply, const char *path,
                     const SceneLoadOptions *options, Error *error);
