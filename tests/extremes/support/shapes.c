// SPDX-License-Identifier: MIT
// Makes the meshes of shapes. They use clrt's own sines, which are equal on every machine.
#include "shapes.h"

#include "base/vec.h"
#include "check.h"
#include "mesh/edges.h"

#include <string.h>

Mesh shape_unfilled(size_t vertices, size_t triangles)
{
    Mesh mesh = {.vertex_count = vertices, .triangle_count = triangles};
    mesh.positions = require_memory(vertices, sizeof *mesh.positions);
    mesh.triangles = require_memory(triangles, sizeof *mesh.triangles);
    return mesh;
}

Vec3 shape_vertex(const Mesh *mesh, size_t vertex)
{
    const double *position = mesh->positions[vertex];
    return vec3(position[0], position[1], position[2]);
}

void shape_set_vertex(Mesh *mesh, size_t vertex, Vec3 position)
{
    mesh->positions[vertex][0] = shape_rounded(position.x);
    mesh->positions[vertex][1] = shape_rounded(position.y);
    mesh->positions[vertex][2] = shape_rounded(position.z);
}

static void swap_corners(uint32_t corners[3], uint32_t one, uint32_t other)
{
    const uint32_t kept = corners[one];
    corners[one] = corners[other];
    corners[other] = kept;
}

void shape_flip(Mesh *mesh)
{
    for (size_t i = 0; i < mesh->triangle_count; i++)
        swap_corners(mesh->triangles[i], 1, 2);
}

Mesh shape_reordered(Mesh mesh, Random *random)
{
    for (size_t i = 0; i < mesh.triangle_count; i++) {
        swap_corners(mesh.triangles[i], 2, random_below(random, 3));
        swap_corners(mesh.triangles[i], 1, random_below(random, 2));
    }
    return mesh;
}

static size_t put_triangle(Mesh *mesh, size_t triangle, uint32_t a, uint32_t b, uint32_t c)
{
    mesh->triangles[triangle][0] = a;
    mesh->triangles[triangle][1] = b;
    mesh->triangles[triangle][2] = c;
    return triangle + 1;
}

Vec3 shape_center(int exponent)
{
    const double s = ldexp(1, exponent);
    return vec3(s, -0.75 * s, 0.5 * s);
}

// Vertex 0 is the pole at +z, and the last vertex is the pole at -z. rings - 1 circles of vertices
// lie between the poles.
static void connect_globe(Mesh *mesh, uint32_t rings, uint32_t segments)
{
    size_t triangle = 0;
    const uint32_t last = (uint32_t)mesh->vertex_count - 1;
    for (uint32_t segment = 0; segment < segments; segment++) {
        const uint32_t next = (segment + 1) % segments;
        triangle = put_triangle(mesh, triangle, 0, 1 + segment, 1 + next);
        for (uint32_t ring = 0; ring + 2 < rings; ring++) {
            const uint32_t upper = 1 + ring * segments, lower = upper + segments;
            triangle = put_triangle(mesh, triangle, upper + segment, lower + segment, lower + next);
            triangle = put_triangle(mesh, triangle, upper + segment, lower + next, upper + next);
        }
        triangle =
            put_triangle(mesh, triangle, last - segments + segment, last, last - segments + next);
    }
}

// Returns the direction from the center to a vertex of a globe.
static Vec3 globe_direction(uint32_t vertex, uint32_t rings, uint32_t segments)
{
    const uint32_t last = 1 + (rings - 1) * segments;
    if (vertex == 0 || vertex == last)
        return vec3(0, 0, vertex == 0 ? 1 : -1);
    const double polar = 180.0 * (1 + (vertex - 1) / segments) / rings;
    const double around = 360.0 * ((vertex - 1) % segments) / segments;
    const double radius = sine_of_degrees(polar);
    return vec3(radius * cosine_of_degrees(around), radius * sine_of_degrees(around),
                cosine_of_degrees(polar));
}

// The vertices' distance from center is radius or, if random is not NULL, a random number from 1 to
// radius.
static Mesh make_globe(uint32_t rings, uint32_t segments, Vec3 center, double radius,
                       Random *random)
{
    Mesh mesh =
        shape_unfilled(2 + (size_t)(rings - 1) * segments, 2 * (size_t)segments * (rings - 1));
    connect_globe(&mesh, rings, segments);
    for (uint32_t vertex = 0; vertex < mesh.vertex_count; vertex++) {
        const double distance = random != NULL ? random_between(random, 1, radius) : radius;
        const Vec3 direction = globe_direction(vertex, rings, segments);
        shape_set_vertex(&mesh, vertex, vec3_add(center, vec3_scale(direction, distance)));
    }
    return mesh;
}

Mesh shape_sphere(uint32_t rings, Vec3 center)
{
    return make_globe(rings, 2 * rings, center, SPHERE_RADIUS, NULL);
}

Mesh shape_bumpy(Random *random, Vec3 center)
{
    return make_globe(16, 16, center, 6, random);
}

Mesh shape_fan(uint32_t count)
{
    Mesh mesh = shape_unfilled((size_t)count + 1, count);
    shape_set_vertex(&mesh, 0, vec3(0, 0, 0));
    for (uint32_t spoke = 0; spoke < count; spoke++) {
        const double angle = 360.0 * spoke / count;
        shape_set_vertex(&mesh, 1 + spoke,
                         vec3(cosine_of_degrees(angle), sine_of_degrees(angle),
                              0.05 * cosine_of_degrees(4 * angle)));
        put_triangle(&mesh, spoke, 0, 1 + spoke, 1 + (spoke + 1) % count);
    }
    return mesh;
}

// Writes grid number `place` of cells * cells quads. spans are the grid's corner and two sides.
static void put_plane(Mesh *mesh, size_t place, const Vec3 spans[3], uint32_t cells)
{
    const uint32_t first = (uint32_t)place * (cells + 1) * (cells + 1);
    size_t triangle = place * 2 * cells * cells;
    for (uint32_t row = 0; row <= cells; row++)
        for (uint32_t column = 0; column <= cells; column++) {
            const Vec3 across = vec3_scale(spans[1], (double)column / cells);
            const Vec3 down = vec3_scale(spans[2], (double)row / cells);
            const uint32_t corner = first + row * (cells + 1) + column;
            shape_set_vertex(mesh, corner, vec3_add(spans[0], vec3_add(across, down)));
            if (row == cells || column == cells)
                continue;
            const uint32_t below = corner + cells + 1;
            triangle = put_triangle(mesh, triangle, corner, corner + 1, below + 1);
            triangle = put_triangle(mesh, triangle, corner, below + 1, below);
        }
}

Mesh shape_plane(Vec3 corner, Vec3 across, Vec3 down, uint32_t cells)
{
    const size_t side = (size_t)cells + 1;
    Mesh mesh = shape_unfilled(side * side, 2 * (size_t)cells * cells);
    put_plane(&mesh, 0, (Vec3[3]){corner, across, down}, cells);
    return mesh;
}

Mesh shape_cube(double half_side, uint32_t cells)
{
    const double h = half_side;
    const Vec3 x = vec3(2 * h, 0, 0), y = vec3(0, 2 * h, 0), z = vec3(0, 0, 2 * h);
    const Vec3 low = vec3(-h, -h, -h);
    const Vec3 faces[6][3] = {{low, y, x}, {vec3(-h, -h, h), x, y},
                              {low, z, y}, {vec3(h, -h, -h), y, z},
                              {low, x, z}, {vec3(-h, h, -h), z, x}};
    const size_t side = (size_t)cells + 1;
    Mesh mesh = shape_unfilled(6 * side * side, 12 * (size_t)cells * cells);
    for (size_t face = 0; face < 6; face++)
        put_plane(&mesh, face, faces[face], cells);
    return mesh;
}

Mesh shape_soup(Random *random, uint32_t count, double size)
{
    Mesh mesh = shape_unfilled(3 * (size_t)count, count);
    for (uint32_t triangle = 0; triangle < count; triangle++) {
        const Vec3 place = random_in_cube(random, 1);
        for (uint32_t corner = 0; corner < 3; corner++)
            shape_set_vertex(&mesh, 3 * triangle + corner,
                             vec3_add(place, random_in_cube(random, size)));
        put_triangle(&mesh, triangle, 3 * triangle, 3 * triangle + 1, 3 * triangle + 2);
    }
    return mesh;
}

Mesh shape_triangle(Vec3 a, Vec3 b, Vec3 c)
{
    Mesh mesh = shape_unfilled(3, 1);
    shape_set_vertex(&mesh, 0, a);
    shape_set_vertex(&mesh, 1, b);
    shape_set_vertex(&mesh, 2, c);
    put_triangle(&mesh, 0, 0, 1, 2);
    return mesh;
}

// Stores the number of each corner's fan in fans->parents, and returns the number of fans.
static uint32_t find_fans(Fans *fans, const Mesh *mesh, Edges *edges)
{
    Edge edge = {0};
    Error error = {0};
    require(edges_make(edges, mesh, &error) && fans_make(fans, mesh, edges, &error), &error);
    while (edges_next(edges, &edge)) {
        assert_int_equal(edge.count, 2);
        fans_join(fans, edge.low, edge.sides[0].triangle, edge.sides[1].triangle);
        fans_join(fans, edge.sides->high, edge.sides[0].triangle, edge.sides[1].triangle);
    }
    return fans_number(fans);
}

// Returns the mean of the points around a fan.
static Vec3 middle_of_fan(const Mesh *mesh, uint32_t fan)
{
    Vec3 sum = {0};
    double count = 0;
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++)
        for (size_t other = 1; mesh->triangles[i / 3][i % 3] == fan && other < 3; other++) {
            sum = vec3_add(sum, shape_vertex(mesh, mesh->triangles[i / 3][(i + other) % 3]));
            count++;
        }
    return vec3_scale(sum, 1 / count);
}

Mesh shape_apart(const Mesh *mesh)
{
    Fans fans;
    Edges edges;
    const uint32_t count = find_fans(&fans, mesh, &edges);
    Mesh apart = shape_unfilled(count, mesh->triangle_count);
    uint32_t *first = require_memory(mesh->vertex_count, sizeof *first); // first fan at each point
    memset(first, 0xff, mesh->vertex_count * sizeof *first);
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
        const uint32_t vertex = mesh->triangles[i / 3][i % 3];
        apart.triangles[i / 3][i % 3] = fans.parents[i];
        shape_set_vertex(&apart, fans.parents[i], shape_vertex(mesh, vertex));
    }
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
        uint32_t *const known = &first[edges.weld.points[mesh->triangles[i / 3][i % 3]]];
        const uint32_t fan = fans.parents[i];
        *known = *known == WELD_UNUSED ? fan : *known;
        const Vec3 here = shape_vertex(&apart, fan), there = shape_vertex(&apart, *known);
        if (fan != *known && vec3_extent(vec3_sub(here, there)) == 0)
            shape_set_vertex(
                &apart, fan,
                vec3_add(vec3_scale(here, 0.95), vec3_scale(middle_of_fan(&apart, fan), 0.05)));
    }
    free(first);
    free(fans.parents);
    edges_free(&edges);
    return apart;
}

void shape_add(Scene *scene, Mesh mesh, uint32_t material)
{
    Error error = {0};
    const MeshObject object = {.mesh = mesh, .material = material, .two_sided = true};
    require(array_push(&scene->objects, object, &error), &error);
}

Scene shape_scene(Mesh mesh)
{
    Error error = {0};
    Scene scene;
    require(scene_init(&scene, &error), &error);
    shape_add(&scene, mesh, 1);
    return scene;
}
