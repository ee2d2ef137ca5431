// SPDX-License-Identifier: MIT
// Collects successive triangles in blocks, and intersects rays with them. Triangles are enlarged by
// TOLERANCE of their size, so that rounding lets no ray pass between two of them. Float rounding is
// sixty thousand times as large as TOLERANCE.
#include "oracle/blocks.h"

#include <stdlib.h>

#define TOLERANCE 1e-12

// A block's sphere is enlarged by these fractions of its radius and of its coordinates. Rounding is
// less than a millionth of either enlargement.
#define RADIUS_PADDING 1e-6
#define PLACE_PADDING  1e-9

static Vec3 corner_of(const Mesh *mesh, size_t triangle, int corner)
{
    const double *position = mesh->positions[mesh->triangles[triangle][corner]];
    return vec3(position[0], position[1], position[2]);
}

static void store(VectorColumns *columns, uint32_t place, Vec3 v)
{
    columns->x[place] = v.x;
    columns->y[place] = v.y;
    columns->z[place] = v.z;
}

static Vec3 load(const VectorColumns *columns, uint32_t place)
{
    return vec3(columns->x[place], columns->y[place], columns->z[place]);
}

// `least` is the triangle's value for OracleBlock::least.
static void block_add(OracleBlock *block, const Mesh *mesh, size_t triangle, double least)
{
    const Vec3 corner = corner_of(mesh, triangle, 0);
    const uint32_t place = block->count++;
    store(&block->corner, place, corner);
    store(&block->first, place, vec3_sub(corner_of(mesh, triangle, 1), corner));
    store(&block->second, place, vec3_sub(corner_of(mesh, triangle, 2), corner));
    block->least[place] = least;
}

static double distance(Vec3 a, Vec3 b)
{
    const Vec3 apart = vec3_sub(a, b);
    return sqrt(vec3_dot(apart, apart));
}

// Computes a bounding sphere around the mean of the corners.
static void block_enclose(OracleBlock *block)
{
    Vec3 sum = {0, 0, 0};
    for (uint32_t place = 0; place < block->count; place++) {
        const Vec3 edges = vec3_add(load(&block->first, place), load(&block->second, place));
        sum = vec3_add(sum, vec3_add(load(&block->corner, place), vec3_scale(edges, 1.0 / 3)));
    }
    block->center = vec3_scale(sum, 1.0 / block->count);
    for (uint32_t place = 0; place < block->count; place++) {
        const Vec3 a = load(&block->corner, place);
        const Vec3 b = vec3_add(a, load(&block->first, place));
        const Vec3 c = vec3_add(a, load(&block->second, place));
        block->radius = fmax(block->radius, distance(a, block->center));
        block->radius = fmax(block->radius, distance(b, block->center));
        block->radius = fmax(block->radius, distance(c, block->center));
    }
    const double place = vec3_extent(block->center) + block->radius;
    block->radius += RADIUS_PADDING * block->radius + PLACE_PADDING * place;
}

bool blocks_make(OracleBlocks *blocks, const Scene *scene, Error *error)
{
    const size_t count = scene_triangle_count(scene);
    size_t number = 0;
    *blocks = (OracleBlocks){.count = (count + BLOCK_SIZE - 1) / BLOCK_SIZE};
    blocks->data = memory_zeroed(blocks->count, sizeof *blocks->data, error);
    if (blocks->data == NULL)
        return false;
    for (size_t i = 0; i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        const bool glass = scene->materials.data[object->material].shader == SHADER_GLASS;
        const double least = object->two_sided || glass ? -INFINITY : 0;
        for (size_t triangle = 0; triangle < object->mesh.triangle_count; triangle++, number++) {
            OracleBlock *block = &blocks->data[number / BLOCK_SIZE];
            block->ids[block->count] = (uint32_t)(scene->spheres.count + number);
            block_add(block, &object->mesh, triangle, least);
        }
    }
    for (size_t i = 0; i < blocks->count; i++)
        block_enclose(&blocks->data[i]);
    return true;
}

void blocks_free(OracleBlocks *blocks)
{
    free(blocks->data);
    *blocks = (OracleBlocks){0};
}

// Returns whether the ray enters the block's sphere before far.
static bool block_is_near(const OracleBlock *block, const OracleRay *ray, double far)
{
    const Vec3 toward = vec3_sub(block->center, ray->origin);
    const double along = vec3_dot(toward, ray->direction);
    if (along + block->radius < 0 || along - block->radius > far)
        return false;
    const Vec3 aside = vec3_cross(toward, ray->direction);
    return vec3_dot(aside, aside) <= block->radius * block->radius;
}

// Stores the distance of the hit with each triangle, or INFINITY. The loop has no branches and
// joins conditions by &, so that compilers vectorize it.
static void block_distances(const OracleBlock *block, const OracleRay *ray,
                            double distances[BLOCK_SIZE])
{
    const Vec3 d = ray->direction, o = ray->origin;
    for (uint32_t i = 0; i < block->count; i++) {
        const Vec3 first = load(&block->first, i), second = load(&block->second, i);
        const Vec3 s = vec3_sub(o, load(&block->corner, i));
        const Vec3 p = vec3_cross(d, second), q = vec3_cross(s, first);
        const double determinant = vec3_dot(first, p);
        const double reciprocal = 1 / determinant;
        const double u = vec3_dot(s, p) * reciprocal, v = vec3_dot(d, q) * reciprocal;
        const double t = vec3_dot(second, q) * reciprocal;
        const int inside = (u >= -TOLERANCE) & (v >= -TOLERANCE) & (u + v <= 1 + TOLERANCE);
        const int seen = (determinant > block->least[i]) & (determinant != 0);
        const int reached = (t > ray->near) & (t < ray->far);
        distances[i] = inside & seen & reached ? t : INFINITY;
    }
}

static bool precedes(double t, uint32_t id, const OracleHit *hit)
{
    return t < hit->t || (t == hit->t && t < INFINITY && id < hit->id);
}

void blocks_meet(const OracleBlocks *blocks, const OracleRay *ray, OracleHit *hit)
{
    double distances[BLOCK_SIZE];
    for (size_t i = 0; i < blocks->count; i++) {
        const OracleBlock *block = &blocks->data[i];
        if (!block_is_near(block, ray, fmin(hit->t, ray->far)))
            continue;
        block_distances(block, ray, distances);
        for (uint32_t place = 0; place < block->count; place++)
            if (precedes(distances[place], block->ids[place], hit) && block->ids[place] != ray->own)
                *hit = (OracleHit){distances[place], block->ids[place]};
    }
}

bool blocks_block(const OracleBlocks *blocks, const OracleRay *ray)
{
    double distances[BLOCK_SIZE];
    for (size_t i = 0; i < blocks->count; i++) {
        const OracleBlock *block = &blocks->data[i];
        if (!block_is_near(block, ray, ray->far))
            continue;
        block_distances(block, ray, distances);
        for (uint32_t place = 0; place < block->count; place++)
            if (distances[place] < INFINITY && block->ids[place] != ray->own)
                return true;
    }
    return false;
}
