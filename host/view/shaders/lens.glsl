// SPDX-License-Identifier: MIT
// Projects points like the camera of the rays, without a far plane. Depth is 1 - nearest /
// distance.
uniform vec3 eye, forward;
uniform vec3 clip_x, clip_y;          // across the picture, from -1 to 1 at distance 1
uniform vec3 right_step, down_step;   // half a pixel at distance 1
uniform vec2 size;                    // of the picture in pixels
uniform float nearest;

// Projects a point given relative to the eye.
vec4 projected(vec3 offset)
{
    float distance = dot(offset, forward);
    return vec4(dot(offset, clip_x), dot(offset, clip_y), distance - 2.0 * nearest, distance);
}
