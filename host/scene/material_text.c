// SPDX-License-Identifier: MIT
// One table lists the properties for the reader and for the writer.
#include "scene/material_text.h"

#include "base/limits.h"
#include "base/number.h"
#include "base/word.h"

#include <stddef.h>
#include <string.h>

static const struct {
    const char *name;
    size_t offset; // of the floats in Material
    int count;
    double most;
    bool is_shine; // only Blinn-Phong materials use it
} properties[] = {{"diffuse", offsetof(Material, diffuse), 3, 1, false},
                  {"kd", offsetof(Material, kd), 1, FACTOR_MOST, false},
                  {"specular", offsetof(Material, specular), 3, 1, true},
                  {"ks", offsetof(Material, ks), 1, FACTOR_MOST, true},
                  {"shininess", offsetof(Material, shininess), 1, SHININESS_MOST, true},
                  {"reflectivity", offsetof(Material, reflectivity), 1, 1, false}};

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
        double value;
        if (!tokens_number_within(tokens, &value, 0, properties[i].most))
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
        if (properties[i].is_shine && material->shader != SHADER_BLINN_PHONG)
            continue;
        fprintf(stream, " %s", properties[i].name);
        const void *values = (const char *)material + properties[i].offset;
        for (int place = 0; place < properties[i].count; place++)
            number_write_float(stream, ((const float *)values)[place]);
    }
}
