// SPDX-License-Identifier: MIT
// Reads material definitions. Missing properties get the course's values for the material's shader.
#include "scene/statements.h"

#include "base/limits.h"
#include "base/number.h"
#include "base/word.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    size_t offset; // of the floats in Material
    int count;
    double most;
} properties[] = {{"diffuse", offsetof(Material, diffuse), 3, 1},
                  {"specular", offsetof(Material, specular), 3, 1},
                  {"kd", offsetof(Material, kd), 1, FACTOR_MOST},
                  {"ks", offsetof(Material, ks), 1, FACTOR_MOST},
                  {"shininess", offsetof(Material, shininess), 1, SHININESS_MOST},
                  {"reflectivity", offsetof(Material, reflectivity), 1, 1}};

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
    static const char *const names[] = {"silhouette", "matte", "blinn_phong"};
    const Token token = tokens_next(tokens);
    for (int kind = SHADER_SILHOUETTE; kind <= SHADER_BLINN_PHONG; kind++) {
        if (token_is(token, names[kind])) {
            *shader = (Shader)kind;
            return true;
        }
    }
    return tokens_fail(tokens, token, "expected 'silhouette', 'matte' or 'blinn_phong'");
}

static const MaterialName *find_name(const Scene *scene, Token token)
{
    return token.text == NULL
               ? NULL
               : material_names_find(&scene->material_names, token.text, token.length);
}

static bool read_name(const Scene *scene, Tokens *tokens, MaterialName *entry)
{
    double number;
    const Token token = tokens_next(tokens);
    if (token.text == NULL || token.length >= sizeof entry->name)
        return tokens_fail(tokens, token, "expected a name of at most %zu bytes",
                           sizeof entry->name - 1);
    if (number_parse(token.text, token.text + token.length, &number) != NULL)
        return tokens_fail(tokens, token, "a name must not begin like a number");
    if (find_name(scene, token) != NULL)
        return tokens_fail(tokens, token, "this name is already defined");
    memcpy(entry->name, token.text, token.length);
    entry->name[token.length] = '\0';
    return true;
}

bool materials_define(Scene *scene, Tokens *tokens)
{
    MaterialName entry = {.material = (uint32_t)scene->materials.count};
    Shader shader = SHADER_MATTE;
    if (!read_name(scene, tokens, &entry) || !read_shader(tokens, &shader))
        return false;
    Material material = material_of_shader(shader);
    for (;;) {
        const Token property = tokens_next(tokens);
        if (property.text == NULL)
            break;
        if (!read_property(tokens, property, &material))
            return false;
    }
    return material_names_add(&scene->material_names, &entry, tokens->error) &&
           array_push(&scene->materials, material, tokens->error);
}

static bool unknown_name(const Scene *scene, const Tokens *tokens, Token token)
{
    const char *nearest = NULL;
    const size_t count = scene->material_names.list.count;
    const char **names = memory_raw(count, sizeof *names, tokens->error);
    if (names == NULL)
        return false;
    for (size_t i = 0; i < count; i++)
        names[i] = scene->material_names.list.data[i].name;
    if (token.text != NULL)
        nearest = word_nearest(token.text, token.length, names, count);
    if (nearest == NULL)
        tokens_fail(tokens, token, "expected an integer or a defined name");
    else
        tokens_fail(tokens, token, "undefined material (did you mean '%s'?)", nearest);
    free(names);
    return false;
}

bool materials_select(const Scene *scene, Tokens *tokens, uint32_t *material)
{
    int64_t number;
    const Token token = tokens_next(tokens);
    const char *end = token.text == NULL ? NULL : token.text + token.length;
    if (token.text != NULL && integer_parse(token.text, end, &number) == end) {
        *material = number >= 0 && number < COURSE_MATERIALS ? (uint32_t)number : 0;
        return true;
    }
    const MaterialName *entry = find_name(scene, token);
    if (entry == NULL && !token_is(token, "own"))
        return unknown_name(scene, tokens, token);
    *material = entry != NULL ? entry->material : MATERIAL_OWN;
    return true;
}
