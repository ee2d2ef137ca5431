// SPDX-License-Identifier: MIT
// Cables start side by side near the ground, rise diagonally and spread out. Each cable has its own
// slight bend. A cable is a hexagonal tube of a few long segments.
#include "cables.h"

#include "base/array.h"
#include "base/vec.h"

#define CABLES   900
#define SIDES    6 // each cap consists of two quads
#define SEGMENTS 6
#define RADIUS   0.0035

#define RINGS          (SEGMENTS + 1)
#define CABLE_VERTICES (RINGS * SIDES)
#define CABLE_QUADS    (SEGMENTS * SIDES + 4)
#define GOLDEN_DEGREES 137.50776405003785 // between consecutive seeds of a sunflower

// The bundle's direction, and two directions perpendicular to it.
static const Vec3 along = {0.62, 0.48, 0.62}, across = {-0.6121, 0.7908, 0},
                  up = {-0.49, -0.38, 0.78};

static Vec3 cross_section(double degrees, double radius)
{
    return vec3_add(vec3_scale(across, radius * cosine_of_degrees(degrees)),
                    vec3_scale(up, radius * sine_of_degrees(degrees)));
}

// Returns a point on a cable's center line; part is 0 to 1. In a cross-section, the cables lie like
// a sunflower's seeds.
static Vec3 cable_point(int cable, double part)
{
    const double degrees = GOLDEN_DEGREES * cable, ring = sqrt((cable + 0.5) / CABLES);
    const double spread = 0.13 + 0.30 * part * part;
    const Vec3 middle = vec3_add(vec3(-0.42, -0.33, 0.09), vec3_scale(along, 1.15 * part));
    const Vec3 seed = cross_section(degrees + 40 * part, ring * spread);
    const Vec3 bend = cross_section(3 * degrees, 0.012 * sine_of_degrees(180 * part));
    return vec3_add(middle, vec3_add(seed, bend));
}

static void place_ring(Surface *surface, int cable, int ring)
{
    const size_t first = (size_t)cable * CABLE_VERTICES + (size_t)ring * SIDES;
    const Vec3 middle = cable_point(cable, (double)ring / SEGMENTS);
    for (int side = 0; side < SIDES; side++) {
        const Vec3 outward = cross_section(360.0 / SIDES * side, 1);
        surface->positions[first + (size_t)side] = vec3_add(middle, vec3_scale(outward, RADIUS));
        surface->normals[first + (size_t)side] = vec3_normalize(outward);
    }
}

static void put_quad(uint32_t quad[4], uint32_t first, const int corners[4])
{
    for (int corner = 0; corner < 4; corner++)
        quad[corner] = first + (uint32_t)corners[corner];
}

static void place_quads(Surface *surface, int cable)
{
    static const int start[2][4] = {{0, 3, 2, 1}, {0, 5, 4, 3}},
                     end[2][4] = {{0, 1, 2, 3}, {0, 3, 4, 5}};
    const uint32_t first = (uint32_t)cable * CABLE_VERTICES;
    uint32_t(*quads)[4] = surface->quads + (size_t)cable * CABLE_QUADS;
    for (int segment = 0; segment < SEGMENTS; segment++)
        for (int side = 0; side < SIDES; side++) {
            const int next = (side + 1) % SIDES;
            const int corners[4] = {side, next, SIDES + next, SIDES + side};
            put_quad(*quads++, first + (uint32_t)(segment * SIDES), corners);
        }
    for (int half = 0; half < 2; half++) {
        put_quad(*quads++, first, start[half]);
        put_quad(*quads++, first + SEGMENTS * SIDES, end[half]);
    }
}

bool cables_make(Surface *surface, Error *error)
{
    *surface =
        (Surface){.vertex_count = CABLES * CABLE_VERTICES, .quad_count = CABLES * CABLE_QUADS};
    surface->positions = memory_raw(surface->vertex_count, sizeof *surface->positions, error);
    surface->normals = memory_raw(surface->vertex_count, sizeof *surface->normals, error);
    surface->quads = memory_raw(surface->quad_count, sizeof *surface->quads, error);
    if (surface->positions == NULL || surface->normals == NULL || surface->quads == NULL)
        return false;
    for (int cable = 0; cable < CABLES; cable++) {
        for (int ring = 0; ring < RINGS; ring++)
            place_ring(surface, cable, ring);
        place_quads(surface, cable);
    }
    return true;
}
