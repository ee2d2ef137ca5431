// SPDX-License-Identifier: MIT
// Draws a traced picture over the whole target. The texture starts with the picture's top row.
#ifdef VERTEX
out vec2 place;

void main()
{
    vec2 corner = vec2(gl_VertexID % 2, gl_VertexID / 2);
    place = vec2(corner.x, 1.0 - corner.y);
    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
#else
in vec2 place;
out vec4 color;
uniform sampler2D picture;

void main()
{
    color = vec4(texture(picture, place).rgb, 1.0);
}
#endif
