// SPDX-License-Identifier: MIT
// The data that the tracer's steps share: a ray, its cost and the scene.
#ifndef CLRT_RAY_CL
#define CLRT_RAY_CL
#include "hit.cl"

typedef enum { RAY_CAMERA, RAY_REFLECTED, RAY_SHADOW } RayKind;

// Returns the kind without RAY_ANY_HIT. Only programs with CLRT_RAYS have kinds with this bit.
static inline RayKind plain_kind(RayKind kind)
{
    return CLRT_RAYS ? (RayKind)(kind & ~RAY_ANY_HIT) : kind;
}

// Returns whether rays of this kind end at any hit. With glass, shadow rays search for the nearest
// hit.
static inline bool ends_at_any_hit(RayKind kind)
{
    return (!CLRT_GLASS && kind == RAY_SHADOW) || kind != plain_kind(kind);
}

// Returns whether rays of this kind can hit the sphere on which they start. Reflected and refracted
// rays can hit it from inside. In scenes with glass, shadow rays can hit it, too.
static inline bool may_hit_own_sphere(RayKind kind)
{
    return CLRT_GLASS || plain_kind(kind) == RAY_REFLECTED;
}

// A ray: origin + t * direction. A shadow ray leads from a surface at t = 0 to a light at t = 1.
typedef struct {
    Real3 origin, direction;
    UInt own;       // id of the primitive on which the ray starts, or NOTHING
    UInt own_index; // index of that primitive if it is a triangle, else NOTHING
    RayKind kind;
    Mask active; // lanes that have a ray
#if CLRT_ALL_HITS
    UInt number; // in the array of rays
#endif
} Ray;

// Returns the uncertainty of the ray's origin, in units of rounding.
static inline float blur_of(const Ray *ray)
{
    return plain_kind(ray->kind) == RAY_CAMERA ? 0.0f : POINT_BLUR;
}

static inline float length_of_ray(const Ray *ray)
{
    return ray->kind == RAY_SHADOW ? 1.0f : INFINITY;
}

// The lists of hits in programs that find all hits. Each ray has `room` entries for its nearest
// hits.
typedef struct {
    global HitData *hits;
    global uint *counts; // of all hits of each ray
    uint room;
} HitLists;

typedef struct {
    uint camera_rays, shadow_rays, reflected_rays, shaded_points, camera_hits;
    uint triangle_tests, box_tests, sphere_tests;
#if CLRT_GLASS
    ulong cut; // stored as TALLY_CUT and TALLY_CUT_HIGH
#endif
#if CLRT_ALL_HITS
    HitLists lists;
#endif
} Tally;

#if CLRT_WIDE_NODES
typedef BvhWide Node;
typedef TriangleBlock Triangles;
#else
typedef BvhPair Node;
typedef TriangleData Triangles;
#endif

// The data of all rays: the arrays of the flattened scene, the picture's parameters and the
// counters.
typedef struct {
    global const PointLight *lights;
    global const Material *materials;
    global const SphereData *spheres;
    global const Node *nodes;
    global const Triangles *triangles;
    global const TriangleLook *looks;
    global const CornerNormals *normals;
    global const CornerColors *colors;
    const FrameData *frame;
    Tally *tally;
} Tracer;

// The first arguments of all kernels that trace rays, in the order in which the host sets them.
// TRACER makes a Tracer from these arguments.
#define TRACER_ARGUMENTS                                                                           \
    const FrameData frame, global const PointLight *lights, global const Material *materials,      \
        global const SphereData *spheres, global const Node *nodes,                                \
        global const Triangles *triangles, global const TriangleLook *looks,                       \
        global const CornerNormals *normals, global const CornerColors *colors
#define TRACER(tally)                                                                              \
    {                                                                                              \
        lights, materials, spheres, nodes, triangles, looks, normals, colors, &frame, tally        \
    }

#endif
