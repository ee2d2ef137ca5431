// SPDX-License-Identifier: MIT
// Tests that a scene written as text is read back bit for bit.
#include "scene/scn_write.h"
#include "unit/parsed.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static Scene written_and_read(const Scene *scene, char *const *mesh_names, char **text)
{
    size_t size;
    Error error = {0};
    FILE *stream = open_memstream(text, &size);
    assert_non_null(stream);
    assert_true(scn_write(scene, mesh_names, stream, &error));
    assert_int_equal(fclose(stream), 0);
    return parsed(*text);
}

static void expect_same_materials(const Scene *a, uint32_t left, const Scene *b, uint32_t right)
{
    assert_memory_equal(&a->materials.data[left], &b->materials.data[right], sizeof(Material));
}

static void expect_same(const Scene *a, const Scene *b)
{
    assert_int_equal(a->lights.count, b->lights.count);
    for (size_t i = 0; i < a->lights.count; i++) {
        const Light *one = &a->lights.data[i], *other = &b->lights.data[i];
        assert_memory_equal(one, other, offsetof(Light, is_sun));
        assert_int_equal(one->is_sun, other->is_sun);
    }
    assert_int_equal(a->area_lights.count, b->area_lights.count);
    assert_int_equal(a->viewpoints.count, b->viewpoints.count);
    assert_memory_equal(a->viewpoints.data, b->viewpoints.data,
                        a->viewpoints.count * sizeof *a->viewpoints.data);
    assert_true(a->has_course_views == b->has_course_views && a->ambient == b->ambient);
    assert_memory_equal(&a->background, &b->background, sizeof a->background);
    assert_true(a->width == b->width && a->height == b->height && a->max_level == b->max_level);
    assert_int_equal(a->spheres.count, b->spheres.count);
    for (size_t i = 0; i < a->spheres.count; i++) {
        const Sphere *left = &a->spheres.data[i], *right = &b->spheres.data[i];
        assert_memory_equal(&left->center, &right->center, sizeof left->center);
        assert_true(left->radius == right->radius);
        expect_same_materials(a, left->material, b, right->material);
    }
    assert_int_equal(a->objects.count, b->objects.count);
    for (size_t i = 0; i < a->objects.count; i++) {
        const MeshObject *left = &a->objects.data[i], *right = &b->objects.data[i];
        assert_true(left->two_sided == right->two_sided);
        expect_same_materials(a, left->material, b, right->material);
        assert_true((left->mesh.colors != NULL) == (right->mesh.colors != NULL));
    }
}

TEST(every_statement_comes_back)
{
    static const char text[] =
        "size 640 480\nbackground 0.1 0.2 0.3\nambient 0.07\nmax_level 9\n"
        "camera 1 2 3.3333333333333335 0 0 0 33.3\nup 0 1 0.1\ncamera 9 9 9 0 0 0 60 70.1\n"
        "camera 9 9 8 0 0 0 orthographic 0.1\ncamera 9 9 7 0 0 0 orthographic 3.3 4.4\n"
        "light 0.1 1e29 -1e-29 0.3\nlight 0 0 0 1 0.1 1 0.30000000000000004\n"
        "light 3 4 5 0.7 0.1 1 0.3 area 0.1 0.2 0 0 0.3 1e-9 3\n"
        "sun 0.1 -1e29 1e-29 0.3\nsun 0 0 1 0 0.1 1 0.2\n"
        "define gold blinn_phong diffuse 1 .8 .2 shininess 200.5 reflectivity .3 ks 3.3 kd 0.7\n"
        "define \"my wax\" matte diffuse 0.1 0.2 0.3 checker 0.1 .1 .2 .3 .9 .8 .7 kd 0.9\ndefine "
        "\"#a\" silhouette\n"
        "define pane glass ior 1.33 color 0.9 1 0.8\nmaterial pane\nsphere 1 1 1 1\n"
        "material 0\n"
        "sphere 0.1 0.2 0.3 1e-7\nmaterial gold\nsphere 1 2 3 4\nmaterial 3\nsphere 5 6 7 8\n"
        "material \"my wax\"\nply_file cube.ply\nsides two\nnormals flat\nply_file cube.ply\n"
        "sides one\nmaterial \"#a\"\nply_file cube.ply\nmaterial 2\nsphere 5 6 7 8\n"
        "mesh ../tests/image/painted.ply\nmaterial own\nmesh ../tests/image/painted.ply\n"
        "material own gold\nmesh ../tests/image/painted.ply\nmesh cube.ply\n";
    static char painted[] = "../tests/image/painted.ply";
    static char *const names[] = {"cube.ply", "cube.ply", "cube.ply", painted,
                                  painted,    painted,    "cube.ply"};
    char *again;
    FREED_BY(scene_free) Scene scene = parsed(text);
    FREED_BY(scene_free) Scene copy = written_and_read(&scene, names, &again);
    expect_same(&scene, &copy);
    free(again);
}

TEST(a_scene_without_cameras_keeps_the_courses)
{
    char *again;
    FREED_BY(scene_free) Scene scene = parsed("light 1 2 3 1");
    FREED_BY(scene_free) Scene copy = written_and_read(&scene, NULL, &again);
    assert_true(copy.has_course_views);
    assert_null(strstr(again, "camera"));
    expect_same(&scene, &copy);
    free(again);
}

// Mesh files may give their materials these names.
TEST(names_that_no_scene_can_define_are_replaced)
{
    static const char *const names[] = {"3d.obj:red", "a\"b",  "",          "own",
                                        "twice",      "twice", "material_4"};
    Error error = {0};
    char *again;
    FREED_BY(scene_free) Scene scene = parsed("");
    for (uint32_t i = 0; i < 7; i++) {
        MaterialName name = {.material = (uint32_t)scene.materials.count};
        Material material = material_of_shader(SHADER_MATTE);
        strcpy(name.name, names[i]);
        material.diffuse[0] = (float)i / 8;
        assert_true(array_push(&scene.materials, material, &error));
        assert_true(material_names_add(&scene.material_names, &name, &error));
        assert_true(array_push(&scene.spheres, ((Sphere){{0, 0, i}, 1, name.material}), &error));
    }
    FREED_BY(scene_free) Scene copy = written_and_read(&scene, NULL, &again);
    expect_same(&scene, &copy);
    assert_non_null(strstr(again, "define \"twice\" "));
    free(again);
}

TEST(numbers_have_no_more_digits_than_they_need)
{
    char *again;
    static const char text[] = "ambient 0.05\nlight 0.1 0.2 0.30000000000000004 1";
    FREED_BY(scene_free) Scene scene = parsed(text);
    FREED_BY(scene_free) Scene copy = written_and_read(&scene, NULL, &again);
    assert_non_null(strstr(again, "ambient 0.05\n"));
    assert_non_null(strstr(again, "light 0.1 0.2 0.30000000000000004 1\n"));
    free(again);
}
