// SPDX-License-Identifier: MIT
// Chooses the crease angle of a mesh. The faces of a smooth shape meet at small angles, and larger
// angles are ever rarer. Technical shapes have chamfers and edges, which are peaks at larger
// angles.
#include "mesh/mesh.h"

#include "mesh/edges.h"

// Meshes with fewer edges are too small for statistics.
#define EDGES_LEAST 1000

#define ROUND_CREASE_DEGREES 70 // for smooth shapes

// The cosines of the windows' ends.
static const double ends[ANGLE_WINDOWS] = {
    0.99619469809174555, 0.98480775301220806, 0.96592582628906829, 0.93969262078590838,
    0.90630778703664996, 0.86602540378443865, 0.81915204428899178, 0.76604444311897804,
    0.70710678118654752, 0.64278760968653933, 0.57357643635104610, 0.50000000000000000,
    0.42261826174069944, 0.34202014332566873, 0.25881904510252076};

void edge_angles_add(EdgeAngles *angles, Vec3 a, Vec3 b)
{
    int window = 0;
    while (window < ANGLE_WINDOWS && vec3_dot(a, b) <= ends[window])
        window++;
    angles->edges++;
    if (window < ANGLE_WINDOWS)
        angles->windows[window]++;
}

static Vec3 normal_of(const Mesh *mesh, const EdgeSide *side)
{
    const uint32_t *triangle = mesh->triangles[side->triangle];
    const Vec3 ab = mesh_direction(mesh, triangle[0], triangle[1]);
    return vec3_normalize(vec3_cross(ab, mesh_direction(mesh, triangle[0], triangle[2])));
}

bool edge_angles_add_mesh(EdgeAngles *angles, const Mesh *mesh, Error *error)
{
    Weld weld = {0};
    Edges edges = {0};
    Edge edge = {0};
    const bool ok = weld_make(&weld, mesh, error) && edges_make(&edges, mesh, &weld, error);
    while (ok && edges_next(&edges, &edge))
        if (edge.count == 2)
            edge_angles_add(angles, normal_of(mesh, &edge.sides[0]),
                            normal_of(mesh, &edge.sides[1]));
    edges_free(&edges);
    weld_free(&weld);
    return ok;
}

// Returns the number of edges per degree from one angle to another. The angles are multiples of
// ANGLE_WINDOW_DEGREES.
static double density(const EdgeAngles *angles, int from, int to)
{
    size_t sum = 0;
    for (int window = from / ANGLE_WINDOW_DEGREES; window < to / ANGLE_WINDOW_DEGREES; window++)
        sum += angles->windows[window];
    return (double)sum / (to - from);
}

double crease_of_angles(const EdgeAngles *angles)
{
    const double common = density(angles, 25, 35);
    bool is_round = angles->edges >= EDGES_LEAST && common > 0 &&
                    density(angles, 5, 15) > density(angles, 15, 25) &&
                    density(angles, 15, 25) > common && density(angles, 55, 75) < common / 5;
    for (int from = 35; from < 75; from += ANGLE_WINDOW_DEGREES)
        is_round = is_round && density(angles, from, from + ANGLE_WINDOW_DEGREES) < common;
    return is_round ? ROUND_CREASE_DEGREES : CREASE_DEGREES;
}
