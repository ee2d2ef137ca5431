// SPDX-License-Identifier: MIT
// Ids and indices -> what people call the things of a scene: a sphere by its number in the file,
// from 1, a triangle by its mesh and its number there, from 0, a material by its name.
#pragma once

#include "scene/scene.h"

typedef struct {
    bool is_sphere;
    size_t number;    // as people count: spheres from 1, triangles from 0
    const char *path; // of the triangle's mesh; NULL for a sphere
} PrimitiveName;

PrimitiveName name_primitive(const Scene *scene, uint32_t id);

// The name that a define statement gave the material, or the course's number; it is kept by the
// scene or lasts.
const char *name_material(const Scene *scene, uint32_t material);
