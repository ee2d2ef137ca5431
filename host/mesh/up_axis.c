// SPDX-License-Identifier: MIT
// A rotation by multiples of 90 degrees is three source coordinates with signs. Turns from y and -y
// keep x, and the others keep y, so that a front toward -y stays there.
#include "mesh/up_axis.h"

#include <stdlib.h>

const char *const up_axis_names[UP_AXES] = {"auto", "x", "y", "z", "-x", "-y", "-z"};

// For each axis of the turned mesh, the number of its source axis from 1, negative if the sign
// changes.
static const int sources[UP_AXES][3] = {
    [UP_X] = {-3, 2, 1},       [UP_Y] = {1, -3, 2},       [UP_Z] = {1, 2, 3},
    [UP_MINUS_X] = {3, 2, -1}, [UP_MINUS_Y] = {1, 3, -2}, [UP_MINUS_Z] = {-1, 2, -3}};

static Vec3 turned(Vec3 v, const int source[3])
{
    const double given[3] = {v.x, v.y, v.z};
    double result[3];
    for (int axis = 0; axis < 3; axis++) {
        const double value = given[abs(source[axis]) - 1];
        result[axis] = source[axis] < 0 ? -value : value;
    }
    return vec3(result[0], result[1], result[2]);
}

void mesh_turn_up(Mesh *mesh, UpAxis up)
{
    if (up == UP_AUTO || up == UP_Z)
        return;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        double *p = mesh->positions[i];
        const Vec3 position = turned(vec3(p[0], p[1], p[2]), sources[up]);
        p[0] = position.x, p[1] = position.y, p[2] = position.z;
    }
    for (size_t i = 0; mesh->normals != NULL && i < mesh->vertex_count; i++) {
        float *n = mesh->normals[i];
        const Vec3 normal = turned(vec3((double)n[0], (double)n[1], (double)n[2]), sources[up]);
        n[0] = (float)normal.x, n[1] = (float)normal.y, n[2] = (float)normal.z;
    }
}

UpAxis up_axis_inverse(UpAxis up)
{
    static const UpAxis inverses[UP_AXES] = {
        [UP_X] = UP_MINUS_X, [UP_Y] = UP_MINUS_Y, [UP_Z] = UP_Z,
        [UP_MINUS_X] = UP_X, [UP_MINUS_Y] = UP_Y, [UP_MINUS_Z] = UP_MINUS_Z};
    return inverses[up];
}
