// SPDX-License-Identifier: MIT
// Compares device functions with host arithmetic of higher precision.
#include "base/vec.h"
#include "kernel/probe.h"
#include "scene/scene.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <math.h>

#define PROBES CLRT_SOURCE_FOLDER "/tests/kernel/probe.cl"

static Probe probe, probe_fp64;

TEST(host_and_device_agree_on_the_layout)
{
    uint32_t sizes[21];
    const ProbeInput none[2] = {0};
    assert_true(probe_run(&probe, "probe_layout", none, 1, (ProbeInput){sizes, sizeof sizes}));
    const size_t expected[21] = {sizeof(Material),
                                 sizeof(PointLight),
                                 sizeof(SphereData),
                                 sizeof(TriangleData),
                                 sizeof(CornerNormals),
                                 sizeof(BvhPair),
                                 sizeof(CameraData),
                                 sizeof(FrameData),
                                 offsetof(SphereData, material),
                                 offsetof(BvhPair, count),
                                 offsetof(FrameData, uses_bvh),
                                 offsetof(TriangleData, shading),
                                 sizeof(BvhWide),
                                 sizeof(TriangleBlock),
                                 sizeof(TriangleLook),
                                 offsetof(BvhWide, child),
                                 offsetof(BvhWide, child_count),
                                 offsetof(TriangleBlock, id),
                                 offsetof(TriangleLook, shading),
                                 sizeof(CornerColors),
                                 offsetof(CornerColors, shading)};
    for (int i = 0; i < 21; i++)
        assert_int_equal(sizes[i], expected[i]);
}

// Each squaring doubles the relative error and adds one rounding, so the error is at most 2^-24 per
// unit of the exponent. The second result of each case is exp(-x). Its x, exponent * -log(base), is
// rounded a few times. A relative error r of x changes exp(-x) by r x exp(-x). This change is below
// 1e-6 for any exponent.
TEST(powers_are_close_to_exact_ones)
{
    static const float exponents[] = {0, 1, 2, 7, 50, 200, 1000, 1024};
    float values[8 * 400][2], results[8 * 400][2];
    for (int i = 0; i < 8 * 400; i++) {
        values[i][0] = 1.0f - (float)(i % 400) * (float)(i % 400) * 6.2e-6f;
        values[i][1] = exponents[i / 400];
    }
    const ProbeInput inputs[2] = {{values, sizeof values}, {0}};
    assert_true(
        probe_run(&probe, "probe_powers", inputs, 8 * 400, (ProbeInput){results, sizeof results}));
    for (int i = 0; i < 8 * 400; i++) {
        const double exact = pow((double)values[i][0], (double)values[i][1]);
        const double squaring = (double)values[i][1] * 0x1p-24 + 1e-7;
        assert_true(fabs((double)results[i][0] - exact) < squaring);
        assert_true(fabs((double)results[i][1] - exact) < 1e-6);
    }
}

TEST(unit_vectors_survive_every_magnitude)
{
    float vectors[181][3], results[181][3];
    for (int i = 0; i <= 180; i++) {
        vectors[i][0] = ldexpf(1.0f, i - 90);
        vectors[i][1] = ldexpf(-0.7f, i - 90);
        vectors[i][2] = ldexpf(0.3f, i - 90);
    }
    const ProbeInput inputs[2] = {{vectors, sizeof vectors}, {0}};
    assert_true(
        probe_run(&probe, "probe_units", inputs, 181, (ProbeInput){results, sizeof results}));
    for (int i = 0; i <= 180; i++) {
        const double x = (double)results[i][0], y = (double)results[i][1],
                     z = (double)results[i][2];
        assert_true(fabs(sqrt(x * x + y * y + z * z) - 1) < 2e-7);
        assert_memory_equal(results[i], results[0], sizeof results[0]);
    }
}

#define CASES 4096

typedef struct {
    float normal[3], half_vector[3];
    float shininess;
    uint32_t exponent; // as in Material
} Highlight;

static Vec3 random_direction(uint64_t *random)
{
    const double x = 2 * random_unit(random) - 1, y = 2 * random_unit(random) - 1;
    return vec3_normalize(vec3(x, y, 2 * random_unit(random) - 1));
}

// Returns a case whose half vector equals the normal, is near the normal, is perpendicular to it,
// or is at any angle to it.
static Highlight highlight_case(int number, double shininess, uint64_t *random)
{
    Material material = {0};
    material_set_shininess(&material, (float)shininess);
    Highlight made = {.shininess = material.shininess, .exponent = material.exponent};
    const Vec3 normal = random_direction(random);
    const Vec3 aside = vec3_normalize(vec3_cross(normal, random_direction(random)));
    const double angles[4] = {0, scalbn(1, -(int)random_below(random, 24)), 0.5 * acos(-1),
                              random_unit(random) * acos(-1)};
    const double angle = angles[number % 4];
    const Vec3 half = vec3_add(vec3_scale(normal, cos(angle)), vec3_scale(aside, sin(angle)));
    vec3_store(made.normal, normal);
    vec3_store(made.half_vector, number % 4 == 0 ? normal : vec3_normalize(half));
    return made;
}

// Returns (n . h + more)^shininess in long double. n and h are the case's float vectors,
// normalized.
static double exact_highlight(const Highlight *made, double more)
{
    long double nn = 0, hh = 0, nh = 0;
    for (int axis = 0; axis < 3; axis++) {
        nn += (long double)made->normal[axis] * made->normal[axis];
        hh += (long double)made->half_vector[axis] * made->half_vector[axis];
        nh += (long double)made->normal[axis] * made->half_vector[axis];
    }
    const long double cosine = fminl(nh / sqrtl(nn * hh) + more, 1);
    if (made->shininess == 0)
        return 1;
    return cosine > 0 ? (double)powl(cosine, made->shininess) : 0;
}

// Returns the error of the result. Below shininess 1, powers of small cosines are steep, so the
// cosine may be off by the rounding of a dot product.
static double error_of(const Highlight *made, double result)
{
    const double slack = made->shininess < 1 ? 0x1p-22 : 0;
    const double low = exact_highlight(made, -slack), high = exact_highlight(made, slack);
    return result < low ? low - result : result > high ? result - high : result - result;
}

TEST(highlights_of_any_shininess_are_exact_to_a_thousandth)
{
    static Highlight cases[CASES];
    static float results[CASES];
    static const double values[] = {0, 1e-3, 1, 50, 1e3, 1e6, 1e9};
    for (size_t value = 0; value < sizeof values / sizeof *values; value++) {
        uint64_t random = 53;
        for (int i = 0; i < CASES; i++)
            cases[i] = highlight_case(i, values[value], &random);
        const ProbeInput inputs[2] = {{cases, sizeof cases}, {0}};
        assert_true(probe_run(&probe, "probe_highlights", inputs, CASES,
                              (ProbeInput){results, sizeof results}));
        // Above shininess 1e6, highlights are single points, and any result in [0, 1] is accepted.
        const double limit = values[value] <= 1e6 ? 1e-3 : 1;
        for (int i = 0; i < CASES; i++) {
            assert_true(error_of(&cases[i], (double)results[i]) <= limit);
            assert_true(results[i] >= 0 && results[i] <= 1);
        }
    }
}

// In fp64, hits of distant and huge spheres must be correct to the last bits of double, and so must
// narrow highlights. A step in float arithmetic would exceed the limit of four roundings of double.
// The exact values are closed forms in long double.
#define ROUNDINGS 0x1p-51

typedef struct {
    SphereData sphere;
    float ray[6];
    long double exact; // the distance of the hit
} SphereCase;

static void store_center(SphereData *sphere, int axis, double center)
{
    sphere->center[axis] = (float)center;
    sphere->center_low[axis] = (float)(center - (double)sphere->center[axis]);
}

static double largest_error(const SphereCase *cases)
{
    static SphereData spheres[CASES];
    static float rays[CASES][6];
    static double distances[CASES];
    double largest = 0;
    for (int i = 0; i < CASES; i++) {
        spheres[i] = cases[i].sphere;
        for (int k = 0; k < 6; k++)
            rays[i][k] = cases[i].ray[k];
    }
    const ProbeInput inputs[2] = {{spheres, sizeof spheres}, {rays, sizeof rays}};
    assert_true(probe_run(&probe_fp64, "probe_spheres", inputs, CASES,
                          (ProbeInput){distances, sizeof distances}));
    for (int i = 0; i < CASES; i++)
        largest = fmax(largest, fabs((double)(distances[i] / cases[i].exact - 1)));
    return largest;
}

// Returns a unit sphere at (3, 4, 0) * distance + (-4, 3, 0) * aside. All numbers are exact, and
// the closed form has no cancellation.
static SphereCase far_case(double distance, double aside)
{
    SphereCase made = {.sphere.radius = 1, .ray = {0, 0, 0, 3, 4, 0}};
    store_center(&made.sphere, 0, 3 * distance - 4 * aside);
    store_center(&made.sphere, 1, 4 * distance + 3 * aside);
    made.exact = distance - sqrtl(1 - 25 * (long double)aside * aside) / 5;
    return made;
}

TEST(distances_of_far_spheres_are_exact_in_fp64)
{
    static SphereCase cases[CASES];
    for (double distance = 0x1p2; distance <= 0x1p22; distance *= 4) {
        for (int i = 0; i < CASES; i++)
            cases[i] = far_case(distance, (i - CASES / 2) * 0x1.98p-14);
        assert_true(largest_error(cases) <= ROUNDINGS);
    }
}

// Returns a sphere that touches the origin from below, and a sloped ray from above that hits it.
static SphereCase ground_case(double radius, float height, float across)
{
    SphereCase made = {.sphere.radius = (float)radius, .ray = {0, 0, height, across, 0, -1}};
    store_center(&made.sphere, 2, -radius);
    const long double h = (long double)height, dd = (long double)across * across + 1;
    const long double b = h + radius, c = h * (h + 2 * radius);
    made.exact = c / (b + sqrtl(b * b - dd * c));
    return made;
}

TEST(distances_of_ground_spheres_are_exact_in_fp64)
{
    static SphereCase cases[CASES];
    for (double radius = 1e3; radius <= 1e9; radius *= 10) {
        for (int i = 0; i < CASES; i++)
            cases[i] = ground_case(radius, 0.25f + (float)(i % 64), (float)(i / 64) * 0.25f);
        assert_true(largest_error(cases) <= ROUNDINGS);
    }
}

// A relative error r of the argument x changes exp(-x) by r x exp(-x). The error of squaring is one
// rounding per unit of the exponent.
TEST(powers_are_right_in_fp64)
{
    static double values[CASES][2], results[CASES][2];
    static const double exponents[] = {1, 3.5, 50, 1000, 1e4, 1e5, 1e6, 1e7};
    for (int i = 0; i < CASES; i++) {
        values[i][1] = exponents[i % 8];
        values[i][0] = exp(-(i / 8) * 0.05 / values[i][1]);
    }
    const ProbeInput inputs[2] = {{values, sizeof values}, {0}};
    assert_true(probe_run(&probe_fp64, "probe_powers", inputs, CASES,
                          (ProbeInput){results, sizeof results}));
    for (int i = 0; i < CASES; i++) {
        const long double exact = expl(values[i][1] * log1pl(values[i][0] - 1));
        assert_true(fabs((double)(results[i][1] - exact)) <= ROUNDINGS);
        if (values[i][1] <= 1024 && values[i][1] == floor(values[i][1]))
            assert_true(fabs((double)(results[i][0] - exact)) <= (values[i][1] + 1) * 0x1p-53);
    }
}

// Applies Snell's and Fresnel's laws with angles instead of cosines. Returns whether light passes.
static bool exact_refraction(double ratio, double cosine, double *beyond, double *reflectance)
{
    const double incoming = acos(fmin(cosine, 1)), sine = ratio * sin(incoming);
    *beyond = 0;
    *reflectance = 1;
    if (sine >= 1)
        return false;
    const double outgoing = asin(sine), upright = (ratio - 1) / (ratio + 1);
    const double s = sin(incoming - outgoing) / sin(incoming + outgoing);
    const double p = tan(incoming - outgoing) / tan(incoming + outgoing);
    *beyond = cos(outgoing);
    *reflectance = incoming < 1e-5 ? upright * upright : (s * s + p * p) / 2;
    return true;
}

#define ANGLES 1000

// Allows for rounding, and for the effect of an error of 4 * 2^-24 in the cosine. The effect is
// largest near the angle of total reflection.
static void expect_refraction(const float given[2], const float result[6])
{
    const double ratio = (double)given[0], cosine = (double)given[1], change = 4 * 0x1p-24;
    double beyond[3], reflectance[3];
    for (int i = 0; i < 3; i++)
        exact_refraction(ratio, cosine + (i - 1) * change, &beyond[i], &reflectance[i]);
    const double slack = 8e-7, beyond_slack = slack + fabs(beyond[2] - beyond[0]);
    const double reflected_slack = slack + fabs(reflectance[2] - reflectance[0]);
    assert_true(fabs((double)result[0] - beyond[1]) < beyond_slack);
    assert_true(fabs((double)result[1] - reflectance[1]) < reflected_slack);
    assert_true(result[1] >= 0 && result[1] + result[2] == 1);
    if (result[1] == 1)
        return;
    const double x = (double)result[3], z = (double)result[5];
    assert_true(fabs(x + ratio * sqrt(1 - cosine * cosine)) < slack * (1 + ratio));
    assert_true(fabs(z + (double)result[0]) < slack * (1 + ratio));
}

TEST(refraction_follows_snell_and_fresnel_at_a_thousand_angles)
{
    static const float ratios[] = {1.5f, 1 / 1.5f, 2.4f, 0.1f, 10, 1.0001f, 0.9999f, 1};
    static float cases[8 * ANGLES][2], results[8 * ANGLES][6];
    for (int i = 0; i < 8 * ANGLES; i++) {
        cases[i][0] = ratios[i / ANGLES];
        cases[i][1] = (float)cos((i % ANGLES) * (acos(-1) / 2 / ANGLES));
    }
    const ProbeInput inputs[2] = {{cases, sizeof cases}, {0}};
    assert_true(probe_run(&probe, "probe_refractions", inputs, 8 * ANGLES,
                          (ProbeInput){results, sizeof results}));
    for (int i = 0; i < 8 * ANGLES; i++)
        expect_refraction(cases[i], results[i]);
    for (int i = 7 * ANGLES; i < 8 * ANGLES; i++)
        assert_true(results[i][1] == 0 && results[i][0] == cases[i][1]);
}

TEST(grazing_and_turned_away_rays_are_reflected)
{
    const float cases[][2] = {{1 / 1.5f, 0}, {1 / 1.5f, -0.5f}, {1.5f, 0}, {1.5f, 0.74f}};
    float results[4][6];
    const ProbeInput inputs[2] = {{cases, sizeof cases}, {0}};
    assert_true(
        probe_run(&probe, "probe_refractions", inputs, 4, (ProbeInput){results, sizeof results}));
    for (int i = 0; i < 4; i++)
        assert_true(results[i][1] == 1 && results[i][2] == 0);
}

TEST(freed_memory_for_results_goes_to_the_next_user_of_this_size)
{
    Error error = {0};
    HostMemory first, other, again;
    assert_true(host_memory_make(&first, probe.device.pool, 5000, &error));
    const void *data = first.data;
    host_memory_free(&first);
    assert_true(host_memory_make(&other, probe.device.pool, 6000, &error));
    assert_true(host_memory_make(&again, probe.device.pool, 5000, &error));
    assert_ptr_equal(again.data, data);
    assert_ptr_not_equal(other.data, data);
    host_memory_free(&other);
    host_memory_free(&again);
}

SET_UP(open_probes)
{
    return probe_begin(&probe, PROBES, CLRT_FP32) + probe_begin(&probe_fp64, PROBES, CLRT_FP64);
}

TEAR_DOWN(close_probes)
{
    probe_close(&probe);
    probe_close(&probe_fp64);
    return 0;
}
