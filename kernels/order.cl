// SPDX-License-Identifier: MIT
// Orders triangles that a ray hits at almost equal distances. t has an error, so t alone could
// order two triangles wrongly. A ray could then hit the farther one and leave a closed surface.
//
// The edge tests are exact for the sheared corners (triangle.inc.cl), which neighbors share. In the
// frame of a ray, all triangles therefore form one surface: the stored surface after each corner
// has moved by the rounding of the shear. A Nearness is the distance to this surface with twice the
// bits of t (B5 of docs/numerics.md). The same page proves that rays then stay inside closed
// surfaces, except for one step that is only measured.
//
// Invariant: a Nearness depends only on the ray and on the triangle's corners, and not on the order
// of the tests.
#ifndef CLRT_ORDER_CL
#define CLRT_ORDER_CL
#include "fetch.cl"
#include "search.cl"

// If the ray hits an edge or a corner exactly, all triangles there have the same t. The slopes then
// select the triangle that a ray would hit first if it passed a little beside the edge or corner.
typedef struct {
    TwoFloat t;
    Real lowest; // at a corner: the least slope of t from there into the triangle; else 0
    Real slope;  // slope of t across the edge, into the triangle; 0 if the ray hits no edge exactly
} Nearness;

static inline TwoFloat two_product(Real a, Real b)
{
    const Real product = a * b;
    return (TwoFloat){product, fma(a, b, -product)};
}

static inline TwoFloat two_difference_of_products(Real a, Real b, Real c, Real d)
{
    return two_add(two_product(a, b), two_negate(two_product(c, d)));
}

static inline TwoFloat two_quotient(TwoFloat a, TwoFloat b)
{
    const Real high = a.high / b.high;
    const TwoFloat rest = two_add(a, two_negate(two_scale(b, high)));
    return two_sum_ordered(high, rest.high / b.high);
}

// Returns the depth at which the ray hits the edge from `first` to `second`. The depth depends only
// on the edge's ends, which the host has sorted, so all triangles at this edge get the same bits.
static inline TwoFloat edge_depth(Real3 first, Real3 second)
{
    const Mask by_x = fabs(second.x - first.x) >= fabs(second.y - first.y);
    const Real f = by_x ? first.x : first.y, s = by_x ? second.x : second.y;
    return two_quotient(two_difference_of_products(second.z, f, first.z, s), two_sum(f, -s));
}

static inline TwoFloat inner_depth(const Corners *s)
{
    const TwoFloat u = two_difference_of_products(s->c.x, s->b.y, s->c.y, s->b.x);
    const TwoFloat v = two_difference_of_products(s->a.x, s->c.y, s->a.y, s->c.x);
    const TwoFloat w = two_difference_of_products(s->b.x, s->a.y, s->b.y, s->a.x);
    const TwoFloat depths =
        two_add(two_add(two_scale(u, s->a.z), two_scale(v, s->b.z)), two_scale(w, s->c.z));
    return two_quotient(depths, two_add(two_add(u, v), w));
}

// Returns the slope of the depth in the triangle, perpendicular to the edge and away from it.
static inline Real slope_across(Real3 first, Real3 second, Real3 third)
{
    const Real x = second.x - first.x, y = second.y - first.y, squared = fma(x, x, y * y);
    const Real to_x = third.x - first.x, to_y = third.y - first.y;
    const Real along = fma(to_x, x, to_y * y) / squared;
    const Real rise = (third.z - first.z) - along * (second.z - first.z);
    return rise * sqrt(squared) / fabs(difference_of_products(to_x, y, to_y, x));
}

static inline Real slope_along(Real3 first, Real3 second)
{
    const Real x = second.x - first.x, y = second.y - first.y;
    return (second.z - first.z) / sqrt(fma(x, x, y * y));
}

// Returns the least slope of the depth from the corner `first` into the triangle. The steepest
// descent has this slope if it leads into the triangle. Otherwise, an edge at the corner has the
// least slope.
static inline Real slope_around(Real3 first, Real3 second, Real3 third)
{
    const Real3 p = difference(second, first), q = difference(third, first);
    const Real area = difference_of_products(p.x, q.y, p.y, q.x);
    const Real x = difference_of_products(q.z, p.y, p.z, q.y) / area;
    const Real y = difference_of_products(p.z, q.x, q.z, p.x) / area;
    const Mask between = (p.x * y - p.y * x) * area > 0.0f && (x * q.y - y * q.x) * area > 0.0f;
    const Real least = min(slope_along(first, second), slope_along(first, third));
    return between ? -sqrt(fma(x, x, y * y)) : least;
}

static inline Corners corners_chosen(Mask first, const Corners *a, const Corners *b)
{
    return (Corners){choose3(first, a->a, b->a), choose3(first, a->b, b->b),
                     choose3(first, a->c, b->c)};
}

// Returns whether the ray hits a corner of the triangle exactly.
static inline Mask edges_meet_at_ray(const Edges *edges)
{
    const Mask on_u = edges->u == 0.0f, on_v = edges->v == 0.0f, on_w = edges->w == 0.0f;
    return (on_u && (on_v || on_w)) || (on_v && on_w);
}

// Returns the corners in another order. An edge that the ray hits exactly becomes the edge from a
// to b, with its ends in the host's order. A corner that the ray hits exactly becomes the corner a.
static inline Corners corners_from_edge(const Corners *s, const Edges *edges, Mask *at_corner)
{
    const Mask on_u = edges->u == 0.0f, on_v = edges->v == 0.0f;
    const Corners on_bc = {s->b, s->c, s->a}, on_ac = {s->a, s->c, s->b}, at_c = {s->c, s->a, s->b};
    const Corners on_v_or_w = corners_chosen(on_v, &on_ac, s);
    const Corners on_any = corners_chosen(on_u, &on_bc, &on_v_or_w);
    *at_corner = edges_meet_at_ray(edges);
    return corners_chosen(on_u && on_v, &at_c, &on_any);
}

static inline TwoFloat depth_of_hit(const Corners *s, const Corners *from_edge, Mask on_edge,
                                    Mask at_corner)
{
    const TwoFloat corner = {from_edge->a.z, 0.0f};
    const TwoFloat edge = edge_depth(from_edge->a, from_edge->b);
    return two_choose(at_corner, corner, two_choose(on_edge, edge, inner_depth(s)));
}

static NOT_INLINE Nearness nearness_of(const Tracer *tracer, const Ray *ray, UInt index)
{
    const ShearAxes axes = shear_axes(ray->direction);
    const Shear shear = shear_along(ray->direction, &axes);
    const Corners corners = fetch_corners(tracer, index);
    const Corners relative = {axes_ordered(difference(corners.a, ray->origin), &axes),
                              axes_ordered(difference(corners.b, ray->origin), &axes),
                              axes_ordered(difference(corners.c, ray->origin), &axes)};
    const Corners s = corners_sheared(&relative, &shear);
    const Edges edges = edges_of(&s);
    const Mask on_edge = edges.u == 0.0f || edges.v == 0.0f || edges.w == 0.0f;
    Mask at_corner;
    Corners e = corners_from_edge(&s, &edges, &at_corner);
    Nearness nearness;
    nearness.t = two_scale(depth_of_hit(&s, &e, on_edge, at_corner), shear.inverse_z);
    e.a.z *= shear.inverse_z; // for slopes of t
    e.b.z *= shear.inverse_z;
    e.c.z *= shear.inverse_z;
    const Corners exchanged = {e.a, e.c, e.b};
    const Mask lower = at_corner && slope_along(e.a, e.c) < slope_along(e.a, e.b);
    e = corners_chosen(lower, &exchanged, &e);
    nearness.lowest = at_corner ? slope_around(e.a, e.b, e.c) : 0.0f;
    nearness.slope = on_edge ? slope_across(e.a, e.b, e.c) : 0.0f;
    return nearness;
}

// Returns whether `a` is nearer than `b`. If both are equal, returns `else_nearer`.
static inline Mask is_nearer(const Nearness *a, const Nearness *b, Mask else_nearer)
{
    const Mask same_high = a->t.high == b->t.high;
    const Mask same_t = same_high && a->t.low == b->t.low;
    const Mask by_slope = a->slope < b->slope || (a->slope == b->slope && else_nearer);
    const Mask by_lowest = a->lowest < b->lowest || (a->lowest == b->lowest && by_slope);
    return a->t.high < b->t.high || (same_high && a->t.low < b->t.low) || (same_t && by_lowest);
}

// Returns whether, by Nearness, the ray's own triangle is nearer than triangle `index`.
static NOT_INLINE Mask is_ahead(const Tracer *tracer, const Ray *ray, UInt index)
{
    const Mask known = ray->own_index != NOTHING;
    const Nearness own = nearness_of(tracer, ray, known ? ray->own_index : index);
    const Nearness other = nearness_of(tracer, ray, index);
    return is_nearer(&own, &other, 0);
}

// Returns whether a triangle precedes the best hit, in the given lanes. In these lanes, the best
// hit must also be a triangle. If the nearnesses are equal, the triangles' distances t differ only
// by rounding, and both triangles get the lesser t. The id then decides only which triangle is hit.
// On GPUs, storing the common nearness as t instead would take 15 more registers. A separate test
// for equality instead of the second is_nearer would take 9 more registers.
static NOT_INLINE Mask triangle_is_nearer(const Search *search, Hit *triangle, Hit *best,
                                          Mask lanes)
{
    const UInt index = lanes ? best->index : triangle->index;
    const Nearness other = nearness_of(search->tracer, search->ray, triangle->index);
    const Nearness nearest = nearness_of(search->tracer, search->ray, index);
    const Mask lower = triangle->id < best->id;
    const Mask nearer = is_nearer(&other, &nearest, lower);
    const Mask tied = lanes && nearer != is_nearer(&other, &nearest, !lower);
    const Real t = min(triangle->t, best->t);
    triangle->t = tied ? t : triangle->t;
    best->t = tied ? t : best->t;
    return nearer;
}

// Returns the lanes in which nearness decides between a triangle at t and the best hit. In these
// lanes, both distances are below search->limit.
static inline Mask is_close(const Search *search, Real t, const Hit *best)
{
    return fabs(t - best->t) <= search->tie && t < search->limit && best->t < search->limit;
}

#endif
