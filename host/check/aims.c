// SPDX-License-Identifier: MIT
// Makes aims, and rays toward the aims. The bounds on rounding errors include a safety margin.
#include "check/aims.h"

#include "base/array.h"

#include <assert.h>
#include <stdlib.h>

#define EYES         32
#define EYE_DISTANCE 3.0 // in radii of the mesh, from its center

// The smallest accepted cosine between a normal at the aim and the direction to the ray's origin.
#define FACING_FROM_AFAR  0.1
#define FACING_FROM_CLOSE 0.01

// A ray misses its aim by at most LENGTH_ERROR times its length plus COORDINATE_ERROR times the
// aim's largest coordinate. Let Q be the triangle's largest coordinate relative to the ray's start.
// If division is correctly rounded, every hit that triangle.inc.cl accepts is within 22 * 2^-24 Q
// of the ray (BVH_SLACK in shared.h). Rounding directions and aims to float adds to this error.
#define LENGTH_ERROR     0x1p-19
#define COORDINATE_ERROR 0x1p-22

// An aim at an edge divides the edge at this fraction, measured from the point with the lower
// index. The fraction is not 1/2, because a midpoint may need no rounding, and rounded aims are the
// harder test.
#define EDGE_PART 0.4

// The distance between an open edge and the aim beyond it, in radii of the mesh. This distance far
// exceeds rounding errors.
#define BEYOND 0x1p-14

typedef struct {
    const AimSource *source;
    Aims *aims;
    Star *stars; // by point
    size_t step; // the builder keeps one aim out of `step`
    size_t seen;
} AimBuilder;

static Vec3 point_of(const Triangles *triangles, uint32_t vertex)
{
    return vec3_of_floats(triangles->points[vertex]);
}

static Vec3 corner_of(const Triangles *triangles, uint32_t triangle, int corner)
{
    return point_of(triangles, triangles->corners[triangle][corner]);
}

static Vec3 normal_of(const AimSource *source, uint32_t triangle)
{
    const Vec3 a = corner_of(source->triangles, triangle, 0);
    const Vec3 b = corner_of(source->triangles, triangle, 1);
    const Vec3 c = corner_of(source->triangles, triangle, 2);
    const Vec3 normal = vec3_normalize(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)));
    return source->is_inside_out ? vec3_scale(normal, -1) : normal;
}

// Returns the distance from a corner to the line through the two others.
static double height_at(const Triangles *triangles, uint32_t triangle, int corner)
{
    const Vec3 apex = corner_of(triangles, triangle, corner);
    const Vec3 from = corner_of(triangles, triangle, (corner + 1) % 3);
    const Vec3 to = corner_of(triangles, triangle, (corner + 2) % 3);
    const Vec3 base = vec3_sub(to, from);
    const double length = vec3_length(base);
    return length > 0 ? vec3_length(vec3_cross(base, vec3_sub(apex, from))) / length : 0;
}

// Returns the triangle's angle at a corner. Normals are weighted by these angles, so that their sum
// does not depend on how flat polygons are divided into triangles.
static double angle_at(const Triangles *triangles, uint32_t triangle, int corner)
{
    const Vec3 apex = corner_of(triangles, triangle, corner);
    const Vec3 a = vec3_sub(corner_of(triangles, triangle, (corner + 1) % 3), apex);
    const Vec3 b = vec3_sub(corner_of(triangles, triangle, (corner + 2) % 3), apex);
    return atan2(vec3_length(vec3_cross(a, b)), vec3_dot(a, b));
}

// Counts an aim and returns whether to keep it.
static bool is_chosen(AimBuilder *builder)
{
    return builder->seen++ % builder->step == 0;
}

static void keep(AimBuilder *builder, Vec3 point, const Star *star)
{
    builder->aims->aims[builder->aims->count++] = (Aim){.point = point, .star = *star};
}

static Star *star_at(const AimBuilder *builder, uint32_t triangle, int corner)
{
    const AimSource *source = builder->source;
    return &builder->stars[source->edges->weld.points[source->mesh->triangles[triangle][corner]]];
}

static void sum_stars(const AimBuilder *builder)
{
    const AimSource *source = builder->source;
    for (uint32_t triangle = 0; triangle < source->mesh->triangle_count; triangle++) {
        const Vec3 normal = normal_of(source, triangle);
        for (int corner = 0; corner < 3; corner++) {
            Star *star = star_at(builder, triangle, corner);
            const double angle = angle_at(source->triangles, triangle, corner);
            star->outward = vec3_add(star->outward, vec3_scale(normal, angle));
            star->triangle = triangle;
        }
    }
}

static void bound_stars(const AimBuilder *builder)
{
    const AimSource *source = builder->source;
    for (size_t point = 0; point < source->mesh->vertex_count; point++) {
        builder->stars[point].outward = vec3_normalize(builder->stars[point].outward);
        builder->stars[point].facing = 1;
        builder->stars[point].size = INFINITY;
    }
    for (uint32_t triangle = 0; triangle < source->mesh->triangle_count; triangle++) {
        const Vec3 normal = normal_of(source, triangle);
        for (int corner = 0; corner < 3; corner++) {
            Star *star = star_at(builder, triangle, corner);
            star->facing = fmin(star->facing, vec3_dot(normal, star->outward));
            star->size = fmin(star->size, height_at(source->triangles, triangle, corner));
        }
    }
}

static void aim_at_points(AimBuilder *builder)
{
    const AimSource *source = builder->source;
    for (uint32_t point = 0; point < source->mesh->vertex_count; point++)
        if (source->edges->weld.points[point] == point && is_chosen(builder))
            keep(builder, point_of(source->triangles, point), &builder->stars[point]);
}

static Star edge_star(const AimSource *source, const EdgeSide *sides, size_t count)
{
    Star star = {.facing = 1, .size = INFINITY, .triangle = sides[0].triangle};
    for (size_t side = 0; side < count; side++)
        star.outward = vec3_add(star.outward, normal_of(source, sides[side].triangle));
    star.outward = vec3_normalize(star.outward);
    for (size_t side = 0; side < count; side++) {
        const uint32_t triangle = sides[side].triangle;
        star.facing = fmin(star.facing, vec3_dot(normal_of(source, triangle), star.outward));
        for (int corner = 0; corner < 3; corner++)
            star.size = fmin(star.size, EDGE_PART * height_at(source->triangles, triangle, corner));
    }
    return star;
}

static void aim_at_edge(AimBuilder *builder, uint32_t point, const EdgeSide *sides, size_t count)
{
    const Triangles *triangles = builder->source->triangles;
    const Vec3 low = point_of(triangles, point), high = point_of(triangles, sides[0].high);
    const Vec3 along = vec3_sub(high, low);
    const Vec3 aim = vec3_add(low, vec3_scale(along, EDGE_PART));
    const Star star = edge_star(builder->source, sides, count);
    if (is_chosen(builder))
        keep(builder, aim, &star);
    if (count > 1 || !is_chosen(builder))
        return;
    Vec3 away = vec3_normalize(vec3_cross(along, star.outward));
    if (vec3_dot(away, vec3_sub(point_of(triangles, sides[0].opposite), low)) > 0)
        away = vec3_scale(away, -1);
    keep(builder, vec3_add(aim, vec3_scale(away, BEYOND * builder->aims->radius)), &star);
}

static void aim_at_edges(AimBuilder *builder)
{
    Edge edge = {0};
    while (edges_next(builder->source->edges, &edge))
        aim_at_edge(builder, edge.low, edge.sides, edge.count);
}

static size_t count_aims(const AimSource *source)
{
    size_t count = 0;
    Edge edge = {0};
    for (uint32_t point = 0; point < source->mesh->vertex_count; point++)
        count += source->edges->weld.points[point] == point;
    while (edges_next(source->edges, &edge))
        count += edge.count > 1 ? 1 : 2;
    return count;
}

static void find_sphere(Aims *aims, const Triangles *triangles)
{
    BoundingBox box = bounding_box_empty();
    for (uint32_t triangle = 0; triangle < triangles->count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            bounding_box_add(&box, corner_of(triangles, triangle, corner));
    aims->center = bounding_box_center(&box);
    aims->radius = vec3_length(bounding_box_sides(&box)) / 2;
}

bool aims_make(Aims *aims, const AimSource *source, size_t most, Error *error)
{
    const size_t total = count_aims(source);
    *aims = (Aims){.total = total};
    AimBuilder builder = {.source = source, .aims = aims, .step = (total + most - 1) / most};
    builder.stars = memory_zeroed(source->mesh->vertex_count, sizeof *builder.stars, error);
    aims->aims = memory_raw(total / (builder.step + (total == 0)) + 1, sizeof *aims->aims, error);
    const bool ok = builder.stars != NULL && aims->aims != NULL;
    if (ok && total > 0) {
        find_sphere(aims, source->triangles);
        sum_stars(&builder);
        bound_stars(&builder);
        aim_at_points(&builder);
        aim_at_edges(&builder);
        assert(builder.seen == total);
    }
    free(builder.stars);
    if (!ok)
        aims_free(aims);
    return ok;
}

void aims_free(Aims *aims)
{
    free(aims->aims);
    *aims = (Aims){0};
}

// Returns the position of an eye. The eyes form a Fibonacci lattice on a sphere. Their heights
// differ by equal steps, and each eye is turned by the golden angle from the previous eye.
static Vec3 eye_at(const Aims *aims, int eye)
{
    const double height = 1 - (2 * eye + 1) / (double)EYES;
    const double across = sqrt(1 - height * height), turn = 2.399963229728653 * eye;
    const Vec3 direction = {across * cos(turn), across * sin(turn), height};
    return vec3_add(aims->center, vec3_scale(direction, EYE_DISTANCE * aims->radius));
}

static Vec3 rounded(Vec3 v)
{
    return vec3((double)(float)v.x, (double)(float)v.y, (double)(float)v.z);
}

// Returns a lower bound on the cosine between a direction and the normals around the aim. Only a
// positive result is a valid bound.
static double facing_from(const Aim *aim, Vec3 direction)
{
    const double off = vec3_dot(aim->star.outward, direction);
    const double sines =
        (1 - fmin(off * off, 1)) * (1 - fmin(aim->star.facing * aim->star.facing, 1));
    return aim->star.facing * off - sqrt(sines);
}

static double error_at(const Aim *aim, double distance)
{
    return LENGTH_ERROR * distance + COORDINATE_ERROR * vec3_extent(aim->point);
}

static void store_ray(RayBlock *block, size_t at, Vec3 origin, Vec3 direction)
{
    block->origin[0][at] = (float)origin.x;
    block->origin[1][at] = (float)origin.y;
    block->origin[2][at] = (float)origin.z;
    block->direction[0][at] = (float)direction.x;
    block->direction[1][at] = (float)direction.y;
    block->direction[2][at] = (float)direction.z;
    block->limit[at] = INFINITY;
    block->own[at] = block->own_index[at] = NOTHING;
}

// Stores a ray from `origin` to the aim, and sets the aim's tolerance. Returns false if a triangle
// around the aim may face away from `origin`, or if rounding could make the ray miss the triangles.
static bool shoot(Aim *aim, Vec3 origin, double least_facing, RayBlock *blocks, size_t number)
{
    const Vec3 back = vec3_sub(origin, aim->point);
    const double distance = vec3_length(back);
    const double error = error_at(aim, distance);
    const double facing = facing_from(aim, vec3_scale(back, 1 / distance));
    if (!(facing >= least_facing) || !(aim->star.size * facing > 4 * error))
        return false;
    store_ray(&blocks[number / RAY_BLOCK], number % RAY_BLOCK, origin, vec3_scale(back, -1));
    aim->tolerance = (float)(4 * error / (facing * distance));
    return true;
}

// Returns the eye with the smallest angle to the aim's outward normal.
static uint32_t best_eye(const Aim *aim, const Vec3 eyes[EYES])
{
    uint32_t best = 0;
    double squarest = -1;
    for (uint32_t eye = 0; eye < EYES; eye++) {
        const Vec3 back = vec3_sub(eyes[eye], aim->point);
        const double along = vec3_dot(back, aim->star.outward);
        const double square = along * fabs(along) / vec3_dot(back, back);
        if (square > squarest) {
            squarest = square;
            best = eye;
        }
    }
    return best;
}

size_t aims_shoot_from_afar(Aims *aims, RayBlock *blocks, uint32_t *targets)
{
    Vec3 eyes[EYES];
    size_t count = 0;
    for (int eye = 0; eye < EYES; eye++)
        eyes[eye] = rounded(eye_at(aims, eye));
    for (size_t i = 0; i < aims->count; i++) {
        Aim *aim = &aims->aims[i];
        if (shoot(aim, eyes[best_eye(aim, eyes)], FACING_FROM_AFAR, blocks, count))
            targets[count++] = (uint32_t)i;
    }
    return count;
}

size_t aims_shoot_from_close(Aims *aims, RayBlock *blocks, uint32_t *targets)
{
    size_t count = 0;
    for (size_t i = 0; i < aims->count; i++) {
        Aim *aim = &aims->aims[i];
        const Vec3 origin =
            rounded(vec3_add(aim->point, vec3_scale(aim->star.outward, aim->star.size)));
        if ((aim->state == AIM_UNTRIED || aim->state == AIM_HIDDEN) &&
            shoot(aim, origin, FACING_FROM_CLOSE, blocks, count))
            targets[count++] = (uint32_t)i;
    }
    return count;
}

void aims_judge(Aims *aims, const uint32_t *targets, const HitData *hits, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        Aim *aim = &aims->aims[targets[i]];
        aim->state = hits[i].t > 1 + aim->tolerance   ? AIM_LEAKED
                     : hits[i].t < 1 - aim->tolerance ? AIM_HIDDEN
                                                      : AIM_REACHED;
    }
}
