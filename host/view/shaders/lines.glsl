// SPDX-License-Identifier: MIT
// Draws the edges of boxes, or single lines from a box's low corner to its high corner.
#include "lens.glsl"
#ifdef VERTEX
in vec3 corner;    // of the unit cube
in vec3 low, high; // of the box

void main()
{
    gl_Position = projected(mix(low, high, corner) - eye);
}
#else
out vec4 color;
uniform vec3 paint;

void main()
{
    color = vec4(paint, 1.0);
}
#endif
