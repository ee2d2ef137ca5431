// SPDX-License-Identifier: MIT
// What a thick ray meets first, and whether anything stands between a point and a light, where that
// is certain.  The tree's boxes grow by ten blurs of the farthest corner: a triangle within one
// blur of the axis, no more than eight behind the origin, lies in them.
#ifndef CLRT_SURE_SEARCH_CL
#define CLRT_SURE_SEARCH_CL
#include "sure_sphere.cl"

// The nearest primitive that is met surely, and the least depth at which any other may be met.
typedef struct {
    Count id, index;
    Real low, high; // INFINITY where nothing is met
    Real other;
} Nearest;

static inline bool nearest_is_sure(const Nearest *nearest)
{
    return nearest->id == NOTHING ? nearest->other == INFINITY : nearest->other > nearest->high;
}

static inline void nearest_add(Nearest *nearest, const Candidate *candidate, uint id, uint index)
{
    if (candidate->met == ANSWER_YES && candidate->high < nearest->high) {
        nearest->other = min(nearest->other, nearest->low);
        *nearest = (Nearest){id, index, candidate->low, candidate->high, nearest->other};
    } else if (candidate->met != ANSWER_NO) {
        nearest->other = min(nearest->other, candidate->low);
    }
}

typedef struct {
    const ThickRay *ray;
    Query query;
    Nearest nearest;
    Answer blocked; // of a shadow ray
} Search;

// Corners lie within the frame's [-1, 1] and a little.
static inline Query thick_query(const ThickRay *ray)
{
    const Ray axis = {ray->origin, ray->along, ray->own, ray->kind, ray->origin, true};
    const Real far = sum_of_sizes(ray->origin) + 3.25f;
    const Real growth =
        11.0f * (ray->around + ray->spread * (far + ray->around) +
                 (18.0f * ray->u + 32.0f * OWN_ROUNDOFF) * (far + ray->around));
    Query query = query_of(&axis);
    const Real3 size = scaled3(growth, magnitudes(query.inverse));
    query.near_offset = difference(query.near_offset, size);
    query.far_offset = sum3(query.far_offset, size);
    return query;
}

static inline Real search_reach(const Search *search)
{
    return search->ray->kind == RAY_SHADOW ? 1.01f * search->ray->length : search->nearest.high;
}

static inline void search_leaf(const SceneView *scene, Search *search, uint2 range)
{
    for (uint index = range.x; index < range.x + range.y; index++) {
        global const TriangleData *triangle = &scene->triangles[index];
        const Candidate candidate = triangle_candidate(search->ray, triangle);
        if (search->ray->kind == RAY_SHADOW)
            search->blocked = max(search->blocked, candidate.met);
        else
            nearest_add(&search->nearest, &candidate, triangle->id, index);
    }
}

static void search_triangles(const SceneView *scene, Search *search)
{
    Waiting waiting;
    waiting.count = 0;
    wait_for_children(scene, 0, &search->query, search_reach(search), &waiting);
    while (waiting.count > 0 && search->blocked != ANSWER_YES) {
        waiting.count--;
        const Real reach = search_reach(search);
        if (waiting.entry[waiting.count] > reach)
            continue;
        const uint child = waiting.child[waiting.count];
        const uint first = scene->nodes[child >> 1].first[child & 1];
        const uint count = scene->nodes[child >> 1].count[child & 1];
        if (count == 0)
            wait_for_children(scene, first, &search->query, reach, &waiting);
        else
            search_leaf(scene, search, (uint2)(first, count));
    }
}

static inline Nearest surely_nearest(const SceneView *scene, const FrameData *frame,
                                     const ThickRay *ray)
{
    Search search = {.ray = ray,
                     .nearest = {NOTHING, NOTHING, INFINITY, INFINITY, INFINITY},
                     .blocked = ANSWER_NO};
    for (uint index = 0; index < frame->sphere_count; index++) {
        const PlainSphere sphere = plain_sphere(&scene->spheres[index]);
        const Chord chord = chord_of(ray, &sphere);
        const Candidate candidate =
            index == ray->own ? own_sphere_candidate(ray, &sphere) : sphere_candidate(&chord);
        nearest_add(&search.nearest, &candidate, index, index);
    }
    if (frame->triangle_count > 0) {
        search.query = thick_query(ray);
        search_triangles(scene, &search);
    }
    return search.nearest;
}

// A shadow ray as spheres are met by it: from the surface to the light.
static inline ThickRay turned_around(const ThickRay *ray)
{
    ThickRay turned = *ray;
    turned.origin = ray->end.point;
    turned.along = negative3(ray->along);
    turned.around = radius_of(&ray->end);
    return turned;
}

static inline Answer spheres_block(const SceneView *scene, const FrameData *frame,
                                    const ThickRay *ray)
{
    const ThickRay turned = turned_around(ray);
    const Real margin = turned.around + 20.0f * (ray->u + OWN_ROUNDOFF) * ray->length;
    Answer blocked = ANSWER_NO;
    for (uint index = 0; index < frame->sphere_count; index++) {
        if (index == ray->own)
            continue;
        const PlainSphere sphere = plain_sphere(&scene->spheres[index]);
        const Chord chord = chord_of(&turned, &sphere);
        blocked = max(blocked, sphere_blocks(&chord, ray->length - margin, ray->length + margin));
    }
    return blocked;
}

static inline Answer surely_blocked(const SceneView *scene, const FrameData *frame,
                                     const ThickRay *ray)
{
    Search search = {.ray = ray, .blocked = spheres_block(scene, frame, ray)};
    if (frame->triangle_count > 0 && search.blocked != ANSWER_YES) {
        search.query = thick_query(ray);
        search_triangles(scene, &search);
    }
    return search.blocked;
}

#endif
