// SPDX-License-Identifier: MIT
// Tests that the boxes of the device's nodes contain all triangles below them, with a margin for
// culling.
#include "support/outcome.h"
#include "support/shapes.h"
#include "support/stage.h"
#include "support/tree_scenes.h"

#include "device/kernel_choice.h"

// The margin that culling needs, relative to the box's largest coordinate (docs/numerics.md, B9).
#define NEEDED_MARGIN (224 * 0x1p-24)

typedef struct {
    const FlatScene *flat;
    size_t triangles, boxes, violations; // so far
} Walk;

// `box` contains the triangles below a child. Checks the child's planes against `box`, and extends
// `all` by `box`. Successive planes are `children` floats apart, one for each possible child.
static void check_child(Walk *walk, const float *planes, size_t children, const Box *box, Box *all)
{
    double largest = 0;
    bool holds = true;
    for (int axis = 0; axis < 3; axis++)
        largest = fmax(largest, fmax(fabs((double)box->low[axis]), fabs((double)box->high[axis])));
    const double margin = NEEDED_MARGIN * largest;
    for (size_t axis = 0; axis < 3; axis++)
        holds = holds && (double)planes[2 * axis * children] <= (double)box->low[axis] - margin &&
                (double)planes[(2 * axis + 1) * children] >= (double)box->high[axis] + margin;
    walk->boxes++;
    walk->violations += !holds;
    box_include(all, box->low, box->high);
}

static Box leaf_box(Walk *walk, uint32_t first, uint32_t count)
{
    Box box = box_empty();
    for (uint32_t place = first; place < first + count; place++) {
        const TriangleData *triangle = &walk->flat->triangles[place];
        box_include(&box, triangle->a, triangle->a);
        box_include(&box, triangle->b, triangle->b);
        box_include(&box, triangle->c, triangle->c);
    }
    walk->triangles += count;
    return box;
}

// Checks the subtree of a pair. Returns the box of its triangles.
static Box check_pair(Walk *walk, uint32_t number)
{
    Box all = box_empty();
    const BvhPair *node = &walk->flat->pairs[number];
    for (int child = 0; child < 2; child++) {
        const bool is_missing = node->planes[0][0][child] > node->planes[0][1][child];
        const uint32_t first = node->first[child], count = node->count[child];
        if (is_missing)
            continue;
        const Box box = count > 0 ? leaf_box(walk, first, count) : check_pair(walk, first);
        check_child(walk, &node->planes[0][0][child], 2, &box, &all);
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
            box_include(&box, point, point);
        }
        walk->triangles += block->id[place] != NOTHING;
    }
    return box;
}

// Checks the subtree of a wide node. Returns the box of its triangles.
static Box check_wide(Walk *walk, uint32_t number)
{
    Box all = box_empty();
    const BvhWide *node = &walk->flat->wides[number];
    for (uint32_t place = 0; place < node->child_count; place++) {
        const uint32_t child = node->child[place];
        const Box box =
            child & WIDE_LEAF ? block_box(walk, child & ~WIDE_LEAF) : check_wide(walk, child);
        check_child(walk, &node->planes[0][0][place], WIDE, &box, &all);
    }
    return all;
}

static void check_tree(const char *name, const Scene *scene, TreeKind tree, NodeLayout layout)
{
    Stage stage;
    stage_make_as(&stage, scene, tree, layout);
    Walk walk = {.flat = &stage.flat};
    if (layout == NODES_WIDE)
        check_wide(&walk, 0);
    else
        check_pair(&walk, 0);
    assert_int_equal(walk.triangles, stage.flat.triangle_count);
    outcome_report(outcome_of("T-27", walk.boxes, walk.violations), "scene=%s tree=%s nodes=%s",
                   name, tree_names[tree], kernel_nodes_name(layout));
    stage_free(&stage);
}

// Frees the scene.
static void check_trees(const char *name, Scene scene)
{
    for (TreeKind tree = TREE_SAH; tree < TREE_NONE; tree++) {
        check_tree(name, &scene, tree, NODES_PAIR);
        check_tree(name, &scene, tree, NODES_WIDE);
    }
    scene_free(&scene);
}

EXTREME(every_box_of_a_tree_holds_all_vertices_below_it_t27)
{
    for (size_t number = 0; number < TREE_SCENES; number++)
        check_trees(tree_scene_names[number], tree_scene_make(number));
    check_trees("sphere_k0", shape_scene(shape_sphere(100, shape_center(0))));
    check_trees("sphere_k10", shape_scene(shape_sphere(100, shape_center(10))));
    check_trees("sphere_k20", shape_scene(shape_sphere(100, shape_center(20))));
}
