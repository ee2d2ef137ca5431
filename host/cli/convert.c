// SPDX-License-Identifier: MIT
// clrt convert: writes a scene as scene text with PLY meshes, or as one PLY mesh. clrt reads all
// files before it writes any, and never overwrites a file that it has read.
#include "cli/commands.h"

#include "base/file.h"
#include "base/output_file.h"
#include "base/print.h"
#include "base/text.h"
#include "cli/stages.h"
#include "mesh/ply_write.h"
#include "scene/scn_write.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const Options *options;
    Scene scene;
    char **mesh_paths; // the PLY files beside the scene text; NULL for one PLY mesh; owned
    char **mesh_names; // the file names at the ends of mesh_paths; the array is owned
} Conversion;

static bool write_ply(void *context, FILE *stream, Error *cause)
{
    (void)cause;
    return ply_write(context, stream);
}

static bool write_scn(void *context, FILE *stream, Error *cause)
{
    const Conversion *conversion = context;
    return scn_write(&conversion->scene, conversion->mesh_names, stream, cause);
}

static bool write_mesh(const Conversion *conversion, Mesh *mesh, const char *path, Error *error)
{
    if (!output_file_write(path, write_ply, mesh, error))
        return false;
    if (conversion->options->verbose)
        print_text(stderr, "%s: %zu triangles\n", path, mesh->triangle_count);
    return true;
}

// Prints which data the PLY file does not store.
static void warn_of_losses(const Conversion *conversion)
{
    const Scene *scene = &conversion->scene;
    const bool is_mesh = scene->mesh_up != UP_AUTO;
    bool has_materials = false;
    for (size_t i = 0; i < scene->objects.count; i++)
        has_materials |= scene->objects.data[i].material >= MESH_OWN_MATERIALS;
    if (!is_mesh || has_materials)
        stage_note(conversion->options, "%s: %s left out, because PLY cannot store them",
                   conversion->options->other_path,
                   is_mesh ? "materials are" : "materials, lights and cameras are");
}

static ExitCode write_joined(const Conversion *conversion, Error *error)
{
    Mesh mesh;
    Error cause = {0};
    const Scene *scene = &conversion->scene;
    if (scene->spheres.count > 0 && scene->mesh_up == UP_AUTO) {
        error_set(error, "%s: PLY cannot store spheres: convert the scene to .scn",
                  conversion->options->scene_path);
        return EXIT_SCENE;
    }
    if (!scn_write_join(&mesh, scene, &cause)) {
        error_set(error, "%s: %s", conversion->options->scene_path, cause.text);
        return EXIT_SCENE;
    }
    warn_of_losses(conversion);
    const bool ok = write_mesh(conversion, &mesh, conversion->options->other_path, error);
    mesh_free(&mesh);
    return ok ? EXIT_DONE : EXIT_OUTPUT;
}

// Gives the meshes of STEM.scn the paths STEM-1.ply, STEM-2.ply and so on.
static bool name_meshes(Conversion *conversion, Error *error)
{
    const char *path = conversion->options->other_path;
    const char *name = text_file_name(path);
    const int stem = (int)(strlen(path) - strlen(".scn"));
    const size_t count = conversion->scene.objects.count;
    conversion->mesh_paths = memory_zeroed(count, sizeof *conversion->mesh_paths, error);
    conversion->mesh_names = memory_zeroed(count, sizeof *conversion->mesh_names, error);
    if (conversion->mesh_paths == NULL || conversion->mesh_names == NULL)
        return false;
    if (!scn_write_can_name(name))
        return error_set(error, "%s: scene text cannot contain this name: choose another", path);
    for (size_t i = 0; i < count; i++) {
        conversion->mesh_paths[i] = text_format(error, "%.*s-%zu.ply", stem, path, i + 1);
        if (conversion->mesh_paths[i] == NULL)
            return false;
        conversion->mesh_names[i] = conversion->mesh_paths[i] + (name - path);
    }
    return true;
}

static bool check_files(const Conversion *conversion, Error *error)
{
    FilePlan plan = {0};
    const Scene *scene = &conversion->scene;
    bool ok = command_files_add(&plan, conversion->options, scene, error);
    for (size_t i = 0; ok && conversion->mesh_paths != NULL && i < scene->objects.count; i++)
        ok = file_plan_add(&plan, FILE_OUTPUT, "the output ", conversion->mesh_paths[i], error);
    ok = ok && file_plan_check(&plan, error);
    file_plan_free(&plan);
    return ok;
}

static bool write_meshes(const Conversion *conversion, Error *error)
{
    const Scene *scene = &conversion->scene;
    bool ok = true;
    for (size_t i = 0; ok && i < scene->objects.count; i++)
        ok = write_mesh(conversion, &scene->objects.data[i].mesh, conversion->mesh_paths[i], error);
    return ok;
}

static ExitCode write_text(Conversion *conversion, Error *error)
{
    const bool ok =
        write_meshes(conversion, error) &&
        output_file_write(conversion->options->other_path, write_scn, conversion, error);
    return ok ? EXIT_DONE : EXIT_OUTPUT;
}

static ExitCode run(Conversion *conversion, Error *error)
{
    const Options *options = conversion->options;
    if (!stage_read(&conversion->scene, options, error) ||
        !check_geometry(options, &conversion->scene, error))
        return EXIT_SCENE;
    const bool is_mesh = file_has_ending(options->other_path, ".ply");
    if ((!is_mesh && !name_meshes(conversion, error)) || !check_files(conversion, error))
        return EXIT_OUTPUT;
    return is_mesh ? write_joined(conversion, error) : write_text(conversion, error);
}

ExitCode convert_scene(const Options *options, Error *error)
{
    Conversion conversion = {.options = options};
    if (!file_has_ending(options->other_path, ".scn") &&
        !file_has_ending(options->other_path, ".ply")) {
        error_set(error, "clrt convert writes .scn and .ply, not '%s'", options->other_path);
        return EXIT_USAGE;
    }
    const ExitCode outcome = run(&conversion, error);
    for (size_t i = 0; conversion.mesh_paths != NULL && i < conversion.scene.objects.count; i++)
        free(conversion.mesh_paths[i]);
    free(conversion.mesh_paths);
    free(conversion.mesh_names);
    scene_free(&conversion.scene);
    return outcome;
}
