// SPDX-License-Identifier: MIT
// The boxes of the device's nodes hold all that lies below them, with the room to spare that
// culling needs.
#include "support/box_around.h"
#include "support/check.h"
#include "support/report.h"
#include "support/shapes.h"
#include "support/stage.h"
#include "support/tree_scenes.h"

#include "device/kernel_choice.h"

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

// planes leads to those of one child; the next plane is as many floats on as there are children.
static bool planes_hold(const float *planes, size_t children, const Box *box)
{
    const double growth = NEEDED_GROWTH * largest_coordinate(box);
    for (size_t axis = 0; axis < 3; axis++)
        if (!((double)planes[2 * axis * children] <= (double)box->low[axis] - growth) ||
            !((double)planes[(2 * axis + 1) * children] >= (double)box->high[axis] + growth))
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
        walk->violations += !planes_hold(&node->planes[0][0][child], 2, &box);
        box_include(&all, &box);
    }
    return all;
}

static Box block_box(Walk *walk, uint32_t number)
{
    Box box = box_empty();
    const TriangleBlock *block = &walk->flat->blocks[number];
    for (int place = 0; place < WIDE; place++) {
        for (int corner = 0; corner < 3 && block->id[place] != NOTHING; corner++) {
            const float point[3] = {block->corners[corner][0][place],
                                    block->corners[corner][1][place],
                                    block->corners[corner][2][place]};
            box_include_point(&box, point);
        }
        walk->triangles += block->id[place] != NOTHING;
    }
    return box;
}

// The same as check_node.
static Box check_wide(Walk *walk, uint32_t number)
{
    Box all = box_empty();
    const BvhWide *node = &walk->flat->wides[number];
    for (uint32_t place = 0; place < node->child_count; place++) {
        const uint32_t child = node->child[place];
        const Box box =
            child & WIDE_LEAF ? block_box(walk, child & ~WIDE_LEAF) : check_wide(walk, child);
        walk->boxes++;
        walk->violations += !planes_hold(&node->planes[0][0][place], WIDE, &box);
        box_include(&all, &box);
    }
    return all;
}

static size_t check_tree(const char *name, const Scene *scene, TreeKind tree, NodeLayout layout)
{
    Stage stage;
    char details[80];
    stage_make_as(&stage, scene, tree, layout);
    Walk walk = {.flat = &stage.flat};
    if (layout == NODES_WIDE)
        check_wide(&walk, 0);
    else
        check_node(&walk, 0);
    assert_int_equal(walk.triangles, stage.flat.triangle_count);
    snprintf(details, sizeof details, "scene=%s tree=%s nodes=%s", name, tree_names[tree],
             kernel_nodes_name(layout));
    stage_free(&stage);
    return report_case("T-27", details, walk.boxes, walk.violations);
}

static size_t check_trees(const char *name, const Scene *scene)
{
    size_t violations = 0;
    for (TreeKind tree = TREE_SAH; tree < TREE_NONE; tree++) {
        violations += check_tree(name, scene, tree, NODES_PAIR);
        violations += check_tree(name, scene, tree, NODES_WIDE);
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
