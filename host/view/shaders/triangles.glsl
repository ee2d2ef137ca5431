// SPDX-License-Identifier: MIT
// Draws triangles with smooth or flat normals, and with one color or a color per vertex. The
// derivatives of the position yield the face's normal.
#include "lens.glsl"
#ifdef VERTEX
in vec3 position, normal, tint;
out vec3 place, bend, paint;

void main()
{
    place = position;
    vec3 sizes = abs(normal); // dividing by the largest component prevents overflow
    float largest = max(max(sizes.x, sizes.y), sizes.z);
    bend = largest > 0.0 ? normalize(normal / largest) : normal;
    paint = tint;
    gl_Position = projected(position - eye);
}
#else
#include "light.glsl"
in vec3 place, bend, paint;
out vec4 color;
uniform vec4 diffuse, specular, look, even, odd, shift;

void main()
{
    vec3 toward_viewer = normalize(toward_eye(place));
    vec3 face = cross(dFdx(place), dFdy(place));
    if (dot(face, toward_viewer) < 0.0)
        face = -face;
    vec3 normal = face;
    if (dot(bend, bend) > 0.0)
        normal = gl_FrontFacing ? bend : -bend;
    color = seen(Surface(place, normalize(normal), face, toward_viewer, vec4(paint, diffuse.w),
                         specular, look, even, odd, shift));
}
#endif
