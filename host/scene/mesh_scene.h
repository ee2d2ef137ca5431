// SPDX-License-Identifier: MIT
// A lone mesh file -> a scene with lights, a floor, and cameras that frame the mesh. The mesh is
// turned upright and is visible from both sides.
#pragma once

#include "scene/mesh_load.h"

typedef enum {
    NORMALS_AUTO,  // as NORMALS_SMOOTH with CREASE_BY_SHAPE
    NORMALS_FLAT,  // ignore the file's normals
    NORMALS_SMOOTH // compute the normals that the file lacks
} Normals;

// The lights around a lone mesh: points, or areas.
typedef enum { STUDIO_HARD, STUDIO_SOFT } StudioLights;

// The options of scn_load. {0} suits most callers. In scene text, statements choose the up axis,
// the normals and the lights. For scene text, scn_load therefore fails unless `up`, `normals` and
// `studio` are 0.
typedef struct {
    bool is_tolerant;      // PlySource::is_tolerant
    UpAxis up;             // of a lone mesh file
    Normals normals;       // of a lone mesh file
    double crease_degrees; // an angle or CREASE_BY_SHAPE; used only with NORMALS_SMOOTH
    StudioLights studio;   // of a lone mesh file
} SceneLoadOptions;

// Returns whether the `size` bytes begin like a PLY file.
bool mesh_scene_is_mesh(const char *bytes, size_t size);

// The scene text with which the scene of a lone mesh file begins: its background, ambient light and
// materials.
extern const char mesh_scene_studio[];

// Adds meshes, the file's materials, lights, a floor and viewpoints to a scene parsed from
// mesh_scene_studio. Reads the contents `ply` of a PLY file or, if `ply` is NULL, the file of
// another format at `path`. The viewpoints are three-quarter, front, right, back, left and top. z
// is up.
bool mesh_scene_fill(Scene *scene, const File *ply, const char *path,
                     const SceneLoadOptions *options, Error *error);
