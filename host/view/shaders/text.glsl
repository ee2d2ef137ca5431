// SPDX-License-Identifier: MIT
// Draws colored characters at pixel positions, counted from the upper left corner.
uniform vec2 size;
#ifdef VERTEX
in vec2 position, texel;
in vec4 tint;
out vec2 place;
out vec4 shade;

void main()
{
    place = texel;
    shade = tint;
    gl_Position = vec4(2.0 * position.x / size.x - 1.0, 1.0 - 2.0 * position.y / size.y, 0.0, 1.0);
}
#else
in vec2 place;
in vec4 shade;
out vec4 color;
uniform sampler2D glyphs;

void main()
{
    color = vec4(shade.rgb, shade.a * texture(glyphs, place).r);
}
#endif
