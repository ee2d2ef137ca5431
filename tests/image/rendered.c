// SPDX-License-Identifier: MIT
// Renders pictures for tests and compares them.
#include "image/rendered.h"

#include "image/form.h"
#include "unit/cmocka_all.h"

#include <math.h>

Framebuffer rendered(const PictureRequest *request)
{
    Framebuffer picture;
    Error error = {0};
    if (!picture_render(&picture, request, &error))
        fail_msg("%s", error.text);
    return picture;
}

void rendered_expect_same(const PictureRequest *expected, const PictureRequest *others,
                          size_t count)
{
    FREED_BY(framebuffer_free) Framebuffer first = rendered(expected);
    const size_t size = (size_t)first.width * first.height * sizeof *first.pixels;
    for (size_t i = 0; i < count; i++) {
        Framebuffer other = rendered(&others[i]);
        assert_memory_equal(first.pixels, other.pixels, size);
        framebuffer_free(&other);
    }
}

void rendered_expect_same_in_every_form(const PictureRequest *usual)
{
    static const KernelChoice choices[] = {{FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP32},
                                           {FAMILY_RAY, NODES_WIDE, 8, PRECISION_FP32},
                                           {FAMILY_PACKET, NODES_WIDE, 4, PRECISION_FP32},
                                           {FAMILY_PACKET, NODES_WIDE, 8, PRECISION_FP32},
                                           {FAMILY_PACKET, NODES_WIDE, 16, PRECISION_FP32}};
    enum { COUNT = sizeof choices / sizeof choices[0] };
    PictureRequest others[COUNT];
    for (uint32_t i = 0; i < COUNT; i++) {
        others[i] = *usual;
        others[i].choice = choices[i];
        others[i].group_width = others[i].group_height = form_group(&choices[i]);
        others[i].threads = i;
        others[i].builder = i % 2 == 0 ? BVH_SAH : BVH_MIDPOINT;
        others[i].specialization = i == COUNT - 1 ? SPECIALIZE_ALWAYS : SPECIALIZE_NEVER;
    }
    rendered_expect_same(usual, others, COUNT);
}

double rendered_error(const Framebuffer *one, const Framebuffer *other)
{
    const size_t values = (size_t)one->width * one->height * 3;
    const float *first = &one->pixels[0][0], *second = &other->pixels[0][0];
    double sum = 0;
    for (size_t i = 0; i < values; i++)
        sum += pow((double)first[i] - (double)second[i], 2);
    return sqrt(sum / (double)values);
}
