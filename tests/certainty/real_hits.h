// SPDX-License-Identifier: MIT
// Finds the nearest hit of a ray in arithmetic of the type NUMBER, and whether rounding could
// change it. The sign of a sum is settled if the sum's magnitude exceeds the ray's tolerance times
// a bound on the sum's terms. Included by real_text.h.
#include "certainty/real.h"

#include <math.h>
#include <string.h>

typedef struct {
    NUMBER x, y, z;
} Vector;

typedef enum { MISSES, MEETS, UNCLEAR } Outcome;

// A hit or a possible hit of a ray.
typedef struct {
    NUMBER t, low;      // INFINITY without a hit. The true t of a hit is in [low, t + (t - low)].
                        // The true t of a possible hit is at least low.
    uint32_t id, place; // place: index in the flat scene's spheres or triangles
    NUMBER v, w;        // weights of a triangle's second and third corner
    bool front;
} Stop;

typedef struct {
    Stop stop;
    NUMBER other; // the smallest low of all other hits and possible hits, except coincident hits
} Nearest;

typedef struct {
    const RealView *view;
    NUMBER tolerance;
    Vector origin, direction;
    uint32_t own;                     // the id of the primitive that the ray starts on
    const TriangleData *own_triangle; // the triangle that the ray starts on; NULL for none
    bool is_own_inside;               // the ray runs inside the sphere that it starts on
} Path;

static NUMBER size_of(NUMBER a)
{
    return a < 0 ? -a : a;
}

static Vector vector(NUMBER x, NUMBER y, NUMBER z)
{
    return (Vector){x, y, z};
}

static Vector of_floats(const float v[3])
{
    return vector(v[0], v[1], v[2]);
}

static Vector minus(Vector a, Vector b)
{
    return vector(a.x - b.x, a.y - b.y, a.z - b.z);
}

static Vector stepped(Vector a, NUMBER step, Vector b)
{
    return vector(a.x + step * b.x, a.y + step * b.y, a.z + step * b.z);
}

static NUMBER dot(Vector a, Vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static Vector cross(Vector a, Vector b)
{
    return vector(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// Returns an upper bound of the length.
static NUMBER extent(Vector a)
{
    return size_of(a.x) + size_of(a.y) + size_of(a.z);
}

static Vector unit(Vector a)
{
    return stepped(vector(0, 0, 0), 1 / ROOT(dot(a, a)), a);
}

// Returns whether all corners are certainly on one side of a plane that contains the ray. The ray
// then misses the triangle.
static bool is_aside(const Path *path, const Vector corners[3])
{
    const Vector d = unit(path->direction);
    Vector across[3];
    for (int i = 0; i < 3; i++) {
        const Vector apart = minus(corners[i], path->origin);
        across[i] = stepped(apart, -dot(apart, d), d);
    }
    for (int i = 0; i < 3; i++) {
        bool aside = true;
        for (int j = 0; j < 3; j++) {
            const NUMBER sizes =
                extent(minus(corners[i], path->origin)) * extent(minus(corners[j], path->origin));
            aside = aside && dot(across[i], across[j]) > path->tolerance * sizes;
        }
        if (aside)
            return true;
    }
    return false;
}

static NUMBER smallest(NUMBER a, NUMBER b)
{
    return a < b ? a : b;
}

// Uses Moeller and Trumbore's determinants, and settles their signs before dividing.
static Outcome meet_triangle(const Path *path, const TriangleData *triangle, Stop *stop)
{
    const Vector corners[3] = {of_floats(triangle->a), of_floats(triangle->b),
                               of_floats(triangle->c)};
    const Vector first = minus(corners[1], corners[0]), second = minus(corners[2], corners[0]);
    const Vector s = minus(path->origin, corners[0]), d = path->direction;
    const Vector p = cross(d, second), q = cross(s, first);
    NUMBER determinant = dot(first, p), v = dot(s, p), w = dot(d, q), t = dot(second, q);
    const NUMBER error = path->tolerance * extent(d) * (extent(first) + extent(second)) *
                         (extent(first) + extent(second) + extent(s));
    const NUMBER t_error = path->tolerance * extent(first) * extent(second) * extent(s);
    const bool front = determinant > 0;
    if (!front) {
        determinant = -determinant;
        v = -v;
        w = -w;
        t = -t;
    }
    const NUMBER u = determinant - v - w;
    const bool faces = determinant > error;
    if (faces && (v < -error || w < -error || u < -error || t < -t_error))
        return MISSES;
    const bool reversed = (triangle->material & TRIANGLE_REVERSED) != 0;
    if (faces && front == reversed && !(triangle->material & TRIANGLE_TWO_SIDED))
        return MISSES;
    const bool inside = smallest(smallest(u, v), w) > error && faces && t > t_error;
    if (!inside && is_aside(path, corners))
        return MISSES;
    *stop = (Stop){.t = faces ? t / determinant : 0, .id = triangle->id, .front = front};
    stop->low = faces && t > t_error ? (t - t_error) / (determinant + error) : 0;
    stop->v = v / determinant;
    stop->w = w / determinant;
    return inside ? MEETS : UNCLEAR;
}

static Vector center_of(const SphereData *sphere)
{
    return vector((NUMBER)sphere->center[0] + sphere->center_low[0],
                  (NUMBER)sphere->center[1] + sphere->center_low[1],
                  (NUMBER)sphere->center[2] + sphere->center_low[2]);
}

// Half the chord is sqrt((r - d) (r + d)), where d is the center's distance from the ray's line.
static Outcome meet_sphere(const Path *path, const SphereData *sphere, Stop *stop)
{
    const Vector center = center_of(sphere);
    const NUMBER radius = (NUMBER)sphere->radius + sphere->radius_low;
    const NUMBER length = ROOT(dot(path->direction, path->direction));
    const Vector d = unit(path->direction), f = minus(center, path->origin);
    const NUMBER middle = dot(f, d);
    const Vector foot = stepped(f, -middle, d);
    const NUMBER distance = ROOT(dot(foot, foot));
    const NUMBER error = path->tolerance * (extent(f) + radius + extent(path->origin));
    if (distance - radius > error || middle + radius < -error)
        return MISSES;
    if (radius - distance <= error) {
        *stop = (Stop){0};
        return UNCLEAR;
    }
    const NUMBER half = ROOT((radius - distance) * (radius + distance));
    const NUMBER doubt = error * (1 + (radius + distance) / half);
    const NUMBER enters = middle - half, leaves = middle + half;
    if (leaves < -doubt)
        return MISSES;
    const bool outside = enters > doubt, within = enters < -doubt && leaves > doubt;
    *stop = (Stop){.t = (enters > 0 ? enters : leaves) / length};
    stop->low = outside ? (enters - doubt) / length : within ? (leaves - doubt) / length : 0;
    return outside || within ? MEETS : UNCLEAR;
}

static Outcome meet_own_sphere(const Path *path, const SphereData *sphere, Stop *stop)
{
    const Vector center = center_of(sphere);
    const Vector f = minus(center, path->origin);
    const NUMBER along = dot(f, path->direction);
    const NUMBER error = path->tolerance * (extent(f) + extent(path->origin));
    if (!path->is_own_inside || along < -error * extent(path->direction))
        return MISSES;
    *stop = (Stop){.t = 2 * along / dot(path->direction, path->direction)};
    stop->low = stop->t - error;
    return along > error * extent(path->direction) ? MEETS : UNCLEAR;
}

static void take_stop(Nearest *nearest, const Stop *stop, Outcome outcome)
{
    if (outcome == MEETS && stop->t < nearest->stop.t) {
        nearest->other = smallest(nearest->other, nearest->stop.low);
        nearest->stop = *stop;
    } else if (outcome != MISSES) {
        nearest->other = smallest(nearest->other, stop->low);
    }
}

static bool nearest_is_settled(const Nearest *nearest)
{
    const Stop *stop = &nearest->stop;
    if (stop->id == NOTHING)
        return nearest->other == INFINITY;
    return nearest->other > stop->t + (stop->t - stop->low);
}

// Returns whether two triangles have the same corners. Corners are stored in sorted order. A ray
// hits coincident triangles at the same point, and starts on both of them or on neither.
static bool are_coincident(const TriangleData *one, const TriangleData *other)
{
    return memcmp(one->a, other->a, sizeof one->a) == 0 &&
           memcmp(one->b, other->b, sizeof one->b) == 0 &&
           memcmp(one->c, other->c, sizeof one->c) == 0;
}

static void take_triangle(Nearest *nearest, const Path *path, uint32_t place)
{
    Stop stop;
    const FlatScene *flat = path->view->flat;
    const TriangleData *triangle = &flat->triangles[place];
    if (triangle->id == path->own ||
        (path->own_triangle != NULL && are_coincident(triangle, path->own_triangle)))
        return;
    const Outcome outcome = meet_triangle(path, triangle, &stop);
    const uint32_t first = nearest->stop.id;
    stop.place = place;
    if (outcome != MEETS || first == NOTHING || first < flat->sphere_count ||
        !are_coincident(triangle, &flat->triangles[nearest->stop.place]))
        take_stop(nearest, &stop, outcome);
    else if (triangle->id < first)
        nearest->stop = stop;
}

// Returns the nearest hit. May ignore triangles beyond reach.
static Nearest meet_all(const Path *path, NUMBER reach)
{
    const FlatScene *flat = path->view->flat;
    const Vector o = path->origin, d = path->direction;
    Nearest nearest = {.stop = {.t = INFINITY, .low = INFINITY, .id = NOTHING}, .other = INFINITY};
    Stop stop;
    for (uint32_t i = 0; i < flat->sphere_count; i++) {
        const Outcome outcome = i == path->own ? meet_own_sphere(path, &flat->spheres[i], &stop)
                                               : meet_sphere(path, &flat->spheres[i], &stop);
        stop.id = stop.place = i;
        take_stop(&nearest, &stop, outcome);
    }
    RealWalk walk;
    real_walk_begin(&walk, path->view->tree, (double[3]){(double)o.x, (double)o.y, (double)o.z},
                    (double[3]){(double)d.x, (double)d.y, (double)d.z});
    const RealNode *leaf;
    while ((leaf = real_walk_next(&walk, (double)smallest(reach, nearest.stop.t) * (1 + 1e-9))))
        for (uint32_t i = leaf->first; i < leaf->first + leaf->count; i++)
            take_triangle(&nearest, path, i);
    return nearest;
}
