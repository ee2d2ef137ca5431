// SPDX-License-Identifier: MIT
// Makes the scene by library calls and as a file, from the same tables. Texts have 17 digits, which
// restore every double.
#include "library/filled.h"

#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double background[3] = {0.25, 0.5, 0.75}, ambient = 0.125;
static const double lights[2][7] = {{3, -4, 6, 0.8, 1, 1, 1}, {-5, -2, 4.1, 0.4, 0.2, 1, 0.5}};
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
                                           .reflectivity = 0.6}};
static const char *const shadings[] = {"silhouette", "matte", "blinn_phong"};

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
static const uint32_t roof_triangles[][3] = {{0, 3, 2}, {0, 2, 1}, {1, 2, 4}};

static const ClrtMesh meshes[2] = {
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
    for (int i = 0; i < 2; i++) {
        assert_true(
            clrt_scene_add_sphere(scene, spheres[i], spheres[i][3], sphere_materials[i], NULL));
        assert_true(clrt_scene_add_mesh(scene, &meshes[i], NULL));
    }
    return scene;
}

static void write_numbers(FILE *file, const char *word, const double *numbers, int count)
{
    fputs(word, file);
    for (int i = 0; i < count; i++)
        fprintf(file, " %.17g", numbers[i]);
    fputc('\n', file);
}

static void write_material(FILE *file, const ClrtMaterial *material, char name)
{
    fprintf(file, "define %c %s", name, shadings[material->shading]);
    fprintf(file, " kd %.17g ks %.17g shininess %.17g reflectivity %.17g", material->kd,
            material->ks, material->shininess, material->reflectivity);
    fprintf(file, " diffuse %.17g %.17g %.17g", material->diffuse[0], material->diffuse[1],
            material->diffuse[2]);
    fprintf(file, " specular %.17g %.17g %.17g\n", material->specular[0], material->specular[1],
            material->specular[2]);
}

static void write_camera(FILE *file, const ClrtCamera *camera)
{
    static const double upright[3] = {0, 0, 1};
    write_numbers(file, "up", camera->up[2] > 0 ? camera->up : upright, 3);
    fprintf(file, "camera %.17g %.17g %.17g", camera->eye[0], camera->eye[1], camera->eye[2]);
    fprintf(file, " %.17g %.17g %.17g", camera->look_at[0], camera->look_at[1], camera->look_at[2]);
    write_numbers(file, "", &camera->fov_degrees, 1);
}

static void write_ply(const char *path, const ClrtMesh *mesh)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "ply\nformat ascii 1.0\nelement vertex %zu\n", mesh->vertex_count);
    fputs("property double x\nproperty double y\nproperty double z\n", file);
    if (mesh->normals != NULL)
        fputs("property float nx\nproperty float ny\nproperty float nz\n", file);
    fprintf(file, "element face %zu\nproperty list uchar uint vertex_indices\nend_header\n",
            mesh->triangle_count);
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++) {
        for (size_t axis = 3 * vertex; axis < 3 * vertex + 3; axis++)
            fprintf(file, "%.17g ", mesh->positions[axis]);
        for (size_t axis = 3 * vertex; mesh->normals != NULL && axis < 3 * vertex + 3; axis++)
            fprintf(file, "%.9g ", (double)mesh->normals[axis]);
        fputc('\n', file);
    }
    for (const uint32_t *corner = mesh->triangles;
         corner < mesh->triangles + 3 * mesh->triangle_count; corner += 3)
        fprintf(file, "3 %u %u %u\n", corner[0], corner[1], corner[2]);
    fclose(file);
}

static void write_scene(FILE *file)
{
    write_numbers(file, "background", background, 3);
    write_numbers(file, "ambient", &ambient, 1);
    fputs("max_level 5\n", file); // in the library, max_level belongs to the picture
    for (int i = 0; i < 2; i++) {
        write_numbers(file, "light", lights[i], 7);
        write_camera(file, &filled_cameras[i]);
        write_material(file, &materials[i], (char)('a' + i));
    }
    fputs("material a\n", file);
    write_numbers(file, "sphere", spheres[0], 4);
    fputs("material 3\n", file);
    write_numbers(file, "sphere", spheres[1], 4);
    fputs("sides two\nnormals flat\nmaterial b\nply_file floor.ply\n", file);
    fputs("sides one\nnormals smooth\nmaterial 2\nply_file roof.ply\n", file);
}

static void name_file(char path[512], const char *folder, const char *name)
{
    snprintf(path, 512, "%s/%s", folder, name);
}

char *filled_write(void)
{
    char folder[] = "/tmp/clrt-filled-XXXXXX", path[512];
    assert_non_null(mkdtemp(folder));
    name_file(path, folder, "floor.ply");
    write_ply(path, &meshes[0]);
    name_file(path, folder, "roof.ply");
    write_ply(path, &meshes[1]);
    name_file(path, folder, "filled.scn");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    write_scene(file);
    fclose(file);
    return strdup(path);
}

void filled_remove(char *path)
{
    char command[600];
    *strrchr(path, '/') = '\0';
    snprintf(command, sizeof command, "rm -r '%s'", path);
    assert_int_equal(system(command), 0);
    free(path);
}
