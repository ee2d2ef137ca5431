// SPDX-License-Identifier: MIT
// Sorting makes duplicate meshes, spheres and lights adjacent.
#include "check/census.h"

#include "base/array.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

// Two objects of one kind are duplicates if these bits are equal.
typedef struct {
    double numbers[4];
} Identity;

static int compare_identities(const void *first, const void *second)
{
    return memcmp(first, second, sizeof(Identity));
}

static size_t count_duplicates(Identity *identities, size_t count)
{
    size_t duplicates = 0;
    qsort(identities, count, sizeof *identities, compare_identities);
    for (size_t i = 1; i < count; i++)
        duplicates += compare_identities(&identities[i - 1], &identities[i]) == 0;
    return duplicates;
}

// Adding 0.0 turns -0 into 0.
static Identity identity_of(Vec3 position, double radius)
{
    return (Identity){{position.x + 0.0, position.y + 0.0, position.z + 0.0, radius}};
}

static Identity identity_of_mesh(const Mesh *mesh)
{
    Identity identity = {{0}};
    const XXH128_hash_t positions =
        XXH3_128bits(mesh->positions, mesh->vertex_count * sizeof *mesh->positions);
    const XXH128_hash_t triangles =
        XXH3_128bits(mesh->triangles, mesh->triangle_count * sizeof *mesh->triangles);
    const uint64_t words[4] = {positions.low64, positions.high64, triangles.low64,
                               triangles.high64};
    memcpy(identity.numbers, words, sizeof words);
    return identity;
}

static bool find_duplicates(Census *census, const Scene *scene, Error *error)
{
    const size_t count = scene->objects.count + scene->spheres.count + scene->lights.count;
    Identity *identities = memory_zeroed(count, sizeof *identities, error);
    if (identities == NULL)
        return false;
    size_t meshes = 0;
    for (size_t i = 0; i < scene->objects.count; i++)
        if (scene->objects.data[i].mesh.triangle_count > 0)
            identities[meshes++] = identity_of_mesh(&scene->objects.data[i].mesh);
    census->duplicate_meshes = count_duplicates(identities, meshes);
    for (size_t i = 0; i < scene->spheres.count; i++)
        identities[i] = identity_of(scene->spheres.data[i].center, scene->spheres.data[i].radius);
    census->duplicate_spheres = count_duplicates(identities, scene->spheres.count);
    for (size_t i = 0; i < scene->lights.count; i++)
        identities[i] = identity_of(scene->lights.data[i].position, 0);
    census->duplicate_lights = count_duplicates(identities, scene->lights.count);
    free(identities);
    return true;
}

static bool find_unused_materials(Census *census, const Scene *scene, Error *error)
{
    bool *is_used = memory_zeroed(scene->materials.count, sizeof *is_used, error);
    if (is_used == NULL)
        return false;
    for (size_t i = 0; i < scene->objects.count; i++)
        is_used[scene->objects.data[i].material] = true;
    for (size_t i = 0; i < scene->spheres.count; i++)
        is_used[scene->spheres.data[i].material] = true;
    const size_t first = scene->mesh_up != UP_AUTO ? MESH_OWN_MATERIALS : COURSE_MATERIALS;
    for (size_t i = first; i < scene->materials.count; i++)
        census->unused_materials += !is_used[i];
    free(is_used);
    return true;
}

// Replaces indices of triangles by their numbers in the file.
static void number_triangles(MeshCensus *census, const MeshObject *object)
{
    Closedness *closed = &census->closedness;
    Features *features = &census->features;
    size_t *const triangles[] = {
        &closed->open.first,      &closed->crowded.first,     &closed->turned.first,
        &closed->pinched.first,   &closed->duplicates.first,  &features->flat.first,
        &features->edge.triangle, &features->height.triangle, &features->written_edge.triangle};
    for (size_t i = 0; i < sizeof triangles / sizeof *triangles; i++)
        *triangles[i] = (size_t)number_in_file(object, *triangles[i]);
}

static bool take_mesh(MeshCensus *census, const MeshObject *object,
                      const Normalization *normalization, Error *error)
{
    const Mesh *mesh = &object->mesh;
    Weld weld = {0};
    Edges edges = {0};
    const bool ok = weld_make(&weld, mesh, error) && edges_make(&edges, mesh, &weld, error) &&
                    closedness_find(&census->closedness, mesh, &weld, &edges, error);
    census->features = features_of(mesh, normalization);
    census->unused_vertices = weld.unused_count;
    census->repeated_vertices = weld.repeated_count;
    number_triangles(census, object);
    edges_free(&edges);
    weld_free(&weld);
    return ok;
}

bool census_take(Census *census, const Scene *scene, const Normalization *normalization,
                 Error *error)
{
    *census = (Census){.mesh_count = scene->objects.count};
    census->meshes = memory_zeroed(scene->objects.count, sizeof *census->meshes, error);
    bool ok = census->meshes != NULL;
    for (size_t i = 0; ok && i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        census->empty_meshes += object->mesh.triangle_count == 0;
        ok = take_mesh(&census->meshes[i], object, normalization, error);
    }
    ok = ok && find_duplicates(census, scene, error) && find_unused_materials(census, scene, error);
    if (!ok)
        census_free(census);
    return ok;
}

void census_free(Census *census)
{
    free(census->meshes);
    *census = (Census){0};
}
