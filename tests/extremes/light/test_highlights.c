// SPDX-License-Identifier: MIT
// Highlights of any shininess, compared with 64 bits of precision, and vertex normals that are zero
// or cancel out.
#include "kernel/probe.h"
#include "support/picture.h"
#include "support/random.h"
#include "support/scene_text.h"
#include "support/shapes.h"

#define CASES 4096

typedef struct {
    float normal[3], half_vector[3];
    float shininess;
    uint32_t exponent; // as in Material
} Highlight;

// The half vector is the normal, or beside it, across it, or at any angle.
static Highlight highlight_case(int number, double shininess, Random *random)
{
    Material material = {0};
    material_set_shininess(&material, (float)shininess);
    Highlight made = {.shininess = material.shininess, .exponent = material.exponent};
    const Vec3 normal = random_unit(random);
    const Vec3 aside = vec3_normalize(vec3_cross(normal, random_in_cube(random, 1)));
    const double angles[4] = {0, scalbn(1, -(int)random_below(random, 24)), 0.5 * acos(-1),
                              random_between(random, 0, acos(-1))};
    const double angle = angles[number % 4];
    const Vec3 half = vec3_add(vec3_scale(normal, cos(angle)), vec3_scale(aside, sin(angle)));
    shape_store(made.normal, normal);
    shape_store(made.half_vector, number % 4 == 0 ? normal : vec3_normalize(half));
    return made;
}

// Returns (n . h + more)^shininess for the directions of the float vectors.
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

static void judge_highlights(const Probe *probe, uint32_t lanes, double shininess)
{
    static Highlight cases[CASES];
    static float results[CASES];
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
    outcome_report(outcome_of("T-53", CASES, wrong), "lanes=%u shininess=%g largest_error=%.2g",
                   lanes, shininess, largest);
}

static void highlights_of_any_shininess_are_exact_to_a_thousandth_t53(void **state)
{
    static const double values[] = {0, 1e-3, 1, 50, 1e3, 1e6, 1e9};
    static const KernelChoice choices[] = {{FAMILY_RAY, NODES_PAIR, 0, PRECISION_FP32},
                                           {FAMILY_PACKET, NODES_WIDE, 8, PRECISION_FP32}};
    (void)state;
    for (size_t i = 0; i < COUNT(choices); i++) {
        Error error = {0};
        Probe probe;
        require(probe_open(&probe, &choices[i], &error), &error);
        for (size_t value = 0; value < COUNT(values); value++)
            judge_highlights(&probe, i == 0 ? 1 : 8, values[value]);
        probe_close(&probe);
    }
}

// Returns a tilted square with the vertex normals (0, 0, z[i]). eye and light are coordinates.
static Scene square(const float z[4], const char *eye, const char *light)
{
    Scene scene = scene_text_parse("up 0 1 0.1\ncamera %s 0 0 0.125 40\nlight %s 1\n", eye, light);
    Mesh mesh = shape_plane(vec3(-1, -1, 0), vec3(2, 0, 0), vec3(0, 2, 0.25), 1);
    mesh.normals = require_memory(4, sizeof *mesh.normals);
    for (int i = 0; i < 4; i++)
        shape_store(mesh.normals[i], vec3(0, 0, (double)z[i]));
    shape_add(&scene, mesh, 2);
    return scene;
}

static void normals_that_are_nothing_or_cancel_out_give_no_fault_t55(void **state)
{
    static const struct {
        const char *name, *eye, *light;
        float normals[4];
    } cases[] = {{"zero_normals", "0 -1 4", "1 1 3", {0, 0, 0, 0}},
                 {"some_zero", "0 -1 4", "1 1 3", {1, 0, 1, 0}},
                 {"opposite", "0 -1 4", "1 1 3", {1, -1, -1, 1}},
                 {"behind", "0 0 4.125", "0 0 -3.875", {-1, -1, -1, -1}},
                 {"light_opposite_eye", "0 0 4.125", "0 0 -3.875", {1, 1, 1, 1}},
                 {"light_at_eye", "0 0 4.125", "0 0 4.125", {1, 1, 1, 1}}};
    const PictureSettings settings = picture_settings(64);
    for (size_t i = 0; i < COUNT(cases); i++)
        outcome_report(picture_judge("T-55", *state,
                                     square(cases[i].normals, cases[i].eye, cases[i].light),
                                     &settings),
                       "case=%s", cases[i].name);
}

RUN_TESTS(picture_setup, picture_teardown,
          EXTREME(highlights_of_any_shininess_are_exact_to_a_thousandth_t53),
          EXTREME(normals_that_are_nothing_or_cancel_out_give_no_fault_t55))
