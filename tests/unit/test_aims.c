// SPDX-License-Identifier: MIT
// Tests the points of a mesh that clrt check aims at, its rays to these points, and the judgment of
// their hits.
#include "check/aims.h"

#include "unit/cmocka_all.h"

#include <stdlib.h>

// A tetrahedron at four corners of a cube. The cube's other corners are outside the tetrahedron.
static double corners[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
static uint32_t faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};

typedef struct {
    Mesh mesh;
    Edges edges;
    Triangles triangles;
    Aims aims;
    RayBlock rays;
    uint32_t targets[64];
} Fixture;

static Fixture aimed(uint32_t (*triangles)[3], size_t count, size_t most, bool is_inside_out)
{
    Fixture all = {.mesh = {.positions = corners,
                            .triangles = triangles,
                            .vertex_count = 4,
                            .triangle_count = count}};
    Error error = {0};
    Scene scene = {0};
    const MeshObject object = {.mesh = all.mesh};
    const Normalization frame = {{0, 0, 0}, 1};
    assert_true(array_push(&scene.objects, object, &error) &&
                triangles_make(&all.triangles, &scene, &frame, NULL, &error) &&
                edges_make(&all.edges, &all.mesh, &error));
    const AimSource source = {&all.mesh, &all.triangles, &all.edges, is_inside_out};
    assert_true(aims_make(&all.aims, &source, most, &error));
    free(scene.objects.memory);
    return all;
}

static void release(Fixture *all)
{
    aims_free(&all->aims);
    triangles_free(&all->triangles);
    edges_free(&all->edges);
}

TEST(every_edge_and_point_is_aimed_at_once)
{
    FREED_BY(release) Fixture all = aimed(faces, 4, 64, false);
    assert_int_equal(all.aims.total, 6 + 4);
    assert_int_equal(all.aims.count, 6 + 4);
    for (size_t i = 0; i < 4; i++)
        assert_true(vec3_dot(all.aims.aims[i].point, all.aims.aims[i].star.outward) > 1.7);
    for (size_t i = 4; i < 10; i++)
        assert_true(vec3_dot(all.aims.aims[i].point, all.aims.aims[i].star.outward) > 0.9);
}

TEST(a_mesh_turned_inside_out_is_aimed_at_from_outside_too)
{
    uint32_t turned[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    FREED_BY(release) Fixture all = aimed(turned, 4, 64, true);
    for (size_t i = 0; i < 10; i++)
        assert_true(vec3_dot(all.aims.aims[i].point, all.aims.aims[i].star.outward) > 0.9);
}

TEST(an_open_edge_is_aimed_at_beyond_it_too)
{
    FREED_BY(release) Fixture all = aimed(faces, 3, 64, false);
    assert_int_equal(all.aims.total, 6 + 4 + 3);
    // The missing face is opposite the corner (1, 1, 1).
    const Vec3 outside = vec3(-1, -1, -1);
    size_t beyond = 0;
    for (size_t i = 4; i < all.aims.count; i++)
        beyond += vec3_dot(all.aims.aims[i].point, outside) > 1 + 1e-6;
    assert_int_equal(beyond, 3);
}

TEST(no_more_aims_are_kept_than_requested)
{
    FREED_BY(release) Fixture all = aimed(faces, 4, 3, false);
    assert_int_equal(all.aims.total, 10);
    assert_int_equal(all.aims.count, 3);
}

static Vec3 stored_vector(const float *components, size_t i)
{
    return vec3((double)components[i], (double)components[RAY_BLOCK + i],
                (double)components[2 * RAY_BLOCK + i]);
}

TEST(rays_from_afar_start_outside_and_end_at_their_aims)
{
    FREED_BY(release) Fixture all = aimed(faces, 4, 64, false);
    const size_t count = aims_shoot_from_afar(&all.aims, &all.rays, all.targets);
    assert_true(count >= 6 && count <= 10);
    for (size_t i = 0; i < count; i++) {
        const Aim *aim = &all.aims.aims[all.targets[i]];
        const Vec3 origin = stored_vector(all.rays.origin[0], i);
        const Vec3 direction = stored_vector(all.rays.direction[0], i);
        assert_true(vec3_dot(origin, origin) > 3 * 1.5 * 1.5);
        assert_true(vec3_extent(vec3_sub(vec3_add(origin, direction), aim->point)) < 1e-6);
        assert_true(vec3_dot(direction, aim->star.outward) < 0);
        assert_true(aim->tolerance > 0 && aim->tolerance < 1e-3f);
    }
}

TEST(rays_are_judged_by_where_they_end)
{
    FREED_BY(release) Fixture all = aimed(faces, 4, 64, false);
    aims_shoot_from_afar(&all.aims, &all.rays, all.targets);
    const HitData hits[4] = {{.t = 1}, {.t = 0.9f}, {.t = 1.1f}, {.t = INFINITY}};
    aims_judge(&all.aims, all.targets, hits, 4);
    assert_int_equal(all.aims.aims[all.targets[0]].state, AIM_REACHED);
    assert_int_equal(all.aims.aims[all.targets[1]].state, AIM_HIDDEN);
    assert_int_equal(all.aims.aims[all.targets[2]].state, AIM_LEAKED);
    assert_int_equal(all.aims.aims[all.targets[3]].state, AIM_LEAKED);
    const uint32_t hidden = all.targets[1];
    const uint32_t reached = all.targets[0];
    const size_t close = aims_shoot_from_close(&all.aims, &all.rays, all.targets);
    assert_int_equal(close, all.aims.count - 3);
    bool again = false;
    for (size_t i = 0; i < close; i++) {
        again = again || all.targets[i] == hidden;
        assert_int_not_equal(all.targets[i], reached);
    }
    assert_true(again);
}
