// SPDX-License-Identifier: MIT
// A mesh would stand on a table if the points that touch the table lie on all four sides of the
// mesh's center.
#include "scene/mesh_load.h"

// Fractions of the bounding box's longest side.
#define TOUCH  0.01 // points touch the table up to this height
#define MARGIN 0.03 // least distance of the outermost points from the center

typedef struct {
    double low[3], high[3];
} Box;

static void extend(Box *box, const double *point)
{
    for (int axis = 0; axis < 3; axis++) {
        if (point[axis] < box->low[axis])
            box->low[axis] = point[axis];
        if (point[axis] > box->high[axis])
            box->high[axis] = point[axis];
    }
}

// Returns the bounding box of the corners whose coordinate on the axis is at most `most`. Ignores
// triangles with fewer than `least` such corners.
static Box box_below(const Scene *scene, int axis, double most, int least)
{
    Box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < scene->objects.count; i++) {
        const Mesh *mesh = &scene->objects.data[i].mesh;
        for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
            const uint32_t *corners = mesh->triangles[triangle];
            int below = 0;
            for (int corner = 0; corner < 3; corner++)
                below += mesh->positions[corners[corner]][axis] <= most;
            for (int corner = 0; below >= least && corner < 3; corner++)
                if (mesh->positions[corners[corner]][axis] <= most)
                    extend(&box, mesh->positions[corners[corner]]);
        }
    }
    return box;
}

static bool stands(const Scene *scene, const Box *body, int up, int least)
{
    double extent = 0;
    for (int axis = 0; axis < 3; axis++)
        extent = fmax(extent, body->high[axis] - body->low[axis]);
    const Box base = box_below(scene, up, body->low[up] + TOUCH * extent, least);
    for (int axis = 0; axis < 3; axis++) {
        const double center = (body->low[axis] + body->high[axis]) / 2;
        if (axis != up && fmin(center - base.low[axis], base.high[axis] - center) < MARGIN * extent)
            return false;
    }
    return true;
}

// With a wrong axis up, most meshes fall over. For y instead of z, the base must also be flat,
// because meshes with z up may touch a table with y up by chance.
UpAxis up_axis_of_shape(const Scene *scene, UpAxis usual)
{
    const Box body = box_below(scene, 0, INFINITY, 0);
    const bool stands_on_y = stands(scene, &body, 1, usual == UP_Y ? 1 : 3);
    const bool stands_on_z = stands(scene, &body, 2, 1);
    if (usual == UP_Y)
        return stands_on_z && !stands_on_y ? UP_Z : UP_Y;
    return stands_on_y && !stands_on_z ? UP_Y : UP_Z;
}
