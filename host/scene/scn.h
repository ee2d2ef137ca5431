// SPDX-License-Identifier: MIT
// Parses scene text into a Scene, and writes it exact to the last bit of every number. The grammar
// is the course's four statements and clrt's extensions, defined by the table in scn.c.
#pragma once

#include "base/error.h"
#include "base/file.h"
#include "mesh/ply.h"
#include "scene/scene.h"

#include <stdio.h>

// Parses the size bytes of a scene file. Mesh paths are relative to the folder of the file called
// name. Returns false with "name:line:column: ..." at the first error.
bool scn_parse(Scene *scene, const char *text, size_t size, const char *name, Error *error);

// Loads the file at path, which may also be a mesh alone (mesh_load.h). parse_mesh reads PLY
// meshes: ply_parse or ply_parse_tolerantly.
bool scn_load(Scene *scene, const char *path, PlyParse *parse_mesh, Error *error);

// Loads a file in memory. Mesh paths are relative to the folder of a file called name.
bool scn_take(Scene *scene, const File *file, const char *name, PlyParse *parse_mesh, Error *error);

// Writes scene to stream. The objects' meshes are in files of these names beside the text. Returns
// false if the stream has failed.
bool scn_write(const Scene *scene, char *const *mesh_names, FILE *stream, Error *error);

// Writes a camera statement, after an up statement if the camera's up direction is not up.
void scn_write_camera(const Viewpoint *camera, Vec3 up, FILE *stream);

// Returns whether scene text can contain a file of that name.
bool scn_write_can_name(const char *name);

// Concatenates the meshes of a scene into one, all triangles in the scene's order. Objects without
// normals get zero normals.
bool mesh_join(Mesh *mesh, const Scene *scene, Error *error);
