// SPDX-License-Identifier: MIT
// One table lists the properties for the reader and for the writer.
#include "scene/material_text.h"

#include "base/limits.h"
#include "base/number.h"
#include "base/word.h"

#include <stddef.h>
#include <string.h>

// The first number is in [least, most], and all others in [0, 1].
static const struct {
    const char *name;
    size_t offset; // of the floats in Material
    int count;
    double least, most;
    bool is_shine; // only Blinn-Phong materials use it
} properties[] = {{"diffuse", offsetof(Material, diffuse), 3, 0, 1, false},
                  {"checker", offsetof(Material, check_size), 7, RADIUS_LEAST, RADIUS_MOST, false},
                  {"kd", offsetof(Material, kd), 1, 0, FACTOR_MOST, false},
                  {"specular", offsetof(Material, specular), 3, 0, 1, true},
                  {"ks", offsetof(Material, ks), 1, 0, FACTOR_MOST, true},
                  {"shininess", offsetof(Material, shininess), 1, 0, SHININESS_MOST, true},
                  {"reflectivity", offsetof(Material, reflectivity), 1, 0, 1, false}};

// The numbers of a checker are its size and its colors.
_Static_assert(offsetof(Material, checks) == offsetof(Material, check_size) + sizeof(float), "");

#define PROPERTY_COUNT (sizeof properties / sizeof *properties)

static bool unknown_property(Tokens *tokens, Token property)
{
    const char *names[PROPERTY_COUNT];
    char list[128] = "";
    for (size_t i = 0; i < PROPERTY_COUNT; i++) {
        names[i] = properties[i].name;
        strcat(strcat(list, i == 0 ? "" : ", "), names[i]);
    }
    const char *nearest = word_nearest(property.text, property.length, names, PROPERTY_COUNT);
    return nearest == NULL
               ? tokens_fail(tokens, property, "expected a property of a material (%s)", list)
               : tokens_fail(tokens, property, "unknown property (did you mean '%s'?)", nearest);
}

static bool read_property(Tokens *tokens, Token property, Material *material)
{
    size_t i = 0;
    while (i < PROPERTY_COUNT && !token_is(property, properties[i].name))
        i++;
    if (i == PROPERTY_COUNT)
        return unknown_property(tokens, property);
    float *values = (float *)(void *)((char *)material + properties[i].offset);
    for (int place = 0; place < properties[i].count; place++) {
        const double least = place == 0 ? properties[i].least : 0;
        const double most = place == 0 ? properties[i].most : 1;
        double value;
        if (!tokens_number_within(tokens, &value, least, most))
            return false;
        values[place] = (float)value;
    }
    if (properties[i].offset == offsetof(Material, shininess))
        material_set_shininess(material, material->shininess);
    return true;
}

static bool read_shader(Tokens *tokens, Shader *shader)
{
    const Token token = tokens_next(tokens);
    for (int kind = SHADER_SILHOUETTE; kind <= SHADER_BLINN_PHONG; kind++) {
        if (token_is(token, shader_names[kind])) {
            *shader = (Shader)kind;
            return true;
        }
    }
    return tokens_fail(tokens, token, "expected 'silhouette', 'matte' or 'blinn_phong'");
}

bool material_read(Material *material, Tokens *tokens)
{
    Shader shader = SHADER_MATTE;
    if (!read_shader(tokens, &shader))
        return false;
    *material = material_of_shader(shader);
    for (;;) {
        const Token property = tokens_next(tokens);
        if (property.text == NULL)
            return true;
        if (!read_property(tokens, property, material))
            return false;
    }
}

void material_write(const Material *material, FILE *stream)
{
    fputs(shader_names[material->shader], stream);
    for (size_t i = 0; i < PROPERTY_COUNT; i++) {
        const void *values = (const char *)material + properties[i].offset;
        if ((properties[i].is_shine && material->shader != SHADER_BLINN_PHONG) ||
            (values == &material->check_size && material->check_size == 0))
            continue;
        fprintf(stream, " %s", properties[i].name);
        for (int place = 0; place < properties[i].count; place++)
            number_write_float(stream, ((const float *)values)[place]);
    }
}
