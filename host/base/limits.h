// SPDX-License-Identifier: MIT
// The ranges of a scene's numbers, in scene files and in calls of the library.
#pragma once

#include <stdint.h>

#define COORDINATE_MOST 1e30 // products of several coordinates stay finite in fp64
#define RADIUS_LEAST    1e-30
#define RADIUS_MOST     1e30
#define INTENSITY_MOST  1e30
#define AREA_CELLS_MOST 16
#define FOV_LEAST       1e-6 // degrees
#define FOV_MOST        179.9999
#define HEIGHT_LEAST    1e-30 // of an orthographic picture
#define HEIGHT_MOST     1e30
#define FACTOR_MOST     1000 // kd and ks
#define SHININESS_MOST  1e9
#define IOR_LEAST       0.1 // of glass, inside over outside
#define IOR_MOST        10
#define CREASE_MOST     180 // degrees

#define MESH_COUNT_MOST INT64_C(2147483647) // vertices or triangles in one mesh
