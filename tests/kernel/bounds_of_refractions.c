// SPDX-License-Identifier: MIT
// Measures B20 of docs/numerics.md, and the rounding of reflections (B13). A case has a normal and
// a vector toward the viewer. The kernels refract with both vectors turned, and the certificate
// bounds the change of the direction. Many cases are close to total reflection.
#include "kernel/surface_bounds.h"

#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <string.h>

typedef struct {
    float normal[3], viewer[3], turned_normal[3], turned_viewer[3], ior, inside;
    float normal_doubt, viewer_doubt;
} RefractionCase;

typedef struct {
    float normal[3], viewer[3], cosine, beyond, refracted[3], reflected[3];
} Refracted;

typedef struct {
    double certain, refracts, direction[3], doubt;
} CertainRefraction;

enum { REFLECTION, COSINE, ROUNDING, TURNS, CONE, BOUNDS };

static Share shares[BOUNDS] = {
    [REFLECTION] = {"B13: reflection, 9 u", 0},
    [COSINE] = {"B20: cosine, 8 u", 0},
    [ROUNDING] = {"B20: rounding, 24 u (1 + r^2) / t + (24 r + 8) u", 0},
    [TURNS] = {"B20: turns, max(1, r c / t) and max(r, r c / t)", 0},
    [CONE] = {"B20: refract_cone", 0},
};

static RefractionCase cases[CASES];
static Material materials[CASES];
static Refracted refracted[CASES];
static CertainRefraction certain[CASES];
static uint64_t seed = 2001;

static Vec3 random_vector(void)
{
    const double x = random_between(&seed, -1, 1), y = random_between(&seed, -1, 1);
    return vec3(x, y, random_between(&seed, -1, 1));
}

// Returns the ratio of the indices, r.
static Quad ratio_of(const RefractionCase *given)
{
    return given->inside > 0 ? (Quad)given->ior : 1 / (Quad)given->ior;
}

// Returns the cosine at the normal. If the ratio allows total reflection, the cosine is often close
// to the angle at which it starts.
static double make_cosine(double ratio)
{
    const double beyond = ldexp(random_unit(&seed), -(int)random_below(&seed, 10));
    if (ratio <= 1 || random_below(&seed, 4) == 0)
        return ldexp(random_unit(&seed), -(int)random_below(&seed, 6));
    return sqrt(1 - (1 - beyond * beyond) / (ratio * ratio));
}

// Stores v turned by a small angle, either in a random direction or in the plane of incidence.
// `within` is a unit vector in this plane, perpendicular to v.
static void turn(Vec3 v, Vec3 within, float turned[3])
{
    const double angle = ldexp(random_between(&seed, -1, 1), -7 - (int)random_below(&seed, 20));
    const Vec3 way = random_below(&seed, 2) == 0 ? within : random_vector();
    vec3_store(turned, vec3_add(v, vec3_scale(way, angle)));
}

static void make_case(int i)
{
    const Vec3 n = vec3_normalize(random_vector());
    const Vec3 aside = vec3_normalize(vec3_cross(n, random_vector()));
    RefractionCase *made = &cases[i];
    made->ior = (float)(random_below(&seed, 8) == 0 ? ldexp(random_between(&seed, 1, 2), 2)
                                                    : random_between(&seed, 0.3, 2.5));
    made->inside = (float)random_below(&seed, 2);
    const double c = make_cosine((double)ratio_of(made)), s = sqrt(1 - c * c);
    const Vec3 v = vec3_add(vec3_scale(n, c), vec3_scale(aside, s));
    vec3_store(made->normal, n);
    vec3_store(made->viewer, v);
    turn(n, aside, made->turned_normal);
    turn(v, vec3_sub(vec3_scale(aside, c), vec3_scale(n, s)), made->turned_viewer);
    materials[i] = (Material){.ior = made->ior};
}

// Stores r c n - t n - r v, where t is the refracted ray's cosine. Returns false if there is no
// refracted ray.
static bool refract(Quad r, const Quad n[3], const Quad v[3], Quad direction[3])
{
    const Quad c = dot3(n, v), square = 1 - r * r + r * r * c * c;
    for (int i = 0; i < 3; i++)
        direction[i] = (r * c - quad_root(square)) * n[i] - r * v[i];
    return square > 0;
}

// Returns the square of the refracted ray's cosine.
static Quad square_beyond(Quad r, Quad c)
{
    return 1 - r * r * (1 - c) * (1 + c);
}

static Quad distance3(const Quad a[3], const Quad b[3])
{
    Quad apart[3];
    subtract3(a, b, apart);
    return length3(apart);
}

// Stores the doubts of the case's vectors: their distances from the kernel's vectors, rounded up.
static void set_doubts(int i)
{
    Quad before[3], after[3];
    unit3(cases[i].normal, before);
    unit3(refracted[i].normal, after);
    cases[i].normal_doubt = (float)(distance3(before, after) * (1 + 2 * U) + 0x1p-45);
    unit3(cases[i].viewer, before);
    unit3(refracted[i].viewer, after);
    cases[i].viewer_doubt = (float)(distance3(before, after) * (1 + 2 * U) + 0x1p-45);
}

static void check_reflection(const Refracted *found)
{
    Quad n[3], v[3], apart[3];
    for (int k = 0; k < 3; k++) {
        n[k] = found->normal[k];
        v[k] = found->viewer[k];
    }
    const Quad c = dot3(n, v);
    for (int k = 0; k < 3; k++)
        apart[k] = found->reflected[k] - (2 * c * n[k] - v[k]);
    if (found->cosine > 0)
        share_note(&shares[REFLECTION], length3(apart), 9 * U);
}

// Checks the rounding of a refraction. `exact` is the exact direction for the same vectors.
static void check_rounding(int i, Quad cosine, const Quad exact[3])
{
    const Quad r = ratio_of(&cases[i]), most = 24 * U * (1 + r * r);
    const Quad least = square_beyond(r, cosine - 8 * U) - most;
    const Quad direction[3] = {refracted[i].refracted[0], refracted[i].refracted[1],
                               refracted[i].refracted[2]};
    if (cosine > 0x1p-10 && least > 0x1p-20)
        share_note(&shares[ROUNDING], distance3(direction, exact),
                   most / quad_root(least) + (24 * r + 8) * U);
}

// Checks the change of the exact direction from `before` to `after`.
static void check_turns(int i, Quad cosine, const Quad before[3], const Quad after[3])
{
    const Quad r = ratio_of(&cases[i]), dn = cases[i].normal_doubt, dv = cases[i].viewer_doubt;
    const Quad least = square_beyond(r, cosine - dn - dv);
    if (!(cosine - dn - dv > 0) || !(least > 0))
        return;
    const Quad growth = r * smaller(cosine + dn + dv, 1) / quad_root(least);
    share_note(&shares[TURNS], distance3(before, after),
               (larger(1, growth) * dn + larger(r, growth) * dv) * (1 + 0x1p-12));
}

// Checks the certificate's decision, and its bound on both the exact direction and the kernel's
// direction.
static void check_cone(int i, const Quad exact[3])
{
    const CertainRefraction *answer = &certain[i];
    const Refracted *found = &refracted[i];
    const Quad center[3] = {answer->direction[0], answer->direction[1], answer->direction[2]};
    const Quad direction[3] = {found->refracted[0], found->refracted[1], found->refracted[2]};
    if (answer->certain == 0)
        return;
    assert_true((answer->refracts != 0) == (found->beyond > 0));
    if (answer->refracts == 0)
        return;
    share_note(&shares[CONE], distance3(center, exact), answer->doubt);
    share_note(&shares[CONE], distance3(center, direction), answer->doubt);
}

static void check_case(int i)
{
    Quad n[3], v[3], turned_n[3], turned_v[3], before[3], after[3];
    const Quad r = ratio_of(&cases[i]);
    unit3(cases[i].normal, n);
    unit3(cases[i].viewer, v);
    unit3(refracted[i].normal, turned_n);
    unit3(refracted[i].viewer, turned_v);
    const Quad cosine = dot3(turned_n, turned_v);
    const bool was_refracted = refract(r, n, v, before);
    const bool is_refracted = refract(r, turned_n, turned_v, after);
    share_note(&shares[COSINE], magnitude(refracted[i].cosine - cosine), 8 * U);
    check_reflection(&refracted[i]);
    check_cone(i, after);
    if (was_refracted && is_refracted) {
        check_turns(i, dot3(n, v), before, after);
        check_rounding(i, cosine, after);
    }
}

TEST(refracted_directions_stay_within_their_bounds)
{
    for (int round = 0; round < bound_rounds(); round++) {
        for (int i = 0; i < CASES; i++)
            make_case(i);
        RUN_PROBE(surface_probe, "probe_refractions", cases, materials, refracted);
        for (int i = 0; i < CASES; i++)
            set_doubts(i);
        RUN_PROBE(surface_probe_fp64, "probe_certain_refractions", cases, materials, certain);
        for (int i = 0; i < CASES; i++)
            check_case(i);
    }
    shares_check(shares, BOUNDS);
}
