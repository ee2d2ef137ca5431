// SPDX-License-Identifier: MIT
// Tests the explanations of pixels. They must match the picture and be consistent in themselves.
// Their error bounds must hold for the oracle's results on the same stored numbers.
#include "image/course.h"
#include "image/form.h"
#include "image/rendered.h"
#include "oracle/stored.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <string.h>

#define SOURCE_SCENE(name) CLRT_SOURCE_FOLDER "/" name

static void trace(Explainer *explainer, const uint32_t pixel[2], uint32_t index,
                  ExplainedSample *sample)
{
    Error error = {0};
    rendered_require(explainer_trace(explainer, pixel, index, sample, &error), &error);
}

static double clamped(double value)
{
    return fmin(fmax(value, 0), 1);
}

static double component(Vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// Checks that a surface's color is the sum of the ambient light and its reported lights.
static void check_surface(const Explainer *explainer, const ExplainedRay *ray)
{
    const Scene *scene = explainer->scene;
    const Material *material = &scene->materials.data[ray->found.material];
    double diffuse[3] = {scene->ambient, scene->ambient, scene->ambient}, specular[3] = {0, 0, 0};
    for (size_t i = 0; i < ray->found.light_count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            const double part =
                component(scene->lights.data[i].color, axis) * ray->lights[i].tint[axis];
            diffuse[axis] += part * (double)material->kd * ray->lights[i].diffuse;
            specular[axis] += part * (double)material->ks * ray->lights[i].specular;
        }
        assert_true((ray->lights[i].blocker != NOTHING) ==
                    (ray->lights[i].state == CLRT_LIGHT_BLOCKED));
        assert_true((ray->lights[i].cosine > 0) == (ray->lights[i].state != CLRT_LIGHT_BEHIND));
    }
    for (int axis = 0; axis < 3; axis++) {
        const double own = component(ray->diffuse, axis);
        const double lit = own * diffuse[axis] + (double)material->specular[axis] * specular[axis];
        const double color = material->shader == SHADER_SILHOUETTE ? own : clamped(lit);
        assert_true(fabs(color - ray->found.shaded[axis]) < 1e-5);
    }
}

// Rounds the result of an operation to the kernel's precision. Rounding a sum or product of floats
// to double first does not change the float.
static double rounded_as(const Explainer *explainer, double value)
{
    return explainer->is_fp64 ? value : (double)(float)value;
}

static double sum_after(const Explainer *explainer, double sum, double weight, double color)
{
    return rounded_as(explainer, sum + rounded_as(explainer, weight * color));
}

// Checks that a sample's color is the sum of its rays and of the background, to the last bit.
static void check_sum(const Explainer *explainer, const ExplainedSample *sample, int axis)
{
    double sum = 0;
    for (uint32_t i = 0; i < sample->found.ray_count; i++) {
        const ClrtExplainedRay *ray = &sample->rays[i].found;
        const double seen = rounded_as(explainer, ray->tint[axis] * ray->shaded[axis]);
        sum = sum_after(explainer, sum, ray->share, seen);
    }
    const double background = (double)(float)component(explainer->scene->background, axis);
    sum = clamped(sum_after(explainer, sum, sample->found.background_weight, background));
    assert_true(rint(sum * 0x1p32) * 0x1p-32 == sample->found.color[axis]);
}

static void check_sample(const Explainer *explainer, const ExplainedSample *sample)
{
    for (uint32_t i = 0; i < sample->found.ray_count; i++) {
        const ExplainedRay *ray = &sample->rays[i];
        if (ray->found.primitive == NOTHING)
            assert_true(!ray->found.is_cut || ray->found.level == explainer->frame.max_level);
        else if (explainer->scene->materials.data[ray->found.material].shader == SHADER_GLASS)
            assert_true(ray->found.share == 0);
        else
            check_surface(explainer, ray);
    }
    for (int axis = 0; axis < 3; axis++)
        check_sum(explainer, sample, axis);
}

#define PIXELS 40

static void check_pixels(Explainer *explainer, const Framebuffer *picture, void *context)
{
    uint64_t state = 1;
    const uint32_t side = explainer->frame.samples;
    (void)context;
    for (int i = 0; i < PIXELS; i++) {
        float color[3];
        const uint32_t x = random_below(&state, picture->width);
        const uint32_t y = random_below(&state, picture->height);
        for (uint32_t place = 0; place < side * side; place++) {
            ExplainedSample sample;
            trace(explainer, (uint32_t[]){x, y}, place, &sample);
            check_sample(explainer, &sample);
            explained_sample_free(&sample);
        }
        explainer_mix(explainer, color);
        assert_memory_equal(color, picture->pixels[(size_t)y * picture->width + x], sizeof color);
    }
}

static void check_in_form(const KernelChoice *form, const char *path, uint32_t samples)
{
    PictureRequest request = rendered_in_form(picture_request(path, 1), form);
    request.width = 131;
    request.height = 97;
    request.samples = samples;
    request.visit = check_pixels;
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
}

static void check_scene(const char *path, uint32_t samples)
{
    for (size_t i = 0; i < FORMS_FEW; i++)
        check_in_form(&form_few[i], path, samples);
}

TEST(explanations_give_the_bits_of_pixels_in_every_form)
{
    check_scene(SOURCE_SCENE("tests/image/every_feature.scn"), 1);
    check_scene(SOURCE_SCENE("scenes/silhouette.scn"), 1);
    check_scene(SOURCE_SCENE("tests/image/mirrors.scn"), 1);
    check_scene(SOURCE_SCENE("tests/image/painted.scn"), 1);
    check_scene(SOURCE_SCENE("tests/image/orthographic.scn"), 1);
    check_scene(SOURCE_SCENE("tests/image/suns.scn"), 1);
    check_scene(SOURCE_SCENE("tests/image/glass.scn"), 1);
}

// Scenes with checkers need programs of their own, which take time to compile. The code for
// checkers is the same in all forms, so this test uses one form.
TEST(explanations_of_checkers_give_the_bits_of_pixels)
{
    check_in_form(&form_few[0], SOURCE_SCENE("tests/image/checkered.scn"), 1);
}

TEST(explanations_of_several_samples_give_the_bits_of_pixels)
{
    check_scene(SOURCE_SCENE("scenes/reflections.scn"), 3);
    check_scene(SOURCE_SCENE("tests/image/far_away.scn"), 2);
}

TEST(explanations_of_a_large_mesh_give_the_bits_of_pixels)
{
    if (!models_are_made())
        return;
    check_scene(SOURCE_SCENE("scenes/creature.scn"), 2);
}

typedef struct {
    const char *path;
    uint32_t compared;
    double largest; // the largest error divided by its bound
} Bounds;

static void judge_distance(Bounds *bounds, const Explainer *explainer, const ExplainedRay *ray,
                           const OraclePath *path)
{
    const double scale = explainer->normalization->scale;
    const ClrtExplainedRay *found = &ray->found;
    if (found->primitive == NOTHING || found->primitive != path->surface.id)
        return;
    const Vec3 origin = vec3_of_doubles(found->origin);
    const Vec3 eye = normalize_point(explainer->normalization, origin);
    const Vec3 apart = vec3_sub(path->surface.point, eye);
    const double distance = sqrt(vec3_dot(apart, apart));
    // Allows for the rounding of the oracle and of this test.
    const double rounding = 0x1p-48 * (distance + vec3_extent(eye));
    bounds->compared++;
    bounds->largest = fmax(bounds->largest, fabs(found->distance * scale - distance) /
                                                (found->distance_error * scale + rounding));
}

// Checks only camera rays, because the oracle's reflected rays start at slightly different points.
static void check_bounds(Explainer *explainer, const Framebuffer *picture, void *context)
{
    Bounds *bounds = context;
    FREED_BY(scene_free) Scene scene = rendered_scene(bounds->path);
    FREED_BY(oracle_free) Oracle oracle = {0};
    Error error = {0};
    rendered_require(stored_round(&scene, explainer->normalization, &error) &&
                         oracle_make(&oracle, &scene, &error),
                     &error);
    OracleView view =
        stored_view(&oracle, &explainer->frame.camera, picture->width, picture->height);
    view.max_level = 1;
    for (uint32_t y = 0; y < picture->height; y += 3)
        for (uint32_t x = 0; x < picture->width; x += 3) {
            ExplainedSample sample;
            trace(explainer, (uint32_t[]){x, y}, 0, &sample);
            const OraclePath path =
                oracle_follow(&view, vec3_of_doubles(sample.rays[0].found.direction));
            judge_distance(bounds, explainer, &sample.rays[0], &path);
            explained_sample_free(&sample);
        }
}

static void check_bounds_of(const char *path, const KernelChoice *choice)
{
    Bounds bounds = {.path = path};
    PictureRequest request = rendered_in_form(picture_request(path, 1), choice);
    request.width = 150;
    request.height = 110;
    request.visit = check_bounds;
    request.visit_context = &bounds;
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    print_message("%s: %u distances, errors take up to %.2g of their bounds\n",
                  strrchr(path, '/') + 1, bounds.compared, bounds.largest);
    assert_true(bounds.compared > 200);
    assert_true(bounds.largest <= 1 && bounds.largest > 1e-3);
}

TEST(distances_are_within_their_reported_error_bounds)
{
    check_bounds_of(SOURCE_SCENE("tests/image/every_feature.scn"), &form_all[0]);
    check_bounds_of(SOURCE_SCENE("tests/image/every_feature.scn"), &form_all[2]);
    check_bounds_of(SOURCE_SCENE("tests/image/far_away.scn"), &form_all[1]);
    check_bounds_of(SOURCE_SCENE("tests/image/mirrors.scn"), &form_all[0]);
}

static void draw_into_a_smaller_framebuffer(Explainer *explainer, const Framebuffer *drawn,
                                            void *context)
{
    FREED_BY(framebuffer_free) Framebuffer small;
    Renderer renderer = explainer->renderer;
    Error error = {0};
    assert_true(framebuffer_make(&small, drawn->width, drawn->height - 1, &error));
    assert_false(tile_pass_draw(&renderer, &explainer->frame.camera, NULL, &small, &error));
    assert_non_null(strstr(error.text, "32 x 23"));
    *(bool *)context = true;
}

TEST(framebuffers_of_another_size_are_refused)
{
    bool is_visited = false;
    PictureRequest request = picture_request(SOURCE_SCENE("scenes/reflections.scn"), 1);
    request.width = 32;
    request.height = 24;
    request.visit = draw_into_a_smaller_framebuffer;
    request.visit_context = &is_visited;
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    assert_true(is_visited);
}
