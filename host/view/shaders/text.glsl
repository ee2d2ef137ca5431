// SPDX-License-Identifier: MIT
// Draws colored shapes at pixel positions, counted from the upper left corner.
uniform vec2 size;
#ifdef VERTEX
in vec2 position;
in vec4 tint;
out vec4 shade;

void main()
{
    shade = tint;
    gl_Position = vec4(2.0 * position.x / size.x - 1.0, 1.0 - 2.0 * position.y / size.y, 0.0, 1.0);
}
#else
in vec4 shade;
out vec4 color;

void main()
{
    color = shade;
}
#endif
