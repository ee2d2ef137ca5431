// SPDX-License-Identifier: MIT
// Loads a mesh and applies its transforms in the order written, in fp64.
#include "scene/mesh_statement.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/trigonometry.h"

#include <stdlib.h>
#include <string.h>

static Vec3 rotated(Vec3 v, Vec3 axis, double sine, double cosine)
{
    const Vec3 along = vec3_scale(axis, vec3_dot(axis, v) * (1 - cosine));
    const Vec3 across = vec3_scale(vec3_cross(axis, v), sine);
    return vec3_add(vec3_add(vec3_scale(v, cosine), across), along);
}

// Normals of any length are read; turned, a component may grow by the root of three.  Only their
// lengths against each other count, so all of a mesh's are shortened where one could overflow.
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
        const Vec3 turned = rotated(vec3(p[0], p[1], p[2]), axis, sine, cosine);
        p[0] = turned.x, p[1] = turned.y, p[2] = turned.z;
        if (mesh->normals == NULL)
            continue;
        float *n = mesh->normals[i];
        const Vec3 given = {(double)n[0], (double)n[1], (double)n[2]};
        const Vec3 normal = rotated(vec3_scale(given, scale), axis, sine, cosine);
        n[0] = (float)normal.x, n[1] = (float)normal.y, n[2] = (float)normal.z;
    }
}

static bool read_rotation(Tokens *tokens, Mesh *mesh)
{
    double axis[3], degrees;
    if (!tokens_numbers(tokens, 3, axis) || !tokens_number_within(tokens, &degrees, -1e6, 1e6))
        return false;
    const Vec3 unit = vec3_normalize(vec3(axis[0], axis[1], axis[2]));
    if (!(vec3_extent(unit) > 0))
        return tokens_fail(tokens, tokens->last, "the axis of rotation must not be zero");
    rotate_mesh(mesh, unit, degrees);
    return true;
}

static bool read_scale(Tokens *tokens, Mesh *mesh)
{
    double scale;
    if (!tokens_number_within(tokens, &scale, 1e-30, 1e30))
        return false;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            mesh->positions[i][axis] *= scale;
    return true;
}

static bool read_translation(Tokens *tokens, Mesh *mesh)
{
    double offset[3];
    if (!tokens_numbers(tokens, 3, offset))
        return false;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            mesh->positions[i][axis] += offset[axis];
    return true;
}

static bool read_transforms(Tokens *tokens, Mesh *mesh)
{
    for (;;) {
        const Token token = tokens_next(tokens);
        if (token.text == NULL)
            return true;
        bool ok;
        if (token_is(token, "scale"))
            ok = read_scale(tokens, mesh);
        else if (token_is(token, "rotate"))
            ok = read_rotation(tokens, mesh);
        else if (token_is(token, "translate"))
            ok = read_translation(tokens, mesh);
        else
            ok = tokens_fail(tokens, token, "expected 'scale', 'rotate' or 'translate'");
        if (!ok)
            return false;
    }
}

// Repeated scaling could otherwise leave the range the rest of the program relies on.
static bool positions_in_range(const Tokens *tokens, const Mesh *mesh)
{
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            if (!(mesh->positions[i][axis] >= -1e30 && mesh->positions[i][axis] <= 1e30))
                return error_set(tokens->error, "%s:%u: the transforms move vertex %zu past 1e30",
                                 tokens->name, tokens->line, i);
    return true;
}

static bool load_mesh(Scene *scene, Mesh *mesh, const Tokens *tokens, Token path, PlyParse *parse)
{
    Error *error = tokens->error;
    Error cause = {0};
    char *relative = memory_zeroed(path.length + 1, 1, error);
    if (relative == NULL)
        return false;
    memcpy(relative, path.text, path.length);
    char *full = file_path_beside(tokens->name, relative, error);
    File file = {0};
    bool ok = full != NULL && file_read(&file, full, &cause);
    if (full != NULL && !ok)
        error_set(error, "%s:%u:%u: %s", tokens->name, path.line, path.column, cause.text);
    ok = ok && scene_add_input(scene, full, error);
    if (ok) {
        scene_hash_mesh(scene, file.bytes, file.size);
        ok = parse(mesh, file.bytes, file.size, full, error);
    }
    file_free(&file);
    free(full);
    free(relative);
    return ok;
}

bool mesh_statement_read(Scene *scene, Tokens *tokens, MeshObject object, PlyParse *parse)
{
    const bool transformable = strncmp(tokens->usage, "mesh", 4) == 0;
    const Token path = tokens_next(tokens);
    if (path.text == NULL || path.length == 0)
        return tokens_fail(tokens, path, "expected the path of a mesh");
    if (memchr(path.text, '\0', path.length) != NULL)
        return tokens_fail(tokens, path, "expected a path without a zero byte");
    const double start = clock_seconds();
    const bool loaded = load_mesh(scene, &object.mesh, tokens, path, parse);
    scene->mesh_seconds += clock_seconds() - start;
    const bool ok = loaded &&
                    (!transformable || (read_transforms(tokens, &object.mesh) &&
                                        positions_in_range(tokens, &object.mesh))) &&
                    array_push(&scene->objects, object, tokens->error);
    if (!ok)
        mesh_free(&object.mesh);
    return ok;
}
