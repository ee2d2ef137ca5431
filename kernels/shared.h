// SPDX-License-Identifier: MIT
// The types and constants that host and kernels share. All positions are in normalized coordinates
// (host/scene/normalize.h).
//
// Invariant: this file compiles as C17 and as OpenCL C, with the same memory layout. Members are
// float, uint and ulong, arrays of these, and structs. The size of every struct is a multiple of 4
// bytes, or of 8 if it has a ulong, which keeps array elements aligned. tests/kernel measures the
// layout on the device.
#ifndef CLRT_SHARED_H
#define CLRT_SHARED_H

#ifdef __OPENCL_C_VERSION__
#define CLRT_SAME_SIZE(type, bytes)
#define CLRT_ALIGNED __attribute__((aligned(16))) // so that GPUs read 16 bytes at once
#else
#include <stdint.h>
typedef uint32_t uint;
typedef uint64_t ulong;
#define CLRT_ALIGNED
#define CLRT_SAME_SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), #type);
#endif

// The id of no primitive. Ids number the spheres, then the triangles, each in file order.
#define NOTHING 0xffffffffu

// Builders limit trees to BVH_MAX_DEPTH levels. The traversal stack of a binary tree has
// BVH_STACK_SIZE entries. A search keeps one pending sibling per level. On CPUs, it also pushes the
// child that it enters next.
#define BVH_MAX_DEPTH  62
#define BVH_STACK_SIZE (BVH_MAX_DEPTH + 2)

// Boxes grow and origins move by this fraction of their largest coordinate. The fraction is 256
// units of 2^-24. A triangle that triangle.inc.cl accepts is within 22 units of the ray (B8 of
// docs/numerics.md), and the slab arithmetic adds 4 (B9). If division is only accurate to 2.5 ulp,
// 22 and 4 become 34 and 8.
//
// The error of a hit's distance can put the hit up to 54 units behind the ray's start, and
// search_behind allows another 256 units. A box at the start has nearly the origin's coordinates,
// so the box grows as far as the origin moves. The growth and the move each cover half of these 256
// units. Each must cover at most 34 + 8 + 54 + 128 = 224 units. search_reach (search.cl) covers
// hits beyond the best hit. Boxes of spheres need less (B22). Twice the slack takes no longer.
#define BVH_SLACK 0x1p-16f

// The box around all primitives grows by this fraction of its largest coordinate. Kernels grow the
// box again, by this fraction of its largest coordinate relative to the eye. Rays that miss the
// grown box hit nothing (docs/numerics.md, B17).
#define SKY_SLACK 0x1p-12f

// Lights shade surfaces for which IS_SHADED is true.
typedef enum { SHADER_SILHOUETTE, SHADER_MATTE, SHADER_BLINN_PHONG, SHADER_GLASS } Shader;
#define IS_SHADED(shader) ((shader) == SHADER_MATTE || (shader) == SHADER_BLINN_PHONG)

// The most levels of a path in a scene with glass: the slots of its stack (branches.cl).
#define GLASS_LEVELS 16

// Color seen = (1 - reflectivity) * clamp(shaded) + reflectivity * reflected. With a checker, cubes
// fill the scene, and checks[0] or checks[1] replaces the diffuse color in even or odd cubes. The
// cube of a normalized point p is floor(check_rate * p + check_shift) on each axis. The host sets
// check_rate and check_shift for the device (host/scene/normalize.c). Glass has the reflectivity 1.
// It uses only the index of refraction and the diffuse color, which tints refracted light.
typedef struct {
    float diffuse[3];
    float kd;
    float specular[3];
    float ks;
    uint shader;   // a Shader
    uint exponent; // the shininess if it is an integer up to 1024, else UINT_MAX
    float shininess;
    float reflectivity;
    float check_size; // side of a cube in scene units; 0 for no checker
    float checks[2][3];
    float check_rate;
    float check_shift[3];
    float ior; // of glass: the index of refraction, inside over outside
} CLRT_ALIGNED Material;
CLRT_SAME_SIZE(Material, 96)

typedef struct {
    float position[3];
    float intensity;
    float color[3];
    float unused;
} CLRT_ALIGNED PointLight;
CLRT_SAME_SIZE(PointLight, 32)

// Center and radius as unevaluated sums high + low, with 48 bits each. In the array, the scene's
// spheres come first. If they have a tree, its entries follow with pair nodes
// (host/accel/sphere_tree.c). With wide nodes, only its leaves follow, each as a SphereBlock.
typedef struct {
    float center[3];
    float radius;
    float center_low[3];
    float radius_low;
    uint material;
    uint id;   // only in the tree: the sphere's id; NOTHING for a bounding sphere
    uint next; // only for a bounding sphere: index of the entry after the spheres in it
    uint unused;
} CLRT_ALIGNED SphereData;
CLRT_SAME_SIZE(SphereData, 48)

// A triangle for the intersection test. The array is in leaf order. The host sorts the corners by
// their coordinates, so triangles with the same three corners store the same bits, regardless of
// the corners' order in the file. Every kernel computes t from only the ray and these bits, by the
// same operations. A ray therefore hits these triangles at equal t. The flags only decide whether
// the ray hits a triangle at all. Among the triangles that the ray hits, the lowest id wins.
typedef struct {
    float a[3];
    uint id;
    float b[3];
    uint material; // index and flags
    float c[3];
    uint shading; // see TRIANGLE_COLORED
} CLRT_ALIGNED TriangleData;
CLRT_SAME_SIZE(TriangleData, 48)

// A triangle's flags, in the highest bits of a word that also holds an index or id.
#define TRIANGLE_TWO_SIDED 0x80000000u
#define TRIANGLE_REVERSED  0x40000000u // sorting has swapped front and back
#define TRIANGLE_MARKS     (TRIANGLE_TWO_SIDED | TRIANGLE_REVERSED)

// A triangle's shading word is the index of its CornerNormals, or NOTHING if the triangle is flat.
// If a word other than NOTHING has this flag, its other bits are the index of the triangle's
// CornerColors. These contain a second shading word: an index of CornerNormals, or NOTHING.
#define TRIANGLE_COLORED 0x80000000u

// Vertex normals of a smooth triangle, in the stored order of its corners. Their lengths weight the
// interpolation. The host negates the normals of a reversed triangle.
typedef struct {
    float normals[3][4]; // the fourth component is zero and pads each vector to 16 bytes
} CLRT_ALIGNED CornerNormals;
CLRT_SAME_SIZE(CornerNormals, 48)

// Vertex colors of a triangle, in the stored order of its corners. They replace the diffuse color.
typedef struct {
    float colors[3][3];
    uint shading; // index of CornerNormals, or NOTHING
} CornerColors;
CLRT_SAME_SIZE(CornerColors, 40)

// An inner node. It contains the boxes of both children, so one read serves both tests. If a
// child's count is above 0, the child is a leaf with the triangles [first, first + count).
// Otherwise, it is the inner node `first`. A missing child has an inverted box, which no ray
// enters.
typedef struct {
    float planes[3][2][2]; // [axis][low, high][child], grown by BVH_SLACK
    uint first[2];
    uint count[2];
} CLRT_ALIGNED BvhPair;
CLRT_SAME_SIZE(BvhPair, 64)

// With wide nodes, a work-item renders BLOCK_SIDE x BLOCK_SIDE pixels.
#define BLOCK_SIDE 8

// The largest number of children in a wide node, and of triangles in a block. WIDE floats fill a
// vector of 256 bits.
#define WIDE 8

// An inner node of the wide tree. Its children's boxes are side by side, so one vector operation
// reads or tests the same plane of all boxes. A child is the index of an inner node or, if
// WIDE_LEAF is set, of a block. Present children come first; missing ones have inverted boxes.
typedef struct {
    float planes[3][2][WIDE]; // [axis][low, high][child], grown by BVH_SLACK
    uint child[WIDE];
    uint child_count;
    float level[3];  // for each axis: the coordinate of all triangles below, INFINITY if it varies
    uint padding[4]; // keeps nodes on cache lines of 64 bytes
} BvhWide;
CLRT_SAME_SIZE(BvhWide, 256)
#define WIDE_LEAF 0x80000000u

// A leaf of the wide tree over spheres has these bits and the number of a SphereBlock.
#define WIDE_SPHERES 0xc0000000u

// Up to WIDE spheres, with an array for each component that SphereData has too. An empty slot has
// the id NOTHING.
typedef struct {
    float center[3][WIDE], radius[WIDE];
    float center_low[3][WIDE], radius_low[WIDE];
    uint id[WIDE];
} SphereBlock;
CLRT_SAME_SIZE(SphereBlock, 288)

// The size of a SphereBlock, as a number of SphereData. The array of spheres ends with the blocks.
#define SPHERE_BLOCK_ENTRIES 6

// A leaf of the wide tree: up to WIDE triangles, component by component. An empty slot holds the id
// NOTHING and three corners at the origin. No ray hits such a triangle.
typedef struct {
    float corners[3][3][WIDE]; // [corner][axis][triangle]
    uint id[WIDE];             // and flags
} TriangleBlock;
CLRT_SAME_SIZE(TriangleBlock, 320)

// The data for shading a triangle of a block, besides its corners. The array has the triangles in
// the order of the file, although the blocks have the tree's order.
typedef struct {
    uint material; // index
    uint shading;  // see TRIANGLE_COLORED
} TriangleLook;
CLRT_SAME_SIZE(TriangleLook, 8)

// The rays of a perspective camera start at the eye, and their directions are
// forward + x * right_step + y * down_step. The rays of an orthographic camera have the direction
// forward, and start at eye + x * right_step + y * down_step. For sample i of n across the picture,
// x is 2 * i + 1 - n. y is analogous. Up to n = 2^24, these integers are exact floats.
typedef struct {
    float eye[3];
    uint orthographic; // 1 or 0
    float forward[4];
    float right_step[4];
    float down_step[4];
} CameraData;
CLRT_SAME_SIZE(CameraData, 64)

// The parameters of one tile of one picture, without the scene's arrays.
typedef struct {
    CameraData camera;
    float background[3];
    float ambient;
    uint width, height; // of the whole picture, in pixels
    uint samples;       // per pixel and axis
    uint max_level;     // the most levels of a path; further rays return the background
    uint tile_x, tile_y, tile_width, tile_height;
    uint light_count, sphere_count, triangle_count;
    uint sphere_entries;   // entries in the array of spheres; more than sphere_count with a tree
    uint sphere_root;      // the root of the wide tree over spheres; NOTHING if there is none
    uint uses_bvh;         // 0: every triangle is tested
    float low[3], high[3]; // a box around all primitives, with a margin (SKY_SLACK)
} FrameData;
CLRT_SAME_SIZE(FrameData, 160)

// A sample's position in sub-pixels of the whole picture.
typedef struct {
    uint x, y;
} SamplePlace;
CLRT_SAME_SIZE(SamplePlace, 8)

// A sample of a SamplePlace.
typedef struct {
    float color[3];
} SampleData;
CLRT_SAME_SIZE(SampleData, 12)

// Sub-pixels along a side of a pixel in pictures with goals. Because their number is a power of
// two, the sample at a pixel's center has the same bits as in a picture with one sample per pixel.
#define LADDER_GRID 1024

// The numbers of samples in small and in large requests. A pixel's requests together have up to
// LADDER_GRID samples.
#define SMALL_SAMPLES 4
#define LARGE_SAMPLES 16

// A request for SMALL_SAMPLES or LARGE_SAMPLES consecutive points of a pixel's sequence.
typedef struct {
    uint x, y;
    uint first; // number of the first point; a multiple of the number of points
} PixelRequest;
CLRT_SAME_SIZE(PixelRequest, 12)

// Sums over the samples of a request. Colors are in steps of 2^-32, and the squares of all three
// channels in steps of 2^-48.
typedef struct {
    ulong colors[3];
    ulong squares;
} PixelSums;
CLRT_SAME_SIZE(PixelSums, 32)

// The certainty of a pixel's decisions: which surfaces its rays hit, which lights reach them, and
// which squares of checkers they show.
typedef enum {
    CERTAINTY_OPEN,      // a decision may differ from the decision of real arithmetic
    CERTAINTY_REPAIRED,  // all decisions of fp64 equal the decisions of real arithmetic
    CERTAINTY_CERTIFIED, // all decisions of fp64 and fp32 equal the decisions of real arithmetic
    CERTAINTY_KINDS
} Certainty;

// The result of certify.cl for a pixel: its certainty and the decisions of its last sample. If the
// pixel is open, the decisions are not meaningful.
typedef struct {
    uint certainty; // a Certainty
    uint first_id;  // of the camera ray's hit, or NOTHING
    uint lit;       // bit i is set if light i reaches the hit, for i < 32
    uint signature; // hash of all decisions of the ray tree
} CertaintyMark;
CLRT_SAME_SIZE(CertaintyMark, 16)

// Indices of the counts in a tally. A tally has the counts of a pixel, a beam or a work-item.
typedef enum {
    TALLY_CAMERA_RAYS,
    TALLY_SHADOW_RAYS,
    TALLY_REFLECTED_RAYS,
    TALLY_SHADED_POINTS,
    TALLY_CAMERA_HITS,
    TALLY_TRIANGLE_TESTS,
    TALLY_BOX_TESTS,
    TALLY_SPHERE_TESTS,
    TALLY_CUT, // the low word and the high word of a sum over samples (branches.cl)
    TALLY_CUT_HIGH,
    TALLY_KINDS
} TallyKind;

// The first kind that kernels store. They store all kinds from this one on.
#define TALLY_FIRST(has_statistics) ((has_statistics) ? TALLY_CAMERA_RAYS : TALLY_CUT)

// The first hit of the ray through a pixel's center, and data on the path from there. Kernels write
// PathData only if channels are requested. Without a hit, `depth` is INFINITY, `primitive` and
// `material` are NOTHING, and all other members are zero.
typedef struct {
    float point[3];
    float depth;     // along the camera's axis
    float normal[3]; // unit, the shading normal
    uint primitive;  // id
    uint material;   // index
    uint lights;     // number of lights that reach the point
    uint bounces;    // levels of reflected or refracted rays after the hit
    uint padding;
} PathData;
CLRT_SAME_SIZE(PathData, 48)

// Consecutive rays origin + t * direction, for rays.cl. Each component has its own array, so the
// kernels read it as vectors. With an array of rays instead, gathering their components took 7 % of
// a call for camera rays.
#define RAY_BLOCK 64
typedef struct {
    float origin[3][RAY_BLOCK];
    float limit[RAY_BLOCK]; // the largest t of a hit; below 0 for no ray
    float direction[3][RAY_BLOCK];
    uint own[RAY_BLOCK];       // id of the primitive that the ray skips, or NOTHING
    uint own_index[RAY_BLOCK]; // index of that primitive if the ray starts on it, else NOTHING
    float doubt[RAY_BLOCK];    // only for certify_rays.cl: bound on the distance from origin to the
                               // exact start
} RayBlock;
CLRT_SAME_SIZE(RayBlock, 40 * RAY_BLOCK)

// Bits of the argument `kinds` of trace_rays (rays.cl).
#define RAY_ON_SURFACE 1 // some rays start on primitives; equals RAY_REFLECTED of ray.cl
#define RAY_ANY_HIT    4 // the rays end at any hit

typedef struct {
    float t; // INFINITY without a hit
    uint id; // NOTHING without a hit
} HitData;
CLRT_SAME_SIZE(HitData, 8)

// clrt explain stores a record for each ray of a path, in the order in which the kernels add the
// rays' colors. A record holds LEVEL_VALUES numbers of the kernel's precision and LEVEL_WORDS
// words. For each light, LIGHT_VALUES numbers and LIGHT_WORDS words follow. Vectors take three
// entries. HEAD_VALUES numbers and HEAD_WORDS words precede the records.
typedef enum {
    HEAD_COLOR = 0,      // of the sample, in steps of 2^-32
    HEAD_BACKGROUND = 3, // weight of the background that is added last
    HEAD_VALUES = 4
} HeadValue;

typedef enum { HEAD_RAYS, HEAD_WORDS } HeadWord;

typedef enum {
    LEVEL_ORIGIN = 0,
    LEVEL_DIRECTION = 3,
    LEVEL_WEIGHT = 6,  // of the ray's color in the sample's color
    LEVEL_TINT = 7,    // color of the glass on the path; multiplies LEVEL_WEIGHT and LEVEL_SHARE
    LEVEL_SHADED = 10, // the surface's own color or, without a hit, the background
    LEVEL_SHARE = 13,  // of LEVEL_SHADED in the sample's color
    LEVEL_T = 14,      // the entries from here on are invalid without a hit
    LEVEL_ERROR = 15,  // error bound of t
    LEVEL_POINT = 16,
    LEVEL_NORMAL = 19,
    LEVEL_DIFFUSE = 22,
    LEVEL_VALUES = 25
} LevelValue;

typedef enum {
    LEVEL_PRIMITIVE,
    LEVEL_MATERIAL,
    LEVEL_NUMBER,    // of the level, from 0 on
    LEVEL_REFRACTED, // 1 if the ray crosses the surface that it leaves
    LEVEL_WORDS
} LevelWord;

typedef enum {
    LIGHT_COSINE,    // between the normal and the direction to the light
    LIGHT_BLOCKER_T, // fraction of the way to the light, up to the blocker
    LIGHT_DIFFUSE,   // as Received::diffuse (shade.cl)
    LIGHT_SPECULAR,
    LIGHT_TINT, // the color of the glass before the light
    LIGHT_VALUES = LIGHT_TINT + 3
} LightValue;

typedef enum { LIGHT_STATE, LIGHT_BLOCKER, LIGHT_WORDS } LightWord;

// Whether a light reaches a surface.
typedef enum {
    LIGHT_BEHIND, // the shading normal is turned away from the light
    LIGHT_SEEN,
    LIGHT_BLOCKED,
    LIGHT_BEHIND_FACE // the face is turned away from the light, but the shading normal is not
} LightState;

#endif
