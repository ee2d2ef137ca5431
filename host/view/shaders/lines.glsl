// SPDX-License-Identifier: MIT
// Draws the edges of boxes, or single lines from a box's low corner to its high corner.
#include "lens.glsl"
#ifdef VERTEX
in vec3 low, high; // of the box

// The ends of a cube's edges, and of a diagonal. Bit n of a corner selects low or high along axis n.
const int corners[26] = int[](0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4,
                              6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7, 0, 7);

void main()
{
    int corner = corners[gl_VertexID];
    vec3 part = vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    gl_Position = projected(mix(low, high, part) - eye);
}
#else
out vec4 color;
uniform vec3 paint;

void main()
{
    color = vec4(paint, 1.0);
}
#endif
