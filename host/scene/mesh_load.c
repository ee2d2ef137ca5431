// SPDX-License-Identifier: MIT
// Reads a mesh file and moves its meshes into the scene's objects. clrt reads PLY itself, and
// clrt-foreign reads all other formats. A material of a file is named FILE:NAME, so that materials
// of two files rarely have the same name.
#include "scene/mesh_load.h"

#include "base/text.h"
#include "mesh/foreign_stream.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Converts a file's material to Blinn-Phong or, if it has no highlights, to matte.
static Material material_of(const ForeignMaterial *given)
{
    const bool shines = given->shininess > 0 && (given->specular[0] > 0 || given->specular[1] > 0 ||
                                                 given->specular[2] > 0);
    Material material = material_of_shader(shines ? SHADER_BLINN_PHONG : SHADER_MATTE);
    material.kd = 1;
    memcpy(material.diffuse, given->diffuse, sizeof material.diffuse);
    if (shines) {
        material.ks = 1;
        memcpy(material.specular, given->specular, sizeof material.specular);
        material_set_shininess(&material, given->shininess);
    }
    return material;
}

static MaterialName name_of(const ForeignMaterial *given, const char *path, uint32_t material)
{
    MaterialName name = {.material = material};
    snprintf(name.name, sizeof name.name, "%.30s:%s", text_file_name(path), given->name);
    return name;
}

static bool add_materials(Scene *scene, const ForeignModel *model, const char *path, Error *error)
{
    for (size_t i = 0; i < model->materials.count; i++) {
        const ForeignMaterial *given = &model->materials.data[i];
        const MaterialName name = name_of(given, path, (uint32_t)scene->materials.count);
        if (!array_push(&scene->materials, material_of(given), error) ||
            !material_names_add(&scene->material_names, &name, error))
            return false;
    }
    return true;
}

// Adds the model's files to the scene's inputs and hashes. The first file is the model itself,
// which the inputs list as `path`.
static bool add_files(Scene *scene, const ForeignModel *model, const char *path, Error *error)
{
    if (!scene_add_input(scene, path, error))
        return false;
    for (size_t i = 0; i < model->files.count; i++) {
        const ForeignHash *hash = &model->hashes.data[i];
        scene_hash_mesh(scene, hash, sizeof *hash);
        if (i > 0 && !scene_add_input(scene, model->files.data[i], error))
            return false;
    }
    return true;
}

// Drops the mesh's colors if the file's materials are ignored. If colors remain, chooses the
// material that shows them.
static void choose_colors(MeshObject *object, const MeshLoadOptions *options)
{
    if (!options->takes_own_materials)
        mesh_drop_colors(&object->mesh);
    else if (object->mesh.colors != NULL)
        object->material = options->colored_material;
}

// Moves the parts' meshes into scene objects.
static bool add_parts(Scene *scene, ForeignModel *model, const MeshLoadOptions *options,
                      uint32_t first_material, Error *error)
{
    uint64_t number_before = 0;
    for (size_t i = 0; i < model->parts.count; i++) {
        ForeignPart *part = &model->parts.data[i];
        MeshObject object = options->object;
        object.mesh = part->mesh;
        object.number_before = number_before;
        choose_colors(&object, options);
        if (options->takes_own_materials && part->material != FOREIGN_NO_MATERIAL)
            object.material = first_material + part->material;
        part->mesh = object.mesh;
        if (!array_push(&scene->objects, object, error))
            return false;
        part->mesh = (Mesh){0};
        number_before += object.mesh.triangle_count + object.mesh.dropped.count;
    }
    return true;
}

static bool add_model(Scene *scene, ForeignModel *model, const char *path,
                      const MeshLoadOptions *options, Error *error)
{
    MeshLoadOptions here = *options;
    here.object.input = (uint32_t)scene->inputs.count;
    const uint32_t first_material = (uint32_t)scene->materials.count;
    return (model->note == NULL || scene_add_note(scene, path, model->note, error)) &&
           add_files(scene, model, path, error) &&
           (!options->takes_own_materials || add_materials(scene, model, path, error)) &&
           add_parts(scene, model, &here, first_material, error);
}

void mesh_load_free_kept(KeptFiles *files)
{
    for (size_t i = 0; i < files->files.count; i++) {
        free(files->files.data[i].path);
        file_free(&files->files.data[i].stream);
    }
    free(files->files.memory);
    *files = (KeptFiles){0};
}

static const File *kept_stream(const KeptFiles *kept, const char *path)
{
    for (size_t i = 0; kept != NULL && i < kept->files.count; i++)
        if (strcmp(kept->files.data[i].path, path) == 0)
            return &kept->files.data[i].stream;
    return NULL;
}

// Keeps clrt-foreign's output for later statements with the same path. Frees the output if `kept`
// is NULL or full.
static void keep_or_free(KeptFiles *kept, const char *path, File *stream)
{
    Error unused = {0};
    const bool fits = kept != NULL && stream->size <= FOREIGN_KEPT_MOST - kept->size;
    const KeptFile file = {fits ? text_copy(path, &unused) : NULL, *stream};
    if (file.path != NULL && array_push(&kept->files, file, &unused)) {
        kept->size += stream->size;
        return;
    }
    free(file.path);
    file_free(stream);
}

bool mesh_load_foreign(Scene *scene, const char *path, const MeshLoadOptions *options, Error *error)
{
    // clrt-foreign sets itself a shorter time limit, so it normally ends before it is killed.
    static const ForeignReader assimp = {
        .library = "Assimp", .seconds = 125, .bytes = (size_t)8 << 30};
    const char *const words[FOREIGN_WORDS] = {path};
    const File *kept = kept_stream(options->kept, path);
    File stream = {0};
    ForeignModel model = {0};
    Error cause = {0};
    const bool parsed = kept != NULL || foreign_run(&stream, &assimp, words, &cause)
                            ? foreign_stream_parse(&model, kept != NULL ? kept : &stream, path,
                                                   options->is_tolerant, error)
                            : error_set(error, "%s: %s", path, cause.text);
    if (kept == NULL)
        keep_or_free(options->kept, path, &stream);
    const bool ok = parsed && add_model(scene, &model, path, options, error);
    foreign_model_free(&model);
    return ok;
}

bool mesh_load_ply(Scene *scene, const File *file, const char *path, const MeshLoadOptions *options,
                   Error *error)
{
    MeshObject object = options->object;
    object.input = (uint32_t)scene->inputs.count;
    scene_hash_mesh(scene, file->bytes, file->size);
    const PlySource source = {.bytes = file->bytes,
                              .size = file->size,
                              .name = path,
                              .is_tolerant = options->is_tolerant};
    bool ok = ply_parse(&object.mesh, &source, error) && scene_add_input(scene, path, error);
    choose_colors(&object, options);
    ok = ok && array_push(&scene->objects, object, error);
    if (!ok)
        mesh_free(&object.mesh);
    return ok;
}

// Computes the crease angle that suits the shape of the objects from index `first` on. Ignores
// objects that have all normals.
static bool choose_crease(const Scene *scene, size_t first, double *degrees, Error *error)
{
    EdgeAngles angles = {0};
    bool ok = true;
    for (size_t i = first; ok && i < scene->objects.count; i++)
        if (!mesh_has_all_normals(&scene->objects.data[i].mesh))
            ok = normals_add_angles(&angles, &scene->objects.data[i].mesh, error);
    *degrees = normals_crease(&angles);
    return ok;
}

static bool add_normals(MeshObject *object, const MeshLoadOptions *options, double crease,
                        Error *error)
{
    if (!options->is_flat)
        return crease == NO_CREASE || mesh_compute_normals(&object->mesh, crease, error);
    mesh_drop_normals(&object->mesh);
    return true;
}

bool mesh_load_normals(const Scene *scene, size_t first, const MeshLoadOptions *options,
                       Error *error)
{
    Error cause = {0};
    double crease = options->crease_degrees;
    const size_t end = options->is_tolerant ? first : scene->objects.count;
    // For a single mesh, mesh_compute_normals chooses the angle, which saves a second pass over the
    // edges.
    if (crease == CREASE_BY_SHAPE && end > first + 1 &&
        !choose_crease(scene, first, &crease, &cause))
        return error_set(error, "%s: %s", scene->inputs.data[scene->objects.data[first].input],
                         cause.text);
    for (size_t i = first; i < end; i++) {
        MeshObject *object = &scene->objects.data[i];
        if (!add_normals(object, options, crease, &cause))
            return error_set(error, "%s: %s", scene->inputs.data[object->input], cause.text);
    }
    return true;
}
