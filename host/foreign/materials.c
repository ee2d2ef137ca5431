// SPDX-License-Identifier: MIT
#include "foreign/materials.h"

#include <stdio.h>
#include <string.h>

static bool find_color(const struct aiMaterial *material, const char *key, float color[3])
{
    struct aiColor4D found;
    if (aiGetMaterialColor(material, key, 0, 0, &found) != aiReturn_SUCCESS)
        return false;
    color[0] = found.r;
    color[1] = found.g;
    color[2] = found.b;
    return true;
}

static float find_number(const struct aiMaterial *material, const char *key, float otherwise)
{
    float found;
    return aiGetMaterialFloatArray(material, key, 0, 0, &found, NULL) == aiReturn_SUCCESS
               ? found
               : otherwise;
}

static void find_name(const struct aiMaterial *material, char *name, size_t size)
{
    struct aiString found = {0};
    if (aiGetMaterialString(material, AI_MATKEY_NAME, &found) == aiReturn_SUCCESS)
        snprintf(name, size, "%.*s", (int)size - 1, found.data);
    else
        name[0] = '\0';
}

// Returns false for materials that importers invent. They have Assimp's default name, or no name
// and a diffuse color of 60 % gray or white.
bool material_is_given(const struct aiMaterial *material)
{
    const float gray = 0.6f, white = 1;
    char name[sizeof((ForeignMaterial *)0)->name];
    float color[3] = {0, 0, 0};
    find_name(material, name, sizeof name);
    find_color(material, "$clr.diffuse", color);
    const bool is_even = color[0] == color[1] && color[1] == color[2];
    const bool is_plain = is_even && (color[0] == gray || color[0] == white);
    return strcmp(name, AI_DEFAULT_MATERIAL_NAME) != 0 && !(name[0] == '\0' && is_plain);
}

ForeignMaterial material_taken(const struct aiMaterial *material)
{
    ForeignMaterial taken = {.diffuse = {1, 1, 1}};
    find_name(material, taken.name, sizeof taken.name);
    if (!find_color(material, "$clr.diffuse", taken.diffuse))
        find_color(material, "$clr.base", taken.diffuse);
    find_color(material, "$clr.specular", taken.specular);
    const float strength = find_number(material, "$mat.shinpercent", 1);
    for (int channel = 0; channel < 3; channel++)
        taken.specular[channel] *= strength;
    taken.shininess = find_number(material, "$mat.shininess", 0);
    return taken;
}

bool material_is_textured(const struct aiMaterial *material)
{
    return aiGetMaterialTextureCount(material, aiTextureType_DIFFUSE) > 0 ||
           aiGetMaterialTextureCount(material, aiTextureType_BASE_COLOR) > 0;
}
