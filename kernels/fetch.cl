// SPDX-License-Identifier: MIT
// Reads the scene's data for the hits of a packet, lane by lane. If all lanes need the same record,
// which is common for large triangles and for materials, it is read only once.
#ifndef CLRT_FETCH_CL
#define CLRT_FETCH_CL
#include "ray.cl"
#include "sphere.cl"

typedef struct {
    UInt material; // index
    UInt normals;  // index of the vertex normals, NOTHING for flat triangles
    UInt colors;   // index of the vertex colors, NOTHING without them
} Look;

// The address of a record of words, for each lane.
typedef struct {
    global const uint *words;
    UInt place;
    bool shared; // all lanes have the same address
} Record;

#if CLRT_LANES == 1
static inline Record record_at(global const void *words, UInt place)
{
    return (Record){(global const uint *)words + place, 0, true};
}
#else
static inline Record record_at(global const void *words, UInt place)
{
    global const uint *start = (global const uint *)words;
    if (any_lane(place != (UInt)(place.s0)))
        return (Record){start, place, false};
    return (Record){start + place.s0, place, true};
}
#endif

static inline UInt record_word(const Record *record, uint offset)
{
    if (record->shared)
        return (UInt)(record->words[offset]);
    return gather(record->words + offset, record->place);
}

static inline Real record_real(const Record *record, uint offset)
{
    return stored_real(record_word(record, offset));
}

static inline Real3 record_real3(const Record *record, uint offset, uint stride)
{
    return real3_of(record_real(record, offset), record_real(record, offset + stride),
                    record_real(record, offset + 2 * stride));
}

#define WORDS(type) ((uint)(sizeof(type) / sizeof(uint)))

// `index` is a triangle's position in the array or, with wide nodes, block * WIDE + slot.
static inline Corners fetch_corners(const Tracer *tracer, UInt index)
{
#if CLRT_WIDE_NODES
    const UInt place = (index / WIDE) * WORDS(TriangleBlock) + index % WIDE;
    const uint stride = WIDE, corner = 3 * WIDE;
#else
    const UInt place = index * WORDS(TriangleData);
    const uint stride = 1, corner = 4;
#endif
    const Record record = record_at(tracer->triangles, place);
    return (Corners){record_real3(&record, 0, stride), record_real3(&record, corner, stride),
                     record_real3(&record, 2 * corner, stride)};
}

// Returns the corners of one triangle, equal in all lanes.
static inline Corners triangle_corners(const Tracer *tracer, uint index)
{
#if CLRT_WIDE_NODES
    global const float *words = tracer->triangles[index / WIDE].corners[0][0] + index % WIDE;
    const uint stride = WIDE, corner = 3 * WIDE;
#else
    global const float *words = tracer->triangles[index].a;
    const uint stride = 1, corner = 4;
#endif
    global const float *b = words + corner, *c = b + corner;
    return (Corners){real3_of(words[0], words[stride], words[2 * stride]),
                     real3_of(b[0], b[stride], b[2 * stride]),
                     real3_of(c[0], c[stride], c[2 * stride])};
}

// Returns whether sorting has swapped the front and the back of a triangle.
static inline Mask fetch_reversed(const Tracer *tracer, UInt index)
{
#if CLRT_WIDE_NODES
    const UInt place = (index / WIDE) * WORDS(TriangleBlock) + index % WIDE;
    const Record record = record_at(tracer->triangles, place + 9 * WIDE); // the row of ids
    return (record_word(&record, 0) & TRIANGLE_REVERSED) != 0;
#else
    return (tracer->triangles[index].material & TRIANGLE_REVERSED) != 0;
#endif
}

// Decodes a shading word (TRIANGLE_COLORED in shared.h).
static inline Look look_of(const Tracer *tracer, UInt material, UInt shading)
{
    Look look = {material, shading, (UInt)(NOTHING)};
    const Mask colored = shading != NOTHING && (shading & TRIANGLE_COLORED) != 0;
    if (!CLRT_COLORS || !any_lane(colored))
        return look;
    const UInt colors = shading & ~TRIANGLE_COLORED;
    look.colors = colored ? colors : look.colors;
    const Record record =
        record_at(tracer->colors, (colored ? colors : (UInt)(0)) * WORDS(CornerColors));
    look.normals = colored ? record_word(&record, 9) : shading;
    return look;
}

static inline Look fetch_look(const Tracer *tracer, const Hit *hit)
{
#if CLRT_WIDE_NODES
    const UInt number = hit->id - tracer->frame->sphere_count;
    const Record record = record_at(tracer->looks, number * WORDS(TriangleLook));
    return look_of(tracer, record_word(&record, 0), record_word(&record, 1));
#else
    const Record record = record_at(tracer->triangles, hit->index * WORDS(TriangleData));
    return look_of(tracer, record_word(&record, 7) & ~TRIANGLE_MARKS, record_word(&record, 11));
#endif
}

static inline Corners fetch_normals(const Tracer *tracer, UInt normals)
{
    const Record record = record_at(tracer->normals, normals * WORDS(CornerNormals));
    return (Corners){record_real3(&record, 0, 1), record_real3(&record, 4, 1),
                     record_real3(&record, 8, 1)};
}

static inline Corners fetch_colors(const Tracer *tracer, UInt colors)
{
    const Record record = record_at(tracer->colors, colors * WORDS(CornerColors));
    return (Corners){record_real3(&record, 0, 1), record_real3(&record, 3, 1),
                     record_real3(&record, 6, 1)};
}

static inline Sphere fetch_sphere(const Tracer *tracer, UInt index)
{
    const Record record = record_at(tracer->spheres, index * WORDS(SphereData));
    const Real3 high = record_real3(&record, 0, 1), low = record_real3(&record, 4, 1);
    return (Sphere){
        {two_stored(high.x, low.x), two_stored(high.y, low.y), two_stored(high.z, low.z)},
        two_stored(record_real(&record, 3), record_real(&record, 7))};
}

static inline UInt fetch_sphere_material(const Tracer *tracer, UInt index)
{
    const Record record = record_at(tracer->spheres, index * WORDS(SphereData));
    return record_word(&record, 8);
}

typedef struct {
    Real3 diffuse, specular;
    Real kd, ks, shininess, reflectivity;
    UInt shader, exponent;
} MaterialLanes;

static inline MaterialLanes fetch_material(const Tracer *tracer, UInt material)
{
    const Record record = record_at(tracer->materials, material * WORDS(Material));
    return (MaterialLanes){.diffuse = record_real3(&record, 0, 1),
                           .kd = record_real(&record, 3),
                           .specular = record_real3(&record, 4, 1),
                           .ks = record_real(&record, 7),
                           .shader = record_word(&record, 8),
                           .exponent = record_word(&record, 9),
                           .shininess = record_real(&record, 10),
                           .reflectivity = record_real(&record, 11)};
}

#endif
