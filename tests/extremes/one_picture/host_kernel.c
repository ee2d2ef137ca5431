// SPDX-License-Identifier: MIT
// The built-in functions that the kernels call, under the names that clang gives them, and a loop
// over the work-items.
#include "host_kernel.h"

#include <math.h>

typedef float Float2 __attribute__((vector_size(8)));

static size_t work_item[2];

#define BUILTIN(result, name, parameters, symbol) result name parameters __asm__(symbol)

BUILTIN(size_t, item_id, (uint), "_Z13get_global_idj");
BUILTIN(float, float_fma, (float, float, float), "_Z3fmafff");
BUILTIN(Float2, pair_fma, (Float2, Float2, Float2), "_Z3fmaDv2_fS_S_");
BUILTIN(float, float_max, (float, float), "_Z3maxff");
BUILTIN(Float2, pair_max, (Float2, Float2), "_Z3maxDv2_fS_");
BUILTIN(float, float_min, (float, float), "_Z3minff");
BUILTIN(Float2, pair_min, (Float2, Float2), "_Z3minDv2_fS_");
BUILTIN(uint, uint_min, (uint, uint), "_Z3minjj");
BUILTIN(float, float_abs, (float), "_Z4fabsf");
BUILTIN(float, float_rint, (float), "_Z4rintf");
BUILTIN(float, float_sqrt, (float), "_Z4sqrtf");
BUILTIN(float, float_clamp, (float, float, float), "_Z5clampfff");
BUILTIN(float, float_sign, (float, float), "_Z8copysignff");
BUILTIN(int, int_of_float, (float), "_Z11convert_intf");
BUILTIN(int, int_of_uint, (uint), "_Z11convert_intj");
BUILTIN(uint, uint_of_int, (int), "_Z12convert_uinti");
BUILTIN(float, float_of_int, (int), "_Z13convert_floati");
BUILTIN(float, float_of_ulong, (unsigned long), "_Z13convert_floatm");
BUILTIN(unsigned long, ulong_of_float, (float), "_Z13convert_ulongf");

size_t item_id(uint dimension)
{
    return work_item[dimension];
}

float float_fma(float a, float b, float c)
{
    return fmaf(a, b, c);
}

Float2 pair_fma(Float2 a, Float2 b, Float2 c)
{
    return (Float2){fmaf(a[0], b[0], c[0]), fmaf(a[1], b[1], c[1])};
}

float float_max(float a, float b)
{
    return a < b ? b : a;
}

Float2 pair_max(Float2 a, Float2 b)
{
    return (Float2){float_max(a[0], b[0]), float_max(a[1], b[1])};
}

float float_min(float a, float b)
{
    return b < a ? b : a;
}

Float2 pair_min(Float2 a, Float2 b)
{
    return (Float2){float_min(a[0], b[0]), float_min(a[1], b[1])};
}

uint uint_min(uint a, uint b)
{
    return b < a ? b : a;
}

float float_abs(float value)
{
    return fabsf(value);
}

float float_rint(float value)
{
    return rintf(value);
}

float float_sqrt(float value)
{
    return sqrtf(value);
}

float float_clamp(float value, float low, float high)
{
    return float_min(float_max(value, low), high);
}

float float_sign(float size, float sign)
{
    return copysignf(size, sign);
}

int int_of_float(float value)
{
    return (int)value;
}

int int_of_uint(uint value)
{
    return (int)value;
}

uint uint_of_int(int value)
{
    return (uint)value;
}

float float_of_int(int value)
{
    return (float)value;
}

float float_of_ulong(unsigned long value)
{
    return (float)value;
}

unsigned long ulong_of_float(float value)
{
    return (unsigned long)value;
}

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
