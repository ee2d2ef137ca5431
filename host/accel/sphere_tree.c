// SPDX-License-Identifier: MIT
// The tree for NODES_PAIR is an array in depth-first order. The entry of a bounding sphere names
// the entry after the spheres in it, so rays walk the array without a stack. The other entries are
// copies of the spheres with their ids. A median split halves the spheres along the axis on which
// their centers extend farthest. Separate links for each octant of directions would visit near
// nodes first, but they gained nothing.
//
// Invariant: a bounding sphere contains the spheres below it, as stored. Skipping a bounding sphere
// that a ray does not meet therefore changes no hit (B21 in docs/numerics.md).
#include "accel/sphere_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A group of more than GROUP_MOST spheres is split in halves, so each group has at least two
// spheres.
#define GROUP_MOST 4

typedef struct {
    double place; // of the center, along the axis of the split
    uint32_t sphere;
} SplitItem;

// The spheres below one bounding sphere.
typedef struct {
    const SphereData *spheres; // all spheres
    SplitItem *items;
    uint32_t count;
} SphereGroup;

static double stored(const SphereData *sphere, int axis)
{
    return (double)sphere->center[axis] + (double)sphere->center_low[axis];
}

static double stored_radius(const SphereData *sphere)
{
    return (double)sphere->radius + (double)sphere->radius_low;
}

static const SphereData *sphere_of(const SphereGroup *group, uint32_t item)
{
    return &group->spheres[group->items[item].sphere];
}

static int compare(const void *left, const void *right)
{
    const SplitItem *a = left, *b = right;
    if (a->place != b->place)
        return a->place < b->place ? -1 : 1;
    return a->sphere < b->sphere ? -1 : 1;
}

// Stores the least and the largest coordinate of the group along an axis. `radii` is 1 for whole
// spheres, and 0 for their centers.
static void range_along(const SphereGroup *group, int axis, double radii, double range[2])
{
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (uint32_t i = 0; i < group->count; i++) {
        const SphereData *sphere = sphere_of(group, i);
        const double center = stored(sphere, axis), radius = radii * stored_radius(sphere);
        range[0] = fmin(range[0], center - radius);
        range[1] = fmax(range[1], center + radius);
    }
}

static void sort_along_longest(const SphereGroup *group)
{
    int longest = 0;
    double extent = -1;
    for (int axis = 0; axis < 3; axis++) {
        double range[2];
        range_along(group, axis, 0, range);
        longest = range[1] - range[0] > extent ? axis : longest;
        extent = fmax(extent, range[1] - range[0]);
    }
    for (uint32_t i = 0; i < group->count; i++)
        group->items[i].place = stored(sphere_of(group, i), longest);
    qsort(group->items, group->count, sizeof *group->items, compare);
}

// Returns a sphere around the group. The low parts of its center and radius are zero.
static SphereData bounding_sphere(const SphereGroup *group)
{
    SphereData bound = {.id = NOTHING};
    double reach = 0;
    for (int axis = 0; axis < 3; axis++) {
        double range[2];
        range_along(group, axis, 1, range);
        bound.center[axis] = (float)(0.5 * (range[0] + range[1]));
    }
    for (uint32_t i = 0; i < group->count; i++) {
        const SphereData *sphere = sphere_of(group, i);
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

// Writes the group's entries from index `number` on. Returns the index after them.
static uint32_t write_group(SphereData *entries, uint32_t number, const SphereGroup *group)
{
    uint32_t next = number + 1;
    entries[number] = bounding_sphere(group);
    if (group->count <= GROUP_MOST) {
        for (uint32_t i = 0; i < group->count; i++) {
            entries[next] = *sphere_of(group, i);
            entries[next++].id = group->items[i].sphere;
        }
    } else {
        const uint32_t half = group->count / 2;
        sort_along_longest(group);
        next = write_group(entries, next, &(SphereGroup){group->spheres, group->items, half});
        next =
            write_group(entries, next,
                        &(SphereGroup){group->spheres, group->items + half, group->count - half});
    }
    entries[number].next = next;
    return next;
}

bool sphere_tree_make(FlatScene *flat, Error *error)
{
    const uint32_t count = flat->sphere_count;
    // The spheres, their copies, and fewer than `count` bounding spheres.
    SphereData *entries = memory_zeroed(3 * (size_t)count, sizeof *entries, error);
    SplitItem *items = memory_raw(count, sizeof *items, error);
    const bool ok = entries != NULL && items != NULL;
    if (ok) {
        memcpy(entries, flat->spheres, count * sizeof *entries);
        for (uint32_t i = 0; i < count; i++)
            items[i].sphere = i;
        flat->sphere_entries =
            write_group(entries, count, &(SphereGroup){flat->spheres, items, count});
        free(flat->spheres);
        flat->spheres = entries;
    } else {
        free(entries);
    }
    free(items);
    return ok;
}
