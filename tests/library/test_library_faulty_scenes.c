// SPDX-License-Identifier: MIT
// Invalid additions to a scene give an error with a message and change nothing.
#include "library/faults.h"
#include "library/filled.h"
#include "unit/cmocka_all.h"

#include <float.h>
#include <math.h>
#include <string.h>

static ClrtScene *scene;

static const double bad_numbers[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, DBL_MAX,
                                     -DBL_MAX};
#define BAD_NUMBERS (sizeof bad_numbers / sizeof *bad_numbers)

SET_UP(open_scene)
{
    scene = filled_make();
    return 0;
}

TEAR_DOWN(close_scene)
{
    clrt_scene_free(scene);
    return 0;
}

static ClrtSceneInfo info_of(void)
{
    ClrtSceneInfo info = {.size = sizeof info};
    assert_true(clrt_scene_get_info(scene, &info, NULL));
    return info;
}

TEST(null_arguments_are_named)
{
    const double three[3] = {0, 0, 0};
    const ClrtMaterial matte = {.size = sizeof matte};
    ClrtSceneInfo info = {.size = sizeof info};
    uint32_t number;
    REFUSES(clrt_scene_load(NULL, NULL, &error) != NULL, "the path is NULL");
    REFUSES(clrt_scene_add_material(NULL, &matte, &number, &error), "the scene is NULL");
    REFUSES(clrt_scene_add_material(scene, NULL, &number, &error), "the material is NULL");
    REFUSES(clrt_scene_add_material(scene, &matte, NULL, &error), "the number is NULL");
    REFUSES(clrt_scene_add_sphere(NULL, three, 1, 0, &error), "the scene is NULL");
    REFUSES(clrt_scene_add_sphere(scene, NULL, 1, 0, &error), "the center is NULL");
    REFUSES(clrt_scene_add_mesh(NULL, NULL, &error), "the scene is NULL");
    REFUSES(clrt_scene_add_mesh(scene, NULL, &error), "the mesh is NULL");
    REFUSES(clrt_scene_add_light(NULL, three, 1, &error), "the scene is NULL");
    REFUSES(clrt_scene_add_light(scene, NULL, 1, &error), "the position is NULL");
    REFUSES(clrt_scene_add_colored_light(scene, three, 1, NULL, &error),
            "the light's color is NULL");
    REFUSES(clrt_scene_add_area_light(scene, NULL, &error), "the light is NULL");
    REFUSES(clrt_scene_add_area_light(
                scene, &(ClrtAreaLight){.size = sizeof(ClrtAreaLight), .cells = 17}, &error),
            "the number of cells is 17, not between 1 and 16");
    REFUSES(clrt_scene_add_sun(scene, NULL, 1, three, &error), "the direction is NULL");
    REFUSES(clrt_scene_add_sun(scene, (const double[3]){0}, 1, (const double[3]){1, 1, 1}, &error),
            "the direction of a sun must not be zero");
    REFUSES(clrt_scene_add_camera(NULL, &filled_cameras[0], &error), "the scene is NULL");
    REFUSES(clrt_scene_add_camera(scene, NULL, &error), "the camera is NULL");
    REFUSES(clrt_scene_set_background(NULL, three, &error), "the scene is NULL");
    REFUSES(clrt_scene_set_background(scene, NULL, &error), "the background is NULL");
    REFUSES(clrt_scene_set_ambient(NULL, 0, &error), "the scene is NULL");
    REFUSES(clrt_scene_get_info(NULL, &info, &error), "the scene is NULL");
    REFUSES(clrt_scene_get_info(scene, NULL, &error), "the info is NULL");
    clrt_scene_free(NULL);
}

TEST(numbers_out_of_range_are_refused)
{
    const double origin[3] = {0, 0, 0};
    const ClrtSceneInfo before = info_of();
    for (size_t i = 0; i < BAD_NUMBERS; i++) {
        const double bad = bad_numbers[i];
        for (int axis = 0; axis < 3; axis++) {
            double three[3] = {0, 0, 0};
            three[axis] = bad;
            REFUSES(clrt_scene_add_sphere(scene, three, 1, 0, &error), "the center is");
            REFUSES(clrt_scene_add_light(scene, three, 1, &error), "the position is");
            REFUSES(clrt_scene_set_background(scene, three, &error), "the background is");
        }
        REFUSES(clrt_scene_add_sphere(scene, origin, bad, 0, &error), "the radius is");
        REFUSES(clrt_scene_add_light(scene, origin, bad, &error), "the intensity is");
        REFUSES(clrt_scene_set_ambient(scene, bad, &error), "the ambient light is");
    }
    REFUSES(clrt_scene_add_sphere(scene, origin, 0, 0, &error), "the radius is 0");
    REFUSES(clrt_scene_add_sphere(scene, origin, 1, 6, &error),
            "material 6 does not exist: the scene has 6");
    const ClrtSceneInfo after = info_of();
    assert_memory_equal(&before, &after, sizeof before);
}

TEST(no_material_of_impossible_numbers_is_added)
{
    const ClrtMaterial matte = {.size = sizeof matte, .shading = CLRT_SHADING_MATTE};
    for (size_t i = 0; i < BAD_NUMBERS; i++) {
        ClrtMaterial bad[6] = {matte, matte, matte, matte, matte, matte};
        static const char *const words[] = {"the diffuse color", "the specular color", "kd", "ks",
                                            "the shininess",     "the reflectivity"};
        bad[0].diffuse[2] = bad[1].specular[1] = bad[2].kd = bad_numbers[i];
        bad[3].ks = bad[4].shininess = bad[5].reflectivity = bad_numbers[i];
        for (int member = 0; member < 6; member++) {
            uint32_t number = 77;
            REFUSES(clrt_scene_add_material(scene, &bad[member], &number, &error), words[member]);
            assert_int_equal(number, 77);
        }
    }
    for (int shading = -1; shading <= 4; shading += 5) {
        uint32_t number;
        ClrtMaterial bad = matte;
        memcpy(&bad.shading, &shading, sizeof shading);
        REFUSES(clrt_scene_add_material(scene, &bad, &number, &error), "the shading is");
    }
}

TEST(glass_needs_an_index_of_refraction)
{
    ClrtMaterial glass = {
        .size = sizeof glass, .shading = CLRT_SHADING_GLASS, .diffuse = {1, 1, 1}};
    uint32_t number = 77;
    REFUSES(clrt_scene_add_material(scene, &glass, &number, &error), "the index of refraction");
    glass.ior = 1.5;
    ClrtScene *other = clrt_scene_create(NULL);
    assert_true(clrt_scene_add_material(other, &glass, &number, NULL));
    assert_int_equal(number, 4);
    clrt_scene_free(other);
}

static const double corners[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
static const uint32_t triangle[3] = {0, 1, 2};

static ClrtMesh good_mesh(void)
{
    return (ClrtMesh){.size = sizeof(ClrtMesh),
                      .positions = corners[0],
                      .triangles = triangle,
                      .vertex_count = 3,
                      .triangle_count = 1};
}

static bool add(const ClrtMesh *mesh, ClrtError *error)
{
    return clrt_scene_add_mesh(scene, mesh, error);
}

TEST(meshes_that_point_nowhere_are_refused)
{
    const uint32_t outside[3] = {0, 1, 3}, huge[3] = {UINT32_MAX, 1, 2};
    ClrtMesh mesh = good_mesh();
    mesh.positions = NULL;
    REFUSES(add(&mesh, &error), "positions are NULL");
    mesh = good_mesh();
    mesh.triangles = NULL;
    REFUSES(add(&mesh, &error), "triangles are NULL");
    mesh = good_mesh();
    mesh.triangles = outside;
    REFUSES(add(&mesh, &error), "triangle 0 has vertex 3, but the mesh has 3 vertices");
    mesh.triangles = huge;
    REFUSES(add(&mesh, &error), "has vertex 4294967295");
    mesh.vertex_count = 0;
    REFUSES(add(&mesh, &error), "the mesh has 0 vertices");
    mesh = good_mesh();
    mesh.vertex_count = SIZE_MAX;
    REFUSES(add(&mesh, &error), "positions, more than");
    mesh = good_mesh();
    mesh.triangle_count = (size_t)1 << 62;
    REFUSES(add(&mesh, &error), "triangles, more than");
    mesh = good_mesh();
    mesh.material = UINT32_MAX;
    REFUSES(add(&mesh, &error), "material 4294967295");
}

TEST(vertices_that_are_no_points_are_refused)
{
    for (size_t i = 0; i < BAD_NUMBERS; i++) {
        double positions[3][3];
        float normals[3][3] = {{0}};
        ClrtMesh mesh = good_mesh();
        mesh.normals = normals[0];
        memcpy(positions, corners, sizeof corners);
        mesh.positions = positions[0];
        normals[2][1] = (float)bad_numbers[i];
        REFUSES(add(&mesh, &error), "the normal of vertex 2 is not finite");
        positions[1][2] = bad_numbers[i];
        REFUSES(add(&mesh, &error), "a coordinate of vertex 1 is");
    }
}

TEST(colors_outside_the_range_are_refused)
{
    const float bad[] = {-0.001f, 1.001f, NAN, INFINITY};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        float colors[3][3] = {{0}};
        ClrtMesh mesh = good_mesh();
        mesh.colors = colors[0];
        colors[1][2] = bad[i];
        REFUSES(add(&mesh, &error), "the color of vertex 1 is not in [0, 1]");
    }
}

TEST(impossible_cameras_are_refused)
{
    const ClrtCamera good = filled_cameras[0];
    ClrtCamera bad = good;
    memcpy(bad.look_at, bad.eye, sizeof bad.eye);
    REFUSES(clrt_scene_add_camera(scene, &bad, &error), "looks at its own position");
    for (int axis = 0; axis < 3; axis++)
        bad.look_at[axis] = bad.eye[axis] + (axis == 2);
    REFUSES(clrt_scene_add_camera(scene, &bad, &error), "along its 'up'");
    const double angles[] = {0, -1, 180, (double)NAN};
    for (int i = 0; i < 4; i++) {
        bad = good;
        bad.fov_degrees = angles[i];
        REFUSES(clrt_scene_add_camera(scene, &bad, &error), "the field of view is");
    }
    const double heights[] = {-1, 1e-31, 1e31, (double)NAN};
    for (int i = 0; i < 4; i++) {
        bad = good;
        bad.height = heights[i];
        REFUSES(clrt_scene_add_camera(scene, &bad, &error), "the height is");
    }
    for (size_t i = 0; i < BAD_NUMBERS; i++) {
        ClrtCamera cameras[3] = {good, good, good};
        cameras[0].eye[0] = cameras[1].look_at[1] = cameras[2].up[2] = bad_numbers[i];
        REFUSES(clrt_scene_add_camera(scene, &cameras[0], &error), "the eye is");
        REFUSES(clrt_scene_add_camera(scene, &cameras[1], &error), "looked at is");
        REFUSES(clrt_scene_add_camera(scene, &cameras[2], &error), "'up' is");
    }
}

TEST(missing_files_are_reported)
{
    ClrtError error = faults_blank();
    faults_assert(clrt_scene_load("/nowhere/at all.scn", NULL, &error) != NULL, &error, CLRT_SCENE,
                  "/nowhere/at all.scn");
    assert_null(clrt_scene_load("", NULL, NULL));
}
