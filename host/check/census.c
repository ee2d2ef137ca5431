// SPDX-License-Identifier: MIT
// Finds the faults of meshes from their edges. Counts duplicate meshes, spheres and lights by
// sorting, which makes duplicates adjacent.
#include "check/census.h"

#include "base/array.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

// The following functions visit each edge once and join its triangles into fans. A point with
// several fans is pinched.

static void judge_edge(MeshCensus *census, const EdgeSide *sides, size_t count)
{
    uint32_t lowest = sides[0].triangle;
    for (size_t side = 1; side < count; side++) {
        lowest = sides[side].triangle < lowest ? sides[side].triangle : lowest;
        // A duplicate triangle appears at three edges. It is counted only at the edge opposite the
        // point with the highest index.
        if (sides[side].opposite == sides[side - 1].opposite &&
            sides[side].opposite > sides[side].high)
            mesh_fault_add(&census->faults[FAULT_DUPLICATES], sides[side].triangle);
    }
    census->facts.edge_count++;
    if (count == 1)
        mesh_fault_add(&census->faults[FAULT_OPEN], lowest);
    else if (count > 2)
        mesh_fault_add(&census->faults[FAULT_CROWDED], lowest);
    else if (sides[0].falling == sides[1].falling)
        mesh_fault_add(&census->faults[FAULT_TURNED], lowest);
}

static void visit_edges(MeshCensus *census, const Edges *edges, Fans *fans)
{
    Edge edge = {0};
    while (edges_next(edges, &edge)) {
        const EdgeSide *sides = edge.sides;
        judge_edge(census, sides, edge.count);
        for (size_t side = 1; side < edge.count; side++) {
            fans_join(fans, edge.low, sides[0].triangle, sides[side].triangle);
            fans_join(fans, sides[0].high, sides[0].triangle, sides[side].triangle);
        }
    }
}

static bool count_pinched(MeshCensus *census, const Fans *fans, Error *error)
{
    const Mesh *mesh = fans->mesh;
    unsigned char *counts = memory_zeroed(mesh->vertex_count, 1, error); // fans by point, at most 2
    for (uint32_t corner = 0; counts != NULL && corner < 3 * mesh->triangle_count; corner++) {
        const uint32_t point = fans->weld->points[mesh->triangles[corner / 3][corner % 3]];
        if (fans->parents[corner] == corner && counts[point] < 2 && ++counts[point] == 2)
            mesh_fault_add(&census->faults[FAULT_PINCHED], corner / 3);
    }
    const bool ok = counts != NULL;
    free(counts);
    return ok;
}

// Returns six times the mesh's volume, scaled to prevent overflow. The result is positive if the
// backs of the triangles face the inside.
static double signed_volume(const Mesh *mesh)
{
    double volume = 0;
    const BoundingBox box = mesh_bounds(mesh);
    const double scale = 1 / vec3_extent(bounding_box_sides(&box));
    const Vec3 origin = mesh_corner(mesh, 0, 0);
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
        Vec3 corners[3];
        for (int corner = 0; corner < 3; corner++)
            corners[corner] =
                vec3_scale(vec3_sub(mesh_corner(mesh, triangle, corner), origin), scale);
        volume += vec3_dot(corners[0], vec3_cross(corners[1], corners[2]));
    }
    return volume;
}

bool mesh_faults_find(MeshCensus *census, const Mesh *mesh, const Edges *edges, Error *error)
{
    Fans fans;
    *census = (MeshCensus){0};
    if (!fans_make(&fans, mesh, edges, error))
        return false;
    visit_edges(census, edges, &fans);
    const bool ok = count_pinched(census, &fans, error);
    census->facts.closed = mesh->triangle_count > 0;
    for (FaultKind kind = FAULT_OPEN; kind < FAULT_KINDS; kind++)
        census->facts.closed = census->facts.closed && census->faults[kind].count == 0;
    census->facts.inside_out = census->facts.closed && signed_volume(mesh) < 0;
    free(fans.parents);
    return ok;
}

// Two objects of one kind are duplicates if their identities have equal bits.
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

// Returns the identity of a sphere or light. Adding 0.0 turns -0 into 0, so that both zeros have
// equal bits.
static Identity identity_of(Vec3 position, double radius)
{
    return (Identity){{position.x + 0.0, position.y + 0.0, position.z + 0.0, radius}};
}

static Identity identity_of_light(const Light *light)
{
    return light->is_sun ? identity_of(vec3_normalize(light->position), 1)
                         : identity_of(light->position, 0);
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
        identities[i] = identity_of_light(&scene->lights.data[i]);
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

// Adds the flat triangles, and the faults that the file's reader found. Replaces indices of
// triangles by their numbers in the file.
static void complete_faults(MeshCensus *census, const MeshObject *object)
{
    MeshFault *faults = census->faults;
    Feature *const details[] = {&census->features.edge, &census->features.height,
                                &census->features.written_edge};
    faults[FAULT_FLAT] = census->features.flat;
    for (FaultKind kind = FAULT_FLAT; kind < FAULT_KINDS; kind++)
        faults[kind].first = (size_t)scene_number_in_file(object, faults[kind].first);
    for (size_t i = 0; i < sizeof details / sizeof *details; i++)
        details[i]->triangle = (size_t)scene_number_in_file(object, details[i]->triangle);
    faults[FAULT_BAD_POSITIONS] = object->mesh.bad_positions;
    faults[FAULT_BAD_NORMALS] = object->mesh.bad_normals;
    faults[FAULT_LOST_CORNERS] = object->mesh.lost_corners;
    faults[FAULT_EQUAL_CORNERS] = object->mesh.equal_corners;
    faults[FAULT_LOST_CORNERS].first += object->number_before;
    faults[FAULT_EQUAL_CORNERS].first += object->number_before;
}

static bool take_mesh(MeshCensus *census, const MeshObject *object,
                      const Normalization *normalization, Error *error)
{
    const Mesh *mesh = &object->mesh;
    Edges edges = {0};
    const bool ok =
        edges_make(&edges, mesh, error) && mesh_faults_find(census, mesh, &edges, error);
    const Features features = features_of(mesh, normalization);
    census->features = features;
    census->facts.triangle_count = mesh->triangle_count;
    census->facts.vertex_count = mesh->vertex_count;
    census->facts.unused_vertices = edges.weld.unused_count;
    census->facts.repeated_vertices = edges.weld.repeated_count;
    census->facts.shortest_edge = features.edge.size;
    census->facts.shortest_steps = features.edge.steps;
    census->facts.lowest_height = features.height.size;
    census->facts.lowest_steps = features.height.steps;
    complete_faults(census, object);
    edges_free(&edges);
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
