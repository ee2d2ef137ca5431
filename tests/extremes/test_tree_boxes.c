// SPDX-License-Identifier: MIT
// The boxes of the device's nodes hold all that lies below them, with the room to spare that
// culling needs.
#include "support/check.h"
#include "support/shapes.h"
#include "support/stage.h"
#include "support/tree_scenes.h"

#include "accel/box.h"

// The triangle test accepts a triangle up to 34 units of rounding beside the ray where division is
// good to 2.5 ulp, and the slabs add up to 8: a box must be larger by as many units of its largest
// coordinate than what it holds.
#define NEEDED_GROWTH (42 * 0x1p-24)

typedef struct {
    const FlatScene *flat;
    size_t triangles, boxes, violations; // seen so far
} Walk;

static double largest_coordinate(const Box *box)
{
    double largest = 0;
    for (int axis = 0; axis < 3; axis++)
        largest = fmax(largest, fmax(fabs((double)box->low[axis]), fabs((double)box->high[axis])));
    return largest;
}

static bool planes_hold(const BvhPair *node, int child, const Box *box)
{
    const double growth = NEEDED_GROWTH * largest_coordinate(box);
    for (int axis = 0; axis < 3; axis++)
        if (!((double)node->planes[axis][0][child] <= (double)box->low[axis] - growth) ||
            !((double)node->planes[axis][1][child] >= (double)box->high[axis] + growth))
            return false;
    return true;
}

static Box leaf_box(Walk *walk, uint32_t first, uint32_t count)
{
    Box box = box_empty();
    for (uint32_t place = first; place < first + count; place++) {
        box_include_point(&box, walk->flat->triangles[place].a);
        box_include_point(&box, walk->flat->triangles[place].b);
        box_include_point(&box, walk->flat->triangles[place].c);
    }
    walk->triangles += count;
    return box;
}

static bool child_is_missing(const BvhPair *node, int child)
{
    return node->planes[0][0][child] > node->planes[0][1][child];
}

// Checks both children of a node and all below them; the exact box of these.
static Box check_node(Walk *walk, uint32_t number)
{
    Box all = box_empty();
    const BvhPair *node = &walk->flat->pairs[number];
    for (int child = 0; child < 2; child++) {
        if (child_is_missing(node, child))
            continue;
        const uint32_t first = node->first[child], count = node->count[child];
        const Box box = count > 0 ? leaf_box(walk, first, count) : check_node(walk, first);
        walk->boxes++;
        walk->violations += !planes_hold(node, child, &box);
        box_include(&all, &box);
    }
    return all;
}

static size_t check_trees(const char *name, const Scene *scene)
{
    size_t violations = 0;
    for (TreeKind tree = TREE_SAH; tree < TREE_NONE; tree++) {
        Stage stage;
        char details[64];
        stage_make(&stage, scene, tree);
        Walk walk = {.flat = &stage.flat};
        check_node(&walk, 0);
        assert_int_equal(walk.triangles, stage.flat.triangle_count);
        snprintf(details, sizeof details, "scene=%s tree=%s", name, tree_names[tree]);
        violations += report_case("T-27", details, walk.boxes, walk.violations);
        stage_free(&stage);
    }
    return violations;
}

static void every_box_of_a_tree_holds_all_vertices_below_it_t27(void **state)
{
    (void)state;
    size_t violations = 0;
    for (size_t number = 0; number < TREE_SCENES; number++) {
        Scene scene = tree_scene_make(number);
        violations += check_trees(tree_scenes[number].name, &scene);
        scene_free(&scene);
    }
    for (int exponent = 0; exponent <= 20; exponent += 10) {
        char name[32];
        Scene scene = shape_scene(shape_sphere(100, shape_center(exponent)));
        snprintf(name, sizeof name, "sphere_k%d", exponent);
        violations += check_trees(name, &scene);
        scene_free(&scene);
    }
    assert_int_equal(violations, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_box_of_a_tree_holds_all_vertices_below_it_t27),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
