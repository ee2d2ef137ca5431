// SPDX-License-Identifier: MIT
// Tests --aov certainty in random scenes with glass. The colors of certified pixels may differ from
// fp64 only by rounding, repaired pixels must have the colors of fp64, and few pixels may be open.
// Tier 0 draws 10 scenes of each kind, and tier 1 draws 50.
#include "certainty/certified.h"
#include "extremes/support/check.h"
#include "image/comparison.h"
#include "image/form.h"
#include "image/rendered.h"
#include "unit/cmocka_all.h"
#include "unit/parsed.h"
#include "unit/random.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#define FOLDER CLRT_SOURCE_FOLDER "/scenes"
#define BLOCK  CLRT_SOURCE_FOLDER "/tests/image/block.ply"
#define BALL   CLRT_SOURCE_FOLDER "/tests/image/ball.ply"

static void write_place(FILE *stream, uint64_t *random, double height)
{
    fprintf(stream, " %g %g %g", random_between(random, -1.6, 1.6),
            random_between(random, -1.6, 1.6), height);
}

static void write_random_meshes(FILE *stream, uint64_t *random, double lift)
{
    for (int i = 0; i < 3; i++) {
        fprintf(stream, "define m%d glass ior %g color 0.9 1 0.8\nmaterial m%d\nnormals %s\n", i,
                random_between(random, 1.1, 2.4), i, i == 2 ? "smooth" : "flat");
        fprintf(stream, "mesh %s scale %g rotate %g %g 1 %g translate", i == 2 ? BALL : BLOCK,
                random_between(random, 0.2, 0.4), random_between(random, -1, 1),
                random_between(random, -1, 1), random_between(random, 0, 360));
        write_place(stream, random, lift + random_between(random, 0.4, 1.2));
        fputc('\n', stream);
    }
}

// Writes a floor, a mirror ball, a shiny ball, and balls and meshes of glass, which may overlap.
static void write_random_scene(char path[TEMPORARY_PATH], uint64_t seed)
{
    FILE *stream = temporary_open(path);
    uint64_t random = seed;
    fprintf(stream, "size 40 30\nbackground 0.5 0.7 0.9\nmax_level 5\nlight 4 -3 6 0.6\n"
                    "sun -2 -3 5 0.3\ndefine chrome matte kd 0.3 reflectivity 0.7\nmaterial 1\n"
                    "mesh " FOLDER "/plateau.ply\nmaterial 2\nsphere");
    write_place(stream, &random, 0.3);
    fputs(" 0.3\nmaterial chrome\nsphere", stream);
    write_place(stream, &random, 0.4);
    fputs(" 0.4\n", stream);
    for (int i = 0; i < 4; i++) {
        fprintf(stream, "define s%d glass ior %g\nmaterial s%d\nsphere", i,
                random_between(&random, i == 3 ? 0.6 : 1.1, 2), i);
        write_place(stream, &random, random_between(&random, 0.5, 1));
        fprintf(stream, " %g\n", random_between(&random, 0.1, 0.5));
    }
    write_random_meshes(stream, &random, 0);
    fprintf(stream, "camera %g -4 %g  0 0 0.4  45\n", random_between(&random, -3, 3),
            random_between(&random, 0.5, 4));
    temporary_close(stream);
}

// Writes a floor under balls and meshes of glass, which may overlap. The camera is below the glass,
// so the picture shows only its light. A block far below makes the frame larger, and rounding with
// it.
static void write_lit_floor(char path[TEMPORARY_PATH], uint64_t seed)
{
    FILE *stream = temporary_open(path);
    uint64_t random = seed;
    fputs("size 40 30\nbackground 0 0 0\nambient 0\nmax_level 1\nup 0 1 0\n"
          "camera 0 0 0.2  0 0 0  orthographic 2.4\nlight 1 -1 6 0.4\nsun -2 -3 5 0.3\n"
          "light -1 2 3 0.1 area 0.5 0 0 0 0.5 0 2\nmaterial 1\nmesh " FOLDER "/plateau.ply\n"
          "mesh " BLOCK " translate 0 0 -8000\n",
          stream);
    for (int i = 0; i < 8; i++) {
        fprintf(stream, "define s%d glass color %g 1 %g\nmaterial s%d\nsphere", i,
                random_between(&random, 0.4, 0.9), random_between(&random, 0.4, 0.9), i);
        write_place(stream, &random, random_between(&random, 0.9, 1.6));
        fprintf(stream, " %g\n", random_between(&random, 0.1, 0.5));
    }
    write_random_meshes(stream, &random, 0.8);
    temporary_close(stream);
}

typedef struct {
    uint64_t pixels, certified, open, wrong;
    uint64_t differing; // pixels that are not certified and differ from fp64
    float largest;      // largest difference of a certified pixel from fp64
} Sum;

typedef struct {
    void (*write)(char path[TEMPORARY_PATH], uint64_t seed);
    float rounded; // the largest difference that rounding causes if no decision differs
} Kind;

static void check_scene(Sum *sum, const Kind *kind, uint64_t seed)
{
    char path[TEMPORARY_PATH];
    kind->write(path, seed);
    const PictureRequest request = picture_request(path, 1);
    const PictureRequest in_fp64 = rendered_in_form(request, &form_all[FORMS_FP32]);
    FREED_BY(framebuffer_free) Framebuffer exact = rendered(&in_fp64);
    FREED_BY(scene_free) Scene scene = rendered_scene(path);
    const CertifiedView view = {
        .view = 1, .width = scene.width, .height = scene.height, .samples = 1};
    FREED_BY(certified_free) Certified certified = certified_make(&scene, &view);
    unlink(path);
    for (uint32_t i = 0; i < exact.width * exact.height; i++) {
        const uint32_t certainty = certified.map.marks[i].certainty;
        const float apart = color_difference(certified.plain.pixels[i], exact.pixels[i]);
        sum->pixels++;
        sum->open += certainty == CERTAINTY_OPEN;
        sum->differing += certainty != CERTAINTY_CERTIFIED && apart > kind->rounded;
        if (certainty == CERTAINTY_REPAIRED)
            sum->wrong +=
                memcmp(certified.picture.pixels[i], exact.pixels[i], sizeof exact.pixels[i]) != 0;
        if (certainty != CERTAINTY_CERTIFIED)
            continue;
        sum->certified++;
        sum->wrong += !(apart <= kind->rounded);
        sum->largest = fmaxf(sum->largest, apart);
    }
}

static Sum check_scenes(const Kind *kind)
{
    Sum sum = {0};
    const uint64_t scenes = tier_size(10, 50);
    for (uint64_t seed = 1; seed <= scenes; seed++)
        check_scene(&sum, kind, seed);
    print_message(
        "%llu pixels, %.1f %% certified, %.1f %% open, %llu wrong, differences up to %.2g; "
        "%llu others differ\n",
        (unsigned long long)sum.pixels, 100 * (double)sum.certified / (double)sum.pixels,
        100 * (double)sum.open / (double)sum.pixels, (unsigned long long)sum.wrong,
        (double)sum.largest, (unsigned long long)sum.differing);
    assert_int_equal(sum.wrong, 0);
    assert_true(sum.differing > 0); // otherwise, the test would not notice wrong certificates
    return sum;
}

TEST(certified_pixels_of_random_glass_agree_with_fp64)
{
    const Kind kind = {write_random_scene, 1e-5f};
    const Sum sum = check_scenes(&kind);
    assert_true(10 * sum.certified >= 8 * sum.pixels);
    assert_true(100 * sum.open <= sum.pixels);
}

TEST(certified_light_through_glass_agrees_with_fp64)
{
    const Kind kind = {write_lit_floor, 1e-4f};
    const Sum sum = check_scenes(&kind);
    assert_true(6 * sum.certified >= sum.pixels);
    assert_true(20 * sum.open <= sum.pixels);
}

// Rounding decides whether light along the side of a block crosses the glass. The middle column of
// the floor has such light. The camera is below the block.
TEST(light_along_a_side_of_glass_is_open)
{
    FREED_BY(scene_free)
    Scene scene =
        parsed("size 33 9\nmax_level 1\nup 0 1 0\ncamera 0 0 0.2  0 0 0  orthographic 0.3\n"
               "sun 0 0 1 0.8\nmaterial 1\nmesh plateau.ply\ndefine green glass color 0.5 1 0.5\n"
               "material green\nmesh ../tests/image/block.ply translate 1 0 2\n");
    const CertifiedView view = {.view = 1, .width = 33, .height = 9, .samples = 1};
    FREED_BY(certified_free) Certified certified = certified_make(&scene, &view);
    for (uint32_t i = 0; i < 33 * 9; i++)
        assert_true((certified.map.marks[i].certainty == CERTAINTY_OPEN) == (i % 33 == 16));
}
