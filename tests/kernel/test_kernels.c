// SPDX-License-Identifier: MIT
// Compares device functions with host arithmetic of twice the precision.
#include "kernel/probe.h"
#include "unit/cmocka_all.h"

#include <math.h>
#include <string.h>

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

#define CASES 4096

// Stores a unit sphere around origin + (3, 4, 0) * distance + (-4, 3, 0) * aside, and returns where
// the ray from the origin along (3, 4, 0) hits it.
static double far_sphere(SphereData *sphere, const float origin[3], double distance, double aside)
{
    const double apart[3] = {3 * distance - 4 * aside, 4 * distance + 3 * aside, 0};
    *sphere = (SphereData){.radius = 1};
    for (int axis = 0; axis < 3; axis++) {
        const double center = (double)origin[axis] + apart[axis];
        sphere->center[axis] = (float)center;
        sphere->center_low[axis] = (float)(center - (double)sphere->center[axis]);
    }
    return fabs(5 * aside) > 1 ? INFINITY : distance - sqrt(1 - 25 * aside * aside) / 5;
}

// Spheres in two floats are hit and missed correctly up to a distance of 1e4, and distances of rays
// that are no tangents are within 3e-7. The rays pass the center at a half to 2^-16 more or less
// than the radius.
TEST(far_spheres_are_hit_and_missed_as_exactly)
{
    static SphereData spheres[CASES];
    static float rays[CASES][6], distances[CASES];
    static double exact[CASES];
    for (double distance = 2; distance <= 1000; distance *= 8) {
        for (int i = 0; i < CASES; i++) {
            const double gap = ldexp(1, -1 - i % 16), pass = i / 16 % 2 == 0 ? 1 - gap : 1 + gap;
            const float ray[6] = {0.3f, -0.2f, 0.07f, 3, 4, 0};
            memcpy(rays[i], ray, sizeof ray);
            exact[i] = far_sphere(&spheres[i], ray, distance * (1 + (double)i / CASES), pass / 5);
        }
        const ProbeInput inputs[2] = {{spheres, sizeof spheres}, {rays, sizeof rays}};
        assert_true(probe_run(&probe, "probe_spheres", inputs, CASES,
                              (ProbeInput){distances, sizeof distances}));
        for (int i = 0; i < CASES; i++) {
            assert_int_equal(isinf(distances[i]), isinf(exact[i]));
            if (i % 16 < 6 && !isinf(exact[i]))
                assert_true(fabs((double)distances[i] / exact[i] - 1) < 3e-7);
        }
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
    for (uint32_t i = 0; i < WORDS; i++) {
        words[i] = i * 2654435761u;
        places[i] = (i * 1664525u + 1013904223u) >> 7 & (WORDS - 1);
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
