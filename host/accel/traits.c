// SPDX-License-Identifier: MIT
#include "accel/traits.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

// Adds the traits of a material that a primitive uses. Unused materials set no traits.
static void add_material(SceneTraits *traits, const Material *material)
{
    traits->mirrors |= material->reflectivity > 0;
    traits->shaded |= IS_SHADED(material->shader);
    traits->checkers |= material->check_size > 0;
    traits->glass |= material->shader == SHADER_GLASS;
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
                          .colors = flat->colors_count > 0,
                          .statistics = statistics};
    for (uint32_t i = 0; i < flat->sphere_count; i++)
        add_material(&traits, &flat->materials[flat->spheres[i].material]);
    for (uint32_t i = 0; i < flat->triangle_count; i++)
        add_material(&traits, &flat->materials[material_of(flat, i)]);
    return traits;
}

float traits_reflectivity(const FlatScene *flat)
{
    float largest = 0;
    for (uint32_t i = 0; i < flat->sphere_count; i++)
        largest = fmaxf(largest, flat->materials[flat->spheres[i].material].reflectivity);
    for (uint32_t i = 0; i < flat->triangle_count; i++)
        largest = fmaxf(largest, flat->materials[material_of(flat, i)].reflectivity);
    return largest;
}

#define TRAIT(name, option, member) name, "CLRT_" option, offsetof(SceneTraits, member)

const Trait trait_table[TRAIT_COUNT] = {
    {TRAIT("spheres", "SPHERES", spheres), NULL, NULL, false},
    {TRAIT("triangles", "TRIANGLES", triangles), NULL, NULL, false},
    {TRAIT("tree", "BVH", bvh), NULL, NULL, false},
    {TRAIT("lights", "SHADED", shaded), NULL, NULL, false},
    {TRAIT("mirrors", "MIRRORS", mirrors), "no material in use reflects: no reflected rays",
     "a material in use reflects", false},
    {TRAIT("colors", "COLORS", colors), NULL, NULL, false},
    {TRAIT("checkers", "CHECKERS", checkers), "no material in use has a checker",
     "a material in use has a checker", true},
    {TRAIT("glass", "GLASS", glass), "no material in use is glass", "a material in use is glass",
     true},
    {TRAIT("statistics", "STATISTICS", statistics), "not requested: no --stats",
     "--stats counts rays and tests", true}};

bool trait_of(const SceneTraits *traits, const Trait *trait)
{
    return *(const bool *)((const char *)traits + trait->offset);
}

SceneTraits traits_general(SceneTraits needed)
{
    for (size_t i = 0; i < TRAIT_COUNT; i++)
        *(bool *)((char *)&needed + trait_table[i].offset) |= !trait_table[i].is_rare;
    needed.checkers |= needed.glass;
    return needed;
}

void traits_write_options(const SceneTraits *traits, char options[TRAITS_OPTIONS_SIZE])
{
    options[0] = '\0';
    for (size_t i = 0; i < TRAIT_COUNT; i++) {
        const size_t length = strlen(options);
        snprintf(options + length, TRAITS_OPTIONS_SIZE - length, "%s-D%s=%d", i == 0 ? "" : " ",
                 trait_table[i].option, trait_of(traits, &trait_table[i]));
    }
}
