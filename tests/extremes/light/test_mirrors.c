// SPDX-License-Identifier: MIT
// Rays must stay inside closed mirrors for BOUNCES reflections. In a mirror with ridges, one ray
// may leave.
#include "support/picture.h"
#include "support/random.h"
#include "support/shapes.h"
#include "unit/parsed.h"

#include <string.h>

// Perfect mirrors, which show only reflections.
#define MIRROR  "define mirror silhouette diffuse 0.5 0.75 0.2 reflectivity "
#define BOUNCES 64

// Draws the inside of a closed perfect mirror. Rays that leave the mirror shade fewer points. A ray
// through the edge of a ridge may hit the triangle beyond the ridge, and is then outside. In a
// mirror with ridges, BOUNCES points may be missing, which is what one ray shades.
static void judge_escapes(const Studio *studio, const char *name, Mesh mesh, bool from_front)
{
    RenderProgress progress;
    PictureSettings settings = picture_settings((uint32_t)tier_size(64, 1000));
    settings.render.max_level = BOUNCES;
    settings.render.statistics = true;
    FREED_BY(scene_free)
    Scene scene = parsed_format(MIRROR "1\ncamera 0.1 -0.05 0.07 1 2 0.5 100\n");
    if (from_front)
        shape_flip(&mesh);
    shape_add(&scene, mesh, COURSE_MATERIALS);
    FREED_BY(framebuffer_free)
    Framebuffer picture = picture_draw_counted(studio, &scene, &settings, &progress);
    const size_t rays = picture_pixels(&picture);
    const uint64_t lost = rays * BOUNCES - progress.tallies[TALLY_SHADED_POINTS];
    Outcome outcome = outcome_of("T-45", rays, (size_t)lost);
    outcome.limit = strcmp(name, "bumpy") == 0 ? BOUNCES : 0;
    outcome_report(outcome, "mirror=%s bounces=%d from_front=%d", name, BOUNCES, from_front);
}

EXTREME(no_ray_escapes_from_a_closed_mirror_t45)
{
    Random random = {45};
    Vec3 axes[3];
    Mesh turned = shape_cube(1, 3);
    random_rotation(&random, axes);
    for (size_t vertex = 0; vertex < turned.vertex_count; vertex++)
        shape_set_vertex(&turned, vertex, rotated(axes, shape_vertex(&turned, vertex)));
    judge_escapes(*state, "turned_cube", turned, false);
    judge_escapes(*state, "bumpy", shape_bumpy(&random, vec3(0, 0, 0)), false);
    for (int from_front = 0; from_front < 2; from_front++) {
        judge_escapes(*state, "cube", shape_cube(1, 3), from_front == 1);
        judge_escapes(*state, "globe", shape_sphere(16, vec3(0, 0, 0)), from_front == 1);
    }
}

FIXTURES(picture_setup, picture_teardown)
