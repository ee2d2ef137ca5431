// SPDX-License-Identifier: MIT
// Loads mesh files into a scene, as its objects or in its place.
#pragma once

#include "base/file.h"
#include "mesh/mesh.h"
#include "mesh/ply.h"
#include "scene/scene.h"

#define NO_CREASE (-1)

// How to load a file.
typedef struct {
    MeshObject object;        // properties of its objects beside their meshes
    bool is_flat;             // without the file's normals
    double crease_degrees;    // for computing missing normals; NO_CREASE leaves them missing
    bool takes_own_materials; // instead of the object's, if the file has any
    bool is_plain_ply;        // PLY only, without transforms
    PlyParse *parse;          // the mesh reader
} MeshLoadOptions;

// Adds an object with the mesh of the file read from path, and adds the file to the inputs.
bool ply_mesh_add(Scene *scene, const File *file, const char *path, const MeshLoadOptions *options,
                  Error *error);

// Adds an object for each part of the file at path, its materials if requested, and all files that
// it was read from. Returns false with a message that names the file.
bool foreign_mesh_add(Scene *scene, const char *path, const MeshLoadOptions *options, Error *error);

// Drops or computes normals of the scene's objects from the first one on. The tolerant reader
// serves reports on the file's own vertices, so its meshes stay as they are. Returns false with a
// message that names the file.
bool mesh_load_normals(const Scene *scene, size_t first, const MeshLoadOptions *options,
                       Error *error);

// A mesh that replaces a scene is turned upright, framed by cameras of its own, lit, placed on
// a floor, and two-sided.

// Returns whether a file's bytes are a mesh and not scene text.
bool mesh_scene_is_mesh(const char *bytes, size_t size);

// Fills scene from a PLY file in memory or, if ply is NULL, from a file at path in another format,
// with the file's own materials. Viewpoints: three-quarter, front, right, back, left and top, with
// z up.
bool mesh_scene_load(Scene *scene, const File *ply, const char *path, PlyParse *parse,
                     Error *error);

// Turns a loaded mesh so that the axis `up` of its file is up, and frames it again. UP_AUTO changes
// nothing. Fails for scenes from text. Frees the scene on failure.
bool mesh_scene_turn(Scene *scene, UpAxis up, Error *error);

// Returns z, or y if the meshes would fall over with z up and stand on a flat base with y up.
UpAxis up_axis_of_shape(const Scene *scene);
