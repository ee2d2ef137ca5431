// SPDX-License-Identifier: MIT
// Scene -> scene text that renders to the same bits, or one mesh with all triangles.
#pragma once

#include "scene/scene.h"

#include <stdio.h>

// Writes the scene to `stream`. The text refers to the mesh file of object i as mesh_names[i].
// Returns false if the stream has failed or memory runs out.
bool scn_write(const Scene *scene, char *const *mesh_names, FILE *stream, Error *error);

// Writes a `camera` statement, preceded by an `up` statement if camera->up differs from `up`.
void scn_write_camera(const Viewpoint *camera, Vec3 up, FILE *stream);

// Returns whether scene text can quote the name: it is not empty and has no quotes or line ends.
bool scn_write_can_name(const char *name);

// Concatenates the meshes of a scene into one, with all triangles in the scene's order. If any
// object has normals, the objects without normals get zero normals. If any object has colors, the
// objects without colors get the diffuse color of their material.
bool scn_write_join(Mesh *mesh, const Scene *scene, Error *error);
