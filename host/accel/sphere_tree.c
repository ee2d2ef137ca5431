// SPDX-License-Identifier: MIT
// The tree is an array in depth-first order, which rays walk without a stack: the entry of a
// bounding sphere names the entry after the spheres in it. The other entries are copies of the
// spheres with their ids. A median split gives equal halves along the axis on which the centers
// extend farthest. Links for walking near nodes first (by octant of the direction) gained nothing.
//
// Invariant: a bounding sphere contains the spheres below it, as stored. docs/numerics.md (B21)
// proves that skipping it changes no hit.
#include "accel/sphere_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A group of more spheres is split in halves, so each group has at least two spheres.
#define GROUP_MOST 4

typedef struct {
    double place; // of the center, along the axis of the split
    uint32_t sphere;
} SplitItem;

typedef struct {
    SphereData *entries; // of the whole array; spheres come first
    uint32_t count;
} TreeWriter;

static double stored(const SphereData *sphere, int axis)
{
    return (double)sphere->center[axis] + (double)sphere->center_low[axis];
}

static double stored_radius(const SphereData *sphere)
{
    return (double)sphere->radius + (double)sphere->radius_low;
}

static int compare(const void *left, const void *right)
{
    const SplitItem *a = left, *b = right;
    if (a->place != b->place)
        return a->place < b->place ? -1 : 1;
    return a->sphere < b->sphere ? -1 : 1;
}

// Stores the least and the largest coordinate of the spheres, with radii multiplied by `radii`.
static void range_along(const TreeWriter *tree, const SplitItem *items, uint32_t count, int axis,
                        double radii, double range[2])
{
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        const SphereData *sphere = &tree->entries[items[i].sphere];
        const double center = stored(sphere, axis), radius = radii * stored_radius(sphere);
        range[0] = fmin(range[0], center - radius);
        range[1] = fmax(range[1], center + radius);
    }
}

static void sort_along_longest(const TreeWriter *tree, SplitItem *items, uint32_t count)
{
    int longest = 0;
    double extent = -1;
    for (int axis = 0; axis < 3; axis++) {
        double range[2];
        range_along(tree, items, count, axis, 0, range);
        longest = range[1] - range[0] > extent ? axis : longest;
        extent = fmax(extent, range[1] - range[0]);
    }
    for (uint32_t i = 0; i < count; i++)
        items[i].place = stored(&tree->entries[items[i].sphere], longest);
    qsort(items, count, sizeof *items, compare);
}

// Returns a sphere around the spheres. Its center and its radius are floats.
static SphereData bounding_sphere(const TreeWriter *tree, const SplitItem *items, uint32_t count)
{
    SphereData bound = {.id = NOTHING};
    double reach = 0;
    for (int axis = 0; axis < 3; axis++) {
        double range[2];
        range_along(tree, items, count, axis, 1, range);
        bound.center[axis] = (float)(0.5 * (range[0] + range[1]));
    }
    for (uint32_t i = 0; i < count; i++) {
        const SphereData *sphere = &tree->entries[items[i].sphere];
        double squares = 0;
        for (int axis = 0; axis < 3; axis++) {
            const double apart = stored(sphere, axis) - (double)bound.center[axis];
            squares += apart * apart;
        }
        reach = fmax(reach, sqrt(squares) + stored_radius(sphere));
    }
    bound.radius = (float)(reach * (1 + 0x1p-22)); // rounded up
    return bound;
}

static void write_group(TreeWriter *tree, SplitItem *items, uint32_t count)
{
    const uint32_t number = tree->count++;
    tree->entries[number] = bounding_sphere(tree, items, count);
    for (uint32_t i = 0; count <= GROUP_MOST && i < count; i++) {
        SphereData *copy = &tree->entries[tree->count++];
        *copy = tree->entries[items[i].sphere];
        copy->id = items[i].sphere;
    }
    if (count > GROUP_MOST) {
        sort_along_longest(tree, items, count);
        write_group(tree, items, count / 2);
        write_group(tree, items + count / 2, count - count / 2);
    }
    tree->entries[number].next = tree->count;
}

bool sphere_tree_make(FlatScene *flat, Error *error)
{
    const uint32_t count = flat->sphere_count;
    // The spheres, their copies, and fewer than `count` bounding spheres.
    SphereData *entries = memory_zeroed(3 * (size_t)count, sizeof *entries, error);
    SplitItem *items = memory_raw(count, sizeof *items, error);
    const bool ok = entries != NULL && items != NULL;
    if (ok) {
        TreeWriter tree = {entries, count};
        memcpy(entries, flat->spheres, count * sizeof *entries);
        for (uint32_t i = 0; i < count; i++)
            items[i].sphere = i;
        write_group(&tree, items, count);
        free(flat->spheres);
        flat->spheres = entries;
        flat->sphere_entries = tree.count;
    } else {
        free(entries);
    }
    free(items);
    return ok;
}
