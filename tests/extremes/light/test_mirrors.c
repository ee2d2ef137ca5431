// SPDX-License-Identifier: MIT
// Rays must stay inside closed mirrors for BOUNCES reflections.
#include "image/course.h"
#include "scene/mesh_load.h"
#include "support/picture.h"
#include "support/random_points.h"
#include "support/tubes.h"
#include "unit/parsed.h"

// A black mirror before a white background. A pixel's value is REFLECTED^n if its ray left the
// mirror after n reflections.
#define REFLECTED 0.9
#define MIRROR                                                                                     \
    "define mirror silhouette diffuse 0 0 0 reflectivity 0.9\nbackground 1 1 1\n"                  \
    "camera 0 0 0 1 0 0 120\n"
#define BOUNCES 64

#define FLAT (-1) // instead of a crease angle: no normals

static PictureSettings mirror_settings(uint32_t side)
{
    PictureSettings settings = picture_settings(side);
    settings.render.max_level = BOUNCES;
    return settings;
}

// Counts the rays that have left the mirror.
static size_t count_escapes(const Framebuffer *picture)
{
    size_t count = 0;
    const double stayed = pow(REFLECTED, BOUNCES - 0.5);
    for (size_t i = 0; i < picture_pixels(picture); i++)
        count += picture->pixels[i][0] > stayed;
    return count;
}

static Scene mirror_scene(Mesh mesh, double crease_degrees)
{
    Error error = {0};
    Scene scene = parsed(MIRROR);
    if (crease_degrees != FLAT)
        require(mesh_compute_normals(&mesh, crease_degrees, &error), &error);
    shape_add(&scene, mesh, COURSE_MATERIALS);
    return scene;
}

// Draws the inside of a closed convex mirror.
static void judge_convex(const Studio *studio, const char *name, Mesh mesh, bool from_front)
{
    const PictureSettings settings = mirror_settings((uint32_t)tier_size(32, 1000));
    if (from_front)
        shape_flip(&mesh);
    FREED_BY(scene_free) Scene scene = mirror_scene(mesh, FLAT);
    scene.viewpoints.data[0].eye = vec3(0.1, -0.05, 0.07);
    FREED_BY(framebuffer_free) Framebuffer picture = picture_draw(studio, &scene, &settings);
    outcome_report(outcome_of("T-45", picture_pixels(&picture), count_escapes(&picture)),
                   "mirror=%s bounces=%d from_front=%d", name, BOUNCES, from_front);
}

EXTREME(no_ray_escapes_from_a_convex_mirror_t45)
{
    if (tier() == 2) // tier 1 has the same rays
        return;
    Random random = {45};
    Vec3 axes[3];
    Mesh turned = shape_cube(1, 3);
    random_rotation(&random, axes);
    for (size_t vertex = 0; vertex < turned.vertex_count; vertex++)
        shape_set_vertex(&turned, vertex, rotated(axes, shape_vertex(&turned, vertex)));
    judge_convex(*state, "turned_cube", turned, false);
    for (int from_front = 0; from_front < 2; from_front++) {
        judge_convex(*state, "cube", shape_cube(1, 3), from_front == 1);
        judge_convex(*state, "globe", shape_sphere(16, vec3(0, 0, 0)), from_front == 1);
    }
}

// A closed mirror. The mirror's mesh is moved by (offset, offset, offset) and then scaled.
typedef struct {
    const char *name;
    double crease_degrees, offset, scale;
    Vec3 (*inside)(Random *random); // returns a random point inside the mesh
    size_t limit;                   // of escapes
} Mirror;

static Vec3 placed(const Mirror *mirror, Vec3 point)
{
    const Vec3 offset = vec3(mirror->offset, mirror->offset, mirror->offset);
    return vec3_scale(vec3_add(point, offset), mirror->scale);
}

// Draws a picture from the scene's camera, and counts the escapes.
static Outcome view_outcome(OpenPicture *open, const Scene *scene, const RenderSettings *render,
                            Framebuffer *picture)
{
    Error error = {0};
    const CameraData camera = picture_camera(scene, render);
    require(tile_pass_draw(&open->renderer, &camera, NULL, picture, &error), &error);
    return outcome_of("T-45", picture_pixels(picture), count_escapes(picture));
}

// Draws pictures from random points inside the mirror in random directions, and reports all
// escapes. A picture with 256 x 256 pixels has four million reflections.
static void judge_mirror(const Studio *studio, const Mirror *mirror, Mesh mesh, uint32_t views)
{
    OpenPicture open;
    Error error = {0};
    Random random = {45};
    const PictureSettings settings = mirror_settings((uint32_t)tier_size(64, 256));
    Outcome outcome = {.test = "T-45"};
    for (size_t vertex = 0; vertex < mesh.vertex_count; vertex++)
        shape_set_vertex(&mesh, vertex, placed(mirror, shape_vertex(&mesh, vertex)));
    FREED_BY(scene_free) Scene scene = mirror_scene(mesh, mirror->crease_degrees);
    FREED_BY(framebuffer_free) Framebuffer picture;
    const uint32_t side = settings.render.width;
    require(framebuffer_make(&picture, side, side, &error), &error);
    picture_open(&open, studio, &scene, &settings);
    for (uint32_t view = 0; view < views; view++) {
        const Vec3 eye = mirror->inside(&random);
        scene.viewpoints.data[0].eye = placed(mirror, eye);
        scene.viewpoints.data[0].look_at = placed(mirror, vec3_add(eye, random_direction(&random)));
        outcome_add(&outcome, view_outcome(&open, &scene, &settings.render, &picture));
    }
    picture_close(&open);
    outcome.limit = mirror->limit;
    outcome_report(outcome, "mirror=%s bounces=%d crease=%g offset=%g scale=%g", mirror->name,
                   BOUNCES, mirror->crease_degrees, mirror->offset, mirror->scale);
}

// At tier 2, each mesh gets 50 million reflections.
EXTREME(no_ray_escapes_from_a_closed_mirror_t45)
{
    static const Mirror smooth = {NULL, 180, 0, 1, tube_inside, 0};
    static const Mirror creased = {NULL, CREASE_DEGREES, 0, 1, tube_inside, 0};
    static const Mirror placed[TUBE_KINDS] = {{NULL, 180, 0, 0x1p-30, tube_inside, 0},
                                              {NULL, 180, 0, 0x1p30, tube_inside, 0},
                                              {NULL, 180, 0x1p12, 1, tube_inside, 0},
                                              {NULL, 180, 0, 0x1p-30, tube_inside, 0}};
    for (TubeKind kind = 0; kind < TUBE_KINDS; kind++) {
        const Mirror mirrors[] = {smooth, creased, placed[kind]};
        for (size_t i = 0; i < tier_size(1, COUNT(mirrors)); i++) {
            Random random = {45 + kind};
            Mirror mirror = mirrors[i];
            mirror.name = tube_names[kind];
            judge_mirror(*state, &mirror, tube_mesh(kind, &random), tier() == 2 ? 12 : 1);
        }
    }
}

// Returns a closed mesh. Its rim has eight vertices at random heights. Triangles join the rim to
// the origin and to (0, 0, -8). All coordinates are integers.
static Mesh saddle_mesh(Random *random)
{
    static const double rim[8][2] = {{4, 0},  {4, 4},   {0, 4},  {-4, 4},
                                     {-4, 0}, {-4, -4}, {0, -4}, {4, -4}};
    Mesh mesh = shape_unfilled(10, 16);
    shape_set_vertex(&mesh, 8, vec3(0, 0, 0));
    shape_set_vertex(&mesh, 9, vec3(0, 0, -8));
    for (uint32_t i = 0; i < 8; i++) {
        const uint32_t next = (i + 1) % 8;
        const uint32_t triangles[2][3] = {{8, i, next}, {9, next, i}};
        const double height = (double)random_below(random, 7) - 3;
        shape_set_vertex(&mesh, i, vec3(rim[i][0], rim[i][1], height));
        memcpy(mesh.triangles[2 * i], triangles, sizeof(triangles));
    }
    return mesh;
}

static Vec3 saddle_eye(Random *random)
{
    const double x = (double)random_below(random, 33) - 16, y = (double)random_below(random, 33);
    return vec3(x / 16, (y - 16) / 16, -4);
}

// Draws pictures of one pixel whose ray hits the vertex at the origin exactly.
static Outcome saddle_outcome(const Studio *studio, Random *random)
{
    OpenPicture open;
    Error error = {0};
    const PictureSettings settings = mirror_settings(1);
    Outcome outcome = {.test = "T-45"};
    FREED_BY(scene_free) Scene scene = mirror_scene(saddle_mesh(random), FLAT);
    FREED_BY(framebuffer_free) Framebuffer picture;
    require(framebuffer_make(&picture, 1, 1, &error), &error);
    picture_open(&open, studio, &scene, &settings);
    scene.viewpoints.data[0].look_at = vec3(0, 0, 0);
    for (int view = 0; view < 60; view++) {
        scene.viewpoints.data[0].eye = saddle_eye(random);
        outcome_add(&outcome, view_outcome(&open, &scene, &settings.render, &picture));
    }
    picture_close(&open);
    return outcome;
}

EXTREME(no_ray_escapes_at_the_vertex_of_a_saddle_t45)
{
    Random random = {45};
    Outcome outcome = {.test = "T-45"};
    if (tier() == 2) // tier 1 has the same rays
        return;
    for (size_t saddle = 0; saddle < tier_size(8, 200); saddle++)
        outcome_add(&outcome, saddle_outcome(*state, &random));
    outcome_report(outcome, "mirror=saddle bounces=%d", BOUNCES);
}

static Vec3 cow_inside(Random *random)
{
    return vec3_add(vec3(0.1, 0.3, 0.36), random_in_cube(random, 0.05));
}

// Makes 100 million reflections in the course's cow. The cow touches itself at one point, where
// rays could change sides. shape_apart therefore separates the parts that meet there. Rays can also
// escape where parts of the cow cross. The limit is the measured number of escapes: 3.
EXTREME(no_ray_escapes_from_a_mirror_cow_t45)
{
    char path[COURSE_PATH_SIZE];
    static const Mirror cow = {"cow", 180, 0, 1, cow_inside, 3};
    course_path(path, "cow.ply");
    if (tier() < 2 || !course_has(path))
        return;
    FREED_BY(scene_free) Scene scene = parsed_format("mesh %s\n", path);
    judge_mirror(*state, &cow, shape_apart(&scene.objects.data[0].mesh), 24);
}

FIXTURES(picture_setup, picture_teardown)
