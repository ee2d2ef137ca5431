// SPDX-License-Identifier: MIT
// Refined pictures must show parts of meshes that are narrower than a pixel, at any contrast.
#include "image/form.h"
#include "image/rendered.h"
#include "unit/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define SIDE 181
#define PI   3.14159265358979

// A corner's position, in pixels to the right of and above the center of a picture of SIDE x SIDE
// pixels.
typedef struct {
    double x, y;
} Corner;

// Triangles that share no vertex. The camera sees their corners counter-clockwise.
typedef struct {
    char scene[TEMPORARY_PATH], mesh[TEMPORARY_PATH];
    Mesh triangles;
    size_t capacity;
} Drawing;

static Drawing drawing_of(size_t capacity)
{
    Drawing drawing = {.capacity = capacity};
    drawing.triangles.positions = calloc(3 * capacity, sizeof *drawing.triangles.positions);
    drawing.triangles.triangles = calloc(capacity, sizeof *drawing.triangles.triangles);
    assert_true(drawing.triangles.positions != NULL && drawing.triangles.triangles != NULL);
    return drawing;
}

static void add_triangle(Drawing *drawing, Corner a, Corner b, Corner c)
{
    const Corner corners[3] = {a, b, c};
    const double pixel = 2 * 100 * tan(PI / 6) / SIDE;
    Mesh *mesh = &drawing->triangles;
    assert_true(mesh->triangle_count < drawing->capacity);
    for (int i = 0; i < 3; i++) {
        mesh->positions[mesh->vertex_count][0] = corners[i].x * pixel;
        mesh->positions[mesh->vertex_count][2] = corners[i].y * pixel;
        mesh->triangles[mesh->triangle_count][i] = (uint32_t)mesh->vertex_count++;
    }
    mesh->triangle_count++;
}

// Returns a request for the drawing, with brightness `light` on a black background.
static PictureRequest request_of(Drawing *drawing, double light)
{
    temporary_mesh(drawing->mesh, &drawing->triangles);
    FILE *stream = temporary_open(drawing->scene);
    fprintf(stream,
            "background 0 0 0\ndefine it silhouette diffuse %g %g %g\nmaterial it\n"
            "camera 0 -100 0 0 0 0 60\nply_file %s\n",
            light, light, light, drawing->mesh);
    temporary_close(stream);
    PictureRequest request = picture_request(drawing->scene, 1);
    request.width = request.height = SIDE;
    request.contrast = 0.04f;
    return request;
}

static void drawing_free(Drawing *drawing)
{
    remove(drawing->scene);
    remove(drawing->mesh);
    mesh_free(&drawing->triangles);
}

static Corner turned(Corner center, double radius, double angle)
{
    return (Corner){center.x + radius * cos(angle), center.y + radius * sin(angle)};
}

#define GRID 60

static Corner middle_of(int column, int row)
{
    return (Corner){3.013 * (column - GRID / 2) + 0.5, 2.971 * (row - GRID / 2) + 1.5};
}

// Adds triangles at distances of about three pixels. Half of them are slivers: the diameter of the
// incircle is about a third of the circumcircle's radius. Returns the total area.
static double add_grid(Drawing *drawing)
{
    static const double radii[] = {0.6, 0.4, 0.2, 0.1, 0.07, 0.05};
    double area = 0;
    for (int row = 0; row < GRID; row++)
        for (int column = 0; column < GRID; column++) {
            const double angle = row + 2.7 * column, radius = radii[(7 * row + column) % 6];
            const double spread = (row + column) % 2 == 0 ? 2 * PI / 3 : PI - 0.2;
            const Corner center = middle_of(column, row);
            const Corner a = turned(center, radius, angle),
                         b = turned(center, radius, angle + spread),
                         c = turned(center, radius, angle + 2 * PI - spread);
            add_triangle(drawing, a, b, c);
            area += ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)) / 2;
        }
    return area;
}

static double light_around(const Framebuffer *picture, Corner center)
{
    const int column = (int)(SIDE / 2.0 + center.x), row = (int)(SIDE / 2.0 - center.y);
    double light = 0;
    for (int y = row - 1; y <= row + 1; y++)
        for (int x = column - 1; x <= column + 1; x++)
            light += (double)picture->pixels[y * SIDE + x][0];
    return light;
}

TEST(thousands_of_triangles_smaller_than_pixels_are_all_seen)
{
    FREED_BY(drawing_free) Drawing drawing = drawing_of(GRID * GRID);
    const double area = add_grid(&drawing);
    const PictureRequest request = request_of(&drawing, 1);
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    double sum = 0;
    int seen = 0;
    for (int row = 0; row < GRID; row++)
        for (int column = 0; column < GRID; column++) {
            const double light = light_around(&picture, middle_of(column, row));
            sum += light;
            seen += light > 0;
        }
    assert_int_equal(seen, GRID * GRID);
    assert_true(fabs(sum / area - 1) < 0.05);
}

// Adds a strip of two triangles across the picture.
static void add_cable(Drawing *drawing, Corner from, Corner to, double thickness)
{
    const double x = to.x - from.x, y = to.y - from.y;
    const double part = thickness / 2 / sqrt(x * x + y * y);
    const Corner corners[4] = {{from.x + part * y, from.y - part * x},
                               {to.x + part * y, to.y - part * x},
                               {to.x - part * y, to.y + part * x},
                               {from.x - part * y, from.y + part * x}};
    add_triangle(drawing, corners[0], corners[1], corners[2]);
    add_triangle(drawing, corners[0], corners[2], corners[3]);
}

static void expect_unbroken(double light, double from, double to)
{
    FREED_BY(drawing_free) Drawing drawing = drawing_of(2);
    const double length = SIDE + 20, slope = (to - from) / length;
    add_cable(&drawing, (Corner){-length / 2, from}, (Corner){length / 2, to}, 0.1);
    const PictureRequest request = request_of(&drawing, light);
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    const double expected = 0.1 * sqrt(1 + slope * slope) * light;
    for (int x = 0; x < SIDE; x++) {
        double sum = 0;
        for (int y = 0; y < SIDE; y++)
            sum += (double)picture.pixels[y * SIDE + x][0];
        if (fabs(sum / expected - 1) > 0.35)
            fail_msg("column %d has %g of the light", x, sum / expected);
    }
}

TEST(a_cable_a_tenth_of_a_pixel_thick_is_an_unbroken_line)
{
    expect_unbroken(1, -40, 55);
    expect_unbroken(0.02, -40, 55); // too little contrast for refinement by contrast
    expect_unbroken(0.02, 7.3, 7.3);
}

TEST(backs_of_one_sided_triangles_take_no_samples)
{
    uint64_t samples;
    FREED_BY(drawing_free) Drawing drawing = drawing_of(GRID * GRID);
    add_grid(&drawing);
    for (size_t i = 0; i < drawing.triangles.triangle_count; i++) {
        uint32_t *corners = drawing.triangles.triangles[i];
        const uint32_t first = corners[0];
        corners[0] = corners[1];
        corners[1] = first;
    }
    PictureRequest request = request_of(&drawing, 1);
    request.sample_count = &samples;
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    assert_int_equal(samples, SIDE * SIDE);
}

#define FINE 400

// Adds a wall of triangles that are all smaller than pixels.
static void add_wall(Drawing *drawing, double width)
{
    const double step = width / FINE;
    for (int row = 0; row < FINE; row++)
        for (int column = 0; column < FINE; column++) {
            const double x = -width / 2 + column * step, y = -width / 2 + row * step;
            const Corner a = {x, y}, b = {x + step, y}, c = {x + step, y + step}, d = {x, y + step};
            add_triangle(drawing, a, b, c);
            add_triangle(drawing, a, c, d);
        }
}

static uint64_t samples_of(Drawing *drawing)
{
    uint64_t samples;
    PictureRequest request = request_of(drawing, 1);
    request.sample_count = &samples;
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    drawing_free(drawing);
    return samples;
}

TEST(a_wide_mesh_of_small_triangles_takes_the_samples_of_a_large_one)
{
    const double half = 60.3;
    Drawing fine = drawing_of(2 * FINE * FINE), plain = drawing_of(2);
    add_wall(&fine, 2 * half);
    add_triangle(&plain, (Corner){-half, -half}, (Corner){half, -half}, (Corner){half, half});
    add_triangle(&plain, (Corner){-half, -half}, (Corner){half, half}, (Corner){-half, half});
    assert_int_equal(samples_of(&fine), samples_of(&plain));
}
