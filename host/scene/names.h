// SPDX-License-Identifier: MIT
// Converts ids and indices to names for users. A sphere has its number in the file, from 1. A
// triangle has its mesh and its number there, from 0. A material has its name.
#pragma once

#include "scene/scene.h"

typedef struct {
    bool is_sphere;
    size_t number;    // for users: spheres from 1, triangles from 0
    const char *path; // of the triangle's mesh; NULL for a sphere
} PrimitiveName;

PrimitiveName name_primitive(const Scene *scene, uint32_t id);

// Returns the name that a define statement gave the material, or the course's number. The scene
// owns the string, or it is static.
const char *name_material(const Scene *scene, uint32_t material);
