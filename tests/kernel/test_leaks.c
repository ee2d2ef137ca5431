// SPDX-License-Identifier: MIT
// With every form of the kernels, rays find all holes of meshes, however small, and no holes in
// closed meshes.
#include "check/leaks.h"

#include "unit/cmocka_all.h"

#include <stdlib.h>
#include <string.h>

#define AROUND 48 // vertices around the ring
#define ACROSS 24 // vertices around the tube

static const KernelRequest forms[] = {
    {1 + FAMILY_RAY, 1 + NODES_PAIR, 0, PRECISION_FP32},
    {1 + FAMILY_RAY, 1 + NODES_WIDE, 0, PRECISION_FP32},
    {1 + FAMILY_PACKET, 1 + NODES_WIDE, 0, PRECISION_FP32},
    {1 + FAMILY_RAY, 1 + NODES_PAIR, 0, PRECISION_FP64},
};
#define FORMS (sizeof forms / sizeof forms[0])

typedef struct {
    Cache cache;
    Device device;
    RayCaster casters[FORMS];
} Stage;

static Stage stage;

SET_UP(open_stage)
{
    Error error = {0};
    cache_open(&stage.cache);
    bool ok = device_open(&stage.device, getenv("CLRT_DEVICE"), &error);
    for (size_t form = 0; ok && form < FORMS; form++) {
        const KernelChoice choice = kernel_choose(&forms[form], &stage.device);
        const RendererSetup setup = {
            .device = &stage.device,
            .cache = &stage.cache,
            .source = {.kernel_folder = getenv("CLRT_KERNEL_DIR"), .choice = choice}};
        ok = ray_caster_open(&stage.casters[form], &setup, &error);
    }
    if (!ok)
        print_error("%s\n", error.text);
    return ok ? 0 : -1;
}

TEAR_DOWN(close_stage)
{
    for (size_t form = 0; form < FORMS; form++)
        ray_caster_close(&stage.casters[form]);
    device_close(&stage.device);
    cache_close(&stage.cache);
    return 0;
}

// Returns a ring. Parts of a ring hide behind other parts.
static Mesh ring(double scale, Vec3 center)
{
    Error error = {0};
    Mesh mesh = {.vertex_count = AROUND * ACROSS, .triangle_count = 2 * AROUND * ACROSS};
    mesh.positions = memory_raw(mesh.vertex_count, sizeof *mesh.positions, &error);
    mesh.triangles = memory_raw(mesh.triangle_count, sizeof *mesh.triangles, &error);
    assert_true(mesh.positions != NULL && mesh.triangles != NULL);
    uint32_t(*triangle)[3] = mesh.triangles;
    for (uint32_t i = 0; i < AROUND; i++)
        for (uint32_t j = 0; j < ACROSS; j++) {
            const double turn = 6.283185307179586 * i / AROUND,
                         bend = 6.283185307179586 * j / ACROSS;
            const double reach = 1 + 0.4 * cos(bend);
            double *position = mesh.positions[i * ACROSS + j];
            position[0] = center.x + scale * reach * cos(turn);
            position[1] = center.y + scale * reach * sin(turn);
            position[2] = center.z + scale * 0.4 * sin(bend);
            const uint32_t next = (i + 1) % AROUND * ACROSS, above = (j + 1) % ACROSS;
            const uint32_t quad[4] = {i * ACROSS + j, next + j, next + above, i * ACROSS + above};
            memcpy(*triangle++, (uint32_t[]){quad[0], quad[1], quad[2]}, sizeof *mesh.triangles);
            memcpy(*triangle++, (uint32_t[]){quad[0], quad[2], quad[3]}, sizeof *mesh.triangles);
        }
    return mesh;
}

static Closedness closedness_of(const Mesh *mesh)
{
    FREED_BY(weld_free) Weld weld;
    FREED_BY(edges_free) Edges edges;
    Closedness closedness = {0};
    Error error = {0};
    assert_true(weld_make(&weld, mesh, &error) && edges_make(&edges, mesh, &weld, &error) &&
                closedness_find(&closedness, mesh, &weld, &edges, &error));
    return closedness;
}

static LeakCount leaks_of(const Mesh *mesh, size_t form)
{
    LeakCount count;
    Error error = {0};
    Scene scene = {0};
    const Closedness closedness = closedness_of(mesh);
    const MeshObject object = {.mesh = *mesh};
    assert_true(array_push(&scene.objects, object, &error));
    const Normalization frame = normalization_of(&scene);
    const LeakSetting setting = {
        .normalization = &frame, .closedness = &closedness, .builder = BVH_SAH, .uses_bvh = true};
    if (!leaks_count(&count, &stage.casters[form], mesh, &setting, &error))
        fail_msg("%s", error.text);
    free(scene.objects.memory);
    return count;
}

TEST(a_closed_ring_has_no_leaks_at_any_edge_or_point)
{
    FREED_BY(mesh_free) Mesh mesh = ring(1, vec3(0, 0, 0));
    for (size_t form = 0; form < FORMS; form++) {
        const LeakCount count = leaks_of(&mesh, form);
        assert_int_equal(count.leaks.count, 0);
        assert_int_equal(count.total, 3 * AROUND * ACROSS + AROUND * ACROSS);
        assert_int_equal(count.aimed, count.total);
        assert_int_equal(count.hidden, 0);
        assert_true(count.rays > count.total); // hidden edges and points needed further rays
    }
}

TEST(a_ring_far_away_and_turned_inside_out_has_none_either)
{
    FREED_BY(mesh_free) Mesh mesh = ring(0x1p-8, vec3(1000, -2000, 3000));
    for (size_t i = 0; i < mesh.triangle_count; i++) {
        const uint32_t corner = mesh.triangles[i][1];
        mesh.triangles[i][1] = mesh.triangles[i][2];
        mesh.triangles[i][2] = corner;
    }
    assert_true(closedness_of(&mesh).is_inside_out);
    const LeakCount count = leaks_of(&mesh, FORMS - 1);
    assert_int_equal(count.leaks.count, 0);
    assert_int_equal(count.aimed, count.total);
}

TEST(a_missing_triangle_leaks)
{
    FREED_BY(mesh_free) Mesh mesh = ring(1, vec3(0, 0, 0));
    memcpy(mesh.triangles[700], mesh.triangles[mesh.triangle_count - 1], sizeof *mesh.triangles);
    mesh.triangle_count--;
    for (size_t form = 0; form < FORMS; form++) {
        const LeakCount count = leaks_of(&mesh, form);
        assert_in_range(count.leaks.count, 3, 30);
    }
}

// Splits a triangle, but not its neighbor, at the middle of an edge. Moves the new vertex off the
// edge by the fraction gap.
static Mesh cracked_ring(double gap)
{
    FREED_BY(mesh_free) Mesh mesh = ring(1, vec3(0, 0, 0));
    Error error = {0};
    double(*positions)[3] = memory_raw(mesh.vertex_count + 1, sizeof *positions, &error);
    uint32_t(*triangles)[3] = memory_raw(mesh.triangle_count + 1, sizeof *triangles, &error);
    assert_true(positions != NULL && triangles != NULL);
    memcpy(positions, mesh.positions, mesh.vertex_count * sizeof *positions);
    memcpy(triangles, mesh.triangles, mesh.triangle_count * sizeof *triangles);
    const uint32_t *split = mesh.triangles[900];
    const double *a = positions[split[0]], *b = positions[split[1]], *c = positions[split[2]];
    double *middle = positions[mesh.vertex_count];
    for (int axis = 0; axis < 3; axis++) {
        const double on_edge = 0.5 * a[axis] + 0.5 * b[axis];
        middle[axis] = on_edge + gap * (c[axis] - on_edge);
    }
    memcpy(triangles[mesh.triangle_count],
           (uint32_t[]){(uint32_t)mesh.vertex_count, split[1], split[2]}, sizeof *triangles);
    triangles[900][1] = (uint32_t)mesh.vertex_count;
    const Mesh cracked = {.positions = positions,
                          .triangles = triangles,
                          .vertex_count = mesh.vertex_count + 1,
                          .triangle_count = mesh.triangle_count + 1};
    return cracked;
}

TEST(a_vertex_off_its_neighbors_edge_leaves_a_crack_that_leaks)
{
    FREED_BY(mesh_free) Mesh mesh = cracked_ring(0.02);
    assert_int_equal(closedness_of(&mesh).open.count, 3);
    for (size_t form = 0; form < FORMS; form++)
        assert_in_range(leaks_of(&mesh, form).leaks.count, 1, 10);
}
