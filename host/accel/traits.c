// SPDX-License-Identifier: MIT
// Inspects the materials that primitives use. A defined but unused material costs nothing.
#include "accel/traits.h"

#include <stdio.h>

static void add_material(SceneTraits *traits, const Material *material)
{
    traits->mirrors |= material->reflectivity > 0;
    traits->shaded |= material->shader != SHADER_SILHOUETTE;
}

static uint32_t material_of(const FlatScene *flat, uint32_t triangle)
{
    return flat->layout == NODES_WIDE ? flat->looks[triangle].material
                                      : flat->triangles[triangle].material & ~TRIANGLE_MARKS;
}

SceneTraits traits_of(const FlatScene *flat, bool statistics)
{
    SceneTraits traits = {.spheres = flat->sphere_count > 0,
                          .triangles = flat->triangle_count > 0,
                          .bvh = flat->node_count > 0,
                          .statistics = statistics};
    for (uint32_t i = 0; i < flat->sphere_count; i++)
        add_material(&traits, &flat->materials[flat->spheres[i].material]);
    for (uint32_t i = 0; i < flat->triangle_count; i++)
        add_material(&traits, &flat->materials[material_of(flat, i)]);
    return traits;
}

SceneTraits traits_general(bool statistics)
{
    return (SceneTraits){true, true, true, true, true, statistics};
}

void traits_write_options(const SceneTraits *traits, char options[TRAITS_OPTIONS_SIZE])
{
    snprintf(options, TRAITS_OPTIONS_SIZE,
             "-DCLRT_SPHERES=%d -DCLRT_TRIANGLES=%d -DCLRT_BVH=%d -DCLRT_MIRRORS=%d "
             "-DCLRT_SHADED=%d -DCLRT_STATISTICS=%d",
             traits->spheres, traits->triangles, traits->bvh, traits->mirrors, traits->shaded,
             traits->statistics);
}
