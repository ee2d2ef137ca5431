// SPDX-License-Identifier: MIT
// Tests properties of glass that need no second ray tracer.
#include "image/form.h"
#include "image/rendered.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#define FOLDER CLRT_SOURCE_FOLDER "/scenes"
#define BLOCK  CLRT_SOURCE_FOLDER "/tests/image/block.ply"
#define BALL   CLRT_SOURCE_FOLDER "/tests/image/ball.ply"

// The number of meshes along a side of the grid.
#define SIDE 8

// Writes a floor in the light of a sun, and meshes of glass above it, each turned at random. Every
// mesh contains a cube that does not touch it.
static void write_turned_meshes(char path[TEMPORARY_PATH], const char *mesh, double ior,
                                uint64_t seed)
{
    FILE *stream = temporary_open(path);
    uint64_t random = seed;
    fprintf(stream,
            "size 199 197\nbackground 1 1 1\nambient 0\nmax_level 16\n"
            "up 0 1 0\ncamera 0.3 -0.2 9  0 0 0  orthographic 7\n"
            "sun 0.4 -0.3 1 0.9\n"
            "define pane glass ior %g color 0.5 1 1\ndefine floor matte\n"
            "material floor\nmesh " FOLDER "/plateau.ply scale 3 translate 0 0 -3\n"
            "material pane\n",
            ior);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double x = (i % SIDE - 3.5) * 0.8, y = (i / SIDE - 3.5) * 0.8;
        for (int inner = 0; inner < 2; inner++)
            fprintf(stream, "mesh %s scale %g rotate %g %g %g %g translate %g %g 2\n",
                    inner ? BLOCK : mesh, inner ? 0.1 : 0.24, random_unit(&random) - 0.5,
                    random_unit(&random) - 0.5, random_unit(&random) + 0.1,
                    random_unit(&random) * 360, x, y);
    }
    temporary_close(stream);
}

// Returns the number of crossings. Each crossing halves the red channel without rounding.
static uint32_t crossings_of(const float color[3])
{
    assert_true(color[0] > 0 && color[1] == color[2]);
    return (uint32_t)lround(log2((double)color[1] / (double)color[0]));
}

// A ray that leaks into or out of a closed mesh crosses an odd number of surfaces.
TEST(straight_rays_leak_through_no_turned_cube)
{
    char path[TEMPORARY_PATH];
    uint32_t most = 0;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        write_turned_meshes(path, BLOCK, 1, seed);
        const PictureRequest request = picture_request(path, 1);
        FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
        for (size_t i = 0; i < (size_t)picture.width * picture.height; i++) {
            const float *color = picture.pixels[i];
            const uint32_t crossings = crossings_of(color);
            most = crossings > most ? crossings : most;
            assert_int_equal(crossings % 2, 0);
            assert_true(color[0] == scalbnf(color[1], -(int)crossings));
        }
        unlink(path);
    }
    assert_true(most >= 6); // a ray crosses two meshes, and its shadow ray crosses a cube
}

// Expects each ray that hits no glass to be outside of all glass: the rays before it must have
// crossed an even number of surfaces.
static void expect_outside(const Explainer *explainer, const ExplainedSample *sample)
{
    uint32_t crossings[GLASS_LEVELS + 1] = {0};
    for (uint32_t i = 0; i < sample->found.ray_count; i++) {
        const ClrtExplainedRay *ray = &sample->rays[i].found;
        const uint32_t level = ray->level;
        if (level > 0)
            crossings[level] = crossings[level - 1] + ray->is_refracted;
        const bool hits = ray->primitive != NOTHING;
        if (hits && explainer->scene->materials.data[ray->material].shader == SHADER_GLASS)
            continue;
        assert_true(ray->is_cut || crossings[level] % 2 == 0);
    }
}

static void follow_rays(Explainer *explainer, const Framebuffer *picture, void *context)
{
    uint64_t *ray_count = context;
    for (uint32_t y = 0; y < picture->height; y += 4)
        for (uint32_t x = 0; x < picture->width; x += 4) {
            Error error = {0};
            ExplainedSample sample;
            const uint32_t pixel[2] = {x, y};
            rendered_require(explainer_trace(explainer, pixel, 0, &sample, &error), &error);
            expect_outside(explainer, &sample);
            *ray_count += sample.found.ray_count;
            explained_sample_free(&sample);
        }
}

// The balls have interpolated normals, which send some refracted rays back out of the face.
TEST(refracted_rays_leak_through_no_turned_mesh)
{
    static const char *const meshes[] = {BLOCK, BALL};
    uint64_t ray_count = 0;
    for (uint64_t seed = 1; seed <= 2; seed++) {
        char path[TEMPORARY_PATH];
        write_turned_meshes(path, meshes[seed - 1], 1.5, seed);
        PictureRequest request = picture_request(path, 1);
        request.max_level = 8;
        request.visit = follow_rays;
        request.visit_context = &ray_count;
        FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
        unlink(path);
    }
    print_message("%llu rays\n", (unsigned long long)ray_count);
    assert_true(ray_count > 10000);
}

static Framebuffer drawn_behind(const char *front)
{
    char path[TEMPORARY_PATH];
    FILE *stream = temporary_open(path);
    fprintf(stream,
            "size 160 120\nmax_level 6\ncamera 2.6 -3.6 2.2  0 0 0.3  38\nlight 4 -3 6 0.8\n"
            "define clear glass ior 1\ndefine glaze blinn_phong reflectivity 0.2\nmaterial 1\n"
            "mesh " FOLDER "/plateau.ply\nmaterial glaze\nmesh " FOLDER "/cone.ply scale 0.5 "
            "translate 0 0 0.1\nsphere 0.9 0.4 0.3 0.3\n%s",
            front);
    temporary_close(stream);
    const PictureRequest request = picture_request(path, 1);
    const Framebuffer picture = rendered(&request);
    unlink(path);
    return picture;
}

// At the surface of the glass, a new ray continues the path, so pixels with and without the glass
// differ by rounding. At the edges of other shapes, rounding may decide which shape a ray hits.
TEST(a_ball_of_index_one_is_invisible)
{
    uint32_t differing = 0;
    FREED_BY(framebuffer_free) Framebuffer with = drawn_behind("material clear\nsphere 0 0 0 2\n");
    FREED_BY(framebuffer_free) Framebuffer without = drawn_behind("");
    for (size_t i = 0; i < (size_t)with.width * with.height; i++)
        for (int channel = 0; channel < 3; channel++)
            differing += fabsf(with.pixels[i][channel] - without.pixels[i][channel]) > 2e-5f;
    assert_true(differing <= 12);
}

// With all levels, the weights of all branches have the sum 1. A white ball in a white world is
// therefore as white as the background, up to the rounding of the sums.
TEST(reflectance_and_transmittance_sum_to_one_along_a_path)
{
    char path[TEMPORARY_PATH];
    FILE *stream = temporary_open(path);
    fprintf(stream, "size 64 64\nbackground 1 1 1\nmax_level 12\ncamera 0 -5 0  0 0 0  40\n"
                    "define clear glass ior 1.5\ndefine air glass ior 0.667\nmaterial clear\n"
                    "sphere 0 0 0 1\nmaterial air\nsphere 0.2 0.1 0.1 0.5\n");
    temporary_close(stream);
    const PictureRequest request = picture_request(path, 1);
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    for (size_t i = 0; i < (size_t)picture.width * picture.height; i++)
        for (int channel = 0; channel < 3; channel++)
            assert_true(fabsf(picture.pixels[i][channel] - 1) < 1e-6f);
    unlink(path);
}

// Draws a thin triangle of glass. Blocks fix the frame, and are so many triangles that there is a
// tree.
static void write_needle(char path[TEMPORARY_PATH], const char *needle)
{
    FILE *stream = temporary_open(path);
    fprintf(stream, "size 1024 1024\nbackground 1 1 1\nmax_level 4\nup 1 0 0\n"
                    "camera 0.0005859375 0.001953125 -0.001953125  0 0 0  orthographic 1e-6\n"
                    "define pane glass ior 1 color 0.5 1 1\nmaterial pane\n");
    fprintf(stream, "mesh %s\n", needle);
    for (int i = 0; i < 3; i++)
        fprintf(stream, "mesh " BLOCK " scale 0.25 translate %g %g %g\n", i == 1 ? -0.75 : 0.75,
                i == 1 ? -0.75 : 0.75, i == 0 ? 0.75 : -0.75);
    temporary_close(stream);
}

// Near the corner at the middle of this needle, coordinates almost cancel. Rounding puts some
// points so far before the triangle that height_over (kernels/triangle.inc.cl) is not zero. A
// search for the worst case found the needle. Without the test for the ray's own triangle in
// accept.cl and wide.cl, 6 rays hit the needle again, in pairs and in single rays.
TEST(a_ray_does_not_hit_its_own_triangle_again)
{
    char path[TEMPORARY_PATH], needle[TEMPORARY_PATH];
    double positions[3][3] = {{-0x1.01b544p-19, 0x1.188138p-20, -0x1.8dad88p-24},
                              {-0x1.c71326p-20, 0x1.2d5cap-1, 0x1.321cdep-1},
                              {0x1.acdcep-18, -0x1.1e329ep-1, -0x1.22b516p-1}};
    uint32_t triangle[1][3] = {{0, 1, 2}};
    const Mesh mesh = {
        .positions = positions, .triangles = triangle, .vertex_count = 3, .triangle_count = 1};
    temporary_mesh(needle, &mesh);
    write_needle(path, needle);
    for (int form = 0; form < FORMS_FEW - 1; form++) {
        const PictureRequest usual = picture_request(path, 1);
        const PictureRequest request = rendered_in_form(usual, &form_few[form]);
        FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
        for (size_t i = 0; i < (size_t)picture.width * picture.height; i++)
            assert_true(picture.pixels[i][0] == 0.5f);
    }
    unlink(path);
    unlink(needle);
}
