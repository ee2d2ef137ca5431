// SPDX-License-Identifier: MIT
// Draws colored characters at pixel positions, counted from the upper left corner.
uniform vec2 size;
#ifdef VERTEX
in vec4 first, last; // opposite corners: position and texel
in vec4 tint;
out vec2 place;
out vec4 shade;

void main()
{
    vec4 corner = mix(first, last, vec2(gl_VertexID % 2, gl_VertexID / 2).xyxy);
    place = corner.zw;
    shade = tint;
    gl_Position = vec4(2.0 * corner.x / size.x - 1.0, 1.0 - 2.0 * corner.y / size.y, 0.0, 1.0);
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
