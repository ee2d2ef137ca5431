// SPDX-License-Identifier: MIT
// Makes the scene of filled.scn by library calls.
#include "library/filled.h"

#include "unit/cmocka_all.h"

static const double background[3] = {0.25, 0.5, 0.75}, ambient = 0.125;
static const double lights[2][7] = {{3, -4, 6, 0.8, 1, 1, 1}, {-5, -2, 4.1, 0.4, 0.2, 1, 0.5}};
static const double sun[7] = {0.5, 1, 0.75, 0.3, 1, 0.8, 0.6};
static const double spheres[2][4] = {{0, 0, 1.1, 1}, {1.5, -0.5, 0.4, 0.4}};
static const uint32_t sphere_materials[2] = {4, CLRT_MATERIAL_MIRROR};

static const ClrtMaterial materials[2] = {{.size = sizeof(ClrtMaterial),
                                           .shading = CLRT_SHADING_BLINN_PHONG,
                                           .diffuse = {0.9, 0.7, 0.2},
                                           .specular = {1, 0.9, 0.5},
                                           .kd = 0.7,
                                           .ks = 0.6,
                                           .shininess = 37.5,
                                           .reflectivity = 0.3},
                                          {.size = sizeof(ClrtMaterial),
                                           .shading = CLRT_SHADING_MATTE,
                                           .diffuse = {0.3, 0.8, 0.6},
                                           .specular = {0, 0, 0},
                                           .kd = 1.1,
                                           .ks = 0,
                                           .shininess = 3,
                                           .reflectivity = 0.6,
                                           .check_size = 0.7,
                                           .even = {0.9, 0.8, 0.1},
                                           .odd = {0.2, 0.3, 0.4}}};

const ClrtCamera filled_cameras[2] = {
    {.size = sizeof(ClrtCamera), .eye = {4, -6, 3}, .look_at = {0, 0, 0.5}, .fov_degrees = 40},
    {.size = sizeof(ClrtCamera),
     .eye = {-3, -3, 1.3},
     .look_at = {0.2, 0, 0.7},
     .up = {0.1, 0.2, 1},
     .fov_degrees = 71.5}};

static const double floor_positions[][3] = {
    {-4, -4, 0.01}, {4, -4.3, 0}, {4.1, 4, 0.1}, {-4, 4, 0}};
static const uint32_t floor_triangles[][3] = {{0, 2, 1}, {0, 1, 1}, {0, 3, 2}};

// A roof with a smooth ridge. One vertex has no normal.
static const double roof_positions[][3] = {
    {-2, -1, 0.2}, {-2, 1, 1.3}, {-1, 1.1, 1.35}, {-1.1, -1, 0.3}, {-2, 3, 0.2}};
static const float roof_normals[][3] = {
    {0, -1, 1}, {0, 0, 2.5f}, {0, 0.1f, 1}, {0, -1, 0.9f}, {0, 0, 0}};
static const float roof_colors[][3] = {
    {1, 0.25f, 0}, {0, 1, 0.5f}, {0.125f, 0.25f, 1}, {1, 1, 0}, {0.5f, 0.5f, 0.5f}};
static const uint32_t roof_triangles[][3] = {{0, 3, 2}, {0, 2, 1}, {1, 2, 4}};

const ClrtMesh filled_meshes[2] = {
    {.size = sizeof(ClrtMesh),
     .positions = floor_positions[0],
     .triangles = floor_triangles[0],
     .vertex_count = sizeof floor_positions / sizeof *floor_positions,
     .triangle_count = sizeof floor_triangles / sizeof *floor_triangles,
     .material = 5,
     .two_sided = true,
     .flat = true},
    {.size = sizeof(ClrtMesh),
     .positions = roof_positions[0],
     .normals = roof_normals[0],
     .colors = roof_colors[0],
     .triangles = roof_triangles[0],
     .vertex_count = sizeof roof_positions / sizeof *roof_positions,
     .triangle_count = sizeof roof_triangles / sizeof *roof_triangles,
     .material = CLRT_MATERIAL_BLINN_PHONG}};

ClrtScene *filled_make(void)
{
    uint32_t number = 0;
    ClrtScene *scene = clrt_scene_create(NULL);
    assert_non_null(scene);
    assert_true(clrt_scene_set_background(scene, background, NULL));
    assert_true(clrt_scene_set_ambient(scene, ambient, NULL));
    for (uint32_t i = 0; i < 2; i++) {
        assert_true(
            clrt_scene_add_colored_light(scene, lights[i], lights[i][3], &lights[i][4], NULL));
        assert_true(clrt_scene_add_camera(scene, &filled_cameras[i], NULL));
        assert_true(clrt_scene_add_material(scene, &materials[i], &number, NULL));
        assert_int_equal(number, 4 + i);
    }
    assert_true(clrt_scene_add_sun(scene, sun, sun[3], &sun[4], NULL));
    for (int i = 0; i < 2; i++) {
        assert_true(
            clrt_scene_add_sphere(scene, spheres[i], spheres[i][3], sphere_materials[i], NULL));
        assert_true(clrt_scene_add_mesh(scene, &filled_meshes[i], NULL));
    }
    return scene;
}
