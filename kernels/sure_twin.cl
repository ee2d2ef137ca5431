// SPDX-License-Identifier: MIT
// Twins are triangles with the same stored corners (shared.h). A ray hits both at the same
// distance, bit for bit, so the lower id wins if the ray certainly hits one of them first. A ray
// that leaves one twin starts in the plane of the other and does not hit it.
#ifndef CLRT_SURE_TWIN_CL
#define CLRT_SURE_TWIN_CL
#include "sure_triangle.cl"

static inline bool is_same_corner(global const float *a, global const float *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static inline bool are_twins(const SceneView *scene, uint index, uint other)
{
    global const TriangleData *one = &scene->triangles[index], *two = &scene->triangles[other];
    return is_same_corner(one->a, two->a) && is_same_corner(one->b, two->b) &&
           is_same_corner(one->c, two->c);
}

// Returns whether a ray that leaves a triangle certainly misses its twin. It does if height_over
// returns zero for the ray's start. meets_neighbor then compares the triangles and finds neither
// in front of the other: the height of an edge over its own plane is below 6u n.|edge|, less than
// height_over allows. Here n is the tracer's normal, and n.|v| is the sum of the products'
// magnitudes. The computed height of the start is the sum of these errors:
//  - The start is a weighted sum of corners, which all have the height n.a over the origin. Its
//    weights add up to 1 within 4u, which gives 4u |n.a|. Rounding the sum adds 3u n.|corner|.
//  - Moving the start into the triangle adds u n.|start| and 2u n.|way|.
//  - An edge leaves the plane across n by 4u n.|edge|: 3u from rounding the components of n, and
//    u from rounding the edge.
//  - The difference of start and corner and its product with n add 4u n.|difference|.
// Both sides of the comparison are in units of u. The normal computed here differs from n by 4u E
// per axis, because the tracer rounds the edges. E is the product of the largest edge components.
// As coordinates are at most 1, this changes the comparison by less than 1100u E.
static inline bool surely_passes_twin(const Corners *corners, const ThickRay *ray)
{
    const FatPoint *start = &ray->start;
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
