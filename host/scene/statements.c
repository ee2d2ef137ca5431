// SPDX-License-Identifier: MIT
// Reads the arguments of `define`, `material`, `mesh` and `ply_file`. scn.c reads all other
// statements.
#include "scene/statements.h"

#include "base/clock.h"
#include "base/number.h"
#include "base/text.h"
#include "mesh/foreign_stream.h"
#include "mesh/mesh.h"
#include "scene/material_text.h"

#include <stdlib.h>
#include <string.h>

// The following functions add materials and find them by name.

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

bool define_statement_read(Scene *scene, Tokens *tokens)
{
    MaterialName entry = {.material = (uint32_t)scene->materials.count};
    Material material;
    if (!read_name(scene, tokens, &entry) || !material_read(&material, tokens))
        return false;
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
        names[i] = scene->material_names.list.data[i]->name;
    if (token.text != NULL)
        nearest = word_nearest(token.text, token.length, names, count);
    if (nearest == NULL)
        tokens_fail(tokens, token, "expected an integer or the name of a 'define' above");
    else
        tokens_fail(tokens, token, "undefined material (did you mean '%s'?)", nearest);
    free(names);
    return false;
}

static bool find_material(const Scene *scene, const Tokens *tokens, Token token, uint32_t *material)
{
    int64_t number;
    const char *end = token.text == NULL ? NULL : token.text + token.length;
    if (token.text != NULL && integer_parse(token.text, end, &number) == end) {
        *material = number >= 0 && number < COURSE_MATERIALS ? (uint32_t)number : 0;
        return true;
    }
    const MaterialName *entry = find_name(scene, token);
    if (entry == NULL)
        return unknown_name(scene, tokens, token);
    *material = entry->material;
    return true;
}

const MaterialChoice material_own = {.colored = COURSE_MATTE, .is_own = true};

bool material_statement_read(const Scene *scene, Tokens *tokens, MaterialChoice *choice)
{
    Token token = tokens_next(tokens);
    *choice = (MaterialChoice){0};
    if (token_is(token, "own") && find_name(scene, token) == NULL) {
        *choice = material_own;
        if (!tokens_have_more(tokens))
            return true;
        token = tokens_next(tokens);
    }
    const bool ok = find_material(scene, tokens, token, &choice->plain);
    choice->colored = choice->plain;
    return ok;
}

// The following functions add a file's meshes and apply the transforms of a `mesh` statement in the
// written order, in fp64.

static Vec3 rotated(Vec3 v, Vec3 axis, double sine, double cosine)
{
    const Vec3 along = vec3_scale(axis, vec3_dot(axis, v) * (1 - cosine));
    const Vec3 across = vec3_scale(vec3_cross(axis, v), sine);
    return vec3_add(vec3_add(vec3_scale(v, cosine), across), along);
}

// Returns a factor for all normals of a mesh. The factor prevents overflow, because a rotation can
// make a component sqrt(3) times as large. One common factor keeps the ratios of the normals'
// lengths.
static double normal_scale(const Mesh *mesh)
{
    for (size_t i = 0; mesh->normals != NULL && i < mesh->vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            if (fabsf(mesh->normals[i][axis]) > 0x1p125f)
                return 0.125;
    return 1;
}

static void rotate_mesh(Mesh *mesh, Vec3 axis, double degrees)
{
    const double sine = sine_of_degrees(degrees), cosine = cosine_of_degrees(degrees);
    const double scale = normal_scale(mesh);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        double *p = mesh->positions[i];
        vec3_store_doubles(p, rotated(vec3_of_doubles(p), axis, sine, cosine));
        if (mesh->normals == NULL)
            continue;
        float *n = mesh->normals[i];
        vec3_store(n, rotated(vec3_scale(vec3_of_floats(n), scale), axis, sine, cosine));
    }
}

// The objects that the statement added.
typedef struct {
    MeshObject *data;
    size_t count;
} Objects;

static bool read_rotation(Tokens *tokens, Objects objects)
{
    double axis[3], degrees;
    if (!tokens_numbers(tokens, 3, axis) || !tokens_number_within(tokens, &degrees, -1e6, 1e6))
        return false;
    const Vec3 unit = vec3_normalize(vec3_of_doubles(axis));
    if (!(vec3_extent(unit) > 0))
        return tokens_fail(tokens, tokens->last, "the axis of rotation must not be zero");
    for (size_t object = 0; object < objects.count; object++)
        rotate_mesh(&objects.data[object].mesh, unit, degrees);
    return true;
}

static void scale_mesh(Mesh *mesh, double scale)
{
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            mesh->positions[i][axis] *= scale;
}

static bool read_scale(Tokens *tokens, Objects objects)
{
    double scale;
    if (!tokens_number_within(tokens, &scale, 1e-30, 1e30))
        return false;
    for (size_t object = 0; object < objects.count; object++)
        scale_mesh(&objects.data[object].mesh, scale);
    return true;
}

static void translate_mesh(Mesh *mesh, const double offset[3])
{
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            mesh->positions[i][axis] += offset[axis];
}

static bool read_translation(Tokens *tokens, Objects objects)
{
    double offset[3];
    if (!tokens_numbers(tokens, 3, offset))
        return false;
    for (size_t object = 0; object < objects.count; object++)
        translate_mesh(&objects.data[object].mesh, offset);
    return true;
}

static bool read_up_axis(Tokens *tokens, Objects objects)
{
    const Token token = tokens_next(tokens);
    UpAxis up = UP_X;
    while (up < UP_AXES && !token_is(token, up_axis_names[up]))
        up++;
    if (up == UP_AXES)
        return tokens_fail(tokens, token, "expected x, y, z, -x, -y or -z");
    for (size_t object = 0; object < objects.count; object++)
        mesh_turn_up(&objects.data[object].mesh, up);
    return true;
}

static bool read_transforms(Tokens *tokens, Objects objects)
{
    for (;;) {
        const Token token = tokens_next(tokens);
        if (token.text == NULL)
            return true;
        bool ok;
        if (token_is(token, "scale"))
            ok = read_scale(tokens, objects);
        else if (token_is(token, "rotate"))
            ok = read_rotation(tokens, objects);
        else if (token_is(token, "translate"))
            ok = read_translation(tokens, objects);
        else if (token_is(token, "up"))
            ok = read_up_axis(tokens, objects);
        else
            ok = tokens_fail(tokens, token, "expected 'up', 'scale', 'rotate' or 'translate'");
        if (!ok)
            return false;
    }
}

// Fails if a coordinate of a vertex is outside [-1e30, 1e30], the range that the rest of the
// program requires.
static bool positions_in_range(const Tokens *tokens, const Mesh *mesh)
{
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            if (!(mesh->positions[i][axis] >= -1e30 && mesh->positions[i][axis] <= 1e30))
                return error_set(tokens->error, "%s:%u: the transforms move vertex %zu past 1e30",
                                 tokens->name, tokens->line, i);
    return true;
}

static bool positions_are_kept(const Tokens *tokens, Objects objects)
{
    for (size_t object = 0; object < objects.count; object++)
        if (!positions_in_range(tokens, &objects.data[object].mesh))
            return false;
    return true;
}

static bool add_ply(Scene *scene, const char *path, const MeshLoadOptions *options, Error *cause,
                    Error *error)
{
    File file;
    if (!file_read(&file, path, cause))
        return false;
    const bool ok = mesh_load_ply(scene, &file, path, options, error);
    file_free(&file);
    return ok;
}

// Loads the mesh file. If a message names no position in the mesh file, it begins with the path's
// position in the scene file.
static bool add_objects(Scene *scene, const Tokens *tokens, Token path,
                        const MeshLoadOptions *options)
{
    Error *error = tokens->error;
    Error cause = {0};
    char *relative = text_format(error, "%.*s", (int)path.length, path.text);
    char *full = relative != NULL ? file_path_beside(tokens->name, relative, error) : NULL;
    const bool ok = full != NULL && (!options->is_plain_ply && foreign_format_is(full)
                                         ? mesh_load_foreign(scene, full, options, &cause)
                                         : add_ply(scene, full, options, &cause, error));
    if (cause.text[0] != '\0')
        error_set(error, "%s:%u:%u: %s", tokens->name, path.line, path.column, cause.text);
    free(full);
    free(relative);
    return ok;
}

// Meshes with fewer triangles than this usually show flat faces on purpose.
#define ROUND_TRIANGLES 100

// Adds a note for each reflective mesh without normals, because its triangles look like separate
// flat mirrors.
static bool note_flat_mirrors(Scene *scene, Objects added, const MeshLoadOptions *options,
                              Error *error)
{
    bool ok = true;
    for (size_t i = 0; ok && i < added.count && !options->is_flat; i++) {
        const MeshObject *object = &added.data[i];
        const bool reflects = scene->materials.data[object->material].reflectivity > 0;
        if (reflects && object->mesh.normals == NULL &&
            object->mesh.triangle_count >= ROUND_TRIANGLES)
            ok = scene_add_note(
                scene, scene->inputs.data[object->input],
                "it has no normals, so its mirrors are flat triangles: 'normals "
                "smooth' before the mesh smooths them, and 'normals flat' keeps them",
                error);
    }
    return ok;
}

bool mesh_statement_read(Scene *scene, Tokens *tokens, const MeshLoadOptions *options)
{
    const size_t count = scene->objects.count;
    const Token path = tokens_next(tokens);
    if (path.text == NULL || path.length == 0)
        return tokens_fail(tokens, path, "expected the path of a mesh");
    if (memchr(path.text, '\0', path.length) != NULL)
        return tokens_fail(tokens, path, "expected a path without a zero byte");
    const double start = clock_seconds();
    if (!add_objects(scene, tokens, path, options))
        return false;
    const Objects added = {scene->objects.data + count, scene->objects.count - count};
    const bool ok = options->is_plain_ply ||
                    (read_transforms(tokens, added) && positions_are_kept(tokens, added));
    const bool is_complete = ok && mesh_load_normals(scene, count, options, tokens->error) &&
                             note_flat_mirrors(scene, added, options, tokens->error);
    scene->mesh_seconds += clock_seconds() - start;
    return is_complete;
}
