// SPDX-License-Identifier: MIT
// Every ray of an orthographic camera inside a closed shape must hit the shape. Unlike the rays of
// the other leak tests, these rays share their direction and start apart.
#include "support/picture.h"
#include "support/shapes.h"
#include "unit/parsed.h"

#define CELLS 32

// Frees the scene. Returns how many pixels show the background.
static Outcome judge_inside(const Studio *studio, Scene scene, uint32_t side)
{
    static const float green[3] = {0, 1, 0};
    const PictureSettings settings = picture_settings(side);
    FREED_BY(framebuffer_free)
    Framebuffer picture = picture_draw_once(studio, scene, &settings);
    return outcome_of("T-66", picture_pixels(&picture),
                      picture_pixels(&picture) - picture_count_other(&picture, green));
}

// Returns a cube of side 2 whose faces are uneven. Vertices inside a face are moved inward.
static Mesh uneven_cube(Random *random)
{
    Mesh cube = shape_cube(1, CELLS);
    for (size_t i = 0; i < cube.vertex_count; i++) {
        double *p = cube.positions[i];
        const int rims = (fabs(p[0]) == 1) + (fabs(p[1]) == 1) + (fabs(p[2]) == 1);
        for (int axis = 0; axis < 3 && rims == 1; axis++)
            if (fabs(p[axis]) == 1)
                p[axis] *= shape_rounded(random_between(random, 0.95, 1));
    }
    return cube;
}

// All rays hit vertices or middles of edges exactly, because a pixel is as wide as a cell or half a
// cell.
EXTREME(parallel_rays_at_edges_and_vertices_stay_in_a_closed_cube_t66)
{
    static const char *const directions[] = {"1 0 0", "-1 0 0", "0 1 0", "0 -1 0"};
    for (uint32_t parts = 1; parts <= 2; parts++)
        for (size_t i = 0; i < COUNT(directions); i++) {
            Random random = {6600 + i};
            const uint32_t side = parts * (CELLS - 2) + 1;
            Scene scene = parsed_format("background 0 1 0\ncamera 0 0 0 %s orthographic %.17g\n",
                                        directions[i], (double)side * 2 / (CELLS * parts));
            shape_add(&scene, uneven_cube(&random), 0);
            outcome_report(judge_inside(*state, scene, side), "direction=%s parts=%u",
                           directions[i], parts);
        }
}

EXTREME(parallel_rays_never_leave_a_closed_bumpy_sphere_t66)
{
    const size_t cameras = tier_size(8, 100);
    for (int exponent = 0; exponent <= 20; exponent += 10) {
        Outcome sum = {.test = "T-66"};
        Random random = {(uint64_t)(6650 + exponent)};
        for (size_t i = 0; i < cameras; i++) {
            const Vec3 eye = shape_center(exponent), aim = random_in_cube(&random, 1);
            Scene scene =
                parsed_format("background 0 1 0\nup 1 2 3\n"
                              "camera %.17g %.17g %.17g %.17g %.17g %.17g orthographic 1.4\n",
                              eye.x, eye.y, eye.z, eye.x + aim.x, eye.y + aim.y, eye.z + aim.z);
            shape_add(&scene, shape_bumpy(&random, eye), 0);
            outcome_add(&sum, judge_inside(*state, scene, 96));
        }
        outcome_report(sum, "k=%d cameras=%zu", exponent, cameras);
    }
}

FIXTURES(picture_setup, picture_teardown)
