// SPDX-License-Identifier: MIT
// Shades materials under the scene's lights, without shadows. Mirrors reflect the background. Glass
// covers every second pixel with its color, so that objects behind the glass stay visible. As in
// the traced picture, a light counts only if the shading normal and the face both point toward it.
#define LIGHTS       64
#define SILHOUETTE   0.5 // shader numbers below this are silhouettes
#define BLINN_PHONG  1.5
#define GLASS        2.5

uniform vec4 lights[LIGHTS]; // position and intensity
uniform vec3 light_colors[LIGHTS];
uniform int light_count;
uniform vec3 background;
uniform float ambient, gain;
uniform bool is_srgb;

struct Surface {
    vec3 place, normal, face, toward_viewer; // face is the visible side's normal, of any length
    vec4 diffuse;  // color and kd
    vec4 specular; // color and ks
    vec4 look;     // shader, unused, shininess, reflectivity; of glass, only the shader counts
    vec4 even;     // color of the checker's even cubes, and cubes per unit; 0 for no checker
    vec4 odd;      // color of odd cubes
    vec4 shift;    // offset of the cubes along each axis
};

vec3 encoded(vec3 color)
{
    vec3 shown = clamp(color * gain, 0.0, 1.0);
    vec3 curve = 1.055 * pow(shown, vec3(1.0 / 2.4)) - 0.055;
    return is_srgb ? mix(curve, 12.92 * shown, lessThanEqual(shown, vec3(0.0031308))) : shown;
}

// Returns the color of the checker's cube behind the surface, as in the traced picture.
// Interpolated places are less precise than traced points, so this function moves them 32 times as
// far behind the surface as kernels/material.cl moves traced points. Places do not move along axes
// parallel to the surface, because moves of this length would cross the edges of solids.
vec3 checked(Surface surface)
{
    float move = (surface.even.w + 1.0) / 16384.0;
    vec3 face = normalize(surface.face);
    vec3 moves = -move * sign(face) * step(1.0 / 1024.0, abs(face));
    vec3 cubes = floor(surface.place * surface.even.w + surface.shift.xyz + moves);
    return mod(cubes.x + cubes.y + cubes.z, 2.0) > 0.5 ? surface.odd.rgb : surface.even.rgb;
}

vec3 shaded(Surface surface)
{
    vec3 diffuse = vec3(0.0), specular = vec3(0.0);
    for (int i = 0; i < light_count; i++) {
        vec3 toward_light = normalize(lights[i].xyz - surface.place);
        float cosine = dot(surface.normal, toward_light);
        if (cosine <= 0.0 || dot(surface.face, toward_light) <= 0.0)
            continue;
        vec3 half_vector = normalize(toward_light + surface.toward_viewer);
        float shine = max(dot(surface.normal, half_vector), 0.0);
        diffuse += lights[i].w * cosine * light_colors[i];
        specular += lights[i].w * pow(shine, surface.look.z) * light_colors[i];
    }
    vec3 color = (ambient + surface.diffuse.w * diffuse) * surface.diffuse.rgb;
    if (surface.look.x > BLINN_PHONG)
        color += surface.specular.w * specular * surface.specular.rgb;
    return clamp(color, 0.0, 1.0);
}

vec4 seen(Surface surface)
{
    bool is_glass = surface.look.x > GLASS;
    bool is_flat = surface.look.x < SILHOUETTE || is_glass;
    if (is_glass && mod(floor(gl_FragCoord.x) + floor(gl_FragCoord.y), 2.0) < 1.0)
        discard;
    if (surface.even.w > 0.0)
        surface.diffuse.rgb = checked(surface);
    vec3 color = is_flat ? surface.diffuse.rgb : shaded(surface);
    return vec4(encoded(mix(color, background, is_glass ? 0.0 : surface.look.w)), 1.0);
}
