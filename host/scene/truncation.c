// SPDX-License-Identifier: MIT
// A ray's weight is the product of the reflectivities on its path. At level N, the weight is at
// most the scene's largest reflectivity to the power of N.
#include "scene/truncation.h"

static double larger(double a, double b)
{
    return a > b ? a : b;
}

static double largest_reflectivity(const Scene *scene)
{
    double largest = 0;
    for (size_t i = 0; i < scene->spheres.count; i++) {
        const uint32_t material = scene->spheres.data[i].material;
        largest = larger(largest, (double)scene->materials.data[material].reflectivity);
    }
    for (size_t i = 0; i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        if (object->mesh.triangle_count > 0)
            largest = larger(largest, (double)scene->materials.data[object->material].reflectivity);
    }
    return largest;
}

double truncation_bound(const Scene *scene, uint32_t max_level)
{
    const double reflectivity = largest_reflectivity(scene);
    double weight = 1;
    for (uint32_t level = 0; level < max_level && weight > 0; level++)
        weight *= reflectivity;
    return weight;
}

uint32_t truncation_level(const Scene *scene, double bound)
{
    const double reflectivity = largest_reflectivity(scene);
    double weight = 1;
    uint32_t level = 0;
    for (; level < MAX_LEVEL_LIMIT && weight > bound; level++)
        weight *= reflectivity;
    return level;
}
