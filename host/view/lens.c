// SPDX-License-Identifier: MIT
// The camera's steps are half a pixel, so half the picture's width has as many steps as the width
// has pixels.
#include "view/lens.h"

// In normalized coordinates, where the geometry is 1 to 2 large. Nearer objects are drawn, but
// without depth.
#define NEAREST 0.01f

// Stores step's direction, scaled so that its dot product with a point at depth 1 on the edge is 1.
static void store_clip(float clip[3], const float step[4], double pixels)
{
    const Vec3 v = {(double)step[0], (double)step[1], (double)step[2]};
    const double length = sqrt(vec3_dot(v, v));
    const Vec3 scaled = vec3_scale(v, 1 / (length * length * pixels));
    clip[0] = (float)scaled.x;
    clip[1] = (float)scaled.y;
    clip[2] = (float)scaled.z;
}

Lens lens_of(const Viewpoint *viewpoint, const Normalization *normalization, uint32_t width,
             uint32_t height)
{
    Lens lens = {.camera = camera_make(viewpoint, normalization, width, height, 1),
                 .eye = normalize_point(normalization, viewpoint->eye),
                 .width = (float)width,
                 .height = (float)height,
                 .nearest = NEAREST};
    store_clip(lens.clip_x, lens.camera.right_step, width);
    store_clip(lens.clip_y, lens.camera.down_step, -(double)height);
    return lens;
}

void lens_apply(const Lens *lens, GLuint program)
{
    shader_set_vector(program, "eye", lens->camera.eye);
    shader_set_vector(program, "forward", lens->camera.forward);
    shader_set_vector(program, "clip_x", lens->clip_x);
    shader_set_vector(program, "clip_y", lens->clip_y);
    shader_set_vector(program, "right_step", lens->camera.right_step);
    shader_set_vector(program, "down_step", lens->camera.down_step);
    shader_set_number(program, "nearest", (double)lens->nearest);
    glUniform2f(glGetUniformLocation(program, "size"), lens->width, lens->height);
}
