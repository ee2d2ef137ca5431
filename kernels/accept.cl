// SPDX-License-Identifier: MIT
// Decides, for every search, whether a triangle becomes the best hit. pair.cl tests one triangle
// against one ray, and packet.cl tests one against a packet of rays. wide.cl tests one ray against
// a block of triangles, and then calls accept_triangle for the ray's lane.
//
// Two rare cases need a second test: a hit within rounding of the ray's start (stops_on_neighbor),
// and hits whose distances differ only by rounding (triangle_is_nearer). On CPUs, these two
// functions are not inlined.
//
// Invariant: the choice between two triangles depends only on these triangles, the ray and the
// limit of its search. The best of several triangles therefore does not depend on the order of the
// tests.
#ifndef CLRT_ACCEPT_CL
#define CLRT_ACCEPT_CL
#include "crossings.cl"
#include "order.cl"

// The position of another triangle relative to a triangle's plane. In the lanes of `front`, the
// other triangle certainly has a corner in front of the plane. In the lanes of `back`, it certainly
// has a corner behind the plane.
typedef struct {
    Mask front, back;
} Sides;

static inline Sides sides_of(const Corners *corners, const Corners *other)
{
    const Real a = height_over(corners, other->a, 0.0f);
    const Real b = height_over(corners, other->b, 0.0f);
    const Real c = height_over(corners, other->c, 0.0f);
    const Real highest = max(max(a, b), c), lowest = min(min(a, b), c);
    return (Sides){highest > 0.0f, lowest < 0.0f};
}

static inline Sides sides_exchanged(Mask exchange, Sides sides)
{
    return (Sides){exchange ? sides.back : sides.front, exchange ? sides.front : sides.back};
}

// Returns whether a ray that leaves the triangle `own` certainly stops on the triangle `other`. The
// ray's line must hit `other` within rounding of the ray's start. Each triangle's plane may show
// that `other` is ahead of the start or behind it:
//  - The plane of `own`: `other` is ahead if it is on the side to which the ray leaves, and behind
//    if it is on the opposite side.
//  - The plane of `other`: `other` is ahead if `own` is on the side from which the ray comes, and
//    behind if `own` is on the opposite side.
// A ray does not hit coplanar neighbors. `cross` receives the lanes in which neither plane decides,
// although the triangles are not coplanar. There, order.cl must decide.
static inline Mask hits_neighbor(const Corners *own, const Corners *other, Real3 direction,
                                 Mask from_back, Mask *cross)
{
    const Real3 ab = difference(own->b, own->a), ac = difference(own->c, own->a);
    const Mask downward = dot_product(cross_product(ab, ac), direction) < 0.0f;
    const Sides neighbor = sides_exchanged(downward, sides_of(own, other));
    const Sides start = sides_exchanged(from_back, sides_of(other, own));
    const Mask behind = (neighbor.back && !neighbor.front) || (start.back && !start.front);
    const Mask ahead = (neighbor.front && !neighbor.back) || (start.front && !start.back);
    *cross = (neighbor.front || start.front) && !ahead && !behind;
    return ahead && !behind;
}

// Returns the lanes whose rays start on a triangle and stop on triangle `index`. Each ray's line
// must hit triangle `index` so close to the ray's start that rounding could put the hit before or
// behind the start.
static NOT_INLINE Mask stops_on_neighbor(const Search *search, UInt index, Mask from_back)
{
    const Ray *ray = search->ray;
    const Mask known = ray->own_index != NOTHING;
    const Corners other = fetch_corners(search->tracer, index);
    const Corners own = fetch_corners(search->tracer, known ? ray->own_index : index);
    Mask cross;
    const Mask stops = hits_neighbor(&own, &other, ray->direction, from_back, &cross);
    if (!any_lane(known && cross))
        return known && stops;
    return known && (stops || (cross && is_ahead(search->tracer, ray, index)));
}

// In each lane of `candidates`, makes the triangle the best hit if it precedes the best hit so far.
// Returns the lanes whose hits changed. In a tie, the hit gets the lesser t of both triangles, so
// its t can change even if its triangle does not. If all hits count, adds crossings instead, and
// returns no lanes.
static inline Mask accept_triangle(const Search *search, Mask candidates, Hit *triangle, Hit *best)
{
    if (CLRT_ALL_HITS) {
        add_crossings(search->tracer, search->ray, candidates, triangle, best->t);
        return 0;
    }
    const Mask close = candidates && is_close(search, triangle->t, best);
    Mask precedes = candidates && hit_precedes(triangle->t, triangle->id, best), changed = 0;
    if (any_lane(close)) {
        const Real before = best->t;
        const Mask nearer = triangle_is_nearer(search, triangle, best, close);
        precedes = close ? nearer : precedes;
        changed = best->t != before;
    }
    best->t = precedes ? triangle->t : best->t;
    best->id = precedes ? triangle->id : best->id;
    best->index = precedes ? triangle->index : best->index;
    return precedes || changed;
}

// A triangle's id, its flags and its position.
typedef struct {
    uint id, marks, index;
} TriangleName;

// Returns the distances at which rays stop on the triangle, and INFINITY for rays that pass.
// Distances of camera rays may be beyond `reach`.
static inline Real stop_distances(const Search *search, const TriangleName *name,
                                  const TriangleTest *test, Real reach)
{
    const Ray *ray = search->ray;
    const bool from_eye = plain_kind(ray->kind) == RAY_CAMERA;
    const Meeting met = triangle_meeting(test, (UInt)(name->marks), reach, from_eye);
    if (!any_lane(met.near))
        return met.clear;
    const Corners corners = triangle_corners(search->tracer, name->index);
    const SurfaceRay surface = {ray->origin,           met.front,          met.inner,
                                search_behind(search), length_of_ray(ray), blur_of(ray)};
    const Real error = triangle_depth_error(&test->sheared) * fabs(test->shear.inverse_z);
    Mask in_doubt;
    const Real distance = surface_ray_distance(&corners, &surface, met.t, error, &in_doubt);
    in_doubt = in_doubt && met.near && !from_eye;
    Mask stops = 0;
    if (any_lane(in_doubt))
        stops = in_doubt && stops_on_neighbor(search, (UInt)(name->index), !met.front);
    const Real near = stops ? max(met.t, (Real)(0.0f)) : distance;
    return met.near ? near : met.clear;
}

// Tests a triangle against the rays in `lanes`. `relative` has the triangle's corners relative to
// the rays' origins. Returns the lanes whose hits changed.
static ALWAYS_INLINE Mask intersect_triangle(const Search *search, const TriangleName *name,
                                             const Corners *relative, Mask lanes, Hit *best)
{
    TriangleTest test = triangle_test(relative, &search->shear);
    test.inside = lanes && test.inside;
    if (!any_lane(test.inside))
        return 0;
    test.inside = test.inside && search->ray->own != name->id;
    if (!any_lane(test.inside))
        return 0;
    const Real t = stop_distances(search, name, &test, search_reach(search, best));
    Hit triangle = {t, (UInt)(name->id), (UInt)(name->index)};
    return accept_triangle(search, lanes, &triangle, best);
}

#endif
