// SPDX-License-Identifier: MIT
// Tests the channels besides the colors. Compares them with the oracle and with the picture's
// counters. All channels must be equal for all tile sizes. All channels except the counts of tests
// must also be equal in the fp32 forms of form_few.
#include "image/course.h"
#include "image/form.h"
#include "image/rendered.h"
#include "oracle/oracle.h"
#include "unit/cmocka_all.h"

#include <string.h>

#define SOURCE_SCENE(name) CLRT_SOURCE_FOLDER "/" name

// The number of pixels in 10,000 that may show another primitive, other shadows or other bounces
// than in the oracle's picture. Rays along an edge may hit either side.
#define LIMIT 2

// The values of a pixel, in the order of aov_table.
typedef struct {
    double depth;
    Vec3 normal, position;
    uint32_t primitive, material;
    double shadow, bounces;
} Values;

#define JUDGED "depth,normal,position,primitive,material,shadow,bounces"

static Values values_at(const Layers *layers, uint32_t x, uint32_t y)
{
    const uint32_t *v = layers_at(layers, x, y);
    return (Values){layer_float(v[0]), layer_vector(v + 1), layer_vector(v + 4), v[7], v[8],
                    layer_float(v[9]), layer_float(v[10])};
}

static double apart(Vec3 a, Vec3 b)
{
    return vec3_extent(vec3_sub(a, b));
}

typedef struct {
    uint32_t pixels;                   // all of them
    uint32_t others, shadows, bounces; // pixels that differ from the oracle's picture
    double depth, normal, position;    // largest differences on equal primitives
} Judgment;

// Returns the largest rounding error of a point that is stored in floats.
static double rounding_of(Vec3 point)
{
    return vec3_extent(point) * 0x1p-24;
}

static void judge_pixel(Judgment *judgment, const Values *values, const OraclePath *path,
                        double light_count)
{
    const bool met = path->depth < INFINITY;
    judgment->pixels++;
    if (values->primitive != (met ? path->surface.id : NOTHING)) {
        judgment->others++;
        return;
    }
    judgment->shadows += fabs(values->shadow * light_count - path->lights) > 1e-3;
    judgment->bounces += values->bounces != path->bounces;
    assert_int_equal(values->material, met ? path->surface.material : NOTHING);
    if (!met) {
        assert_true(values->depth == INFINITY);
        assert_true(vec3_extent(values->normal) == 0 && vec3_extent(values->position) == 0);
        return;
    }
    judgment->depth = fmax(judgment->depth, fabs(values->depth / path->depth - 1));
    judgment->normal = fmax(judgment->normal, apart(values->normal, path->surface.normal));
    judgment->position = fmax(judgment->position, apart(values->position, path->surface.point) -
                                                      rounding_of(path->surface.point));
}

static Judgment judge(const Scene *scene, const Layers *layers, uint32_t step)
{
    Judgment judgment = {0};
    FREED_BY(oracle_free) Oracle oracle = {0};
    Error error = {0};
    rendered_require(oracle_make(&oracle, scene, &error), &error);
    const OracleView view = oracle_view(&oracle, &scene->viewpoints.data[0], layers->width,
                                        layers->height, scene->max_level);
    for (uint32_t y = 0; y < layers->height; y += step)
        for (uint32_t x = 0; x < layers->width; x += step) {
            const Values values = values_at(layers, x, y);
            const OraclePath path = oracle_path(&view, x + 0.5, y + 0.5);
            judge_pixel(&judgment, &values, &path, (double)scene->lights.count);
        }
    return judgment;
}

static double size_of(const Scene *scene)
{
    return 1 / normalization_of(scene).scale;
}

// Compares the channels with the oracle. Draws several samples per pixel, which the channels must
// ignore.
static void check(const char *path, uint32_t step)
{
    FREED_BY(scene_free) Scene scene = rendered_scene(path);
    FREED_BY(layers_free) Layers layers;
    PictureRequest request = picture_request(path, 1);
    request.samples = 2;
    FREED_BY(framebuffer_free) Framebuffer picture = rendered_with(request, JUDGED, &layers);
    const Judgment judgment = judge(&scene, &layers, step);
    print_message("%s: %u of %u pixels show another primitive, %u other shadows, %u other bounces; "
                  "depth off by %.2g, normal by %.2g, position by %.2g\n",
                  strrchr(path, '/') + 1, judgment.others, judgment.pixels, judgment.shadows,
                  judgment.bounces, judgment.depth, judgment.normal, judgment.position);
    const uint32_t allowed = judgment.pixels * LIMIT / 10000;
    assert_true(judgment.others <= allowed && judgment.shadows <= allowed);
    assert_true(judgment.bounces <= allowed);
    assert_true(judgment.depth < 2e-5 && judgment.normal < 1e-3);
    assert_true(judgment.position < 1e-5 * size_of(&scene));
}

TEST(channels_of_small_scenes_are_what_the_oracle_sees)
{
    check(SOURCE_SCENE("scenes/reflections.scn"), 2);
    check(SOURCE_SCENE("scenes/silhouette.scn"), 4);
    check(SOURCE_SCENE("tests/image/every_feature.scn"), 1);
    check(SOURCE_SCENE("tests/image/orthographic.scn"), 1);
    check(SOURCE_SCENE("tests/image/suns.scn"), 1);
}

TEST(channels_of_a_mesh_are_what_the_oracle_sees)
{
    if (!models_are_made())
        return;
    check(SOURCE_SCENE("scenes/creature.scn"), 8);
}

TEST(channels_are_in_the_coordinates_of_a_scene_far_away)
{
    check(SOURCE_SCENE("tests/image/far_away.scn"), 2);
}

static bool layers_equal(const Layers *a, const Layers *b)
{
    return memcmp(a->values, b->values,
                  (size_t)a->width * a->height * a->count * sizeof *a->values) == 0;
}

static bool pictures_equal(const Framebuffer *a, const Framebuffer *b)
{
    return memcmp(a->pixels, b->pixels, (size_t)a->width * a->height * sizeof *a->pixels) == 0;
}

static PictureRequest every_feature(void)
{
    return picture_request(SOURCE_SCENE("tests/image/every_feature.scn"), 1);
}

// Checks that the request gives the same bits as the defaults.
static void check_same(PictureRequest other, const char *list)
{
    FREED_BY(layers_free) Layers layers, other_layers;
    FREED_BY(framebuffer_free)
    Framebuffer picture = rendered_with(every_feature(), list, &layers),
                changed = rendered_with(other, list, &other_layers);
    assert_true(pictures_equal(&picture, &changed));
    assert_true(layers_equal(&layers, &other_layers));
}

TEST(every_form_of_the_kernels_gives_the_same_channels)
{
    for (size_t i = 0; i < FORMS_FEW - 1; i++)
        check_same(rendered_in_form(every_feature(), &form_few[i]), JUDGED ",samples");
}

TEST(every_form_over_one_kind_of_nodes_counts_the_same_tests)
{
    for (size_t i = 0; i < FORMS_FEW - 1; i++)
        if (form_few[i].nodes == form_choice().nodes)
            check_same(rendered_in_form(every_feature(), &form_few[i]), "boxtests,tritests");
}

TEST(tiles_change_no_channel)
{
    PictureRequest request = every_feature();
    request.tile_width = 13;
    request.tile_height = 7;
    check_same(request, JUDGED ",samples,boxtests,tritests");
}

static double sum_of(const Layers *layers, uint32_t channel)
{
    double sum = 0;
    const size_t count = (size_t)layers->width * layers->height;
    for (size_t pixel = 0; pixel < count; pixel++)
        sum += layer_float(layers->values[pixel * layers->count + channel]);
    return sum;
}

// Compares the sums of channels with the picture's counts of rays and of tests.
static void check_sums(const char *channels, uint32_t samples, int kind)
{
    FREED_BY(layers_free) Layers layers;
    uint64_t tallies[TALLY_KINDS];
    PictureRequest request = rendered_in_form(every_feature(), &form_all[0]);
    request.tallies = tallies;
    request.samples = samples;
    FREED_BY(framebuffer_free) Framebuffer picture = rendered_with(request, channels, &layers);
    assert_true(sum_of(&layers, 0) == (double)tallies[kind]);
    assert_true(sum_of(&layers, 1) == (double)tallies[TALLY_BOX_TESTS]);
    assert_true(sum_of(&layers, 2) == (double)tallies[TALLY_TRIANGLE_TESTS]);
}

TEST(tests_and_bounces_of_pixels_add_up_to_the_pictures_counts)
{
    check_sums("bounces,boxtests,tritests", 1, TALLY_REFLECTED_RAYS);
    check_sums("samples,boxtests,tritests", 3, TALLY_CAMERA_RAYS);
}

TEST(the_picture_keeps_its_bits_with_channels)
{
    FREED_BY(layers_free) Layers layers;
    const PictureRequest request = every_feature();
    FREED_BY(framebuffer_free)
    Framebuffer plain = rendered(&request),
                picture = rendered_with(request, JUDGED ",boxtests", &layers);
    assert_true(pictures_equal(&picture, &plain));
}

TEST(a_name_that_is_no_channel_is_refused_with_the_nearest)
{
    AovSet set = 0;
    Error error = {0}, other = {0};
    assert_false(aov_read_list("depth,normals", &set, &error));
    assert_non_null(strstr(error.text, "'normals', perhaps normal"));
    assert_false(aov_read_list("depth,", &set, &other));
    assert_non_null(strstr(other.text, "give all or a list of depth, normal, position"));
}

TEST(all_stands_for_the_channels_without_a_reference)
{
    AovSet set = 0, every = 0;
    Error error = {0};
    for (size_t i = 0; i < aov_count; i++)
        assert_true(aov_read_list(aov_table[i].name, &every, &error));
    assert_true(aov_read_list("all", &set, &error));
    assert_false(aov_needs(set, AOV_NEEDS_REFERENCE));
    assert_true(aov_read_list("all,error", &set, &error));
    assert_int_equal(set, every);
}
