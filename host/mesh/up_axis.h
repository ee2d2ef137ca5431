// SPDX-License-Identifier: MIT
// Turns meshes whose up axis is not z, which is up for clrt's cameras.
#pragma once

#include "mesh/mesh.h"

// The axis of a file's coordinates that points up.
typedef enum {
    UP_AUTO, // not known
    UP_X,
    UP_Y,
    UP_Z,
    UP_MINUS_X,
    UP_MINUS_Y,
    UP_MINUS_Z,
    UP_AXES
} UpAxis;

// The axes as users write them: "auto", "x" to "-z".
extern const char *const up_axis_names[UP_AXES];

// Rotates positions and normals so that the axis `up` becomes z. The rotation only exchanges
// coordinates and changes signs, so it rounds nothing. UP_AUTO and UP_Z keep the mesh.
void mesh_turn_up(Mesh *mesh, UpAxis up);

// Returns the axis for which mesh_turn_up undoes a turn from `up`.
UpAxis up_axis_inverse(UpAxis up);
