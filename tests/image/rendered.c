// SPDX-License-Identifier: MIT
// Differences are summed in double, value by value.
#include "image/rendered.h"

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

void rendered_expect_same(const PictureRequest *one, const PictureRequest *other)
{
    Framebuffer first = rendered(one), second = rendered(other);
    const size_t size = (size_t)first.width * first.height * sizeof *first.pixels;
    assert_memory_equal(first.pixels, second.pixels, size);
    framebuffer_free(&first);
    framebuffer_free(&second);
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
