// SPDX-License-Identifier: MIT
// Projects points in the same way as the camera of traced pictures. In perspective pictures, the
// depth is 1 - nearest / distance, so there is no far plane. In orthographic pictures, the depth is
// distance / farthest.
uniform vec3 eye, forward;
uniform vec3 right_step, down_step;   // half a pixel at distance 1
uniform vec2 size;                    // of the picture in pixels
uniform float farthest;               // 0 for a perspective picture

// Points up to this distance all have depth 0, so the one that is drawn last is visible. The
// distance is in normalized coordinates, in which the longest side of the triangles' box is 1 to 2.
const float nearest = 0.01;

// Returns the depth of a point. `offset` is the point relative to the eye.
float depth_of(vec3 offset)
{
    float distance = dot(offset, forward);
    return farthest > 0.0 ? distance / farthest : 1.0 - nearest / distance;
}

// Returns the unnormalized direction from a point toward the viewer.
vec3 toward_eye(vec3 place)
{
    return farthest > 0.0 ? -forward : eye - place;
}

#ifdef VERTEX
// Projects a point, and clips parts behind the eye. `offset` is the point relative to the eye. Half
// of the picture's width is size.x steps, and half of its height is size.y steps.
vec4 projected(vec3 offset)
{
    float distance = dot(offset, forward);
    gl_ClipDistance[0] = distance;
    vec2 place = vec2(dot(offset, right_step) / (dot(right_step, right_step) * size.x),
                      -dot(offset, down_step) / (dot(down_step, down_step) * size.y));
    return farthest > 0.0 ? vec4(place, 2.0 * distance / farthest - 1.0, 1.0)
                          : vec4(place, distance - 2.0 * nearest, distance);
}
#endif
