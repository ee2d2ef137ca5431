// SPDX-License-Identifier: MIT
// A tube is a grid of quads that closes along the ring and around the tube. The middle of each
// cross-section sees its whole outline.
#include "tubes.h"

#include <string.h>

#define SECTIONS 40 // along the ring
#define CORNERS  40 // of a cross-section
#define FIN      8  // corners of a cross-section per fin

const char *const tube_names[TUBE_KINDS] = {"ridges", "bumps", "saddles", "walls"};

// A fin has FIN corners. The fin's walls go from corner 2 to 3, and from corner 4 to 5. The fin's
// edge is thinner than its foot.
static double corner_angle(TubeKind kind, uint32_t corner)
{
    static const double wall_angles[FIN] = {0, 12, 23.9, 23.95, 24, 24.05, 36, 48};
    if (kind == TUBE_WALLS)
        return 72.0 * (corner / FIN) + wall_angles[corner % FIN];
    return 360.0 / CORNERS * corner;
}

// Returns a corner's distance from the middle of the tube.
static double corner_distance(TubeKind kind, uint32_t section, uint32_t corner, Random *random)
{
    const double part = random_unit(random);
    const uint32_t in_fin = corner % FIN;
    switch (kind) {
    case TUBE_RIDGES:
        return (corner % 2 == 0 ? 0.55 : 0.95) + 0.03 * part;
    case TUBE_BUMPS:
        return 0.4 + 0.6 * part;
    case TUBE_SADDLES:
        return 0.7 + 0.25 * sine_of_degrees(45.0 * section) * sine_of_degrees(36.0 * corner);
    default:
        return (in_fin == 3 || in_fin == 4 ? 0.4 : 0.9) + 0.03 * part;
    }
}

static Vec3 in_section(double around_axis, double out, double up)
{
    return vec3((TUBE_MIDDLE + out) * cosine_of_degrees(around_axis),
                (TUBE_MIDDLE + out) * sine_of_degrees(around_axis), up);
}

static void put_quad(Mesh *mesh, uint32_t section, uint32_t corner)
{
    const uint32_t here = section * CORNERS, there = (section + 1) % SECTIONS * CORNERS;
    const uint32_t next = (corner + 1) % CORNERS;
    const uint32_t corners[2][3] = {{here + corner, there + corner, there + next},
                                    {here + corner, there + next, here + next}};
    memcpy(mesh->triangles[2 * (here + corner)], corners, sizeof corners);
}

Mesh tube_mesh(TubeKind kind, Random *random)
{
    Mesh mesh = shape_unfilled(SECTIONS * CORNERS, 2 * SECTIONS * CORNERS);
    for (uint32_t section = 0; section < SECTIONS; section++)
        for (uint32_t corner = 0; corner < CORNERS; corner++) {
            const double distance = corner_distance(kind, section, corner, random);
            const double angle = corner_angle(kind, corner);
            shape_set_vertex(&mesh, section * CORNERS + corner,
                             in_section(360.0 / SECTIONS * section,
                                        distance * cosine_of_degrees(angle),
                                        distance * sine_of_degrees(angle)));
            put_quad(&mesh, section, corner);
        }
    return mesh;
}

Vec3 tube_inside(Random *random)
{
    const double around_axis = random_between(random, 0, 360);
    const Vec3 aside = random_in_cube(random, 0.1);
    return in_section(around_axis, aside.x, aside.y);
}
