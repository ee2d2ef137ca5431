// SPDX-License-Identifier: MIT
// The triangle is sheared along the ray's longest axis, which turns the question into one about a
// point and three edges in the plane.  Products of floats' differences fit 64 bits but for a few.
#include "exact.h"

#include <math.h>

__extension__ typedef __float128 Quad;

// Rounding of corners, shear and edge functions may move an outline by so many units of rounding
// of the largest distance between the origin and a corner.
#define DOUBT (34 * 0x1p-24)

// Errors of depth, by triangle_depth_error of kernels/triangle.inc.cl, where division is at its
// worst.
#define DEPTH_DOUBT (27 * 0x1p-24)

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
    long double reach; // the largest distance along an axis
} Sheared;

static Sheared sheared(const float *corners[3], const TestRay *ray, const Axes *axes)
{
    Sheared s = {.reach = 0};
    const long double dz = ray->direction[axes->z];
    const long double sx = ray->direction[axes->x] / dz, sy = ray->direction[axes->y] / dz;
    for (int i = 0; i < 3; i++) {
        const long double x = (long double)corners[i][axes->x] - ray->origin[axes->x];
        const long double y = (long double)corners[i][axes->y] - ray->origin[axes->y];
        s.z[i] = (long double)corners[i][axes->z] - ray->origin[axes->z];
        s.x[i] = x - sx * s.z[i];
        s.y[i] = y - sy * s.z[i];
        s.reach = fmaxl(s.reach, fmaxl(fabsl(x), fmaxl(fabsl(y), fabsl(s.z[i]))));
    }
    return s;
}

// From the origin of the plane to the segment from corner a to corner b.
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

// The result of one triangle for the ray.
typedef struct {
    bool met, doubtful;
    long double t, error; // of t
} Answer;

static Answer answer_of(const Sheared *s, long double dz)
{
    const long double u = edge_function(s, 2, 1), v = edge_function(s, 0, 2);
    const long double w = edge_function(s, 1, 0), sum = u + v + w;
    const long double outline =
        fminl(edge_distance(s, 0, 1), fminl(edge_distance(s, 1, 2), edge_distance(s, 2, 0)));
    Answer answer = {.error = 4 * (long double)DEPTH_DOUBT * s->reach / fabsl(dz)};
    answer.doubtful = outline <= (long double)DOUBT * s->reach;
    answer.met = ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) && sum != 0;
    answer.t = answer.met ? (u * s->z[0] + v * s->z[1] + w * s->z[2]) / (sum * dz) : INFINITY;
    if (answer.doubtful && !answer.met) {
        const long double nearest = fminl(s->z[0] / dz, fminl(s->z[1] / dz, s->z[2] / dz));
        answer.t = fmaxl(nearest, 0);
    }
    return answer;
}

// Whether the sheared triangle stays clear of the ray on one side: most do.
static bool passes(const Sheared *s)
{
    const long double margin = (long double)DOUBT * s->reach;
    return (s->x[0] > margin && s->x[1] > margin && s->x[2] > margin) ||
           (s->x[0] < -margin && s->x[1] < -margin && s->x[2] < -margin) ||
           (s->y[0] > margin && s->y[1] > margin && s->y[2] > margin) ||
           (s->y[0] < -margin && s->y[1] < -margin && s->y[2] < -margin);
}

// The nearest so far; `doubt` is the nearest thing that might be met instead.
typedef struct {
    Verdict best;
    long double error, doubt, second;
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
        const float *corners[3] = {triangles_corner(triangles, i, 0),
                                   triangles_corner(triangles, i, 1),
                                   triangles_corner(triangles, i, 2)};
        const Sheared s = sheared(corners, ray, &axes);
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

size_t exact_count_wrong(void *context, const TestRay *rays, const TestHit *hits, size_t count)
{
    size_t wrong = 0;
    const Triangles *triangles = context;
    for (size_t i = 0; i < count; i++) {
        const Verdict verdict = exact_nearest(triangles, &rays[i]);
        wrong += verdict.clear && verdict.id != hits[i].id;
    }
    return wrong;
}

// In Quad what `sheared` and `answer_of` do.
ExactMeeting exact_meeting(const float corners[3][3], const TestRay *ray)
{
    Quad x[3], y[3], z[3], edges[3];
    Sheared rounded = {.reach = 0};
    const Axes axes = axes_of(ray);
    const Quad dz = ray->direction[axes.z];
    const Quad sx = ray->direction[axes.x] / dz, sy = ray->direction[axes.y] / dz;
    for (int i = 0; i < 3; i++) {
        z[i] = (Quad)corners[i][axes.z] - ray->origin[axes.z];
        x[i] = (Quad)corners[i][axes.x] - ray->origin[axes.x] - sx * z[i];
        y[i] = (Quad)corners[i][axes.y] - ray->origin[axes.y] - sy * z[i];
        rounded.x[i] = (long double)x[i];
        rounded.y[i] = (long double)y[i];
        const long double across = fmaxl(fabsl(rounded.x[i]), fabsl(rounded.y[i]));
        rounded.reach = fmaxl(rounded.reach, fmaxl(across, fabsl((long double)z[i])));
    }
    for (int i = 0; i < 3; i++)
        edges[i] = x[(i + 2) % 3] * y[(i + 1) % 3] - y[(i + 2) % 3] * x[(i + 1) % 3];
    const Quad sum = edges[0] + edges[1] + edges[2];
    const bool positive = edges[0] >= 0 && edges[1] >= 0 && edges[2] >= 0;
    const bool negative = edges[0] <= 0 && edges[1] <= 0 && edges[2] <= 0;
    const Quad depth = edges[0] * z[0] + edges[1] * z[1] + edges[2] * z[2];
    return (ExactMeeting){
        (positive || negative) && sum != 0, (double)(depth / (sum * dz)),
        (double)fminl(edge_distance(&rounded, 0, 1),
                      fminl(edge_distance(&rounded, 1, 2), edge_distance(&rounded, 2, 0))),
        (double)rounded.reach};
}
