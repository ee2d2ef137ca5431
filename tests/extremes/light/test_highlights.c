// SPDX-License-Identifier: MIT
// Highlights of any shininess, judged by 64 bits of precision, and normals that are nothing or
// cancel out.
#include "kernel/probe.h"
#include "support/check.h"
#include "support/judged_picture.h"
#include "support/random.h"
#include "support/report.h"
#include "support/shapes.h"

#include "device/cache.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CASES 4096

typedef struct {
    float normal[3], half_vector[3];
    float shininess;
    uint32_t exponent; // as in Material
} Highlight;

// As the scene's reader sets it.
static uint32_t exponent_of(double shininess)
{
    const bool is_small_integer = shininess <= 1024 && rint(shininess) == shininess;
    return is_small_integer ? (uint32_t)shininess : UINT32_MAX;
}

static void set_vector(float vector[3], Vec3 value)
{
    const Vec3 unit = vec3_normalize(value);
    vector[0] = (float)unit.x;
    vector[1] = (float)unit.y;
    vector[2] = (float)unit.z;
}

// Half vectors at every angle from the normal: equal to it, next to it, across and behind.
static Highlight highlight_case(int number, double shininess, Random *random)
{
    Highlight made = {.shininess = (float)shininess, .exponent = exponent_of(shininess)};
    const Vec3 normal = vec3_normalize(random_in_cube(random, 1));
    const Vec3 aside = vec3_normalize(vec3_cross(normal, random_in_cube(random, 1)));
    const double angles[4] = {0, scalbn(1, -(int)random_below(random, 24)), 0.5 * acos(-1),
                              random_between(random, 0, acos(-1))};
    const double angle = angles[number % 4];
    set_vector(made.normal, normal);
    set_vector(made.half_vector,
               vec3_add(vec3_scale(normal, cos(angle)), vec3_scale(aside, sin(angle))));
    if (number % 4 == 0)
        memcpy(made.half_vector, made.normal, sizeof made.normal);
    return made;
}

// (n . h)^shininess of the very directions that the floats name, for a cosine so much larger.
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

// How far the result is from what is exact; below shininess 1 for some cosine within the rounding
// of a dot product, since small cosines' powers leap there.
static double error_of(const Highlight *made, double result)
{
    const double slack = made->shininess < 1 ? 0x1p-22 : 0;
    const double low = exact_highlight(made, -slack), high = exact_highlight(made, slack);
    return result < low ? low - result : result > high ? result - high : result - result;
}

static size_t judge_highlights(const Probe *probe, uint32_t lanes, double shininess)
{
    static Highlight cases[CASES];
    static float results[CASES];
    char details[96];
    Random random = {53};
    size_t wrong = 0;
    double largest = 0;
    // Above a million, highlights are single points of light in any picture.
    const double limit = shininess <= 1e6 ? 1e-3 : 1;
    for (int i = 0; i < CASES; i++)
        cases[i] = highlight_case(i, shininess, &random);
    const ProbeInput inputs[2] = {{cases, sizeof cases}, {0}};
    assert_true(
        probe_run(probe, "probe_highlights", inputs, CASES, (ProbeInput){results, sizeof results}));
    for (int i = 0; i < CASES; i++) {
        const double error = error_of(&cases[i], (double)results[i]);
        wrong += !(error <= limit) || !(results[i] >= 0) || !(results[i] <= 1);
        largest = fmax(largest, error);
    }
    snprintf(details, sizeof details, "lanes=%u shininess=%g largest_error=%.2g", lanes, shininess,
             largest);
    return report_case("T-53", details, CASES, wrong);
}

static void highlights_of_any_shininess_are_exact_to_a_thousandth_t53(void **state)
{
    static const double values[] = {0, 1e-3, 1, 50, 1e3, 1e6, 1e9};
    static const uint32_t lanes[] = {1, 8};
    static const KernelChoice choices[] = {{FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP32},
                                           {FAMILY_PACKET, NODES_WIDE, 8, PRECISION_FP32}};
    size_t wrong = 0;
    (void)state;
    for (size_t i = 0; i < sizeof lanes / sizeof *lanes; i++) {
        Error error = {0};
        Probe probe;
        require(probe_open(&probe, &choices[i], &error), &error);
        for (size_t value = 0; value < sizeof values / sizeof *values; value++)
            wrong += judge_highlights(&probe, lanes[i], values[value]);
        probe_close(&probe);
    }
    assert_int_equal(wrong, 0);
}

// A tilted square whose vertex normals are these, one for each corner, seen and lit from places
// opposite to each other or not.
static Scene square(const Vec3 normals[4], Vec3 eye, Vec3 light)
{
    Error error = {0};
    Mesh mesh = shape_plane(vec3(-1, -1, 0), vec3(2, 0, 0), vec3(0, 2, 0.25), 1);
    mesh.normals = memory_raw(4, sizeof *mesh.normals, &error);
    require(mesh.normals != NULL, &error);
    for (int i = 0; i < 4; i++) {
        mesh.normals[i][0] = (float)normals[i].x;
        mesh.normals[i][1] = (float)normals[i].y;
        mesh.normals[i][2] = (float)normals[i].z;
    }
    Scene scene = shape_scene(mesh);
    scene.objects.data[0].material = 2;
    const Light made = light_white(light, 1);
    const Viewpoint viewpoint = {eye, {0, 0, 0.125}, {0, 1, 0.1}, 40};
    require(array_push(&scene.lights, made, &error) &&
                array_push(&scene.viewpoints, viewpoint, &error),
            &error);
    return scene;
}

static void normals_that_are_nothing_or_cancel_out_give_no_fault_t55(void **state)
{
    static const Vec3 up = {0, 0, 1}, down = {0, 0, -1}, zero = {0, 0, 0};
    const struct {
        const char *name;
        Vec3 normals[4];
        Vec3 eye, light;
    } cases[] = {{"zero_normals", {zero, zero, zero, zero}, {0, -1, 4}, {1, 1, 3}},
                 {"some_zero", {up, zero, up, zero}, {0, -1, 4}, {1, 1, 3}},
                 {"opposite", {up, down, down, up}, {0, -1, 4}, {1, 1, 3}},
                 {"behind", {down, down, down, down}, {0, 0, 4.125}, {0, 0, -3.875}},
                 {"light_opposite_eye", {up, up, up, up}, {0, 0, 4.125}, {0, 0, -3.875}},
                 {"light_at_eye", {up, up, up, up}, {0, 0, 4.125}, {0, 0, 4.125}}};
    size_t wrong = 0;
    const PictureSettings settings = picture_settings();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char details[48];
        Scene scene = square(cases[i].normals, cases[i].eye, cases[i].light);
        snprintf(details, sizeof details, "case=%s", cases[i].name);
        wrong += picture_report("T-55", details, *state, &scene, &settings);
        scene_free(&scene);
    }
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(highlights_of_any_shininess_are_exact_to_a_thousandth_t53),
        cmocka_unit_test(normals_that_are_nothing_or_cancel_out_give_no_fault_t55),
    };
    return cmocka_run_group_tests(tests, picture_setup, picture_teardown);
}
