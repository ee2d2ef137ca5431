// SPDX-License-Identifier: MIT
// Compares device functions with host arithmetic of twice the precision.
#include "kernel/probe.h"
#include "unit/cmocka_all.h"

#include <math.h>

static Probe probe;

TEST(host_and_device_agree_on_the_layout)
{
    uint32_t sizes[19];
    const ProbeInput none[2] = {0};
    assert_true(probe_run(&probe, "probe_layout", none, 1, (ProbeInput){sizes, sizeof sizes}));
    const size_t expected[19] = {sizeof(Material),
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
                                 offsetof(TriangleData, normals),
                                 sizeof(BvhWide),
                                 sizeof(TriangleBlock),
                                 sizeof(TriangleLook),
                                 offsetof(BvhWide, child),
                                 offsetof(BvhWide, child_count),
                                 offsetof(TriangleBlock, id),
                                 offsetof(TriangleLook, normals)};
    for (int i = 0; i < 19; i++)
        assert_int_equal(sizes[i], expected[i]);
}

// Each squaring doubles the relative error and adds one rounding, so the error is 2^-24 per unit of
// the exponent. The other path rounds the argument x of exp(-x) a few times. This changes the
// result by x exp(-x) times the rounding, which is below 1e-6 for any exponent.
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

typedef struct {
    SphereData sphere;
    float ray[6];
    double exact; // INFINITY for a miss
    bool clear;   // the ray is no tangent within rounding
} SphereCase;

static double random_unit(uint64_t *random)
{
    *random = *random * 6364136223846793005u + 1442695040888963407u;
    return (double)(*random >> 11) * 0x1p-52 - 1;
}

static long double exact_distance(const long double f[3], const float d[3], long double radius,
                                  bool *clear)
{
    long double dd = 0, b = 0, ff = 0;
    for (int axis = 0; axis < 3; axis++) {
        dd += (long double)d[axis] * d[axis];
        b -= f[axis] * (long double)d[axis];
        ff += f[axis] * f[axis];
    }
    const long double c = (sqrtl(ff) - radius) * (sqrtl(ff) + radius);
    const long double discriminant = b * b - dd * c;
    *clear = fabsl(discriminant) > 1e-6L * dd * radius * radius;
    if (discriminant < 0)
        return INFINITY;
    const long double q = b + copysignl(sqrtl(discriminant), b);
    const long double one = c / q, other = q / dd;
    const long double near = fminl(one, other), far = fmaxl(one, other);
    return near > 0 ? near : far > 0 ? far : (long double)INFINITY;
}

// Returns a sphere of that radius at that distance, and a ray aimed within 1.2 radii of its center.
static SphereCase sphere_case(double radius, double distance, uint64_t *random)
{
    SphereCase made = {0};
    long double f[3];
    double aim[3];
    for (int axis = 0; axis < 3; axis++) {
        const double center = axis == 0 ? distance : random_unit(random);
        made.sphere.center[axis] = (float)center;
        made.sphere.center_low[axis] = (float)(center - (double)made.sphere.center[axis]);
        made.ray[axis] = (float)(0.1 * random_unit(random));
        aim[axis] = center + (axis == 0 ? 0 : 0.85 * radius * random_unit(random));
        made.ray[3 + axis] = (float)((aim[axis] - (double)made.ray[axis]) / distance);
        f[axis] = (long double)made.ray[axis] - (long double)made.sphere.center[axis] -
                  (long double)made.sphere.center_low[axis];
    }
    made.sphere.radius = (float)radius;
    made.sphere.radius_low = (float)(radius - (double)made.sphere.radius);
    const long double whole = (long double)made.sphere.radius + made.sphere.radius_low;
    made.exact = (double)exact_distance(f, made.ray + 3, whole, &made.clear);
    return made;
}

#define CASES 20000

// Spheres of radius 1 in two floats give correct hits up to a distance of 1e4, and distances within
// 3e-7. With single floats, a quarter of these rays is wrong at 1e4.
TEST(far_spheres_are_hit_and_missed_as_exactly)
{
    static SphereData spheres[CASES];
    static float rays[CASES][6], distances[CASES];
    static SphereCase cases[CASES];
    uint64_t random = 7;
    for (double distance = 10; distance <= 1e4; distance *= 10) {
        for (int i = 0; i < CASES; i++) {
            cases[i] = sphere_case(1, distance, &random);
            spheres[i] = cases[i].sphere;
            for (int k = 0; k < 6; k++)
                rays[i][k] = cases[i].ray[k];
        }
        const ProbeInput inputs[2] = {{spheres, sizeof spheres}, {rays, sizeof rays}};
        assert_true(probe_run(&probe, "probe_spheres", inputs, CASES,
                              (ProbeInput){distances, sizeof distances}));
        int hits = 0;
        for (int i = 0; i < CASES; i++) {
            if (!cases[i].clear)
                continue;
            assert_int_equal(isinf(distances[i]), isinf(cases[i].exact));
            if (isinf(cases[i].exact))
                continue;
            hits++;
            assert_true(fabs((double)distances[i] / cases[i].exact - 1) < 3e-7);
        }
        assert_in_range(hits, CASES / 4, CASES);
    }
}

#define MASKS 65536
#define WORDS 4096

static Probe open_lanes(uint32_t lanes)
{
    Probe opened;
    Error error = {0};
    const KernelChoice choice = {FAMILY_PACKET, NODES_WIDE, lanes, PRECISION_FP32};
    if (!probe_open(&opened, &choice, &error))
        fail_msg("%s", error.text);
    return opened;
}

// Checks all possible masks.
static void check_masks(const Probe *lanes_probe, uint32_t lanes)
{
    static uint32_t bits[MASKS], results[MASKS][2], truths[MASKS * 16];
    const uint32_t count = 1u << lanes;
    for (uint32_t mask = 0; mask < count; mask++)
        bits[mask] = mask;
    const ProbeInput inputs[2] = {{bits, count * sizeof *bits}, {0}};
    assert_true(probe_run(lanes_probe, "probe_lanes", inputs, count,
                          (ProbeInput){results, count * sizeof *results}));
    assert_true(probe_run(lanes_probe, "probe_truths", inputs, count,
                          (ProbeInput){truths, count * lanes * sizeof *truths}));
    for (uint32_t mask = 0; mask < count; mask++) {
        uint32_t set = 0;
        for (uint32_t lane = 0; lane < lanes; lane++) {
            assert_int_equal(truths[mask * lanes + lane], mask >> lane & 1);
            set += mask >> lane & 1;
        }
        assert_int_equal(results[mask][0], mask);
        assert_int_equal(results[mask][1], set);
    }
}

TEST(every_mask_becomes_lanes_and_bits_again)
{
    for (uint32_t lanes = 4; lanes <= 16; lanes *= 2) {
        Probe lanes_probe = open_lanes(lanes);
        check_masks(&lanes_probe, lanes);
        probe_close(&lanes_probe);
    }
}

TEST(every_lane_gathers_its_own_word)
{
    static uint32_t words[WORDS], places[WORDS], results[WORDS];
    uint64_t random = 11;
    for (uint32_t i = 0; i < WORDS; i++) {
        words[i] = i * 2654435761u;
        places[i] = (uint32_t)(fabs(random_unit(&random)) * (WORDS - 1));
    }
    for (uint32_t lanes = 4; lanes <= 16; lanes *= 2) {
        Probe lanes_probe = open_lanes(lanes);
        const ProbeInput inputs[2] = {{words, sizeof words}, {places, sizeof places}};
        assert_true(probe_run(&lanes_probe, "probe_gather", inputs, WORDS / lanes,
                              (ProbeInput){results, sizeof results}));
        for (uint32_t i = 0; i < WORDS; i++)
            assert_int_equal(results[i], words[places[i]]);
        probe_close(&lanes_probe);
    }
}

SET_UP(open_probe)
{
    return probe_begin(&probe, PRECISION_FP32);
}

TEAR_DOWN(close_probe)
{
    probe_close(&probe);
    return 0;
}
