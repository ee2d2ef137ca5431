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
    float3 surface; // the point of that primitive
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

// How far along z the reported depth may be from the true one: 16 u Q (10 of the weights, 4 of the
// interpolation, 2 of the division), Q the largest distance of a corner from the origin, and two to
// spare.
static inline float triangle_depth_error(const ShearedTriangle *s)
{
    const float depth = max(max(fabs(s->az), fabs(s->bz)), fabs(s->cz));
    const float across = max(max(max(fabs(s->ax), fabs(s->bx)), fabs(s->cx)),
                             max(max(fabs(s->ay), fabs(s->by)), fabs(s->cy)));
    return 18.0f * UNIT_ROUNDOFF * (depth + across);
}

// The surface point's height over the triangle's front, as a multiple of its normal's length;
// zero where rounding leaves the side open.  Near a triangle this knows far more than the depth
// of a ray that came from afar.  The bound adds the point's own error, the products' and the
// normal's.
static inline float height_over(global const TriangleData *triangle, float3 point)
{
    const float3 a = load3(triangle->a);
    const float3 ab = load3(triangle->b) - a, ac = load3(triangle->c) - a;
    const float3 normal = cross_product(ab, ac), apart = point - a;
    const float height = dot_product(normal, apart);
    const float edges = largest_component(ab) * largest_component(ac);
    const float error =
        16.0f * dot_product(fabs(normal), fabs(point)) +
        8.0f * (dot_product(fabs(normal), fabs(apart)) + edges * largest_component(apart));
    return fabs(height) > UNIT_ROUNDOFF * error ? height : 0.0f;
}

// Where a ray that leaves or reaches a surface stops on a triangle that t says it meets, INFINITY
// where it does not.  The side that its surface point lies on decides, beyond doubt, or the
// neighbors of every point would mirror and shadow it; t near the surface is mere rounding.  From
// its inner side, which only two-sided triangles show, a convex neighbor lies on the right side as
// well, and the depth has to be clear too.
static inline float surface_ray_distance(global const TriangleData *triangle, const Ray *ray,
                                         bool front, float t, float error)
{
    const bool is_shadow = ray->kind == RAY_SHADOW;
    const bool inner = front == is_shadow;
    if (!(t > (is_shadow ? 0.0f : -error)))
        return INFINITY;
    if (inner && !((is_shadow ? 1.0f - t : t) > error))
        return INFINITY;
    const float height = height_over(triangle, ray->surface);
    return (inner ? height < 0.0f : height > 0.0f) ? max(t, 0.0f) : INFINITY;
}

// Whether the ray comes from the front, where the corners turn counter-clockwise.
static inline bool triangle_faces(const Shear *shear, const Edges *edges)
{
    return (edges->determinant < 0.0f) == (shear->direction_z < 0.0f);
}

// One-sided triangles stop what comes from the front.  A shadow ray is traced from the light, so
// for it the front is where the shaded point lies.
static inline bool triangle_is_open(global const TriangleData *triangle, const Ray *ray, bool front)
{
    return !(triangle->material & TRIANGLE_TWO_SIDED) && front == (ray->kind == RAY_SHADOW);
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
    if (!edges_contain(&edges))
        return INFINITY;
    const bool front = triangle_faces(shear, &edges);
    if (triangle_is_open(triangle, ray, front) || triangle->id == ray->own)
        return INFINITY;
    const float t = triangle_depth(&sheared, &edges) * shear->inverse_z;
    if (ray->kind == RAY_CAMERA)
        return t > 0.0f ? t : INFINITY;
    const float error = triangle_depth_error(&sheared) * fabs(shear->inverse_z);
    return surface_ray_distance(triangle, ray, front, t, error);
}

#endif
