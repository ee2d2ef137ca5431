// SPDX-License-Identifier: MIT
// Compiles the exact arithmetic for the tracer's Real, and for eight triangles of a block against
// one ray. All types compile the same vector.cl and triangle.cl, so their results are equal.
#ifndef CLRT_TYPES_CL
#define CLRT_TYPES_CL
#include "lanes.cl"

#include "triangle.cl"

// Wide: a Real for each of the WIDE triangles of a block, or for each child of a wide node.
#if CLRT_WIDE_NODES && CLRT_LANES == WIDE
typedef Real3 Wide3;
typedef Shear WideShear;
typedef Corners WideCorners;
typedef Edges WideEdges;
typedef SurfaceRay WideSurfaceRay;
typedef Sides WideSides;
#elif CLRT_WIDE_NODES
#define Real       float8
#define Truth      int8
#define Count      uint8
#define Real3      Wide3
#define Shear      WideShear
#define Corners    WideCorners
#define Edges      WideEdges
#define SurfaceRay WideSurfaceRay
#define Sides      WideSides
#include "triangle.cl"
#undef Real
#undef Truth
#undef Count
#undef Real3
#undef Shear
#undef Corners
#undef Edges
#undef SurfaceRay
#undef Sides
#endif

#endif
