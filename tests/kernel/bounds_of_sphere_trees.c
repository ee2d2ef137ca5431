// SPDX-License-Identifier: MIT
// Measures B21 to B23 of docs/numerics.md. A case is a bounding sphere, a sphere inside it, and a
// ray that often almost touches the bounding sphere.
#include "kernel/surface_bounds.h"

#include "unit/cmocka_all.h"
#include "unit/random.h"

typedef struct {
    float passed, away, meets_before, t, reach;
} TreeAnswer;

typedef struct {
    Quad center[3], radius;
} ExactSphere;

// A ray with respect to a sphere, in exact numbers.
typedef struct {
    Quad length;    // of the direction
    Quad apart;     // distance of the start from the center
    Quad line;      // distance of the ray's line from the center
    Quad near, far; // distances to the walls, in lengths of the direction
    bool is_hit;
} ExactChord;

enum { PASSED, AWAY, BEHIND, DISTANCE, OUTSIDE, REACH, BOUNDS };

static Share shares[BOUNDS] = {
    [PASSED] = {"B21: passed, 27 u sqrt(q), of the gap", 0},
    [AWAY] = {"B21: leading away, 27 u sqrt(q), of the gap", 0},
    [BEHIND] = {"B21: beyond t, 4000 u (sqrt(q) + t |d|) / |d|", 0},
    [DISTANCE] = {"B21: distance, 64 u (sqrt(q) + t |d|) / |d|", 0},
    [OUTSIDE] = {"B22: hit outside of the sphere, 76 u (B + o)", 0},
    [REACH] = {"B23: bound of a certain hit, 0.001 r / |d|", 0},
};

static SurfaceCase cases[CASES];
static SphereData spheres[CASES][2];
static TreeAnswer answers[CASES];
static uint64_t seed = 2101;

static Vec3 random_unit_vector(void)
{
    const double x = random_between(&seed, -1, 1), y = random_between(&seed, -1, 1);
    return vec3_normalize(vec3(x, y, random_between(&seed, -1, 1)));
}

// Stores the sum of two floats that is closest to v.
static void split(double v, float *high, float *low)
{
    *high = (float)v;
    *low = (float)(v - (double)*high);
}

static void store_sphere(Vec3 center, double radius, SphereData *data)
{
    *data = (SphereData){0};
    split(center.x, &data->center[0], &data->center_low[0]);
    split(center.y, &data->center[1], &data->center_low[1]);
    split(center.z, &data->center[2], &data->center_low[2]);
    split(radius, &data->radius, &data->radius_low);
}

static ExactSphere exact_sphere(const SphereData *data)
{
    ExactSphere exact = {.radius = (Quad)data->radius + data->radius_low};
    for (int axis = 0; axis < 3; axis++)
        exact.center[axis] = (Quad)data->center[axis] + data->center_low[axis];
    return exact;
}

// Makes a sphere that touches the bounding sphere from inside, almost at the end of `way`, or
// elsewhere.
static void make_inside(SphereData pair[2], Vec3 center, double radius, Vec3 way)
{
    const double part = ldexp(random_unit(&seed), -(int)random_below(&seed, 32));
    const Vec3 shift = random_below(&seed, 2) == 0 ? way : random_unit_vector();
    store_sphere(vec3_add(center, vec3_scale(shift, radius * part)), radius, &pair[1]);
    const ExactSphere bound = exact_sphere(&pair[0]), inside = exact_sphere(&pair[1]);
    Quad apart[3];
    subtract3(bound.center, inside.center, apart);
    split((double)(bound.radius - length3(apart)) * (1 - 0x1p-44), &pair[1].radius,
          &pair[1].radius_low);
}

// Returns a unit vector perpendicular to `v`, which has the length 1.
static Vec3 random_perpendicular(Vec3 v)
{
    return vec3_normalize(vec3_cross(v, random_unit_vector()));
}

// Sets the direction of a ray that almost touches the bounding sphere. `toward` leads from the
// start to the center. Returns the unit vector from the center to the touching point.
static Vec3 set_direction(SurfaceCase *made, Vec3 toward, double radius)
{
    const double apart = sqrt(vec3_dot(toward, toward));
    const double near = ldexp(random_between(&seed, -1, 1), -(int)random_below(&seed, 24));
    const double part =
        random_below(&seed, 2) == 0 ? 1 + near : ldexp(1, -(int)random_below(&seed, 16));
    const double s = fmin(1, radius / apart * part), c = sqrt(1 - s * s);
    const double before = 1 + ldexp(random_between(&seed, -1, 1), -(int)random_below(&seed, 24));
    const Vec3 ahead = vec3_scale(toward, 1 / apart), aside = random_perpendicular(ahead);
    const double scale = (random_below(&seed, 4) == 0 ? -1 : 1) * random_between(&seed, 0.25, 4);
    const Vec3 unit = vec3_add(vec3_scale(ahead, c), vec3_scale(aside, s));
    vec3_store(made->direction, vec3_scale(unit, scale));
    made->given[0] = (float)(fmax(0, apart * c - radius * before) / fabs(scale));
    return vec3_sub(vec3_scale(aside, c), vec3_scale(ahead, s));
}

// Makes the spheres and the ray of a case.
static void make_case(int i)
{
    const double range = ldexp(1, (int)random_below(&seed, 24) - 6);
    const int exponent = 2 - (int)random_below(&seed, 12);
    const double radius = range * ldexp(random_between(&seed, 1, 2), exponent);
    const double height = range * ldexp(random_unit(&seed), -(int)random_below(&seed, 20));
    const Vec3 center = vec3_scale(random_unit_vector(), range * random_unit(&seed));
    const Vec3 toward = vec3_scale(random_unit_vector(), radius + height);
    vec3_store(cases[i].origin, vec3_sub(center, toward));
    store_sphere(center, radius, &spheres[i][0]);
    const Vec3 way = set_direction(&cases[i], toward, radius);
    make_inside(spheres[i], center, radius, way);
}

static ExactChord exact_chord(const SurfaceCase *ray, const ExactSphere *sphere)
{
    ExactChord chord;
    Quad f[3], d[3], foot[3];
    for (int axis = 0; axis < 3; axis++) {
        f[axis] = sphere->center[axis] - ray->origin[axis];
        d[axis] = ray->direction[axis];
    }
    chord.length = length3(d);
    chord.apart = length3(f);
    const Quad ahead = dot3(f, d) / dot3(d, d);
    for (int axis = 0; axis < 3; axis++)
        foot[axis] = f[axis] - ahead * d[axis];
    const Quad square = sphere->radius * sphere->radius - dot3(foot, foot);
    const Quad half = quad_root(square) / chord.length;
    chord.line = length3(foot);
    chord.near = ahead - half;
    chord.far = ahead + half;
    chord.is_hit = square > 0 && chord.far > 0;
    return chord;
}

// Notes the share of a least distance. A distance that is not positive exceeds the bound.
static void note_least(int bound, Quad least, Quad distance)
{
    share_note(&shares[bound], least, larger(distance, least * 0x1p-20));
}

static Quad squares_of(const SurfaceCase *ray, const ExactSphere *bound)
{
    const Quad o[3] = {ray->origin[0], ray->origin[1], ray->origin[2]};
    return dot3(o, o) + dot3(bound->center, bound->center) + bound->radius * bound->radius;
}

// Notes how far the hit at t is outside of the sphere.
static void note_outside(const SurfaceCase *ray, const ExactSphere *sphere, Quad t)
{
    Quad place[3], box = 0, start = 0;
    for (int axis = 0; axis < 3; axis++) {
        place[axis] = ray->origin[axis] + t * ray->direction[axis] - sphere->center[axis];
        box = larger(box, magnitude(sphere->center[axis]) + sphere->radius);
        start = larger(start, magnitude((Quad)ray->origin[axis]));
    }
    const Quad outside = larger(length3(place) - sphere->radius, 0);
    share_note(&shares[OUTSIDE], outside, 76 * U * (box + start));
}

// A bound promises a hit before it.
static void check_reach(const TreeAnswer *answer, const ExactSphere *sphere,
                        const ExactChord *chord)
{
    if (isinf(answer->reach))
        return;
    const Quad radius = sphere->radius / chord->length, foot = (chord->near + chord->far) / 2;
    assert_true(chord->is_hit && answer->t <= answer->reach);
    share_note(&shares[REACH], magnitude(answer->reach - foot - (Quad)1.05f * radius),
               0.001 * radius);
}

static void check_case(int i)
{
    const TreeAnswer *answer = &answers[i];
    const ExactSphere bound = exact_sphere(&spheres[i][0]), inside = exact_sphere(&spheres[i][1]);
    const ExactChord outer = exact_chord(&cases[i], &bound);
    const ExactChord chord = exact_chord(&cases[i], &inside);
    const Quad root = quad_root(squares_of(&cases[i], &bound)), t = cases[i].given[0];
    if (!(inside.radius > 0))
        return;
    check_reach(answer, &inside, &chord);
    if (answer->passed != 0)
        note_least(PASSED, 27 * U * root, chord.line - inside.radius);
    else if (answer->away != 0)
        note_least(AWAY, 27 * U * root, outer.apart - bound.radius);
    const bool meets = answer->passed == 0 && answer->away == 0;
    assert_true(meets || (answer->meets_before == 0 && isinf(answer->t)));
    assert_true(answer->meets_before != 0 || answer->t > (float)t);
    if (!chord.is_hit)
        return;
    if (meets && answer->meets_before == 0)
        note_least(BEHIND, 4000 * U * (root / chord.length + t), chord.near - t);
    if (isinf(answer->t))
        return;
    const Quad found = answer->t;
    const Quad error = smaller(magnitude(found - chord.near), magnitude(found - chord.far));
    share_note(&shares[DISTANCE], error, 64 * U * (root / chord.length + found));
    note_outside(&cases[i], &inside, found);
}

TEST(bounding_spheres_that_are_skipped_contain_no_hit)
{
    for (int round = 0; round < bound_rounds(); round++) {
        for (int i = 0; i < CASES; i++)
            make_case(i);
        RUN_PROBE(surface_probe, "probe_sphere_trees", cases, spheres, answers);
        for (int i = 0; i < CASES; i++)
            check_case(i);
    }
    shares_check(shares, BOUNDS);
}
