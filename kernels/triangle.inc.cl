// SPDX-License-Identifier: MIT
// Watertight ray-triangle intersection. The triangle is sheared so that the ray becomes the axis z.
// The signs of three edge functions then decide whether the ray passes inside (Woop, Benthin and
// Wald, "Watertight ray/triangle intersection", JCGT 2(1), 2013).
//
// Invariant: no ray passes between two triangles that share an edge. Both triangles compute the
// same bits for the sheared ends of the edge. Kahan's difference of products then gives the edge
// function the exact sign in both triangles.
//
// numeric.cl includes this file up to twice: for one triangle against one ray or a packet of rays,
// and for eight triangles against one ray. The file needs the number types Real, Mask and UInt, and
// OVERLOAD (lanes.cl). It defines functions and the types Real3, Shear, Corners, Edges,
// TriangleTest, Meeting and SurfaceRay. The second inclusion must rename these types by macros.
#include "vector.inc.cl"

// The shear that turns the ray into the axis z. z is the axis of the direction's largest component;
// x and y follow in cyclic order.
typedef struct {
    Real shear_x, shear_y, inverse_z, direction_z;
} Shear;

typedef struct {
    Real3 a, b, c;
} Corners;

// The edge functions. Divided by their sum, they are the barycentric weights.
typedef struct {
    Real u, v, w, determinant;
} Edges;

// Returns the sheared corners. The given corners are relative to the ray's origin, with components
// in the order of the shear.
static inline Corners OVERLOAD corners_sheared(const Corners *relative, const Shear *shear)
{
    Corners s = *relative;
    s.a.x = fma(-shear->shear_x, s.a.z, s.a.x);
    s.a.y = fma(-shear->shear_y, s.a.z, s.a.y);
    s.b.x = fma(-shear->shear_x, s.b.z, s.b.x);
    s.b.y = fma(-shear->shear_y, s.b.z, s.b.y);
    s.c.x = fma(-shear->shear_x, s.c.z, s.c.x);
    s.c.y = fma(-shear->shear_y, s.c.z, s.c.y);
    return s;
}

static inline Edges OVERLOAD edges_of(const Corners *sheared)
{
    const Real3 a = sheared->a, b = sheared->b, c = sheared->c;
    Edges edges;
    edges.u = difference_of_products(c.x, b.y, c.y, b.x);
    edges.v = difference_of_products(a.x, c.y, a.y, c.x);
    edges.w = difference_of_products(b.x, a.y, b.y, a.x);
    edges.determinant = (edges.u + edges.v) + edges.w;
    return edges;
}

// Returns whether no two edge functions have opposite signs. A zero edge function counts as either
// sign, so a ray through an edge hits both triangles.
static inline Mask OVERLOAD edges_agree(const Edges *edges)
{
    const Real smallest = min(min(edges->u, edges->v), edges->w);
    const Real largest = max(max(edges->u, edges->v), edges->w);
    return smallest >= 0.0f || largest <= 0.0f;
}

// Returns whether the ray passes inside all edges.
static inline Mask OVERLOAD edges_contain(const Edges *edges)
{
    return edges_agree(edges) && edges->determinant != 0.0f;
}

// Returns whether an edge function counts as positive. If a ray meets the edge from `p` to `q`
// exactly, the ray counts as moved by an infinitely small distance along x, and by an even smaller
// distance along y (Edelsbrunner and Muecke, "Simulation of simplicity", 1990).
static inline Mask OVERLOAD edge_is_positive(Real edge, Real3 p, Real3 q)
{
    const Mask beside = p.y > q.y || (p.y == q.y && q.x > p.x);
    return edge > 0.0f || (edge == 0.0f && beside);
}

// Returns whether the triangle owns the ray (crossings.cl).
static inline Mask OVERLOAD edges_own(const Corners *sheared, const Edges *edges)
{
    const Real3 a = sheared->a, b = sheared->b, c = sheared->c;
    const Mask u = edge_is_positive(edges->u, c, b), v = edge_is_positive(edges->v, a, c);
    const Mask w = edge_is_positive(edges->w, b, a);
    return u == v && v == w && edges->determinant != 0.0f;
}

// Returns whether the ray comes from the stored front, on which the stored corners turn
// counter-clockwise.
static inline Mask OVERLOAD edges_face(const Edges *edges, const Shear *shear)
{
    return (edges->determinant < 0.0f) == (shear->direction_z < 0.0f);
}

static inline Real OVERLOAD triangle_depth(const Corners *sheared, const Edges *edges)
{
    const Real r = 1.0f / edges->determinant;
    return fma(edges->u * r, sheared->a.z,
               fma(edges->v * r, sheared->b.z, (edges->w * r) * sheared->c.z));
}

// Returns a bound on the error of triangle_depth and of its later product with inverse_z. These
// errors together are at most 14 u of the largest depth (docs/numerics.md, B4), which is below the
// bound.
static inline Real OVERLOAD triangle_depth_error(const Corners *s)
{
    const Real depth = max(max(fabs(s->a.z), fabs(s->b.z)), fabs(s->c.z));
    const Real across = max(max(max(fabs(s->a.x), fabs(s->b.x)), fabs(s->c.x)),
                            max(max(fabs(s->a.y), fabs(s->b.y)), fabs(s->c.y)));
    return 18.0f * UNIT_ROUNDOFF * (depth + across);
}

// Returns whether rounding could decide on which side of the origin the hit is. Coordinates are at
// most 1, so the error of the depth is at most 2^-17 (B4).
static inline Mask OVERLOAD triangle_is_at_origin(Real t, const Shear *shear)
{
    return fabs(t) <= 0x1p-16f * fabs(shear->inverse_z);
}

// A test of a triangle against a ray, in each lane. `inside` selects the lanes in which the ray
// passes inside the edges.
typedef struct {
    Shear shear;
    Corners sheared;
    Edges edges;
    Mask inside;
} TriangleTest;

// The corners in `relative` are as in corners_sheared.
static inline TriangleTest OVERLOAD triangle_test(const Corners *relative, const Shear *shear)
{
    TriangleTest test;
    test.shear = *shear;
    test.sheared = corners_sheared(relative, shear);
    test.edges = edges_of(&test.sheared);
    test.inside =
        CLRT_ALL_HITS ? edges_own(&test.sheared, &test.edges) : edges_contain(&test.edges);
    return test;
}

// The hits of rays that pass inside the edges.
typedef struct {
    Real t;
    Mask front; // the ray comes from the triangle's stored front
    Mask inner; // the ray comes from the back of the mesh's triangle
    Mask near;  // surface_ray_distance must decide whether the ray stops
    Real clear; // if not near: the distance at which the ray stops, INFINITY if it passes
} Meeting;

// Returns the distances, and whether surface_ray_distance must decide which rays stop. `marks`
// contains the triangles' flags. One-sided triangles do not stop rays on their inner side. For rays
// that leave a surface, surface_ray_distance must decide for all triangles ahead up to `reach`, and
// for triangles within rounding of the start. For rays from the eye, it must decide only for
// triangles within rounding of the eye. With CLRT_ALL_HITS, it is never needed.
static inline Meeting OVERLOAD triangle_meeting(const TriangleTest *test, UInt marks, Real reach,
                                                bool from_eye)
{
    const Shear *shear = &test->shear;
    Meeting met;
    met.front = edges_face(&test->edges, shear);
    met.inner = met.front == ((marks & TRIANGLE_REVERSED) != 0);
    met.near = test->inside && ((marks & TRIANGLE_TWO_SIDED) != 0 || !met.inner);
    met.clear = INFINITY;
    met.t = INFINITY;
    if (lane_bits(met.near) == 0)
        return met;
    met.t = triangle_depth(&test->sheared, &test->edges) * shear->inverse_z;
    const Mask at_origin = triangle_is_at_origin(met.t, shear);
    if (CLRT_ALL_HITS) {
        met.clear = met.near && met.t >= 0.0f ? met.t : INFINITY;
        met.near = 0;
        return met;
    }
    if (from_eye)
        met.clear = met.near && met.t > 0.0f ? met.t : INFINITY;
    met.near = met.near && met.t <= reach && (at_origin || (!from_eye && met.t > 0.0f));
    return met;
}

// Returns a point's height over the triangle's plane, times the normal's length. The height is
// positive in front, and zero if rounding could change its sign. Near a triangle, this height is
// far more precise than the depth at which a ray from afar hits the triangle. The error bound adds
// the errors of the products, of the normal and of the point. `blur` is the error of the point's
// coordinates, in units of rounding.
static inline Real OVERLOAD height_over(const Corners *corners, Real3 point, float blur)
{
    const Real3 ab = difference(corners->b, corners->a), ac = difference(corners->c, corners->a);
    const Real3 normal = cross_product(ab, ac), apart = difference(point, corners->a);
    const Real height = dot_product(normal, apart);
    const Real3 size = magnitudes(normal);
    const Real edges = largest_component(ab) * largest_component(ac);
    const Real error =
        blur * dot_product(size, magnitudes(point)) +
        8.0f * (dot_product(size, magnitudes(apart)) + edges * largest_component(apart));
    return fabs(height) > UNIT_ROUNDOFF * error ? height : 0.0f;
}

// The `blur` of a surface point for height_over (B7).
#define POINT_BLUR 16.0f

// A ray that leaves a surface, and its relation to a triangle.
typedef struct {
    Real3 point;  // of the surface
    Mask front;   // the ray comes from the triangle's stored front
    Mask inner;   // the ray comes from the back of the mesh's triangle
    Real behind;  // rounding may put the start this far beyond a triangle that stops the ray
    float length; // as a distance t: 1 up to a light, else INFINITY
    float blur;   // error of the point, as in height_over; 0 for the eye, which is exact
} SurfaceRay;

// Returns the distance at which the ray stops on a triangle, or INFINITY if it passes. `t` is the
// triangle's distance, with an error of at most `error`.
//
// Near the ray's start, t is only rounding error. If t decided there, neighbors of the triangle on
// which the ray starts would wrongly stop shadow and reflected rays. The ray therefore stops only
// if its start is certainly on the side of the triangle from which the ray comes. A ray from a
// convex edge starts on the inner side of the neighbor across the edge, so it would stop on this
// neighbor if the neighbor is two-sided. On inner sides, a ray therefore stops only if t is also
// certainly positive. The eye is on no surface, so rays from the eye need no positive t. A triangle
// does not block the ray if the triangle's t is within `error` of the light's t.
//
// `in_doubt` receives the lanes whose rays pass, but perhaps only because of rounding. In a valley,
// for example, rounding can put the start beyond the neighbor that should stop the ray.
static inline Real OVERLOAD surface_ray_distance(const Corners *corners, const SurfaceRay *ray,
                                                 Real t, Real error, Mask *in_doubt)
{
    const Mask ahead = t > -error && t < ray->length - error;
    const Mask clear = t > (ray->blur > 0.0f ? error : -error);
    const Real above = height_over(corners, ray->point, ray->blur);
    const Real height = ray->front ? above : -above; // on the ray's side
    const Mask beyond = height > 0.0f && (clear || !ray->inner);
    const Mask may_stop = t > -error - ray->behind && t < ray->length - error;
    *in_doubt = may_stop && !(ahead && beyond) && height >= 0.0f;
    return ahead && beyond ? max(t, (Real)(0.0f)) : INFINITY;
}
