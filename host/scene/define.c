// SPDX-License-Identifier: MIT
// Reads material definitions. Missing properties get the course's values for the material's shader.
#include "scene/define.h"

#include "base/limits.h"
#include "base/number.h"
#include "base/word.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Powers with integer exponents up to this are computed by squaring, which gives the same bits on
// every device.
#define LARGEST_INTEGER_EXPONENT 1024

static bool read_color(Tokens *tokens, float color[3])
{
    for (int channel = 0; channel < 3; channel++) {
        double value;
        if (!tokens_number_within(tokens, &value, 0, 1))
            return false;
        color[channel] = (float)value;
    }
    return true;
}

static bool read_factor(Tokens *tokens, float *factor, double largest)
{
    double value;
    if (!tokens_number_within(tokens, &value, 0, largest))
        return false;
    *factor = (float)value;
    return true;
}

void material_set_shininess(Material *material, float shininess)
{
    const bool by_squaring =
        shininess <= LARGEST_INTEGER_EXPONENT && shininess == floorf(shininess);
    material->shininess = shininess;
    material->exponent = by_squaring ? (uint32_t)shininess : UINT32_MAX;
}

static bool read_shininess(Tokens *tokens, Material *material)
{
    float shininess;
    if (!read_factor(tokens, &shininess, SHININESS_MOST))
        return false;
    material_set_shininess(material, shininess);
    return true;
}

static bool read_property(Tokens *tokens, Token property, Material *material)
{
    static const char *const properties[] = {"diffuse", "specular",  "kd",
                                             "ks",      "shininess", "reflectivity"};
    if (token_is(property, "diffuse"))
        return read_color(tokens, material->diffuse);
    if (token_is(property, "specular"))
        return read_color(tokens, material->specular);
    if (token_is(property, "kd"))
        return read_factor(tokens, &material->kd, FACTOR_MOST);
    if (token_is(property, "ks"))
        return read_factor(tokens, &material->ks, FACTOR_MOST);
    if (token_is(property, "shininess"))
        return read_shininess(tokens, material);
    if (token_is(property, "reflectivity"))
        return read_factor(tokens, &material->reflectivity, 1);
    const char *nearest = word_nearest(property.text, property.length, properties, 6);
    return nearest == NULL
               ? tokens_fail(tokens, property, "expected a property of a material")
               : tokens_fail(tokens, property, "unknown property (did you mean '%s'?)", nearest);
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
    for (size_t i = 0; i < scene->material_names.count; i++)
        if (token_is(token, scene->material_names.data[i].name))
            return &scene->material_names.data[i];
    return NULL;
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
    return array_push(&scene->material_names, entry, tokens->error) &&
           array_push(&scene->materials, material, tokens->error);
}

static bool unknown_name(const Scene *scene, const Tokens *tokens, Token token)
{
    const char *nearest = NULL;
    const char **names = memory_raw(scene->material_names.count, sizeof *names, tokens->error);
    if (names == NULL)
        return false;
    for (size_t i = 0; i < scene->material_names.count; i++)
        names[i] = scene->material_names.data[i].name;
    if (token.text != NULL)
        nearest = word_nearest(token.text, token.length, names, scene->material_names.count);
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
