// SPDX-License-Identifier: MIT
// The vocabulary host and kernels share: compiled twice, as C17 and as OpenCL C, and meaning the
// same bytes in both.  Members are float, uint, ulong and arrays of them; every struct is a
// multiple of 8 bytes, so that arrays of it keep that alignment.  tests/kernel measures the layout
// on the device.  All positions are in the normalized frame (host/scene/normalize.h).
#ifndef CLRT_SHARED_H
#define CLRT_SHARED_H

#ifdef __OPENCL_C_VERSION__
#define CLRT_SAME_SIZE(type, bytes)
#else
#include <stdint.h>
typedef uint32_t uint;
typedef uint64_t ulong;
#define CLRT_SAME_SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), #type);
#endif

// The id of no primitive.  Ids number spheres in file order, then triangles in file order.
#define NOTHING 0xffffffffu

// Entries of the traversal stack.  Depth-first descent keeps one waiting sibling a level, and
// pushes the child it enters next as well; builders keep trees within BVH_MAX_DEPTH levels.
#define BVH_MAX_DEPTH  62
#define BVH_STACK_SIZE (BVH_MAX_DEPTH + 2)

// How far boxes and origins are grown, relative to their largest coordinate: 128 units of rounding
// (2^-24).  A triangle that triangle.cl accepts lies within 22 units of the ray, 16 more where t is
// only within its error of zero, and the slab arithmetic adds 4; where division is only good to
// 2.5 ulp these are 34, 25 and 8.  Measured, twice the slack costs nothing.
#define BVH_SLACK 0x1p-17f

typedef enum { SHADER_SILHOUETTE, SHADER_MATTE, SHADER_BLINN_PHONG } Shader;

// Color seen = (1 - reflectivity) * clamp(shaded) + reflectivity * reflected.
typedef struct {
    float diffuse[3];
    float kd;
    float specular[3];
    float ks;
    uint shader;   // a Shader
    uint exponent; // the shininess where it is an integer up to 1024, else UINT_MAX
    float shininess;
    float reflectivity;
} Material;
CLRT_SAME_SIZE(Material, 48)

typedef struct {
    float position[3];
    float intensity;
} PointLight;
CLRT_SAME_SIZE(PointLight, 16)

// Center and radius as unevaluated sums high + low, 48 bits of each.
typedef struct {
    float center[3];
    float radius;
    float center_low[3];
    float radius_low;
    uint material;
    uint padding[3]; // keeps the array stride a multiple of 16
} SphereData;
CLRT_SAME_SIZE(SphereData, 48)

// A triangle's corners as they are tested, in the order of the leaves.  The host sorts the corners
// by their coordinates, so triangles with the same three corners are stored as the same bits, in
// whatever order their files list them.  Every kernel computes a distance from the ray and these
// bits alone, by the same operations, so the distances of such triangles are equal.  The marks only
// decide whether a ray meets a triangle, and the lowest id wins among those that it meets.
typedef struct {
    float a[3];
    uint id;
    float b[3];
    uint material; // index and marks
    float c[3];
    uint normals; // index of its CornerNormals, NOTHING where it is flat
} TriangleData;
CLRT_SAME_SIZE(TriangleData, 48)

// The marks of a triangle, in the highest bits of a word beside an index or id.
#define TRIANGLE_TWO_SIDED 0x80000000u
#define TRIANGLE_REVERSED  0x40000000u // sorting has swapped front and back
#define TRIANGLE_MARKS     (TRIANGLE_TWO_SIDED | TRIANGLE_REVERSED)

// Vertex normals of a smooth triangle, corner by corner as these are stored, of a common arbitrary
// length.  They point to the stored front: those of a reversed triangle are negated.
typedef struct {
    float normals[3][4]; // the fourth component is zero: keeps each vector 16 bytes
} CornerNormals;
CLRT_SAME_SIZE(CornerNormals, 48)

// An inner node holds both its children's boxes, axis by axis as {low, high} planes, so that one
// read decides about both.  A child with a count is a leaf: triangles [first, first + count);
// one without is the inner node `first`.  A missing child has an inverted box, which no ray meets.
typedef struct {
    float planes[3][2][2]; // [axis][low, high][child], grown by the slack of traverse.cl
    uint first[2];
    uint count[2];
} BvhPair;
CLRT_SAME_SIZE(BvhPair, 64)

// A work-item of the packet family renders PACKET_SIDE x PACKET_SIDE pixels.
#define PACKET_SIDE 4

// Children of a wide node, and triangles of a block: one 256-bit vector of floats.
#define WIDE 8

// An inner node of the wide tree: its children's boxes side by side, so that one instruction tests
// a plane of all.  A child is the index of an inner node, or with WIDE_LEAF set that of a block.
// The children that are there come first; the boxes of missing ones are inverted.
typedef struct {
    float planes[3][2][WIDE]; // [axis][low, high][child], grown by the slack of traverse.cl
    uint child[WIDE];
    uint child_count;
    uint padding[7]; // keeps nodes on cache lines of 64 bytes
} BvhWide;
CLRT_SAME_SIZE(BvhWide, 256)
#define WIDE_LEAF 0x80000000u

// A leaf of the wide tree: up to WIDE triangles, component by component.  Places without a
// triangle hold three corners at the origin, which no ray meets, and the id NOTHING.
typedef struct {
    float corners[3][3][WIDE]; // [corner][axis][triangle]
    uint id[WIDE];             // and marks
} TriangleBlock;
CLRT_SAME_SIZE(TriangleBlock, 320)

// What shading a triangle of a block takes beside its corners, by triangle in file order.
typedef struct {
    uint material; // index
    uint normals;  // index of its CornerNormals, NOTHING where it is flat
} TriangleLook;
CLRT_SAME_SIZE(TriangleLook, 8)

// A camera ray's direction is forward + x * right_step + y * down_step, where x and y are the odd
// numbers 2 * sample + 1 - samples across the picture: exact in float and mirror symmetric.
typedef struct {
    float eye[4];
    float forward[4];
    float right_step[4];
    float down_step[4];
} CameraData;
CLRT_SAME_SIZE(CameraData, 64)

// Everything about one tile of one picture that is no array.
typedef struct {
    CameraData camera;
    float background[3];
    float ambient;
    uint width, height; // of the whole picture, in pixels
    uint samples;       // per pixel and axis
    uint max_level;     // rays of this level return the background
    uint tile_x, tile_y, tile_width, tile_height;
    uint light_count, sphere_count, triangle_count;
    uint uses_bvh; // zero tests every triangle
} FrameData;
CLRT_SAME_SIZE(FrameData, 128)

// What a camera ray saw: its color, and a number that differs where it met another surface or
// other lights reach one.
typedef struct {
    float color[3];
    uint signature;
} SampleData;
CLRT_SAME_SIZE(SampleData, 16)

// Sub-pixels along a side of a pixel whose samples are summed.  A power of two: the sample at the
// center is then that of a picture with one sample a pixel, bit for bit.
#define LADDER_GRID 1024

// The most samples that a request takes of its pixel, which can have LADDER_GRID.
#define REQUEST_SAMPLES 16

// A request for samples of a pixel: 1 at its center, or the first 4 or REQUEST_SAMPLES points of a
// sequence, whose coordinates are XORed with the two digits of offset to the base LADDER_GRID.
typedef struct {
    uint x, y;
    uint offset;
    uint samples;
} PixelRequest;
CLRT_SAME_SIZE(PixelRequest, 16)

// Sums over these samples: of colors in steps of 2^-32, and of the squares of all three values in
// steps of 2^-48.
typedef struct {
    ulong colors[3];
    ulong squares;
} PixelSums;
CLRT_SAME_SIZE(PixelSums, 32)

// How sure the decisions of a pixel's ray trees are: what is met, and which lights are seen.
typedef enum {
    CERTAINTY_OPEN,      // one of them may differ from what real arithmetic decides
    CERTAINTY_REPAIRED,  // they are real arithmetic's in fp64
    CERTAINTY_CERTIFIED, // and in fp32 too
    CERTAINTY_KINDS
} Certainty;

// What certify.cl finds out about a pixel, by its last sample; decisions that are not certain are
// not to be read.
typedef struct {
    uint certainty; // a Certainty
    uint first_id;  // of what the camera ray meets, or NOTHING
    uint lit;       // a bit for each of the first 32 lights that shine on it
    uint signature; // of all decisions of the ray tree
} CertaintyMark;
CLRT_SAME_SIZE(CertaintyMark, 16)

// What one pixel cost, where statistics are asked for.
typedef enum {
    TALLY_CAMERA_RAYS,
    TALLY_SHADOW_RAYS,
    TALLY_REFLECTED_RAYS,
    TALLY_SHADED_POINTS,
    TALLY_CAMERA_HITS,
    TALLY_TRIANGLE_TESTS,
    TALLY_BOX_TESTS,
    TALLY_SPHERE_TESTS,
    TALLY_KINDS
} TallyKind;

// What the ray through a pixel's center meets first and where it goes, where channels beside the
// color are asked for.  Where it meets nothing, depth is INFINITY, the indices are NOTHING and all
// else is zero.
typedef struct {
    float point[3];
    float depth;     // along the camera's axis
    float normal[3]; // unit, what is shaded with
    uint primitive;  // id
    uint material;   // index
    uint lights;     // that reach the point
    uint bounces;    // reflected rays followed from there
    uint padding;
} PathData;
CLRT_SAME_SIZE(PathData, 48)

// What --explain-pixel is told of each ray of a path: LEVEL_VALUES numbers of the kernel's
// precision and LEVEL_WORDS words, and behind these, for each light, LIGHT_VALUES and LIGHT_WORDS.
// Vectors take three places.
typedef enum {
    LEVEL_ORIGIN = 0,
    LEVEL_DIRECTION = 3,
    LEVEL_T = 6,     // INFINITY where nothing is met, and then only what stands above is told
    LEVEL_ERROR = 7, // how far t may be off
    LEVEL_POINT = 8,
    LEVEL_NORMAL = 11,
    LEVEL_SHADED = 14, // the surface's own color
    LEVEL_WEIGHT = 17, // of what the ray sees, in the sample's color; told of all
    LEVEL_SHARE = 18,  // of the surface's own color in it
    LEVEL_VALUES = 19
} LevelValue;

typedef enum { LEVEL_PRIMITIVE, LEVEL_MATERIAL, LEVEL_WORDS } LevelWord;

typedef enum {
    LIGHT_COSINE,    // between the normal and the way to the light
    LIGHT_BLOCKER_T, // part of that way
    LIGHT_DIFFUSE,   // received
    LIGHT_SPECULAR,
    LIGHT_VALUES
} LightValue;

typedef enum { LIGHT_STATE, LIGHT_BLOCKER, LIGHT_WORDS } LightWord;

// Whether a light reaches a surface.
typedef enum {
    LIGHT_BEHIND, // the shading normal is turned away from it
    LIGHT_SEEN,
    LIGHT_BLOCKED,
    LIGHT_BEHIND_FACE // the face is turned away from it, the shading normal is not
} LightState;

#endif
