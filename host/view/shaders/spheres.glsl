// SPDX-License-Identifier: MIT
// Intersects a sphere with each pixel's ray. A cube around the sphere selects the pixels.
#include "lens.glsl"
#ifdef VERTEX
in vec4 sphere; // center relative to the eye, and radius
in vec4 diffuse, specular;
in vec4 look; // the second number is the eye's height above the sphere
in vec4 even, odd, shift;
flat out vec4 sphere_shown, diffuse_shown, specular_shown, look_shown;
flat out vec4 even_shown, odd_shown, shift_shown;

// The triangles of a cube, counter-clockwise seen from outside. Bit n of a corner selects its side
// along axis n.
const int corners[36] = int[](0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                              2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5);

void main()
{
    int corner = corners[gl_VertexID];
    vec3 side = vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1) * 2.0 - 1.0;
    sphere_shown = sphere;
    diffuse_shown = diffuse;
    specular_shown = specular;
    look_shown = look;
    even_shown = even;
    odd_shown = odd;
    shift_shown = shift;
    gl_Position = projected(sphere.xyz + 1.01 * sphere.w * side);
}
#else
#include "light.glsl"
flat in vec4 sphere_shown, diffuse_shown, specular_shown, look_shown;
flat in vec4 even_shown, odd_shown, shift_shown;
out vec4 color;

// Returns the distance to the nearest hit in front of the ray's start, or a negative number without
// a hit. The start is relative to the eye. The root of smaller magnitude is computed from the other
// root and the eye's height above the sphere. This avoids cancellation for large spheres.
float meeting(vec3 start, vec3 direction)
{
    vec3 center = sphere_shown.xyz - start;
    float radius = sphere_shown.w, height = look_shown.y;
    float middle = dot(center, direction);
    vec3 beside = center - middle * direction;
    float square = radius * radius - dot(beside, beside);
    if (square < 0.0)
        return -1.0;
    float product = height * (height + 2.0 * radius) - dot(start, sphere_shown.xyz + center);
    float larger = middle > 0.0 ? middle + sqrt(square) : middle - sqrt(square);
    float smaller = product / larger;
    float first = min(larger, smaller), second = max(larger, smaller);
    return first >= 0.0 ? first : second;
}

void main()
{
    vec2 steps = vec2(2.0 * gl_FragCoord.x - size.x, size.y - 2.0 * gl_FragCoord.y);
    vec3 shift = steps.x * right_step + steps.y * down_step;
    bool is_orthographic = farthest > 0.0;
    vec3 start = is_orthographic ? shift : vec3(0.0);
    vec3 direction = is_orthographic ? forward : normalize(forward + shift);
    float distance = meeting(start, direction);
    if (distance < 0.0)
        discard;
    vec3 offset = start + distance * direction;
    vec3 normal = (offset - sphere_shown.xyz) / sphere_shown.w;
    gl_FragDepth = depth_of(offset);
    vec3 face = dot(normal, direction) > 0.0 ? -normal : normal;
    color = seen(Surface(eye + offset, normal, face, -direction, diffuse_shown, specular_shown,
                         look_shown, even_shown, odd_shown, shift_shown));
}
#endif
