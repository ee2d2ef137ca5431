// SPDX-License-Identifier: MIT
// Groups the rays of a work-item into beams (compare Boulos et al., "Packet-based Whitted and
// distribution ray tracing", 2007).
//
// Camera rays fill their packets. After a reflection or at the edge of a shadow, only some lanes of
// a packet are active, and neighboring rays may point into different octants. However, a packet
// takes as long with one active lane as with all lanes, and bounds cull only if all rays point into
// one octant. The rays of each octant are therefore collected from partly filled packets into full
// packets, which form a beam. Afterwards, the hits are copied back to the original lanes.
//
// Invariant: a ray's hit does not depend on the other rays, because beams only cull, and every lane
// accepts triangles by the same operations. Grouping therefore changes no bit of the picture.
#ifndef CLRT_REGROUP_CL
#define CLRT_REGROUP_CL
#include "beam_walk.cl"
#include "lane_moves.cl"

#if CLRT_WIDE_NODES

// Groups of fewer rays are traced ray by ray, which is faster.
#define SMALLEST_BEAM 6

// The words of a ray in a list: the ray, the primitive on which it starts, and its hit.
enum {
    WORD_ORIGIN = 0,
    WORD_DIRECTION = 3,
    WORD_OWN = 6,
    WORD_OWN_INDEX,
    WORD_T,
    WORD_ID,
    WORD_INDEX,
#if CLRT_ALL_HITS
    WORD_NUMBER,
#endif
    RAY_WORDS
};

// A list of rays. words[i] has word i of all rays.
typedef struct {
    uint words[RAY_WORDS][(PACKETS + 1) * CLRT_LANES];
    uint count;
} RayList;

static inline UInt list_read(const RayList *list, uint word, uint place)
{
    return FOR_LANES(vload)(0, list->words[word] + place);
}

static inline void list_write(RayList *list, uint word, uint place, UInt value)
{
    FOR_LANES(vstore)(value, 0, list->words[word] + place);
}

static inline Real3 list_read3(const RayList *list, uint word, uint place)
{
    return real3_of(as_real(list_read(list, word, place)),
                    as_real(list_read(list, word + 1, place)),
                    as_real(list_read(list, word + 2, place)));
}

static inline void list_append3(RayList *list, uint word, Real3 v, LaneChoice chosen)
{
    list_write(list, word, list->count, compressed(as_bits(v.x), chosen));
    list_write(list, word + 1, list->count, compressed(as_bits(v.y), chosen));
    list_write(list, word + 2, list->count, compressed(as_bits(v.z), chosen));
}

// Appends the rays of the lanes whose bits are set, with their hits.
static inline void list_append(RayList *list, const Ray *ray, const Hit *hit, uint bits)
{
    const LaneChoice chosen = lane_choice(bits);
    list_append3(list, WORD_ORIGIN, ray->origin, chosen);
    list_append3(list, WORD_DIRECTION, ray->direction, chosen);
    list_write(list, WORD_OWN, list->count, compressed(ray->own, chosen));
    list_write(list, WORD_OWN_INDEX, list->count, compressed(ray->own_index, chosen));
    list_write(list, WORD_T, list->count, compressed(as_bits(hit->t), chosen));
    list_write(list, WORD_ID, list->count, compressed(hit->id, chosen));
    list_write(list, WORD_INDEX, list->count, compressed(hit->index, chosen));
#if CLRT_ALL_HITS
    list_write(list, WORD_NUMBER, list->count, compressed(ray->number, chosen));
#endif
    list->count += popcount(bits);
}

// Fills the last packet's unused lanes with copies of the first ray.
static inline void list_fill(RayList *list)
{
    for (uint word = 0; word < RAY_WORDS; word++)
        list_write(list, word, list->count, (UInt)(list->words[word][0]));
}

// Returns the packet of rays that starts at `place` in the list.
static inline Ray list_ray(const RayList *list, uint place, RayKind kind)
{
    const uint left = list->count - place;
    const uint bits = left < CLRT_LANES ? (1u << left) - 1 : ALL_LANES;
    Ray ray = {list_read3(list, WORD_ORIGIN, place),
               list_read3(list, WORD_DIRECTION, place),
               list_read(list, WORD_OWN, place),
               list_read(list, WORD_OWN_INDEX, place),
               kind,
               lanes_of(bits)};
#if CLRT_ALL_HITS
    ray.number = list_read(list, WORD_NUMBER, place);
#endif
    return ray;
}

static inline Hit list_hit(const RayList *list, uint place)
{
    return (Hit){as_real(list_read(list, WORD_T, place)), list_read(list, WORD_ID, place),
                 list_read(list, WORD_INDEX, place)};
}

static inline void list_write_hit(RayList *list, uint place, const Hit *hit)
{
    list_write(list, WORD_T, place, as_bits(hit->t));
    list_write(list, WORD_ID, place, hit->id);
    list_write(list, WORD_INDEX, place, hit->index);
}

// Moves hits back to the lanes from which list_append took the rays at `place`.
static inline void list_return(const RayList *list, uint place, uint bits, Hit *hit)
{
    hit->t = as_real(expanded(list_read(list, WORD_T, place), bits, as_bits(hit->t)));
    hit->id = expanded(list_read(list, WORD_ID, place), bits, hit->id);
    hit->index = expanded(list_read(list, WORD_INDEX, place), bits, hit->index);
}

// Rays that were moved into the packets of a beam.
typedef struct {
    RayList list;
    Ray rays[PACKETS];
    Hit hits[PACKETS];
} MovedRays;

static inline void move_rays(Beam *beam, MovedRays *moved, const Ray *rays,
                             const uint bits[PACKETS], const Hit *hits)
{
    RayList *list = &moved->list;
    RayKind kind = RAY_CAMERA;
    list->count = 0;
    for (uint i = 0; i < PACKETS; i++)
        if (bits[i] != 0) {
            list_append(list, &rays[i], &hits[i], bits[i]);
            kind = rays[i].kind;
        }
    list_fill(list);
    beam->count = (list->count + CLRT_LANES - 1) / CLRT_LANES;
    for (uint i = 0; i < beam->count; i++) {
        moved->rays[i] = list_ray(list, i * CLRT_LANES, kind);
        moved->hits[i] = list_hit(list, i * CLRT_LANES);
    }
}

// Moves the beam's hits back to the lanes that the rays came from.
static inline void return_hits(const Beam *beam, MovedRays *moved, const uint bits[PACKETS],
                               Hit *hits)
{
    uint place = 0;
    for (uint i = 0; i < beam->count; i++)
        list_write_hit(&moved->list, i * CLRT_LANES, &moved->hits[i]);
    for (uint i = 0; i < PACKETS; i++) {
        if (bits[i] != 0)
            list_return(&moved->list, place, bits[i], &hits[i]);
        place += popcount(bits[i]);
    }
}

// A group of rays: bits of its lanes, and whether each ray searches alone.
typedef struct {
    uint bits[PACKETS];
    uint size; // rays
    bool alone;
} RayGroup;

static NOT_INLINE void search_group(const Tracer *tracer, const Ray *rays, const RayGroup *group,
                                    Hit *hits)
{
    MovedRays moved;
    Beam beam;
    beam.hits = moved.hits;
    move_rays(&beam, &moved, rays, group->bits, hits);
    search_beam(&beam, tracer, moved.rays, group->alone);
    return_hits(&beam, &moved, group->bits, hits);
}

// Returns a bit for each lane whose sign is set.
static inline uint sign_bits(Real v)
{
    return lane_bits(sign_bit(v) != 0);
}

// Returns whether all lanes of PACKETS packets search, and all rays point into one octant.
static inline bool are_one_beam(const Ray *rays, const uint *wanted, uint count)
{
    const Real3 first = rays->direction;
    uint all = count == PACKETS ? ALL_LANES : 0;
    UInt differing = 0;
    for (uint i = 0; i < count; i++) {
        const Real3 direction = rays[i].direction;
        all &= wanted[i];
        differing |= as_bits(direction.x) ^ (UInt)(lane_uint((const UInt *)&first.x, 0));
        differing |= as_bits(direction.y) ^ (UInt)(lane_uint((const UInt *)&first.y, 0));
        differing |= as_bits(direction.z) ^ (UInt)(lane_uint((const UInt *)&first.z, 0));
    }
    return all == ALL_LANES && sign_bits(as_real(differing)) == 0;
}

// Finds the hits of rays that fill a beam. These rays need not be moved.
static inline void search_full(const Tracer *tracer, const Ray *rays, Hit *hits)
{
    Beam beam;
    beam.count = PACKETS;
    beam.hits = hits;
    search_beam(&beam, tracer, rays, false);
}

// The octants of rays' directions: for each axis, bits of the lanes whose direction is negative.
typedef struct {
    uint negative[3];
} Octants;

static inline Octants octants_of(Real3 direction)
{
    return (Octants){{sign_bits(direction.x), sign_bits(direction.y), sign_bits(direction.z)}};
}

// Returns the lanes whose directions have the signs `signs`.
static inline uint lanes_in_octant(const Octants *octants, uint signs)
{
    uint bits = ~0u;
    for (uint axis = 0; axis < 3; axis++)
        bits &= signs >> axis & 1 ? octants->negative[axis] : ~octants->negative[axis];
    return bits;
}

// Returns the signs of a lane's octant: a bit for each axis.
static inline uint octant_of_lane(const Octants *octants, uint lane)
{
    return (octants->negative[0] >> lane & 1) | (octants->negative[1] >> lane & 1) << 1 |
           (octants->negative[2] >> lane & 1) << 2;
}

// Rays that have not searched yet.
typedef struct {
    Octants octants[PACKETS];
    uint left[PACKETS];  // bits of the lanes in no group yet
    uint small[PACKETS]; // bits of the lanes in groups that are too small for a beam
    uint count;          // packets
} Ungrouped;

// Takes the rays of one octant. Returns false if no rays are left.
static inline bool take_octant(Ungrouped *rays, RayGroup *group)
{
    uint first = 0;
    while (first < rays->count && rays->left[first] == 0)
        first++;
    if (first == rays->count)
        return false;
    const uint signs = octant_of_lane(&rays->octants[first], lowest_bit(rays->left[first]));
    *group = (RayGroup){.alone = false};
    for (uint i = first; i < rays->count; i++) {
        group->bits[i] = rays->left[i] & lanes_in_octant(&rays->octants[i], signs);
        group->size += popcount(group->bits[i]);
        rays->left[i] &= ~group->bits[i];
    }
    return true;
}

// Takes an octant with at least `smallest` rays as the next group. If no such octant is left, takes
// all remaining rays, and each of them searches alone. Returns false if no rays are left.
static inline bool take_group(Ungrouped *rays, uint smallest, RayGroup *group)
{
    while (take_octant(rays, group)) {
        if (group->size >= smallest)
            return true;
        for (uint i = 0; i < rays->count; i++)
            rays->small[i] |= group->bits[i];
    }
    *group = (RayGroup){.alone = true};
    for (uint i = 0; i < rays->count; i++) {
        group->bits[i] = rays->small[i];
        group->size += popcount(rays->small[i]);
        rays->small[i] = 0;
    }
    return group->size != 0;
}

// If origins or directions differ by more than this, beams are slower than single rays. For random
// rays in 5, 82 and 1300 thousand triangles, single rays save about 45, 35 and 40 % of the time.
// Compared with 1.5 in pictures, limits of 0.5 and 1 are faster in some scenes, but up to 6 and 3 %
// slower in others.
#define LARGEST_SPREAD (CLRT_RAYS ? 0.5f : 1.5f)

// Glass of fewer triangles scatters less, so beams trace all of its rays. With 96 to 320 triangles
// and a LARGEST_SPREAD of 0.5, rays that are traced one by one take 6 to 23 % longer than beams.
#define FEWEST_SCATTERING 1000

static inline Real3 first_real3(Real3 v, Mask among)
{
    return real3_of(first_real(v.x, among), first_real(v.y, among), first_real(v.z, among));
}

// Returns whether rays may differ so much that single rays are faster: random rays of arrays
// (rays.cl), and rays that glass scatters.
static inline bool may_scatter(const Tracer *tracer)
{
    if (CLRT_RAYS)
        return true;
    if (CLRT_LANES != 8)
        return false;
    return CLRT_GLASS && tracer->frame->triangle_count >= FEWEST_SCATTERING;
}

// Returns whether the rays of the lanes selected by `wanted` are probably traced faster as a beam
// than ray by ray. Both ways find the same hits. At least one lane must be selected. In pictures,
// only reflected and refracted rays are compared. Their directions have a length of about 1. The
// library scales the directions of its rays until the largest component is in [1, 2).
static inline bool are_coherent(const Ray *rays, const uint *wanted, uint count)
{
    uint first = 0;
    while (wanted[first] == 0)
        first++;
    if (!CLRT_RAYS && rays[first].kind != RAY_REFLECTED)
        return true;
    const Mask lanes = lanes_of(wanted[first]);
    const Real3 origin = first_real3(rays[first].origin, lanes);
    const Real3 direction = first_real3(rays[first].direction, lanes);
    for (uint i = first; i < count; i++) {
        const Real apart = max(largest_component(difference(rays[i].origin, origin)),
                               largest_component(difference(rays[i].direction, direction)));
        if ((lane_bits(apart > LARGEST_SPREAD) & wanted[i]) != 0)
            return false;
    }
    return true;
}

// Finds the hits of the lanes selected by `wanted`, ray by ray. Each tree of the scene is searched.
static inline void search_lanes(const Tracer *tracer, const Ray *ray, uint wanted, Hit *hit)
{
    Search search = search_along(tracer, ray, hit->t);
    SpherePairs pairs;
    if (has_sphere_tree(tracer)) {
        start_pairs(&pairs, tracer, ray, hit);
        intersect_lanes(&search, wanted, tracer->frame->sphere_root, hit, &pairs);
        finish_pairs(&pairs);
        search.limit = hit->t;
        if (ends_at_any_hit(ray->kind))
            wanted &= lane_bits(hit->id == NOTHING);
    }
    if (CLRT_TRIANGLES && tracer->frame->uses_bvh)
        intersect_lanes(&search, wanted, 0, hit, &pairs);
}

// Finds the hits of the lanes selected by `wanted`, in `count` packets.
static NOT_INLINE void search_beams(const Tracer *tracer, const Ray *rays, const uint *wanted,
                                    uint count, Hit *hits)
{
    const bool has_tree = CLRT_BVH && (tracer->frame->uses_bvh || has_sphere_tree(tracer));
    const bool alone = !CLRT_PACKET || (may_scatter(tracer) && !are_coherent(rays, wanted, count));
    if (has_tree && alone) {
        for (uint i = 0; i < count; i++)
            if (wanted[i] != 0)
                search_lanes(tracer, &rays[i], wanted[i], &hits[i]);
        return;
    }
    if (are_one_beam(rays, wanted, count)) {
        search_full(tracer, rays, hits);
        return;
    }
    Ungrouped ungrouped = {.count = count};
    for (uint i = 0; i < count; i++) {
        ungrouped.left[i] = wanted[i];
        if (wanted[i] != 0)
            ungrouped.octants[i] = octants_of(rays[i].direction);
    }
    RayGroup group;
    while (take_group(&ungrouped, has_tree ? SMALLEST_BEAM : 1, &group))
        search_group(tracer, rays, &group, hits);
}

#endif
#endif
