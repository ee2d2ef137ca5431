// SPDX-License-Identifier: MIT
// The reader and the writer share one table of the properties of materials.
#include "scene/material_text.h"

#include "base/limits.h"
#include "base/text.h"

#include <stddef.h>
#include <string.h>

#define USAGE(values) "define NAME KIND ... " values " ..."

const MaterialProperty material_properties[] = {
    {"diffuse", USAGE("diffuse R G B"), offsetof(Material, diffuse), 3, 0, 1,
     USED_BY_ALL_BUT_GLASS},
    {"checker", USAGE("checker SIZE R G B R G B"), offsetof(Material, check_size), 7, RADIUS_LEAST,
     RADIUS_MOST, USED_BY_ALL_BUT_GLASS},
    {"kd", USAGE("kd V"), offsetof(Material, kd), 1, 0, FACTOR_MOST, USED_BY_ALL_BUT_GLASS},
    {"specular", USAGE("specular R G B"), offsetof(Material, specular), 3, 0, 1,
     USED_BY_BLINN_PHONG},
    {"ks", USAGE("ks V"), offsetof(Material, ks), 1, 0, FACTOR_MOST, USED_BY_BLINN_PHONG},
    {"shininess", USAGE("shininess V"), offsetof(Material, shininess), 1, 0, SHININESS_MOST,
     USED_BY_BLINN_PHONG},
    {"reflectivity", USAGE("reflectivity V"), offsetof(Material, reflectivity), 1, 0, 1,
     USED_BY_ALL_BUT_GLASS},
    {"color", USAGE("color R G B"), offsetof(Material, diffuse), 3, 0, 1, USED_BY_GLASS},
    {"ior", USAGE("ior V"), offsetof(Material, ior), 1, IOR_LEAST, IOR_MOST, USED_BY_GLASS}};

// The property `checker` fills the members check_size and checks, which must therefore be adjacent.
_Static_assert(offsetof(Material, checks) == offsetof(Material, check_size) + sizeof(float), "");

static bool unknown_property(Tokens *tokens, Token property, const Material *material)
{
    const char *names[MATERIAL_PROPERTIES];
    char list[128] = "";
    size_t count = 0;
    for (size_t i = 0; i < MATERIAL_PROPERTIES; i++) {
        if (!material_accepts(material, &material_properties[i]))
            continue;
        names[count] = material_properties[i].name;
        strcat(strcat(list, count == 0 ? "" : ", "), names[count]);
        count++;
    }
    const char *nearest = word_nearest(property.text, property.length, names, count);
    return nearest == NULL
               ? tokens_fail(tokens, property, "expected a property of a material (%s)", list)
               : tokens_fail(tokens, property, "unknown property (did you mean '%s'?)", nearest);
}

static bool read_values(Tokens *tokens, const MaterialProperty *property, Material *material)
{
    float *values = (float *)(void *)((char *)material + property->offset);
    for (int place = 0; place < property->count; place++) {
        const double least = place == 0 ? property->least : 0;
        const double most = place == 0 ? property->most : 1;
        double value;
        if (!tokens_number_within(tokens, &value, least, most))
            return false;
        values[place] = (float)value;
    }
    if (property->offset == offsetof(Material, shininess))
        material_set_shininess(material, material->shininess);
    return true;
}

// Reads the values of `property` into *material, and sets the property's bit in *given. Fails if
// the bit is set already.
static bool read_property(Tokens *tokens, Token property, Material *material, uint32_t *given)
{
    size_t i = 0;
    while (i < MATERIAL_PROPERTIES && !(token_is(property, material_properties[i].name) &&
                                        material_accepts(material, &material_properties[i])))
        i++;
    if (i == MATERIAL_PROPERTIES)
        return unknown_property(tokens, property, material);
    if ((*given >> i & 1) != 0)
        return tokens_fail(tokens, property, "the property is given twice");
    *given |= (uint32_t)1 << i;
    const char *usage = tokens->usage;
    tokens->usage = material_properties[i].usage;
    const bool ok = read_values(tokens, &material_properties[i], material);
    tokens->usage = usage;
    return ok;
}

static bool read_shader(Tokens *tokens, Shader *shader)
{
    const Token token = tokens_next(tokens);
    for (int kind = SHADER_SILHOUETTE; kind <= SHADER_GLASS; kind++) {
        if (token_is(token, shader_names[kind])) {
            *shader = (Shader)kind;
            return true;
        }
    }
    return tokens_fail(tokens, token, "expected 'silhouette', 'matte', 'blinn_phong' or 'glass'");
}

bool material_read(Material *material, Tokens *tokens)
{
    Shader shader = SHADER_MATTE;
    uint32_t given = 0;
    if (!read_shader(tokens, &shader))
        return false;
    *material = material_of_shader(shader);
    for (;;) {
        const Token property = tokens_next(tokens);
        if (property.text == NULL)
            return true;
        if (!read_property(tokens, property, material, &given))
            return false;
    }
}
