// SPDX-License-Identifier: MIT
// Decides which primitive a ray cone hits first, and whether a primitive blocks a shadow ray. Both
// answers can be uncertain. The search follows only the cone's axis, through boxes that have grown
// to cover the cone.
//
// A box grows by the cone's radius at the box's farthest corner, and by 140u of this corner's
// distance. The 140u cover the rounding of a corner's projection (18u, blur_at) and of the distance
// (70u + 25u, B12). For rays that leave a surface, boxes also grow by behind_of, because rounding
// may put a hit behind the origin. With this growth, the axis enters a box before any possible hit
// of a triangle in the box. Spheres, and the bounding spheres of the tree over them, also grow
// (cone_may_meet).
#ifndef CLRT_CERTIFY_SEARCH_CL
#define CLRT_CERTIFY_SEARCH_CL
#include "certify_sphere.cl"

// The nearest hit that is certain, and the least depth of any other possible hit.
typedef struct {
    UInt id, index;
    Real low, high; // bounds of the hit's depth; INFINITY without a hit
    Real other;
} Nearest;

static inline bool nearest_is_certain(const Nearest *nearest)
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
    const RayCone *ray;
    Real origin[3], inverse[3]; // the ray's origin and the inverse of its direction
    Nearest nearest;
    uint triangle;  // index of the nearest hit if it is a triangle, else NOTHING
    Answer blocked; // for a shadow ray: whether a primitive blocks it
    bool may_meet_glass;
} ConeSearch;

// Returns the growth of a box whose farthest corner is `far` away.
static inline Real growth_at(const RayCone *ray, Real far)
{
    const Real rounding = 140.0f * ray->u + 200.0f * OWN_ROUNDOFF;
    return 1.01f * ray->around + (1.01f * ray->spread + rounding) * (far + ray->around) +
           behind_of(ray);
}

// Returns 1 / direction for one component. A magnitude below 2^-60 is first raised to 2^-60. This
// changes the result of the search less than rounding does.
static inline Real inverse_of(Real direction)
{
    return 1.0f / (fabs(direction) < 0x1p-60f ? copysign((Real)(0x1p-60f), direction) : direction);
}

static inline ConeSearch search_in_cone(const RayCone *ray)
{
    const Real3 o = ray->origin, d = ray->along;
    return (ConeSearch){.ray = ray,
                        .origin = {o.x, o.y, o.z},
                        .inverse = {inverse_of(d.x), inverse_of(d.y), inverse_of(d.z)},
                        .nearest = {NOTHING, NOTHING, INFINITY, INFINITY, INFINITY},
                        .triangle = NOTHING,
                        .blocked = ANSWER_NO};
}

// Returns the depth beyond which the search may stop. Nothing beyond the nearest certain hit can be
// the first hit. Beyond an uncertain hit, no hit can be certain to be the first.
static inline Real cone_reach(const ConeSearch *search)
{
    if (search->ray->kind == RAY_SHADOW)
        return 1.01f * search->ray->length;
    return min(search->nearest.high, search->nearest.other);
}

typedef struct {
    Real low[3], high[3];
} Box;

// Returns the depth at which the axis enters the grown box, or INFINITY if it does not enter before
// `reach`.
static inline Real box_entry(const ConeSearch *search, const Box *box, Real reach)
{
    Real low[3], high[3], far = 0.0f, enter = 0.0f, leave = reach;
    for (uint axis = 0; axis < 3; axis++) {
        low[axis] = box->low[axis] - search->origin[axis];
        high[axis] = box->high[axis] - search->origin[axis];
        far += max(fabs(low[axis]), fabs(high[axis]));
    }
    const Real growth = growth_at(search->ray, far);
    for (uint axis = 0; axis < 3; axis++) {
        const Real one = (low[axis] - growth) * search->inverse[axis];
        const Real other = (high[axis] + growth) * search->inverse[axis];
        enter = max(enter, min(one, other));
        leave = min(leave, max(one, other));
    }
    return enter <= leave && low[0] <= high[0] ? enter : INFINITY;
}

static inline Real child_entry(const ConeSearch *search, global const BvhPair *node, uint child,
                               Real reach)
{
    Box box;
    for (uint axis = 0; axis < 3; axis++) {
        box.low[axis] = node->planes[axis][0][child];
        box.high[axis] = node->planes[axis][1][child];
    }
    return box_entry(search, &box, reach);
}

// Returns box_entry for the triangle's own box, which is tested before the triangle. The search's
// result therefore does not depend on the tree.
static inline Real triangle_entry(const ConeSearch *search, global const TriangleData *triangle,
                                  Real reach)
{
    Box box;
    for (uint axis = 0; axis < 3; axis++) {
        const Real a = triangle->a[axis], b = triangle->b[axis], c = triangle->c[axis];
        box.low[axis] = min(min(a, b), c);
        box.high[axis] = max(max(a, b), c);
    }
    return box_entry(search, &box, reach);
}

static inline bool descend_in_cone(const Tracer *tracer, const ConeSearch *search, PairStack *stack,
                                   PairPlace *place)
{
    const Real reach = cone_reach(search);
    global const BvhPair *node = &tracer->nodes[place->first];
    const Real2 entry =
        (Real2)(child_entry(search, node, 0, reach), child_entry(search, node, 1, reach));
    return enter_children(tracer->nodes, entry, stack, place);
}

static inline Candidate leaf_candidate(const Tracer *tracer, const RayCone *ray, uint index)
{
    global const TriangleData *triangle = &tracer->triangles[index];
    const Candidate candidate = triangle_candidate(ray, triangle);
    if (candidate.met == ANSWER_NO || ray->own_index == NOTHING ||
        !are_coincident(tracer, ray->own_index, index))
        return candidate;
    const Corners corners = {load3(triangle->a), load3(triangle->b), load3(triangle->c)};
    return certainly_misses_coincident(&corners, ray) ? candidate_none() : candidate;
}

// Updates the nearest hit with a triangle. If the triangle coincides with the nearest triangle, the
// lower id wins, and the depths do not change.
static inline void add_triangle(const Tracer *tracer, ConeSearch *search, uint index,
                                const Candidate *candidate)
{
    Nearest *nearest = &search->nearest;
    const uint id = tracer->triangles[index].id;
    const bool is_coincident = candidate->met == ANSWER_YES && search->triangle != NOTHING &&
                               are_coincident(tracer, search->triangle, index);
    if (!is_coincident)
        nearest_add(nearest, candidate, id, index);
    else if (id < nearest->id)
        *nearest = (Nearest){id, index, nearest->low, nearest->high, nearest->other};
    if (nearest->id == id)
        search->triangle = index;
}

static inline void add_blocker(const Tracer *tracer, ConeSearch *search, Answer met, uint material)
{
    search->blocked = max(search->blocked, met);
    if (CLRT_GLASS && met != ANSWER_NO)
        search->may_meet_glass |= tracer->materials[material].shader == SHADER_GLASS;
}

static inline void search_leaf(const Tracer *tracer, ConeSearch *search, uint2 range)
{
    for (uint index = range.x; index < range.x + range.y; index++) {
        global const TriangleData *triangle = &tracer->triangles[index];
        if (!(triangle_entry(search, triangle, cone_reach(search)) < INFINITY))
            continue;
        const Candidate candidate = leaf_candidate(tracer, search->ray, index);
        if (!ends_at_any_hit(search->ray->kind))
            add_triangle(tracer, search, index, &candidate);
        add_blocker(tracer, search, candidate.met, triangle->material & ~TRIANGLE_MARKS);
    }
}

static inline bool search_is_over(const ConeSearch *search)
{
    return ends_at_any_hit(search->ray->kind) && search->blocked == ANSWER_YES;
}

static inline void search_triangles(const Tracer *tracer, ConeSearch *search)
{
    PairStack stack;
    PairPlace place = {0};
    if (!tracer->frame->uses_bvh) {
        search_leaf(tracer, search, (uint2)(0, tracer->frame->triangle_count));
        return;
    }
    while (!search_is_over(search)) {
        if (place.count > 0)
            search_leaf(tracer, search, (uint2)(place.first, place.count));
        else if (descend_in_cone(tracer, search, &stack, &place))
            continue;
        if (!pop_place(tracer->nodes, cone_reach(search), &stack, &place))
            return;
    }
}

// Returns whether the axis may enter a grown sphere before `reach`. The sphere grows by `factor`
// times the bound of B21. If the result is false, the tracer finds no hit of the sphere before
// `reach`.
static inline bool cone_may_meet(const RayCone *ray, const PlainSphere *sphere, Real factor,
                                 Real reach)
{
    const Real3 f = difference(sphere->center, ray->origin);
    const Real middle = dot_product(f, ray->along), apart = length_of(f);
    const Real growth = growth_at(ray, apart + sphere->radius) + sizes_doubt(ray->u, apart, sphere);
    const Real radius = sphere->radius + factor * growth;
    return length_of(difference(f, scaled3(middle, ray->along))) <= radius && middle >= -radius &&
           middle - radius <= reach;
}

// The sphere that the search visits. Spheres come in the order of their tree or, without a tree, of
// their ids.
typedef struct {
    uint entry, id;
    PlainSphere sphere;
} SphereVisit;

static inline SphereVisit first_sphere(const FrameData *frame)
{
    const bool has_tree = frame->sphere_entries > frame->sphere_count;
    return (SphereVisit){.entry = has_tree ? frame->sphere_count : 0};
}

// Finds the next sphere that the cone may hit, from visit->entry on. Returns false if there is
// none. A bounding sphere grows three times as much as a sphere. Despite rounding, the axis
// therefore enters a bounding sphere if it enters a sphere in it, so the search's result does not
// depend on the tree. To keep this independence, spheres beyond the nearest hit are not left out.
static inline bool find_sphere(const Tracer *tracer, const ConeSearch *search, SphereVisit *visit)
{
    const FrameData *frame = tracer->frame;
    const bool has_tree = frame->sphere_entries > frame->sphere_count;
    const uint end = has_tree ? frame->sphere_entries : frame->sphere_count;
    const bool is_shadow = search->ray->kind == RAY_SHADOW;
    const Real reach = is_shadow ? cone_reach(search) : INFINITY;
    while (visit->entry < end) {
        global const SphereData *data = &tracer->spheres[visit->entry];
        visit->id = has_tree ? data->id : visit->entry;
        visit->sphere = plain_sphere(data);
        const bool is_bound = visit->id == NOTHING;
        const bool may_meet =
            cone_may_meet(search->ray, &visit->sphere, is_bound ? 3.0f : 1.0f, reach);
        visit->entry = is_bound && !may_meet ? data->next : visit->entry + 1;
        if (may_meet && !is_bound)
            return true;
    }
    return false;
}

static inline Nearest certify_nearest_hit(const Tracer *tracer, const RayCone *ray)
{
    ConeSearch search = search_in_cone(ray);
    SphereVisit visit = first_sphere(tracer->frame);
    while (find_sphere(tracer, &search, &visit)) {
        const Chord chord = chord_of(ray, &visit.sphere);
        const Candidate candidate = visit.id == ray->own ? own_sphere_candidate(ray, &visit.sphere)
                                                         : sphere_candidate(&chord);
        nearest_add(&search.nearest, &candidate, visit.id, visit.id);
    }
    if (tracer->frame->triangle_count > 0)
        search_triangles(tracer, &search);
    return search.nearest;
}

static inline void search_spheres(const Tracer *tracer, ConeSearch *search)
{
    const RayCone *ray = search->ray;
    SphereVisit visit = first_sphere(tracer->frame);
    while (!search_is_over(search) && find_sphere(tracer, search, &visit)) {
        const bool is_own = visit.id == ray->own;
        if (is_own && !may_hit_own_sphere(ray->kind))
            continue;
        const Candidate candidate = sphere_blocker(ray, &visit.sphere, is_own);
        nearest_add(&search->nearest, &candidate, visit.id, visit.id);
        add_blocker(tracer, search, candidate.met, tracer->spheres[visit.id].material);
    }
}

// Returns what a shadow ray may hit before the light. If may_meet_glass is set in the result,
// `nearest` is the ray's nearest hit. Otherwise, `blocked` is whether anything blocks the ray.
static inline ConeSearch search_blockers(const Tracer *tracer, const RayCone *ray)
{
    ConeSearch search = search_in_cone(ray);
    search_spheres(tracer, &search);
    if (tracer->frame->triangle_count > 0 && !search_is_over(&search))
        search_triangles(tracer, &search);
    return search;
}

#endif
