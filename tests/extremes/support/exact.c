// SPDX-License-Identifier: MIT
// A shear makes the ray parallel to the longest axis of its direction. In the plane of the other
// two axes, the ray is then the origin. Edge functions decide whether the sheared triangle contains
// the origin. Long double loses few bits in products of differences of floats.
#include "exact.h"

#include <math.h>

// The largest distance by which rounding of corners, shear and edge functions moves an outline,
// relative to Sheared::reach.
#define DOUBT (34 * 0x1p-24L)

// Bounds the error of a depth, relative to Sheared::reach. With the least accurate division that
// OpenCL allows, the error is at most 22 * 2^-24 (docs/numerics.md, B8).
#define DEPTH_DOUBT (27 * 0x1p-24L)

typedef struct {
    int x, y, z;
} Axes;

static Axes axes_of(const TestRay *ray)
{
    Axes axes = {1, 2, 0};
    for (int axis = 1; axis < 3; axis++)
        if (fabsf(ray->direction[axis]) > fabsf(ray->direction[axes.z]))
            axes = (Axes){(axis + 1) % 3, (axis + 2) % 3, axis};
    return axes;
}

typedef struct {
    long double x[3], y[3], z[3];
    long double reach; // the largest distance of a corner from the ray's origin along an axis
} Sheared;

static Sheared sheared(const Triangles *triangles, size_t triangle, const TestRay *ray,
                       const Axes *axes)
{
    Sheared s = {.reach = 0};
    const long double dz = ray->direction[axes->z];
    const long double sx = ray->direction[axes->x] / dz, sy = ray->direction[axes->y] / dz;
    for (int i = 0; i < 3; i++) {
        const float *corner = triangles_corner(triangles, triangle, i);
        const long double x = (long double)corner[axes->x] - ray->origin[axes->x];
        const long double y = (long double)corner[axes->y] - ray->origin[axes->y];
        s.z[i] = (long double)corner[axes->z] - ray->origin[axes->z];
        s.x[i] = x - sx * s.z[i];
        s.y[i] = y - sy * s.z[i];
        s.reach = fmaxl(s.reach, fmaxl(fabsl(x), fmaxl(fabsl(y), fabsl(s.z[i]))));
    }
    return s;
}

// Returns the distance from the ray to the edge from corner a to corner b.
static long double edge_distance(const Sheared *s, int a, int b)
{
    const long double x = s->x[b] - s->x[a], y = s->y[b] - s->y[a];
    const long double squared = x * x + y * y;
    const long double place = squared > 0 ? -(s->x[a] * x + s->y[a] * y) / squared : 0;
    const long double along = fminl(fmaxl(place, 0), 1);
    return hypotl(s->x[a] + along * x, s->y[a] + along * y);
}

static long double edge_function(const Sheared *s, int a, int b)
{
    return s->x[a] * s->y[b] - s->y[a] * s->x[b];
}

static long double outline_distance(const Sheared *s)
{
    return fminl(edge_distance(s, 0, 1), fminl(edge_distance(s, 1, 2), edge_distance(s, 2, 0)));
}

// The result of testing the ray against one triangle. For a doubtful miss, t is a lower bound.
typedef struct {
    bool met, doubtful;
    long double t, error; // distance along the ray, and its error
} Answer;

static Answer answer_of(const Sheared *s, long double dz)
{
    const long double u = edge_function(s, 2, 1), v = edge_function(s, 0, 2);
    const long double w = edge_function(s, 1, 0), sum = u + v + w;
    Answer answer = {.error = 4 * DEPTH_DOUBT * s->reach / fabsl(dz)};
    answer.doubtful = outline_distance(s) <= DOUBT * s->reach;
    answer.met = ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) && sum != 0;
    answer.t = (u * s->z[0] + v * s->z[1] + w * s->z[2]) / (sum * dz);
    if (answer.doubtful && !answer.met) {
        const long double nearest = fminl(s->z[0] / dz, fminl(s->z[1] / dz, s->z[2] / dz));
        answer.t = fmaxl(nearest, 0);
    }
    return answer;
}

// Returns whether the ray clearly misses, because all corners are on one side of it along an axis.
static bool passes(const Sheared *s)
{
    const long double margin = DOUBT * s->reach;
    return (s->x[0] > margin && s->x[1] > margin && s->x[2] > margin) ||
           (s->x[0] < -margin && s->x[1] < -margin && s->x[2] < -margin) ||
           (s->y[0] > margin && s->y[1] > margin && s->y[2] > margin) ||
           (s->y[0] < -margin && s->y[1] < -margin && s->y[2] < -margin);
}

// The state of a search for the nearest hit.
typedef struct {
    Verdict best;
    long double error;  // of the best hit's t
    long double doubt;  // least t - error of doubtful triangles; 0 if the t of a hit may be 0
    long double second; // least t - error of the other hits
} Search;

static void take(Search *search, uint32_t id, const Answer *answer)
{
    if (answer->doubtful)
        search->doubt = fminl(search->doubt, answer->t - answer->error);
    if (!answer->met)
        return;
    if (fabsl(answer->t) <= answer->error)
        search->doubt = 0;
    if (!(answer->t > 0))
        return;
    if (answer->t < (long double)search->best.t) {
        search->second = fminl(search->second, (long double)search->best.t - search->error);
        search->best.id = id;
        search->best.t = (double)answer->t;
        search->error = answer->error;
    } else {
        search->second = fminl(search->second, answer->t - answer->error);
    }
}

Verdict exact_nearest(const Triangles *triangles, const TestRay *ray)
{
    Search search = {{NOTHING, INFINITY, true}, 0, INFINITY, INFINITY};
    const Axes axes = axes_of(ray);
    for (size_t i = 0; i < triangles->count; i++) {
        const Sheared s = sheared(triangles, i, ray, &axes);
        if (passes(&s))
            continue;
        const Answer answer = answer_of(&s, ray->direction[axes.z]);
        take(&search, (uint32_t)i, &answer);
    }
    const long double reach = (long double)search.best.t + search.error;
    search.best.clear = search.doubt > reach && search.second > reach;
    if (search.best.id == NOTHING)
        search.best.clear = search.doubt == INFINITY;
    return search.best;
}

ExactMeeting exact_meeting(const Triangles *triangles, size_t triangle, const TestRay *ray)
{
    const Axes axes = axes_of(ray);
    const Sheared s = sheared(triangles, triangle, ray, &axes);
    const Answer answer = answer_of(&s, ray->direction[axes.z]);
    return (ExactMeeting){answer.met, (double)answer.t, (double)outline_distance(&s),
                          (double)s.reach};
}
