// SPDX-License-Identifier: MIT
// The box test under special values: it may visit a box in vain, but never miss one that the ray
// truly meets, in exact arithmetic.
#include "support/aim.h"
#include "support/box_case.h"
#include "support/check.h"
#include "support/shapes.h"
#include "support/trial.h"

#include <stdlib.h>

#define COUNT(array) (sizeof(array) / sizeof *(array))

// Components of directions: zeros of both signs, denormals, the smallest and small normal numbers.
static const float components[] = {0.0f,   -0.0f,   1e-45f, -1e-45f, 1e-38f, -1e-38f,
                                   1e-20f, -1e-20f, 0.25f,  -0.25f,  1.0f,   -1.0f};
static const float origins[] = {-2.0f, -0.5f, 0.0f, 0.25f, 0.5f, 0x1p38f};
static const float intervals[][2] = {{-0.5f, 0.5f}, {0.5f, 0.5f}, {0.0f, 0.25f}, {0.0f, 0.0f}};

#define DIRECTIONS (COUNT(components) * COUNT(components) * COUNT(components))
#define ORIGINS    (COUNT(origins) * COUNT(origins) * COUNT(origins))
#define BOXES      (COUNT(intervals) * COUNT(intervals) * COUNT(intervals))

static float largest_component(const float direction[3])
{
    return fmaxf(fmaxf(fabsf(direction[0]), fabsf(direction[1])), fabsf(direction[2]));
}

// The number's digits to these bases choose the components.
static TestRay special_ray(size_t direction, size_t origin)
{
    TestRay ray = {.own = NOTHING};
    for (int axis = 0; axis < 3; axis++) {
        ray.direction[axis] = components[direction % COUNT(components)];
        ray.origin[axis] = origins[origin % COUNT(origins)];
        direction /= COUNT(components);
        origin /= COUNT(origins);
    }
    return ray;
}

static Box special_box(size_t number)
{
    Box box;
    for (int axis = 0; axis < 3; axis++) {
        box.low[axis] = intervals[number % COUNT(intervals)][0];
        box.high[axis] = intervals[number % COUNT(intervals)][1];
        number /= COUNT(intervals);
    }
    return box;
}

// Directions shorter than this cannot arise: a camera's or a reflection's is about as long as 1,
// and from a light to a surface it is at least the distance the point is kept off its surface.
// The reciprocals of shorter directions overflow.
#define SHORTEST_DIRECTION 1e-20f

static void rays_of_special_values_miss_no_box_they_meet_t21(void **state)
{
    Error error = {0};
    size_t misses = 0, met = 0, tested = 0;
    BoxCase *cases = memory_raw(ORIGINS * BOXES / 2, sizeof *cases, &error);
    require(cases != NULL, &error);
    for (size_t direction = 0; direction < DIRECTIONS; direction++) {
        size_t count = 0;
        const TestRay first = special_ray(direction, 0);
        if (largest_component(first.direction) < SHORTEST_DIRECTION)
            continue;
        for (size_t origin = 0; origin < ORIGINS; origin++)
            for (size_t box = 0; box < BOXES; box += 2)
                cases[count++] = (BoxCase){special_ray(direction, origin),
                                           {special_box(box), special_box(box + 1)}};
        misses += box_case_count_misses(*state, cases, count, &met);
        tested += 2 * count;
    }
    free(cases);
    char details[64];
    snprintf(details, sizeof details, "boxes=special met=%zu", met);
    report_case("T-21", details, tested, misses);
    assert_true(met > tested / 100);
    assert_int_equal(misses, 0);
}

#define INNER_RAYS 100

// From inside a closed shape even the strangest direction leads to it.
static void directions_of_special_values_leave_no_closed_shape_t21(void **state)
{
    Stage stage;
    Trial trial;
    Random random = {21};
    size_t misses = 0, count = 0;
    Scene scene = shape_scene(shape_cube(1, 5));
    TestRay *rays = aim_make_rays(DIRECTIONS * INNER_RAYS);
    stage_make(&stage, &scene, TREE_SAH);
    const Room room = room_inside(&stage, vec3(0, 0, 0), 1);
    for (size_t direction = 0; direction < DIRECTIONS; direction++)
        for (int i = 0; i < INNER_RAYS; i++) {
            rays[count] = special_ray(direction, 0);
            const Vec3 origin = room_point(&room, &random);
            rays[count].origin[0] = (float)origin.x;
            rays[count].origin[1] = (float)origin.y;
            rays[count].origin[2] = (float)origin.z;
            count += largest_component(rays[count].direction) >= SHORTEST_DIRECTION;
        }
    trial_open(&trial, "T-21", *state, &stage);
    misses = trial_misses(&trial, "shape=cube", rays, count);
    trial_close(&trial);
    free(rays);
    stage_free(&stage);
    scene_free(&scene);
    assert_int_equal(misses, 0);
}

#define FEATURE_CASES 500000

// A box between multiples of 2^-10, every fourth side of it of length 0.
static Box random_box(Random *random)
{
    Box box;
    for (int axis = 0; axis < 3; axis++) {
        const int low = (int)random_below(random, 2048) - 1024;
        const int side = random_below(random, 4) == 0 ? 0 : (int)random_below(random, 1024);
        box.low[axis] = (float)low * 0x1p-10f;
        box.high[axis] = (float)(low + side) * 0x1p-10f;
    }
    return box;
}

// A corner of the box, or the middle of an edge, a face or all of it.
static void random_feature(const Box *box, Random *random, float point[3])
{
    for (int axis = 0; axis < 3; axis++) {
        const float places[3] = {box->low[axis], box->high[axis],
                                 0.5f * (box->low[axis] + box->high[axis])};
        point[axis] = places[random_below(random, 3)];
    }
}

// Components are multiples of 2^-8, every third zero; the first is not where all others are.
static void random_direction(Random *random, float direction[3])
{
    for (int axis = 0; axis < 3; axis++) {
        const int steps = (int)random_below(random, 513) - 256;
        direction[axis] = random_below(random, 3) == 0 ? 0 : (float)steps * 0x1p-8f;
    }
    if (largest_component(direction) == 0)
        direction[0] = 1;
}

// A ray that reaches a feature of the first box at t without any rounding, and so meets it.
static BoxCase feature_case(float t, Random *random)
{
    float feature[3];
    BoxCase made = {.boxes = {random_box(random), random_box(random)}};
    random_feature(&made.boxes[0], random, feature);
    random_direction(random, made.ray.direction);
    for (int axis = 0; axis < 3; axis++)
        made.ray.origin[axis] = feature[axis] - t * made.ray.direction[axis];
    assert_true(box_case_is_met(&made.ray, &made.boxes[0]));
    return made;
}

static void rays_that_start_on_or_graze_a_box_never_miss_it_t22(void **state)
{
    static const float starts[] = {0, 0.5f, 1, 16, 1024};
    Error error = {0};
    Random random = {22};
    size_t misses = 0;
    BoxCase *cases = memory_raw(FEATURE_CASES, sizeof *cases, &error);
    require(cases != NULL, &error);
    for (size_t i = 0; i < COUNT(starts); i++) {
        char details[64];
        size_t met = 0;
        for (int place = 0; place < FEATURE_CASES; place++)
            cases[place] = feature_case(starts[i], &random);
        const size_t missed = box_case_count_misses(*state, cases, FEATURE_CASES, &met);
        snprintf(details, sizeof details, "t=%g met=%zu", (double)starts[i], met);
        misses += report_case("T-22", details, 2 * (size_t)FEATURE_CASES, missed);
    }
    free(cases);
    assert_int_equal(misses, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_of_special_values_miss_no_box_they_meet_t21),
        cmocka_unit_test(directions_of_special_values_leave_no_closed_shape_t21),
        cmocka_unit_test(rays_that_start_on_or_graze_a_box_never_miss_it_t22),
    };
    return cmocka_run_group_tests(tests, ray_batch_setup, ray_batch_teardown);
}
