// SPDX-License-Identifier: MIT
// The box test with special values. It may visit a box that the ray misses, but must visit every
// box that the ray meets in exact arithmetic.
#include "support/rig.h"
#include "support/shapes.h"

#include "accel/flat_parts.h"

// A ray and the boxes of a node's two children.
typedef struct {
    TestRay ray;
    Box boxes[2];
} BoxCase;

// The fraction above / below. below is at least 0, and 0 means infinity.
typedef struct {
    long double above, below;
} Fraction;

static bool is_less(Fraction a, Fraction b)
{
    return a.above * b.below < b.above * a.below;
}

// Returns whether the ray meets the box at t >= 0. Compares fractions by cross-multiplication. It
// is exact if differences of coordinates, times the direction's components, fit 64 bits.
static bool meets(const TestRay *ray, const Box *box)
{
    Fraction enter = {0, 1}, leave = {1, 0};
    for (int axis = 0; axis < 3; axis++) {
        const long double origin = ray->origin[axis], direction = ray->direction[axis];
        const long double low = (long double)box->low[axis] - origin;
        const long double high = (long double)box->high[axis] - origin;
        if (direction == 0) {
            if (low > 0 || high < 0)
                return false;
            continue;
        }
        const Fraction first = {direction > 0 ? low : -high, fabsl(direction)};
        const Fraction last = {direction > 0 ? high : -low, fabsl(direction)};
        enter = is_less(enter, first) ? first : enter;
        leave = is_less(last, leave) ? last : leave;
    }
    return !is_less(leave, enter);
}

// Returns a root whose leaves have these boxes, enlarged as in any tree.
static BvhPair pair_of(const Box boxes[2])
{
    BvhPair pair = {0};
    BvhNode nodes[3] = {{.first = 1},
                        {.box = boxes[0], .first = 0, .count = 1},
                        {.box = boxes[1], .first = 1, .count = 1}};
    const Bvh bvh = {.nodes = nodes, .node_count = 3, .leaf_count = 2};
    assert_int_equal(flat_pair_count(&bvh), 1);
    flat_pair_write(&pair, &bvh);
    return pair;
}

// Returns how many boxes the device misses although the ray meets them. Adds the number of boxes
// that rays meet to *met.
static size_t count_misses(RayBatch *batch, const BoxCase *cases, size_t count, size_t *met)
{
    size_t misses = 0;
    const Rays rays = rays_make(count);
    BvhPair *nodes = require_memory(count, sizeof *nodes);
    for (size_t i = 0; i < count; i++) {
        rays.data[i] = cases[i].ray;
        nodes[i] = pair_of(cases[i].boxes);
    }
    TestHit *hits = ray_batch_boxes(batch, rays, nodes);
    for (size_t i = 0; i < 2 * count; i++) {
        if (!meets(&cases[i / 2].ray, &cases[i / 2].boxes[i % 2]))
            continue;
        (*met)++;
        misses += (hits[i / 2].id >> i % 2 & 1) == 0;
    }
    free(rays.data);
    free(nodes);
    free(hits);
    return misses;
}

// Components of directions: zeros, denormals, the smallest normal numbers and small ones.
static const float components[] = {0.0f,   -0.0f,   1e-45f, -1e-45f, 1e-38f, -1e-38f,
                                   1e-20f, -1e-20f, 0.25f,  -0.25f,  1.0f,   -1.0f};
static const float origins[] = {-2.0f, -0.5f, 0.0f, 0.25f, 0.5f, 0x1p38f};
static const float intervals[][2] = {{-0.5f, 0.5f}, {0.5f, 0.5f}, {0.0f, 0.25f}, {0.0f, 0.0f}};

#define CUBED(count) ((count) * (count) * (count))
#define DIRECTIONS   CUBED(COUNT(components))
#define ORIGINS      CUBED(COUNT(origins))
#define BOXES        CUBED(COUNT(intervals))

// The digits of the two numbers choose the components.
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

// Returns whether a ray can have this direction. A camera's or reflection's is about as long as 1,
// and a shadow ray is at least as long as its origin's distance from the surface. Reciprocals of
// shorter directions overflow.
static bool is_possible(const float direction[3])
{
    return vec3_extent(vec3_of(direction)) >= (double)1e-20f;
}

static void rays_of_special_values_miss_no_box_they_meet_t21(void **state)
{
    size_t misses = 0, met = 0, tested = 0;
    BoxCase *cases = require_memory(ORIGINS * BOXES / 2, sizeof *cases);
    for (size_t direction = 0; direction < DIRECTIONS; direction++) {
        size_t count = 0;
        if (!is_possible(special_ray(direction, 0).direction))
            continue;
        for (size_t origin = 0; origin < ORIGINS; origin++)
            for (size_t box = 0; box < BOXES; box += 2)
                cases[count++] = (BoxCase){special_ray(direction, origin),
                                           {special_box(box), special_box(box + 1)}};
        misses += count_misses(*state, cases, count, &met);
        tested += 2 * count;
    }
    free(cases);
    outcome_report(outcome_of("T-21", tested, misses), "boxes=special met=%zu", met);
    assert_true(met > tested / 100);
}

#define INNER_RAYS 100 // per direction

// Every direction leads from inside a closed shape to the shape.
static void directions_of_special_values_leave_no_closed_shape_t21(void **state)
{
    Random random = {21};
    Rays rays = rays_make(DIRECTIONS * INNER_RAYS);
    Rig rig = rig_open("T-21", *state, shape_scene(shape_cube(1, 5)));
    const Room room = room_inside(&rig.stage, vec3(0, 0, 0), 1);
    rays.count = 0;
    for (size_t i = 0; i < DIRECTIONS * INNER_RAYS; i++) {
        TestRay ray = special_ray(i / INNER_RAYS, 0);
        shape_store(ray.origin, room_point(&room, &random));
        if (is_possible(ray.direction))
            rays.data[rays.count++] = ray;
    }
    outcome_report(rig_judge(&rig, rays, judge_misses, NULL), "shape=cube");
    rig_close(&rig);
    free(rays.data);
}

#define FEATURE_CASES 500000

// Returns a box between multiples of 2^-10. Every fourth side has length 0.
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

// Returns a ray whose point at t is exactly a feature of the first box: a corner, or the middle of
// an edge, a face or the box. Directions are multiples of 2^-8 with every third component zero.
static BoxCase feature_case(float t, Random *random)
{
    BoxCase made = {.boxes = {random_box(random), random_box(random)}};
    const Box *box = &made.boxes[0];
    TestRay *ray = &made.ray;
    for (int axis = 0; axis < 3; axis++) {
        const float places[3] = {box->low[axis], box->high[axis],
                                 0.5f * (box->low[axis] + box->high[axis])};
        const int steps = (int)random_below(random, 513) - 256;
        ray->origin[axis] = places[random_below(random, 3)];
        ray->direction[axis] = random_below(random, 3) == 0 ? 0 : (float)steps * 0x1p-8f;
    }
    if (vec3_extent(vec3_of(ray->direction)) == 0)
        ray->direction[0] = 1;
    for (int axis = 0; axis < 3; axis++)
        ray->origin[axis] -= t * ray->direction[axis];
    assert_true(meets(ray, box));
    return made;
}

static void rays_that_start_on_or_graze_a_box_never_miss_it_t22(void **state)
{
    static const float starts[] = {0, 0.5f, 1, 16, 1024};
    Random random = {22};
    BoxCase *cases = require_memory(FEATURE_CASES, sizeof *cases);
    for (size_t i = 0; i < COUNT(starts); i++) {
        size_t met = 0;
        for (int place = 0; place < FEATURE_CASES; place++)
            cases[place] = feature_case(starts[i], &random);
        const size_t misses = count_misses(*state, cases, FEATURE_CASES, &met);
        outcome_report(outcome_of("T-22", 2 * (size_t)FEATURE_CASES, misses), "t=%g met=%zu",
                       (double)starts[i], met);
    }
    free(cases);
}

RUN_TESTS(ray_batch_setup, ray_batch_teardown,
          EXTREME(rays_of_special_values_miss_no_box_they_meet_t21),
          EXTREME(directions_of_special_values_leave_no_closed_shape_t21),
          EXTREME(rays_that_start_on_or_graze_a_box_never_miss_it_t22))
