// SPDX-License-Identifier: MIT
// Tests --aov certainty. Certified and repaired pixels must have real arithmetic's decisions. Most
// pixels of ordinary scenes must be certified, and only repaired pixels may change. Tier 0 compares
// some pixels of small pictures. Tier 1 compares all certified and repaired pixels, over ten
// million.
#include "base/thread_pool.h"
#include "certainty/certified.h"
#include "certainty/extreme_scenes.h"
#include "certainty/real.h"
#include "extremes/support/check.h"
#include "image/course.h"
#include "image/rendered.h"
#include "image/unusual_scenes.h"
#include "scene/scn.h"
#include "unit/cmocka_all.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>
#include <time.h>

typedef struct {
    uint64_t pixels, compared, wrong, poor; // poor: views with too few certified pixels
} Sum;

typedef struct {
    uint64_t compared;  // certified or repaired pixels; the other members count some of these
    uint64_t first;     // the first hit or the lights that reach it differ
    uint64_t deeper;    // only another decision of the ray tree differs
    uint64_t unsettled; // not even 113 bits settle the first hit and its lights
    uint64_t in_113;    // 64 bits did not settle the ray tree
} Comparison;

typedef struct {
    const Certified *certified;
    RealView view;
    uint32_t step;
    _Atomic uint64_t compared, first, deeper, unsettled, in_113;
} Comparing;

static void compare_pixel(Comparing *comparing, uint32_t x, uint32_t y)
{
    const CertaintyMap *map = &comparing->certified->map;
    const CertaintyMark *mark = &map->marks[(size_t)y * map->width + x];
    if (mark->certainty == CERTAINTY_OPEN)
        return;
    RealDecisions real = real_decide_64(&comparing->view, x, y);
    if (!real.settled) {
        comparing->in_113++;
        real = real_decide_113(&comparing->view, x, y);
    }
    const bool same = real.first_id == mark->first_id && real.lit == mark->lit;
    comparing->compared++;
    comparing->unsettled += !real.first_settled;
    comparing->first += !same;
    comparing->deeper += same && real.settled && real.signature != mark->signature;
}

static void compare_row(void *context, uint32_t row)
{
    Comparing *comparing = context;
    for (uint32_t x = 0; x < comparing->view.width; x += comparing->step)
        compare_pixel(comparing, x, row * comparing->step);
}

// Compares every step-th pixel of every step-th row.
static bool real_compare(Comparison *comparison, const Certified *certified, uint32_t step,
                         Error *error)
{
    RealTree tree;
    const bool ok = real_tree_make(&tree, &certified->stage.flat, error);
    Comparing comparing = {.certified = certified,
                           .view = {&certified->stage.flat, &tree, &certified->camera,
                                    certified->settings.width, certified->settings.height,
                                    certified->settings.max_level},
                           .step = step};
    if (ok) {
        ThreadPool *pool = thread_pool_open(0);
        thread_pool_run(pool, (comparing.view.height + step - 1) / step, compare_row, &comparing);
        thread_pool_close(pool);
    }
    *comparison = (Comparison){comparing.compared, comparing.first, comparing.deeper,
                               comparing.unsettled, comparing.in_113};
    real_tree_free(&tree);
    return ok;
}

static uint64_t count_changed(const Certified *certified, Certainty certainty)
{
    uint64_t changed = 0;
    const size_t count = (size_t)certified->map.width * certified->map.height;
    for (size_t pixel = 0; pixel < count; pixel++)
        changed += certified->map.marks[pixel].certainty == (uint32_t)certainty &&
                   memcmp(certified->plain.pixels[pixel], certified->picture.pixels[pixel],
                          sizeof certified->plain.pixels[pixel]) != 0;
    return changed;
}

// The plain picture's first hit, its material, and the share of lights that reach it.
typedef struct {
    uint32_t primitive, material;
    float share;
} Seen;

// Returns whether the plain picture and the mark have the same first hit and number of lights at
// the hit. Lights do not color silhouettes and glass, so the function does not compare their
// numbers of lights.
static bool is_alike(const Certified *certified, const CertaintyMark *mark, const Seen *seen)
{
    if (seen->primitive != mark->first_id)
        return false;
    if (seen->primitive == NOTHING)
        return true;
    const uint32_t shader = certified->stage.flat.materials[seen->material].shader;
    if (shader == SHADER_SILHOUETTE || shader == SHADER_GLASS)
        return true;
    const long lights = lroundf(seen->share * (float)certified->stage.flat.light_count);
    return lights == __builtin_popcount(mark->lit);
}

// Returns the number of certified pixels for which the plain picture has other decisions.
static uint64_t count_unlike_plain(const Certified *certified)
{
    uint64_t unlike = 0;
    const CertaintyMap *map = &certified->map;
    for (uint32_t y = 0; y < map->height; y++)
        for (uint32_t x = 0; x < map->width; x++) {
            Seen seen;
            const CertaintyMark *mark = &map->marks[(size_t)y * map->width + x];
            memcpy(&seen, layers_at(&certified->seen, x, y), sizeof seen);
            unlike += mark->certainty == CERTAINTY_CERTIFIED && !is_alike(certified, mark, &seen);
        }
    return unlike;
}

// At least `floor` of 1000 pixels must be certified.
static void check_view(Sum *sum, const Scene *scene, const char *name, uint32_t view,
                       uint32_t floor)
{
    Error error = {0};
    Comparison comparison = {0};
    const uint32_t part = (uint32_t)tier_size(2, 1); // divides the picture's sides
    const CertifiedView wanted = {
        .view = view, .width = scene->width / part, .height = scene->height / part, .samples = 1};
    const uint32_t step = (uint32_t)tier_size(scene_triangle_count(scene) > 1000 ? 8 : 4, 1);
    FREED_BY(certified_free) Certified certified = certified_make(scene, &wanted);
    require(real_compare(&comparison, &certified, step, &error), &error);
    const uint64_t *counts = certified.map.counts;
    const uint64_t pixels = counts[0] + counts[1] + counts[2];
    const uint64_t wrong = comparison.first + comparison.deeper + comparison.unsettled;
    const uint64_t unlike = count_unlike_plain(&certified);
    const uint64_t changed =
        count_changed(&certified, CERTAINTY_CERTIFIED) + count_changed(&certified, CERTAINTY_OPEN);
    print_message(
        "%s view %u: %.2f %% certified, %.2f %% repaired, %.2f %% open; %llu compared, "
        "%llu in 113 bits, wrong first %llu, deeper %llu, unsettled %llu; %llu changed, %llu "
        "unlike\n",
        name, view, 100 * (double)counts[CERTAINTY_CERTIFIED] / (double)pixels,
        100 * (double)counts[CERTAINTY_REPAIRED] / (double)pixels,
        100 * (double)counts[CERTAINTY_OPEN] / (double)pixels,
        (unsigned long long)comparison.compared, (unsigned long long)comparison.in_113,
        (unsigned long long)comparison.first, (unsigned long long)comparison.deeper,
        (unsigned long long)comparison.unsettled, (unsigned long long)changed,
        (unsigned long long)unlike);
    sum->pixels += pixels;
    sum->compared += comparison.compared;
    sum->wrong += wrong + changed + unlike;
    sum->poor += counts[CERTAINTY_CERTIFIED] * 1000 < floor * pixels;
}

static void check_views(Sum *sum, const Scene *scene, const char *name, uint32_t floor)
{
    const uint32_t most = (uint32_t)tier_size(1, 6);
    for (uint32_t view = 1; view <= scene->viewpoints.count && view <= most; view++)
        check_view(sum, scene, name, view, floor);
}

static void check_file(Sum *sum, const char *path, uint32_t floor)
{
    Error error = {0};
    FREED_BY(scene_free) Scene scene = {0};
    require(scn_load(&scene, path, &(SceneLoadOptions){0}, &error), &error);
    check_views(sum, &scene, strrchr(path, '/') + 1, floor);
}

static void judge(const Sum *sum)
{
    print_message("%llu of %llu pixels compared\n", (unsigned long long)sum->compared,
                  (unsigned long long)sum->pixels);
    assert_int_equal(sum->wrong, 0);
    assert_int_equal(sum->poor, 0);
}

TEST(certain_pixels_of_small_scenes_are_decided_as_by_real_arithmetic)
{
    Sum sum = {0};
    check_file(&sum, CLRT_SOURCE_FOLDER "/scenes/silhouette.scn", 990);
    check_file(&sum, CLRT_SOURCE_FOLDER "/scenes/matte.scn", 990);
    check_file(&sum, CLRT_SOURCE_FOLDER "/scenes/blinn_phong.scn", 990);
    check_file(&sum, CLRT_SOURCE_FOLDER "/scenes/reflections.scn", 980);
    check_file(&sum, CLRT_SOURCE_FOLDER "/scenes/simple.scn", 990);
    check_file(&sum, CLRT_SOURCE_FOLDER "/tests/image/every_feature.scn", 950);
    check_file(&sum, CLRT_SOURCE_FOLDER "/tests/image/painted.scn", 950);
    check_file(&sum, CLRT_SOURCE_FOLDER "/tests/image/orthographic.scn", 950);
    check_file(&sum, CLRT_SOURCE_FOLDER "/scenes/steps.scn", 950);
    check_file(&sum, CLRT_SOURCE_FOLDER "/scenes/checkers.scn", 850);
    judge(&sum);
}

TEST(certain_pixels_of_meshes_are_decided_as_by_real_arithmetic)
{
    Sum sum = {0};
    if (!models_are_made())
        return;
    check_file(&sum, CLRT_SOURCE_FOLDER "/scenes/creature.scn", 950);
    check_file(&sum, CLRT_SOURCE_FOLDER "/scenes/figure.scn", 850);
    if (tier() > 0)
        check_file(&sum, CLRT_SOURCE_FOLDER "/scenes/coral.scn", 900);
    judge(&sum);
}

TEST(certain_pixels_at_the_extremes_are_decided_as_by_real_arithmetic)
{
    Sum sum = {0};
    for (size_t i = 0; i < extreme_scene_count; i++) {
        Scene scene = extreme_scenes[i].make();
        check_views(&sum, &scene, extreme_scenes[i].name, 0);
        scene_free(&scene);
    }
    judge(&sum);
}

TEST(certain_pixels_of_unusual_scenes_are_decided_as_by_real_arithmetic)
{
    Sum sum = {0};
    for (size_t scene = 0; scene < UNUSUAL_COUNT; scene++)
        check_file(&sum, unusual_scenes[scene], 0);
    judge(&sum);
}

// A tie between coincident triangles is as certain as a hit of either alone.
TEST(coincident_triangles_are_certified)
{
    Sum sum = {0};
    FREED_BY(scene_free) Scene scene = extreme_coincident();
    check_views(&sum, &scene, "coincident", 980);
    judge(&sum);
}

// Each run draws another scene.
TEST(a_tree_over_spheres_changes_no_decision)
{
    const uint64_t seed = (uint64_t)time(NULL);
    FREED_BY(scene_free) Scene scene = extreme_marbles(seed);
    CertifiedView view = {.view = 1, .width = 192, .height = 192, .samples = 1};
    FREED_BY(certified_free) Certified with = certified_make(&scene, &view);
    view.tree = TREE_NONE;
    FREED_BY(certified_free) Certified without = certified_make(&scene, &view);
    print_message("seed %llu\n", (unsigned long long)seed);
    assert_true(with.stage.flat.sphere_entries > without.stage.flat.sphere_entries);
    assert_memory_equal(with.map.marks, without.map.marks,
                        (size_t)view.width * view.height * sizeof *with.map.marks);
}
