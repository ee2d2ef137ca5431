// SPDX-License-Identifier: MIT
// Decides whether the rays of a cone hit a triangle. The answer is yes, no or unknown. A possible
// hit has bounds on its depth.
//
// The triangle is projected into the frame of the cone's axis. The blur of a corner bounds the
// distance between its projections along the axis and along any ray of the cone, including the
// tracer's rounding. If the axis passes all edges by more than the blur, all rays of the cone pass
// each edge on the same side. A hit near the ray's start also depends on the side of the triangle's
// plane on which the start lies (side_of).
#ifndef CLRT_CERTIFY_TRIANGLE_CL
#define CLRT_CERTIFY_TRIANGLE_CL
#include "certify_cone.cl"

typedef enum { ANSWER_NO, ANSWER_UNKNOWN, ANSWER_YES } Answer;

// A possible hit. Its depth along the ray is within [low, high], including the tracer's rounding.
typedef struct {
    Answer met;
    Real low, high;
} Candidate;

// A triangle in the ray's frame.
typedef struct {
    Corners corners;
    Edges edges; // across the ray; the determinant is twice the area, positive if the front is seen
    Real blur;   // the largest blur of a corner
    Real size;   // upper bound on the corners' distances from the ray's start
    Real sides;  // sum of the lengths of the two edges at the first corner
    bool clear;  // the axis passes all edges by more than the blur
    bool inside; // `clear` is set, and the axis passes inside all edges
    bool faces;  // the visible side is certain
    bool inner;  // the mesh's back is visible
    bool broad;  // the triangle is broad enough to compute its plane
} ProjectedTriangle;

static inline bool corners_pass(const Corners *c, Real blur)
{
    return min(min(c->a.x, c->b.x), c->c.x) > blur || max(max(c->a.x, c->b.x), c->c.x) < -blur ||
           min(min(c->a.y, c->b.y), c->c.y) > blur || max(max(c->a.y, c->b.y), c->c.y) < -blur;
}

// Returns whether the axis passes the edge from `p` to `q` by more than `blur`. `edge` is the value
// of the edge function.
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

static inline ProjectedTriangle project_triangle(const RayCone *ray, const Corners *corners)
{
    ProjectedTriangle projected;
    const Corners seen = {to_cone_frame(ray, corners->a), to_cone_frame(ray, corners->b),
                          to_cone_frame(ray, corners->c)};
    const Real blur = max(max(blur_at(ray, seen.a), blur_at(ray, seen.b)), blur_at(ray, seen.c));
    projected.corners = seen;
    projected.blur = blur;
    projected.size = max(max(sum_of_sizes(seen.a), sum_of_sizes(seen.b)), sum_of_sizes(seen.c)) +
                     2.0f * ray->around;
    projected.inside = projected.faces = projected.broad = false;
    projected.clear = corners_pass(&seen, blur);
    if (projected.clear)
        return projected;
    projected.edges = edges_of(&seen);
    projected.sides = length_across(seen.a, seen.b) + length_across(seen.a, seen.c);
    projected.clear = edge_is_clear(seen.b, seen.c, projected.edges.u, blur) &&
                      edge_is_clear(seen.c, seen.a, projected.edges.v, blur) &&
                      edge_is_clear(seen.a, seen.b, projected.edges.w, blur);
    projected.inside = projected.clear && edges_contain(&projected.edges);
    const Real area = fabs(projected.edges.determinant);
    projected.broad = area > 8.0f * blur * projected.sides;
    projected.faces = projected.inside || projected.broad;
    return projected;
}

// Returns the plane's steepest change of depth per unit across the ray.
static inline Real slope_of(const ProjectedTriangle *projected)
{
    const Real3 ab = difference(projected->corners.b, projected->corners.a);
    const Real3 ac = difference(projected->corners.c, projected->corners.a);
    const Real x = difference_of_products(ab.z, ac.y, ac.z, ab.y);
    const Real y = difference_of_products(ac.z, ab.x, ab.z, ac.x);
    return sqrt(x * x + y * y) / fabs(projected->edges.determinant);
}

// Returns bounds on the depth of a hit. The hit is at most one blur away from the axis, and its
// depth is between the depths of the corners. For a broad triangle, the plane's slope also limits
// how far the hit's depth differs from the depth at which the axis crosses the plane. A broad
// triangle is more than 8 blurs high. The hit's weights then stay within [-1/4, 5/4], and rounding
// changes the plane's slope by less than (1 + slope) / 2. A bound of 4 (1 + slope) blurs covers
// these effects. 26 u times the size covers the rounding of the distance (B11).
static inline Candidate depth_of(const ProjectedTriangle *projected, Real u)
{
    const Corners *c = &projected->corners;
    const Real rounding = 26.0f * (u + OWN_ROUNDOFF) * projected->size + 4.0f * projected->blur;
    Candidate depth = {ANSWER_UNKNOWN, min(min(c->a.z, c->b.z), c->c.z) - rounding,
                       max(max(c->a.z, c->b.z), c->c.z) + rounding};
    if (projected->broad) {
        const Real middle = triangle_depth(c, &projected->edges);
        const Real doubt = rounding + 4.0f * projected->blur * slope_of(projected);
        depth.low = max(depth.low, middle - doubt);
        depth.high = min(depth.high, middle + doubt);
    }
    return depth;
}

// Returns a bound on the argument `error` that the tracer passes to surface_ray_distance (B12).
static inline Real margin_of(const ProjectedTriangle *projected, Real u)
{
    return 70.0f * (u + OWN_ROUNDOFF) * projected->size;
}

// Returns the side of a triangle's plane on which a point certainly is: 1 in front, -1 behind, or 0
// if unknown. A nonzero result agrees with real arithmetic and with height_over. With the n and E
// of B6, the error of height_over is below 12u (n.|apart| + E |apart|). The threshold of
// height_over is at most 16u n.|point| + 8u (n.|apart| + E |apart|). The error and the threshold
// are each below u * rounding, so twice this bound covers their sum. Twice the bound also covers
// is_before_face (shade.cl), where a unit vector adds an error of 4u n.|apart|.
static inline int side_of(const Corners *corners, const UncertainPoint *uncertain, Real u)
{
    const Real3 ab = difference(corners->b, corners->a), ac = difference(corners->c, corners->a);
    const Real3 normal = cross_product(ab, ac), apart = difference(uncertain->point, corners->a);
    const Real3 size = magnitudes(normal);
    const Real radius = radius_of(uncertain);
    const Real edges = largest_component(ab) * largest_component(ac);
    const Real rounding =
        16.0f *
        (dot_product(size, magnitudes(uncertain->point)) + dot_product(size, magnitudes(apart)) +
         edges * largest_component(apart) + 2.0f * radius * (sum_of_sizes(normal) + edges));
    const Real length = length_of(normal);
    const Real tilt = length_of(cross_product(normal, uncertain->face)) + 0x1p-48f * length;
    const Real doubt = 1.01f * (uncertain->slide * tilt + uncertain->lift * length);
    const Real height = dot_product(normal, apart);
    if (!(fabs(height) > doubt + 2.0f * (u + OWN_ROUNDOFF) * rounding))
        return 0;
    return height > 0.0f ? 1 : -1;
}

// Returns a bound on search_behind: rounding may put a ray's start this far beyond a triangle that
// stops the ray. A direction is at most sqrt(3) times as long as its largest component, by which
// search_behind measures (B12).
static inline Real behind_of(const RayCone *ray)
{
    if (ray->kind == RAY_CAMERA)
        return 0.0f;
    const Real far = largest_component(ray->start.point) + radius_of(&ray->start);
    return 448.0f * (ray->u + OWN_ROUNDOFF) * far;
}

static inline Candidate candidate_none(void)
{
    return (Candidate){ANSWER_NO, INFINITY, INFINITY};
}

static inline Candidate reflected_candidate(const RayCone *ray, const ProjectedTriangle *projected,
                                            int side)
{
    Candidate candidate = depth_of(projected, ray->u);
    const Real margin = margin_of(projected, ray->u);
    const bool front = projected->edges.determinant > 0.0f;
    const bool before = front ? side > 0 : side < 0; // the start is before the plane
    const bool behind = front ? side < 0 : side > 0;
    if (candidate.high < -margin - behind_of(ray) || (projected->faces && behind))
        return candidate_none();
    const bool clear = !projected->inner || candidate.low > margin;
    candidate.met = projected->inside && before && clear ? ANSWER_YES : ANSWER_UNKNOWN;
    candidate.low = max(candidate.low, (Real)(0.0f));
    return candidate;
}

// If a hit is closer to the eye than this distance, the tracer may test the ray as if it left a
// surface at the eye.
#define AT_EYE 0x1p-15f

static inline Candidate camera_candidate(const RayCone *ray, const ProjectedTriangle *projected,
                                         const Corners *corners)
{
    Candidate candidate = depth_of(projected, ray->u);
    if (candidate.high < -margin_of(projected, ray->u))
        return candidate_none();
    const bool is_clear = projected->inside && candidate.low > AT_EYE;
    candidate.met = is_clear ? ANSWER_YES : ANSWER_UNKNOWN;
    if (candidate.low > AT_EYE)
        return candidate;
    const Candidate near =
        reflected_candidate(ray, projected, side_of(corners, &ray->start, ray->u));
    if (near.met == ANSWER_NO || (near.met == ANSWER_YES && candidate.low > 0.0f))
        return near;
    return candidate;
}

// Returns whether the triangle may block a shadow ray. The triangle does not block the ray if both
// ends of the ray are on one side of the triangle's plane.
static inline Candidate shadow_candidate(const RayCone *ray, const ProjectedTriangle *projected,
                                         int side, int light_side)
{
    Candidate candidate = reflected_candidate(ray, projected, side);
    const Real doubt =
        margin_of(projected, ray->u) + radius_of(&ray->start) + radius_of(&ray->goal);
    const bool same = side != 0 && side == light_side;
    if (candidate.low > ray->length + doubt || (projected->faces && same))
        return candidate_none();
    if (!(candidate.high + doubt < ray->length))
        candidate.met = ANSWER_UNKNOWN;
    return candidate;
}

static inline Candidate triangle_candidate(const RayCone *ray, global const TriangleData *triangle)
{
    const Corners corners = {load3(triangle->a), load3(triangle->b), load3(triangle->c)};
    if (triangle->id == ray->own)
        return candidate_none();
    ProjectedTriangle projected = project_triangle(ray, &corners);
    if (projected.clear && !projected.inside)
        return candidate_none();
    const bool front = projected.edges.determinant > 0.0f;
    const bool one_sided = (triangle->material & TRIANGLE_TWO_SIDED) == 0;
    projected.inner = front == ((triangle->material & TRIANGLE_REVERSED) != 0);
    if (one_sided && projected.faces && projected.inner)
        return candidate_none();
    if (ray->kind == RAY_CAMERA)
        return camera_candidate(ray, &projected, &corners);
    const int side = side_of(&corners, &ray->start, ray->u);
    if (ray->kind == RAY_REFLECTED)
        return reflected_candidate(ray, &projected, side);
    return shadow_candidate(ray, &projected, side, side_of(&corners, &ray->goal, 0.0f));
}

// The following functions handle coincident triangles, which have the same stored corners
// (shared.h). A ray hits coincident triangles at the same distance, bit for bit, and the lower id
// wins. A ray that leaves one of them starts in the plane of the other triangle, and does not hit
// that triangle.
static inline bool is_same_corner(global const float *a, global const float *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static inline bool are_coincident(const Tracer *tracer, uint index, uint other)
{
    global const TriangleData *one = &tracer->triangles[index], *two = &tracer->triangles[other];
    return is_same_corner(one->a, two->a) && is_same_corner(one->b, two->b) &&
           is_same_corner(one->c, two->c);
}

// Returns whether a ray that leaves a triangle certainly misses a coincident triangle. The ray
// misses if height_over returns zero for the ray's start. hits_neighbor then finds neither triangle
// in front of the other. Here n is the tracer's normal, and n.|v| is the sum of the products'
// magnitudes. Corners b and c are at the ends of the edges from corner a. Their computed height
// over their own triangle's plane is below 6u n.|edge|. The threshold of height_over is at least 8u
// n.|edge|, so height_over returns zero for corners, too.
//
// The computed height of the start is at most the sum of these errors (docs/numerics.md, B6, B7):
//  - The start is a weighted sum of corners. Each corner has the height n.a over the origin. The
//    weights add up to 1 within 4u, which gives 4u |n.a|. Rounding the sum adds 3u n.|corner|.
//  - If the start moves into the triangle, the move adds u n.|start| and 2u n.|move|.
//  - An edge leaves the plane perpendicular to n by 4u n.|edge|: 3u from rounding the components of
//    n, and u from rounding the edge.
//  - Subtracting a corner from the start and multiplying by n adds 4u n.|start - corner|.
// Both sides of the comparison below are in units of u. E is the product of the largest edge
// components. The normal computed here differs from n by 4u E per axis, because the tracer rounds
// the edges. Coordinates are at most 1, so this error changes the comparison by less than 1100u E.
static inline bool certainly_misses_coincident(const Corners *corners, const RayCone *ray)
{
    const UncertainPoint *start = &ray->start;
    const Real3 ab = difference(corners->b, corners->a), ac = difference(corners->c, corners->a);
    const Real3 normal = cross_product(ab, ac), apart = difference(start->point, corners->a);
    const Real3 a = magnitudes(corners->a), b = magnitudes(corners->b), c = magnitudes(corners->c);
    const Real3 size = magnitudes(normal);
    const Real3 farthest =
        real3_of(max(max(a.x, b.x), c.x), max(max(a.y, b.y), c.y), max(max(a.z, b.z), c.z));
    const Real edges = largest_component(ab) * largest_component(ac);
    const Real radius = radius_of(start), moved = radius * sum_of_sizes(normal);
    const Real point = dot_product(size, magnitudes(start->point));
    const Real distance = dot_product(size, magnitudes(apart));
    const Real longest = max(dot_product(size, magnitudes(ab)), dot_product(size, magnitudes(ac)));
    const Real height = 4.0f * fabs(dot_product(normal, corners->a)) +
                        3.0f * dot_product(size, farthest) + point + 4.0f * longest +
                        4.0f * distance + 11.0f * moved + 1100.0f * (ray->u + OWN_ROUNDOFF) * edges;
    const Real least = POINT_BLUR * (point - moved) + 8.0f * (distance - moved) +
                       8.0f * edges * (largest_component(apart) - radius);
    return radius < 1.0f && height < 0.999f * least;
}

#endif
