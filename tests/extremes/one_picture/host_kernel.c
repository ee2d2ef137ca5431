// SPDX-License-Identifier: MIT
// Defines the built-in functions that the kernels call, under clang's mangled names, and loops over
// the work-items.
#include "host_kernel.h"

#include <math.h>

typedef float Float2 __attribute__((vector_size(8)));
typedef unsigned long Ulong;

static size_t work_item[2];

#define BUILTIN(result, name, parameters, value)                                                   \
    result name parameters                                                                         \
    {                                                                                              \
        return value;                                                                              \
    }

static float larger(float a, float b)
{
    return a < b ? b : a;
}

static float smaller(float a, float b)
{
    return b < a ? b : a;
}

BUILTIN(size_t, _Z13get_global_idj, (uint dimension), work_item[dimension])
BUILTIN(float, _Z3fmafff, (float a, float b, float c), fmaf(a, b, c))
BUILTIN(Float2, _Z3fmaDv2_fS_S_, (Float2 a, Float2 b, Float2 c),
        ((Float2){fmaf(a[0], b[0], c[0]), fmaf(a[1], b[1], c[1])}))
BUILTIN(float, _Z3maxff, (float a, float b), larger(a, b))
BUILTIN(Float2, _Z3maxDv2_fS_, (Float2 a, Float2 b),
        ((Float2){larger(a[0], b[0]), larger(a[1], b[1])}))
BUILTIN(float, _Z3minff, (float a, float b), smaller(a, b))
BUILTIN(Float2, _Z3minDv2_fS_, (Float2 a, Float2 b),
        ((Float2){smaller(a[0], b[0]), smaller(a[1], b[1])}))
BUILTIN(uint, _Z3minjj, (uint a, uint b), b < a ? b : a)
BUILTIN(float, _Z4fabsf, (float value), fabsf(value))
BUILTIN(float, _Z4rintf, (float value), rintf(value))
BUILTIN(float, _Z4sqrtf, (float value), sqrtf(value))
BUILTIN(float, _Z5clampfff, (float value, float low, float high), smaller(larger(value, low), high))
BUILTIN(float, _Z8copysignff, (float size, float sign), copysignf(size, sign))
BUILTIN(int, _Z11convert_intf, (float value), (int)value)
BUILTIN(int, _Z11convert_intj, (uint value), (int)value)
BUILTIN(uint, _Z12convert_uinti, (int value), (uint)value)
BUILTIN(float, _Z13convert_floati, (int value), (float)value)
BUILTIN(float, _Z13convert_floatm, (Ulong value), (float)value)
BUILTIN(Ulong, _Z13convert_ulongf, (float value), (Ulong)value)

void render_tile(FrameData frame, const PointLight *lights, const Material *materials,
                 const SphereData *spheres, const BvhPair *nodes, const TriangleData *triangles,
                 const TriangleLook *looks, const CornerNormals *normals, float *pixels,
                 uint *tallies);

void host_kernel_draw(const FrameData *frame, const FlatScene *flat, Framebuffer *picture)
{
    FrameData whole = *frame;
    whole.tile_x = whole.tile_y = 0;
    whole.tile_width = whole.width;
    whole.tile_height = whole.height;
    for (work_item[1] = 0; work_item[1] < whole.height; work_item[1]++)
        for (work_item[0] = 0; work_item[0] < whole.width; work_item[0]++)
            render_tile(whole, flat->lights, flat->materials, flat->spheres, flat->pairs,
                        flat->triangles, flat->looks, flat->normals, *picture->pixels, NULL);
}
