// SPDX-License-Identifier: MIT
// Tests that no ray leaks into or out of closed meshes of glass. The meshes are strongly curved,
// most are not convex, and each is turned by a random angle. CLRT_SEED repeats a run. The full run,
// ctest -C extremes2, has 100 times as many rays.
#include "image/rendered.h"
#include "library/closed_meshes.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

// The last closed mesh is omitted, because it touches itself. Rays may leak where parts touch.
#define KINDS (CLOSED_MESHES - 1)

// The number of meshes along a side of the grid. Each kind occurs twice flat and twice smooth.
#define SIDE 6

#define START                                                                                      \
    "size 149 151\nbackground 1 1 1\nambient 0\nmax_level 16\nup 0 1 0\n"                          \
    "camera 0.3 -0.2 9  0 0 0  orthographic 5\nlight 1 -2 9 0.9\n"
// The shade of the floor changes by less than 2^-5 per unit of length.
#define FLOOR                                                                                      \
    "material 1\nmesh " CLRT_SOURCE_FOLDER "/scenes/plateau.ply scale 3 translate 0 0 -3\n"

static char mesh_paths[KINDS][TEMPORARY_PATH];
static uint64_t random_state;

static int rounds(void)
{
    const char *tier = getenv("CLRT_TEST_TIER");
    return tier != NULL && atoi(tier) > 1 ? 400 : 4;
}

static double volume_of(const Mesh *mesh)
{
    double volume = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corners = mesh->triangles[i];
        const Vec3 a = vec3_of_doubles(mesh->positions[corners[0]]);
        const Vec3 b = vec3_of_doubles(mesh->positions[corners[1]]);
        const Vec3 c = vec3_of_doubles(mesh->positions[corners[2]]);
        volume += vec3_dot(a, vec3_cross(b, c)) / 6;
    }
    return volume;
}

// Turns all triangles around if their fronts are inside.
static void turn_fronts_outward(Mesh *mesh)
{
    const bool is_inside_out = volume_of(mesh) < 0;
    for (size_t i = 0; is_inside_out && i < mesh->triangle_count; i++) {
        uint32_t *corners = mesh->triangles[i];
        const uint32_t first = corners[0];
        corners[0] = corners[1];
        corners[1] = first;
    }
}

static void write_mesh(int kind)
{
    ClosedMesh closed = closed_mesh_make(kind);
    Mesh mesh = {.positions = closed_mesh_positions(&closed),
                 .triangles = closed.faces,
                 .vertex_count = closed.vertex_count,
                 .triangle_count = closed.face_count};
    turn_fronts_outward(&mesh);
    temporary_mesh(mesh_paths[kind], &mesh);
    free(mesh.positions);
    closed_mesh_free(&closed);
}

SET_UP(write_meshes)
{
    const char *seed = getenv("CLRT_SEED");
    random_state = seed != NULL ? strtoull(seed, NULL, 10)
                                : (uint64_t)time(NULL) * 1000003u + (uint64_t)getpid();
    print_message("CLRT_SEED=%llu\n", (unsigned long long)random_state);
    for (int kind = 0; kind < KINDS; kind++)
        write_mesh(kind);
    return 0;
}

TEAR_DOWN(remove_meshes)
{
    for (int kind = 0; kind < KINDS; kind++)
        unlink(mesh_paths[kind]);
    return 0;
}

// Writes statements for a grid of turned meshes, which do not touch each other.
static void write_grid(FILE *stream)
{
    for (int i = 0; i < SIDE * SIDE; i++) {
        fprintf(stream, "normals %s\nmesh %s scale 0.22 rotate",
                i / KINDS % 2 == 0 ? "flat" : "smooth 180", mesh_paths[i % KINDS]);
        for (int axis = 0; axis < 3; axis++)
            fprintf(stream, " %.17g", random_unit(&random_state) - 0.5);
        fprintf(stream, " %.17g", random_unit(&random_state) * 360);
        fprintf(stream, " translate %g %g 2\n", (i % SIDE - 2.5) * 0.8, (i / SIDE - 2.5) * 0.8);
    }
}

// Draws a floor in the light of a lamp. If the index of refraction is not 0, meshes of glass are in
// front of the floor. Glass halves the red channel at each crossing.
static Framebuffer drawn(double ior, PictureVisit *visit, void *context)
{
    char path[TEMPORARY_PATH];
    FILE *stream = temporary_open(path);
    fputs(START FLOOR, stream);
    if (ior > 0) {
        fprintf(stream, "define pane glass ior %.17g color 0.5 1 1\nmaterial pane\n", ior);
        write_grid(stream);
    }
    temporary_close(stream);
    PictureRequest request = picture_request(path, 1);
    request.visit = visit;
    request.visit_context = context;
    const Framebuffer picture = rendered(&request);
    unlink(path);
    return picture;
}

// The largest allowed difference of a color channel between the floor behind glass and the bare
// floor. At each crossing, a new ray continues the path, and its start is rounded. Together, these
// starts move the path by less than 2^-16 units of length. Among nine million pixels, the largest
// measured difference was 2^-23.
#define INVISIBLE 0x1p-21

typedef struct {
    uint64_t most;    // crossings on a path
    uint64_t crossed; // paths with crossings
    uint64_t cut;     // paths that max_level cuts off
    double largest;   // difference from the picture without glass
} Straight;

// Expects the path of a pixel, and its shadow ray, to cross an even number of surfaces. Glass takes
// nothing from the green channel. Only cut paths have the color of the background, which is 1.
static void judge_pixel(Straight *found, const float color[3], const float floor[3])
{
    assert_true(color[0] > 0 && floor[1] < 1);
    const long crossings = lround(log2((double)color[1] / (double)color[0]));
    const double red = scalbn((double)color[1], -(int)crossings);
    assert_int_equal(crossings % 2, 0);
    assert_true(fabs((double)color[0] - red) <= 0x1p-25); // pixels are floats
    found->most = crossings > (long)found->most ? (uint64_t)crossings : found->most;
    found->crossed += crossings > 0;
    found->cut += color[1] == 1;
    if (color[1] < 1)
        found->largest = fmax(found->largest, fabs((double)color[1] - (double)floor[1]));
}

TEST(meshes_of_index_one_are_invisible)
{
    Straight found = {0};
    FREED_BY(framebuffer_free) Framebuffer floor = drawn(0, NULL, NULL);
    for (int round = 0; round < rounds(); round++) {
        FREED_BY(framebuffer_free) Framebuffer picture = drawn(1, NULL, NULL);
        for (size_t i = 0; i < (size_t)picture.width * picture.height; i++)
            judge_pixel(&found, picture.pixels[i], floor.pixels[i]);
    }
    assert_true(found.largest <= INVISIBLE);
    assert_true(found.most >= 8 && found.cut * 1000 < found.crossed);
    print_message("%llu paths cross up to %llu surfaces, %llu are cut; differences up to %.2g\n",
                  (unsigned long long)found.crossed, (unsigned long long)found.most,
                  (unsigned long long)found.cut, found.largest);
}

typedef struct {
    uint64_t inside, outside; // hits from inside and from outside
    uint64_t reflected;       // hits from inside after a reflection
    uint64_t close;           // hits whose side rounding may decide
} Sides;

// Returns the number of a triangle in its mesh, and stores the mesh.
static size_t triangle_of(const Scene *scene, uint32_t id, const Mesh **mesh)
{
    size_t triangle = id - scene->spheres.count;
    const MeshObject *object = scene->objects.data;
    for (; triangle >= object->mesh.triangle_count; object++)
        triangle -= object->mesh.triangle_count;
    *mesh = &object->mesh;
    return triangle;
}

// Returns the least altitude of the triangle that the ray hits, as seen along the ray. The result
// is positive if the ray comes from behind the triangle.
static double altitude_along(const Scene *scene, const ClrtExplainedRay *ray)
{
    const Mesh *mesh;
    const size_t triangle = triangle_of(scene, ray->primitive, &mesh);
    const uint32_t *corners = mesh->triangles[triangle];
    const Vec3 a = vec3_of_doubles(mesh->positions[corners[0]]);
    const Vec3 ab = vec3_sub(vec3_of_doubles(mesh->positions[corners[1]]), a);
    const Vec3 ac = vec3_sub(vec3_of_doubles(mesh->positions[corners[2]]), a);
    const Vec3 bc = vec3_sub(ac, ab);
    const double longest = sqrt(fmax(vec3_dot(bc, bc), fmax(vec3_dot(ab, ab), vec3_dot(ac, ac))));
    return vec3_dot(vec3_cross(ab, ac), vec3_of_doubles(ray->direction)) / longest;
}

// The kernels round corners to within 6 units of their distance from the ray's start, which is less
// than 14. This rounding can turn around triangles whose altitude along the ray is smaller.
#define ALTITUDE_ERROR 0x1p-16

static void judge_side(Sides *sides, double altitude, bool is_inside, bool is_reflected)
{
    if (fabs(altitude) > ALTITUDE_ERROR)
        assert_true((altitude > 0) == is_inside);
    else
        sides->close++;
    sides->inside += is_inside;
    sides->outside += !is_inside;
    sides->reflected += is_inside && is_reflected;
}

// Expects each ray to hit glass from the side that follows from the crossings before it. Rays that
// hit no glass must be outside.
static void judge_sample(Sides *sides, const Scene *scene, const ExplainedSample *sample)
{
    uint32_t crossings[GLASS_LEVELS + 1] = {0};
    for (uint32_t i = 0; i < sample->found.ray_count; i++) {
        const ClrtExplainedRay *ray = &sample->rays[i].found;
        const uint32_t level = ray->level;
        if (level > 0)
            crossings[level] = crossings[level - 1] + ray->is_refracted;
        const bool is_inside = crossings[level] % 2 == 1;
        if (ray->is_cut)
            continue;
        if (ray->primitive != NOTHING &&
            scene->materials.data[ray->material].shader == SHADER_GLASS)
            judge_side(sides, altitude_along(scene, ray), is_inside, !ray->is_refracted);
        else
            assert_false(is_inside);
    }
}

static void follow_rays(Explainer *explainer, const Framebuffer *picture, void *context)
{
    for (uint32_t y = 0; y < picture->height; y += 3)
        for (uint32_t x = 0; x < picture->width; x += 3) {
            Error error = {0};
            ExplainedSample sample;
            const uint32_t pixel[2] = {x, y};
            rendered_require(explainer_trace(explainer, pixel, 0, &sample, &error), &error);
            judge_sample(context, explainer->scene, &sample);
            explained_sample_free(&sample);
        }
}

// Smooth normals send some refracted rays back out of the face. Total reflection keeps some rays
// inside for many levels.
TEST(rays_enter_and_leave_meshes_alternately)
{
    Sides sides = {0};
    for (int round = 0; round < rounds(); round++) {
        const double ior = random_between(&random_state, 0.5, 2.5);
        FREED_BY(framebuffer_free) Framebuffer picture = drawn(ior, follow_rays, &sides);
    }
    assert_true(sides.outside > 10000 && sides.reflected > 10000);
    assert_true(sides.close * 1000 < sides.outside);
    print_message("hits: %llu from outside, %llu from inside, of them %llu after a reflection; the "
                  "sides of %llu are close\n",
                  (unsigned long long)sides.outside, (unsigned long long)sides.inside,
                  (unsigned long long)sides.reflected, (unsigned long long)sides.close);
}
