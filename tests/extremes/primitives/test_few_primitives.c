// SPDX-License-Identifier: MIT
// Scenes of hardly anything, with every tree and program.
#include "support/picture.h"
#include "support/scene_text.h"
#include "support/shapes.h"

// Triangles that are counter-clockwise for the camera if `front`.
static const struct {
    Vec3 place;
    bool front, two_sided;
} triangles[] = {{{0, 0, 0}, true, false},
                 {{0.5, 1, 0.25}, true, true},
                 {{-0.5, -1, -0.5}, false, true},
                 {{0, 0, 0}, false, false},
                 {{0, 0, 0}, false, true}};

// A scene has these spheres and the triangles [first, end).
static const struct {
    const char *name, *spheres;
    size_t first, end;
} scenes[] = {
    {"empty", "", 0, 0},
    {"one_triangle", "", 0, 1},
    {"one_triangle_from_behind", "", 3, 4},
    {"one_two_sided_triangle_from_behind", "", 4, 5},
    {"two_triangles", "", 0, 2},
    {"three_triangles", "", 0, 3},
    {"one_sphere", "sphere 0.25 0 0 1\n", 0, 0},
    {"three_spheres",
     "sphere 0.25 0 0 1\nmaterial b\nsphere -0.75 0.5 0.5 0.75\n"
     "material c\nsphere 0.5 -1 -0.75 0.5\n",
     0, 0},
    {"eye_in_a_sphere", "sphere 0.25 0 0 1\nmaterial b\nsphere 0 0 0 20\n", 0, 0},
    {"sphere_through_triangles", "sphere 0.25 0 -0.25 0.75\n", 0, 3},
};

static Scene make_scene(size_t number)
{
    Scene scene = scene_text_parse("background 0.5 0.75 0.25\n"
                                   "camera 0.3 -6 0.2 0 0 0 30\n"
                                   "define a silhouette diffuse 0 0.125 0.875\n"
                                   "define b silhouette diffuse 0.25 0.125 0.875\n"
                                   "define c silhouette diffuse 0.5 0.125 0.875\n"
                                   "define d silhouette diffuse 0.75 0.125 0.875\n"
                                   "define e silhouette diffuse 1 0.125 0.875\n"
                                   "material a\n%s",
                                   scenes[number].spheres);
    for (size_t i = scenes[number].first; i < scenes[number].end; i++) {
        const Vec3 place = triangles[i].place, a = vec3_add(place, vec3(-1, 0, -0.75));
        Mesh mesh = shape_triangle(a, vec3_add(place, vec3(1, 0.5, -1)),
                                   vec3_add(place, vec3(0.25, -0.5, 1)));
        if (!triangles[i].front)
            shape_flip(&mesh);
        shape_add(&scene, mesh, COURSE_MATERIALS + 1 + (uint32_t)i % 4);
        scene.objects.data[scene.objects.count - 1].two_sided = triangles[i].two_sided;
    }
    return scene;
}

static void scenes_of_few_primitives_show_what_exact_geometry_shows_t17(void **state)
{
    static const Specialization programs[2] = {SPECIALIZE_NEVER, SPECIALIZE_ALWAYS};
    PictureSettings settings = picture_settings(64);
    for (size_t number = 0; number < COUNT(scenes); number++)
        for (settings.tree = TREE_SAH; settings.tree < TREE_KINDS; settings.tree++)
            for (int program = 0; program < 2; program++) {
                settings.render.specialization = programs[program];
                outcome_report(picture_judge("T-17", *state, make_scene(number), &settings),
                               "scene=%s tree=%s program=%s", scenes[number].name,
                               tree_names[settings.tree], program == 0 ? "general" : "special");
            }
}

RUN_TESTS(picture_setup, picture_teardown,
          EXTREME(scenes_of_few_primitives_show_what_exact_geometry_shows_t17))
