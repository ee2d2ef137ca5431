// SPDX-License-Identifier: MIT
// Thick ray against triangle: a certain hit, a certain miss, or undecided; and the depth.
#ifndef CLRT_SURE_TRIANGLE_CL
#define CLRT_SURE_TRIANGLE_CL
#include "thick.cl"

typedef enum { ANSWER_NO, ANSWER_UNKNOWN, ANSWER_YES } Answer;

// A hit lies at a depth within [low, high] along the ray, including the tracer's rounding.
typedef struct {
    Answer met;
    Real low, high;
} Candidate;

// The triangle in the ray's frame.
typedef struct {
    Corners corners;
    Edges edges; // across the ray; the determinant is twice the area, positive if the front is seen
    Real blur;   // of all corners
    Real size;   // upper bound of the corners' distances
    Real sides;  // sum of the two edges at the first corner
    bool clear;  // the axis passes all edges by more than the blur
    bool inside; // and passes inside them
    bool faces;  // the visible side is certain
    bool inner;  // the mesh's back is visible
    bool broad;  // the triangle is broad enough to compute its plane
} Sight;

static inline bool corners_pass(const Corners *c, Real blur)
{
    return min(min(c->a.x, c->b.x), c->c.x) > blur || max(max(c->a.x, c->b.x), c->c.x) < -blur ||
           min(min(c->a.y, c->b.y), c->c.y) > blur || max(max(c->a.y, c->b.y), c->c.y) < -blur;
}

// Returns whether the axis passes the edge from p to q by more than the blur. edge is its edge
// function.
static inline bool edge_is_clear(Real3 p, Real3 q, Real edge, Real blur)
{
    const Real x = q.x - p.x, y = q.y - p.y;
    const Real length = x * x + y * y, place = -(p.x * x + p.y * y);
    if (place <= 0.0f)
        return p.x * p.x + p.y * p.y > blur * blur;
    if (place >= length)
        return q.x * q.x + q.y * q.y > blur * blur;
    return edge * edge > blur * blur * length;
}

static inline Real length_across(Real3 p, Real3 q)
{
    const Real x = q.x - p.x, y = q.y - p.y;
    return sqrt(x * x + y * y);
}

static inline Sight sight_of(const ThickRay *ray, const Corners *corners)
{
    Sight sight;
    const Corners seen = {seen_by(ray, corners->a), seen_by(ray, corners->b),
                          seen_by(ray, corners->c)};
    const Real blur = max(max(blur_at(ray, seen.a), blur_at(ray, seen.b)), blur_at(ray, seen.c));
    sight.corners = seen;
    sight.blur = blur;
    sight.size = max(max(sum_of_sizes(seen.a), sum_of_sizes(seen.b)), sum_of_sizes(seen.c)) +
                 2.0f * ray->around;
    sight.inside = sight.faces = sight.broad = false;
    sight.clear = corners_pass(&seen, blur);
    if (sight.clear)
        return sight;
    sight.edges = edges_of(&seen);
    sight.sides = length_across(seen.a, seen.b) + length_across(seen.a, seen.c);
    sight.clear = edge_is_clear(seen.b, seen.c, sight.edges.u, blur) &&
                  edge_is_clear(seen.c, seen.a, sight.edges.v, blur) &&
                  edge_is_clear(seen.a, seen.b, sight.edges.w, blur);
    sight.inside = sight.clear && edges_contain(&sight.edges);
    const Real area = fabs(sight.edges.determinant);
    sight.broad = area > 8.0f * blur * sight.sides;
    sight.faces = sight.inside || sight.broad;
    return sight;
}

// Returns the largest depth change of the plane per step across the ray.
static inline Real slope_of(const Sight *sight)
{
    const Real3 ab = difference(sight->corners.b, sight->corners.a);
    const Real3 ac = difference(sight->corners.c, sight->corners.a);
    const Real x = difference_of_products(ab.z, ac.y, ac.z, ab.y);
    const Real y = difference_of_products(ac.z, ab.x, ab.z, ac.x);
    return sqrt(x * x + y * y) / fabs(sight->edges.determinant);
}

// A hit lies within the blur of the axis. It is no deeper than the corners. Its distance from the
// axis's own hit is limited by the plane's slope. A broad triangle is more than 8 blurs high.
// Weights then stay within [-1/4, 5/4], and rounding tilts the plane by less than half of 1 +
// slope. A bound of 4 (1 + slope) blurs covers all of this.
static inline Candidate depth_of(const Sight *sight, Real u)
{
    const Corners *c = &sight->corners;
    const Real rounding = 26.0f * (u + OWN_ROUNDOFF) * sight->size + 4.0f * sight->blur;
    Candidate depth = {ANSWER_UNKNOWN, min(min(c->a.z, c->b.z), c->c.z) - rounding,
                       max(max(c->a.z, c->b.z), c->c.z) + rounding};
    if (sight->broad) {
        const Real middle = triangle_depth(c, &sight->edges);
        const Real doubt = rounding + 4.0f * sight->blur * slope_of(sight);
        depth.low = max(depth.low, middle - doubt);
        depth.high = min(depth.high, middle + doubt);
    }
    return depth;
}

// At least the distance error that surface_ray_distance uses.
static inline Real margin_of(const Sight *sight, Real u)
{
    return 64.0f * (u + OWN_ROUNDOFF) * sight->size;
}

// Returns the side of a triangle's plane on which a point certainly lies: 1 in front, -1 behind, 0
// if unknown. It agrees with real arithmetic and with height_over, which may also return zero if
// this returns 0. The error of height_over is below 12u n.|apart| + 12u E |apart|, and its
// threshold is below the bound, which is therefore doubled. The error of is_before_face
// (shade.cl), whose unit vector adds 4u n.|apart|, stays within the bound, too.
static inline int side_of(const Corners *corners, const FatPoint *fat, Real u)
{
    const Real3 ab = difference(corners->b, corners->a), ac = difference(corners->c, corners->a);
    const Real3 normal = cross_product(ab, ac), apart = difference(fat->point, corners->a);
    const Real3 size = magnitudes(normal);
    const Real radius = radius_of(fat);
    const Real edges = largest_component(ab) * largest_component(ac);
    const Real rounding =
        16.0f * (dot_product(size, magnitudes(fat->point)) + dot_product(size, magnitudes(apart)) +
                 edges * largest_component(apart) + 2.0f * radius * (sum_of_sizes(normal) + edges));
    const Real length = length_of(normal);
    const Real tilt = length_of(cross_product(normal, fat->face)) + 0x1p-48f * length;
    const Real doubt = 1.01f * (fat->slide * tilt + fat->lift * length);
    const Real height = dot_product(normal, apart);
    if (!(fabs(height) > doubt + 2.0f * (u + OWN_ROUNDOFF) * rounding))
        return 0;
    return height > 0.0f ? 1 : -1;
}

static inline Candidate candidate_none(void)
{
    return (Candidate){ANSWER_NO, INFINITY, INFINITY};
}

static inline Candidate reflected_candidate(const ThickRay *ray, const Sight *sight, int side)
{
    Candidate candidate = depth_of(sight, ray->u);
    const Real margin = margin_of(sight, ray->u);
    const bool front = sight->edges.determinant > 0.0f;
    const bool before = front ? side > 0 : side < 0; // the ray approaches the plane
    const bool behind = front ? side < 0 : side > 0;
    if (candidate.high < -margin || (sight->faces && behind))
        return candidate_none();
    const bool clear = !sight->inner || candidate.low > margin;
    candidate.met = sight->inside && before && clear ? ANSWER_YES : ANSWER_UNKNOWN;
    candidate.low = max(candidate.low, (Real)(0.0f));
    return candidate;
}

// Closer to the eye than this, a camera ray's start counts as a surface point.
#define AT_EYE 0x1p-15f

static inline Candidate camera_candidate(const ThickRay *ray, const Sight *sight,
                                         const Corners *corners)
{
    Candidate candidate = depth_of(sight, ray->u);
    if (candidate.high < -margin_of(sight, ray->u))
        return candidate_none();
    const bool is_clear = sight->inside && candidate.low > AT_EYE;
    candidate.met = is_clear ? ANSWER_YES : ANSWER_UNKNOWN;
    if (candidate.low > AT_EYE)
        return candidate;
    const Candidate near = reflected_candidate(ray, sight, side_of(corners, &ray->start, ray->u));
    if (near.met == ANSWER_NO || (near.met == ANSWER_YES && candidate.low > 0.0f))
        return near;
    return candidate;
}

// A triangle with both ends of the ray on one side does not block it.
static inline Candidate shadow_candidate(const ThickRay *ray, const Sight *sight, int side,
                                         int light_side)
{
    Candidate candidate = reflected_candidate(ray, sight, side);
    const Real doubt = margin_of(sight, ray->u) + radius_of(&ray->start) + radius_of(&ray->goal);
    const bool same = side != 0 && side == light_side;
    if (candidate.low > ray->length + doubt || (sight->faces && same))
        return candidate_none();
    if (!(candidate.high + doubt < ray->length))
        candidate.met = ANSWER_UNKNOWN;
    return candidate;
}

static inline Candidate triangle_candidate(const ThickRay *ray, global const TriangleData *triangle)
{
    const Corners corners = {load3(triangle->a), load3(triangle->b), load3(triangle->c)};
    if (triangle->id == ray->own)
        return candidate_none();
    Sight sight = sight_of(ray, &corners);
    if (sight.clear && !sight.inside)
        return candidate_none();
    const bool front = sight.edges.determinant > 0.0f;
    const bool one_sided = (triangle->material & TRIANGLE_TWO_SIDED) == 0;
    sight.inner = front == ((triangle->material & TRIANGLE_REVERSED) != 0);
    if (one_sided && sight.faces && sight.inner)
        return candidate_none();
    if (ray->kind == RAY_CAMERA)
        return camera_candidate(ray, &sight, &corners);
    const int side = side_of(&corners, &ray->start, ray->u);
    if (ray->kind == RAY_REFLECTED)
        return reflected_candidate(ray, &sight, side);
    return shadow_candidate(ray, &sight, side, side_of(&corners, &ray->goal, 0.0f));
}

#endif
