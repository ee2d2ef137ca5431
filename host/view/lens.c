// SPDX-License-Identifier: MIT
// A step of the camera is half a pixel. From the center to the picture's edge there are as many
// steps as the picture has pixels.
#include "view/lens.h"

// The near plane in normalized coordinates, in which the longest side of the geometry is 1 to 2.
// Nearer objects are drawn, but without depth.
#define NEAREST 0.01f

// Stores the direction of step, scaled so that its dot product with a point at depth 1 on the
// picture's edge is 1.
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
    Lens lens = {.camera = camera_make(viewpoint, normalization, height, 1),
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
