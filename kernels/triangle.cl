// SPDX-License-Identifier: MIT
// Ray against triangle, watertight: the triangle is sheared into the ray's frame and the signs of
// three edge functions decide (Woop, Benthin and Wald, JCGT 2(1) 2013).  Neighbors share the
// sheared vertices bit for bit, and Kahan's difference of products gives each shared edge the same
// exact sign from both sides, so no ray passes between them.
#ifndef CLRT_TRIANGLE_CL
#define CLRT_TRIANGLE_CL
#include "numeric.cl"

typedef enum { RAY_CAMERA, RAY_REFLECTED, RAY_SHADOW } RayKind;

// origin + t * direction.  A shadow ray runs from the light at t = 0 to the shaded point at t = 1.
typedef struct {
    float3 origin, direction;
    uint own; // id of the primitive it starts or ends on, which it cannot meet
    RayKind kind;
} Ray;

// The shear that turns the ray into the axis z: z is the axis the direction is longest along.
typedef struct {
    uint x, y, z; // the axes, cyclic
    float origin_x, origin_y, origin_z;
    float shear_x, shear_y, inverse_z, direction_z;
} Shear;

static inline float component(float3 v, uint axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static inline Shear shear_along(const Ray *ray)
{
    const float3 size = fabs(ray->direction);
    Shear shear;
    shear.z = size.y > size.x ? 1 : 0;
    shear.z = size.z > (shear.z ? size.y : size.x) ? 2 : shear.z;
    shear.x = shear.z == 2 ? 0 : shear.z + 1;
    shear.y = shear.x == 2 ? 0 : shear.x + 1;
    shear.origin_x = component(ray->origin, shear.x);
    shear.origin_y = component(ray->origin, shear.y);
    shear.origin_z = component(ray->origin, shear.z);
    shear.direction_z = component(ray->direction, shear.z);
    shear.inverse_z = 1.0f / shear.direction_z;
    shear.shear_x = component(ray->direction, shear.x) * shear.inverse_z;
    shear.shear_y = component(ray->direction, shear.y) * shear.inverse_z;
    return shear;
}

// The corners relative to the origin, sheared.
typedef struct {
    float ax, ay, az, bx, by, bz, cx, cy, cz;
} ShearedTriangle;

// Reading components by axis makes the permutation free.
static inline ShearedTriangle triangle_sheared(global const TriangleData *triangle,
                                               const Shear *shear)
{
    ShearedTriangle s;
    s.az = triangle->a[shear->z] - shear->origin_z;
    s.bz = triangle->b[shear->z] - shear->origin_z;
    s.cz = triangle->c[shear->z] - shear->origin_z;
    s.ax = fma(-shear->shear_x, s.az, triangle->a[shear->x] - shear->origin_x);
    s.ay = fma(-shear->shear_y, s.az, triangle->a[shear->y] - shear->origin_y);
    s.bx = fma(-shear->shear_x, s.bz, triangle->b[shear->x] - shear->origin_x);
    s.by = fma(-shear->shear_y, s.bz, triangle->b[shear->y] - shear->origin_y);
    s.cx = fma(-shear->shear_x, s.cz, triangle->c[shear->x] - shear->origin_x);
    s.cy = fma(-shear->shear_y, s.cz, triangle->c[shear->y] - shear->origin_y);
    return s;
}

// The edge functions, which are barycentric weights once divided by their sum.
typedef struct {
    float u, v, w, determinant;
} Edges;

static inline Edges triangle_edges(const ShearedTriangle *s)
{
    Edges edges;
    edges.u = difference_of_products(s->cx, s->by, s->cy, s->bx);
    edges.v = difference_of_products(s->ax, s->cy, s->ay, s->cx);
    edges.w = difference_of_products(s->bx, s->ay, s->by, s->ax);
    edges.determinant = (edges.u + edges.v) + edges.w;
    return edges;
}

// Zero counts for both signs: a ray through an edge meets both triangles, and the lower id wins.
static inline bool edges_contain(const Edges *edges)
{
    const float smallest = min(min(edges->u, edges->v), edges->w);
    const float largest = max(max(edges->u, edges->v), edges->w);
    return (smallest >= 0.0f || largest <= 0.0f) && edges->determinant != 0.0f;
}

// How far along z the reported depth may be from where the true ray meets the true triangle: the
// accepted point is the image of one within 6 u Q sideways and 16 u Q in depth, Q the largest
// distance of a corner from the origin, and a step sideways moves the depth by the triangle's
// slope.  The two units to spare cover the rounding of the ray's own end.
static inline float triangle_depth_error(const ShearedTriangle *s, const Edges *edges)
{
    const float depth = max(max(fabs(s->az), fabs(s->bz)), fabs(s->cz));
    const float across = max(max(max(fabs(s->ax), fabs(s->bx)), fabs(s->cx)),
                             max(max(fabs(s->ay), fabs(s->by)), fabs(s->cy)));
    const float slope = (fabs(s->bz - s->az) * (fabs(s->cx - s->ax) + fabs(s->cy - s->ay)) +
                         fabs(s->cz - s->az) * (fabs(s->bx - s->ax) + fabs(s->by - s->ay))) /
                        fabs(edges->determinant);
    return UNIT_ROUNDOFF * (depth + across) * fma(8.0f, slope, 18.0f);
}

// Whether a ray of this kind may stop at t on the triangle.  Rays that leave or reach a surface
// must be clear of it by more than the error, or its neighbors would shadow and mirror it.
static inline bool ray_may_stop(const Ray *ray, const Shear *shear, const ShearedTriangle *s,
                                const Edges *edges, float t)
{
    if (!(t > 0.0f))
        return false;
    if (ray->kind == RAY_CAMERA)
        return true;
    const float clear = ray->kind == RAY_SHADOW ? 1.0f - t : t;
    return clear * fabs(shear->direction_z) > triangle_depth_error(s, edges);
}

// One-sided triangles stop what comes from the front.  A shadow ray is traced from the light, so
// for it the front is where the shaded point lies.
static inline bool triangle_faces(global const TriangleData *triangle, const Ray *ray,
                                  const Shear *shear, const Edges *edges)
{
    if (triangle->material & TRIANGLE_TWO_SIDED)
        return true;
    const bool front = (edges->determinant < 0.0f) == (shear->direction_z < 0.0f);
    return front != (ray->kind == RAY_SHADOW);
}

static inline float triangle_depth(const ShearedTriangle *s, const Edges *edges)
{
    const float r = 1.0f / edges->determinant;
    return fma(edges->u * r, s->az, fma(edges->v * r, s->bz, (edges->w * r) * s->cz));
}

// The distance t at which the ray meets the triangle, INFINITY where it does not.
static inline float triangle_distance(global const TriangleData *triangle, const Ray *ray,
                                      const Shear *shear)
{
    const ShearedTriangle sheared = triangle_sheared(triangle, shear);
    const Edges edges = triangle_edges(&sheared);
    if (!edges_contain(&edges) || !triangle_faces(triangle, ray, shear, &edges))
        return INFINITY;
    const float t = triangle_depth(&sheared, &edges) * shear->inverse_z;
    if (triangle->id == ray->own || !ray_may_stop(ray, shear, &sheared, &edges, t))
        return INFINITY;
    return t;
}

#endif
