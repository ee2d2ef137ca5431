// SPDX-License-Identifier: MIT
// Splits paths at glass. trace.cl includes this file only if the scene has glass. A path follows
// the refracted ray first, and the reflected ray waits on a stack. docs/numerics.md, "Glass",
// bounds the stack.
//
// Invariant: the order in which a path's rays are followed depends only on the path itself. A color
// is therefore the same sum in every form of the kernels, even if the lanes of a packet are at
// different levels.

// A ray to follow, and its weight in the sample's color.
typedef struct {
    Ray ray;
    Real weight;
    Real3 tint; // product of the colors of the glass on the path; multiplies the weight
} Branch;

static inline Branch choose_branch(Mask first, const Branch *a, const Branch *b)
{
    const Ray ray = {choose3(first, a->ray.origin, b->ray.origin),
                     choose3(first, a->ray.direction, b->ray.direction),
                     first ? a->ray.own : b->ray.own,
                     first ? a->ray.own_index : b->ray.own_index,
                     RAY_REFLECTED,
                     first ? a->ray.active : b->ray.active};
    return (Branch){ray, first ? a->weight : b->weight, choose3(first, a->tint, b->tint)};
}

// The rays that wait. In each lane, slot i contains a ray of level i if bit i of `waiting` is set.
typedef struct {
    Branch slots[GLASS_LEVELS];
    UInt waiting;
} Branches;

static inline uint level_among(UInt levels, Mask among)
{
    const UInt level = first_lane(levels, among);
    return ((const uint *)&level)[0];
}

// Stores the rays of the given lanes, each in the slot of its lane's level.
static inline void push_branches(Branches *branches, UInt levels, Mask lanes, const Branch *branch)
{
    branches->waiting |= lanes ? (UInt)(1) << levels : (UInt)(0);
    while (any_lane(lanes)) {
        const uint level = level_among(levels, lanes);
        const Mask here = lanes && levels == (UInt)(level);
        branches->slots[level] = choose_branch(here, branch, &branches->slots[level]);
        lanes = lanes && !here;
    }
}

// Takes each given lane's waiting ray of the highest level. Returns the lanes that have such a ray,
// and stores the rays and their levels.
static inline Mask pop_branches(Branches *branches, Mask lanes, UInt *levels, Branch *branch)
{
    const Mask popped = lanes && branches->waiting != 0;
    const UInt highest_level = 31 - clz(branches->waiting);
    *levels = popped ? highest_level : *levels;
    branches->waiting ^= popped ? (UInt)(1) << *levels : (UInt)(0);
    for (Mask left = popped; any_lane(left);) {
        const uint level = level_among(*levels, left);
        const Mask here = left && *levels == (UInt)(level);
        *branch = choose_branch(here, &branches->slots[level], branch);
        left = left && !here;
    }
    return popped;
}

// The next rays of a packet, which leave the surfaces that its rays hit.
typedef struct {
    Branch next;   // followed first
    Branch other;  // the reflected ray, which waits
    Mask refracts; // lanes whose next ray is refracted
    Mask splits;   // lanes that have the other ray
} Successors;

// Splits the next ray in the lanes of `glass`. On entry, after->next must hold the reflected ray.
// Only the lanes of `wanted` need the refracted ray.
static inline void split_branch(const Tracer *tracer, const Path *path, Mask glass, Mask wanted,
                                Successors *after)
{
    const Surface *surface = &path->surface;
    const Refraction at = refraction_of(tracer, surface, glass);
    Branch *next = &after->next;
    after->other = *next;
    after->other.weight = next->weight * at.reflectance;
    after->refracts = glass && at.reflectance < 1.0f;
    after->splits = after->refracts && at.reflectance > 0.0f;
    const Mask aims = after->refracts && wanted;
    Branch refracted = *next;
    if (any_lane(aims))
        refracted.ray = ray_refracted(tracer, surface, &at, aims);
    refracted.weight = next->weight * (1.0f - at.reflectance);
    refracted.tint = product3(next->tint, path->material.diffuse);
    *next = choose_branch(after->refracts, &refracted, next);
}

// Returns the next rays in the lanes of path->reflects. In other lanes, `next` has the weight and
// the tint of the path. The rays themselves are valid only in the lanes of `wanted`.
static inline Successors successors_of(const Tracer *tracer, const Path *path, const Ray *last,
                                       Mask wanted)
{
    const Branch ended = {*last, path->weight, path->tint};
    Successors after = {ended, ended, 0, 0};
    if (any_lane(wanted))
        after.next.ray = ray_reflected(tracer, &path->surface, wanted);
    const Mask glass = path->reflects && is_glass(&path->material);
    if (any_lane(glass))
        split_branch(tracer, path, glass, wanted, &after);
    return after;
}

// Returns the lanes whose next rays max_level cuts off.
static inline Mask is_cut(const Tracer *tracer, const Path *path)
{
    return path->reflects && path->level + 1 >= tracer->frame->max_level;
}

// Adds the background, as seen along a branch that ends.
static inline void end_branch(const Tracer *tracer, Path *path, Mask lanes, const Branch *branch)
{
    const Real3 background = load_private3(tracer->frame->background);
    const Real3 seen = scaled3(branch->weight, product3(branch->tint, background));
    path->color = choose3(lanes, sum3(path->color, seen), path->color);
}

// Ends branches that max_level cuts off. Each cut branch causes an error of at most its weight
// times its tint, because colors are at most 1.
static inline void cut_branch(const Tracer *tracer, Path *path, Mask lanes, const Branch *branch)
{
    if (!any_lane(lanes))
        return;
    end_branch(tracer, path, lanes, branch);
    path->cut += lanes ? branch->weight * largest_component(branch->tint) : 0.0f;
}

// Adds the square of each sample's error to the tally, in steps of 2^-32. `cut` is the sum of the
// errors of a sample's cut branches. The factor 1 + 2^-8 covers the rounding of the weights and of
// their sum.
static inline void count_cut(Tally *tally, Real cut)
{
    if (!any_lane(cut > 0.0f))
        return;
    const Real error = clamp_to_one((1.0f + 0x1p-8f) * cut);
    const ULong steps = to_long(ceil(0x1p32f * error * error));
    for (uint lane = 0; lane < CLRT_LANES; lane++)
        tally->cut += ((const ulong *)&steps)[lane];
}

// Sets the next rays of a packet, and their weights. Returns whether any lane has a next ray.
static NOT_INLINE bool follow_branches(const Tracer *tracer, Path *path, Branches *branches,
                                       Ray *ray)
{
    const Mask live = ray->active, leads = path->reflects, cut = is_cut(tracer, path);
    const Mask goes_on = leads && !cut;
    Successors after = successors_of(tracer, path, ray, goes_on);
    path->level = goes_on ? path->level + 1 : path->level;
    push_branches(branches, path->level, after.splits && goes_on, &after.other);
    end_branch(tracer, path, live && !leads, &after.next);
    cut_branch(tracer, path, cut, &after.next);
    cut_branch(tracer, path, after.splits && cut, &after.other);
    const Mask popped = pop_branches(branches, live && !goes_on, &path->level, &after.next);
    *ray = after.next.ray;
    ray->active = goes_on || popped;
    path->weight = ray->active ? after.next.weight : 0.0f;
    path->tint = after.next.tint;
    return any_lane(ray->active);
}
