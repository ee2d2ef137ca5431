// SPDX-License-Identifier: MIT
// Parses scene text into a Scene, and writes text that reads back as the same bits. The table in
// scn.c defines the grammar: the course's four statements and clrt's extensions.
#pragma once

#include "scene/mesh_load.h"

#include <stdio.h>

// Parses the `size` bytes of a scene file. Mesh paths are relative to the folder of the file called
// name. Returns false at the first error, with "name:line:column: ..." if the text itself is wrong.
bool scn_parse(Scene *scene, const char *text, size_t size, const char *name, Error *error);

// Loads a scene file or a lone mesh file (mesh_load.h).
bool scn_load(Scene *scene, const char *path, const SceneLoadOptions *options, Error *error);

// Loads a file that is in memory. Mesh paths are relative to the folder of a file called name.
bool scn_take(Scene *scene, const File *file, const char *name, const SceneLoadOptions *options,
              Error *error);

// Writes scene to stream. The text refers to the mesh file of object i as mesh_names[i]. Returns
// false if the stream has failed or memory runs out.
bool scn_write(const Scene *scene, char *const *mesh_names, FILE *stream, Error *error);

// Writes a camera statement, preceded by an up statement if camera->up differs from up.
void scn_write_camera(const Viewpoint *camera, Vec3 up, FILE *stream);

// Returns whether scene text can quote the name: it is not empty and has no quotes or line ends.
bool scn_write_can_name(const char *name);

// Concatenates the meshes of a scene into one, all triangles in the scene's order. If any object
// has normals, the objects without normals get zero normals.
bool mesh_join(Mesh *mesh, const Scene *scene, Error *error);
