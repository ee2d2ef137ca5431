// SPDX-License-Identifier: MIT
// Traces and shades a tile like kernels/trace.cl, with LANES rays per SIMD packet. Each call of
// Embree traces PACKETS packets. CMakeLists.txt compiles this file once for each mode. Unlike in
// clrt, all surfaces are visible from both sides, and rays start or end at a fixed distance from
// the surface. Most users of Embree trace in this way, because filter functions are slower.
#include "calls.h"
#include "peer_draw.h"

#include <string.h>

#define BLOCK_WIDTH    (LANES < 4 ? 1 : 4)
#define BLOCK_HEIGHT   (LANES / BLOCK_WIDTH)
#define BLOCKS_ABREAST (PACKETS > 1 ? 2 : 1)
#define BLOCKS_DEEP    (PACKETS / BLOCKS_ABREAST)

// Reflected rays start at this distance from a surface, and shadow rays end at it.
// The scene's longest side is 1 to 2.
#define AWAY 3e-5f

// The state of a packet's paths.
typedef struct {
    Points origin, direction, color;
    Floats weight;
    Mask active;
    float nearest; // the least distance of a hit
} Paths;

typedef struct {
    Points point, normal, face, toward_viewer;
    Mask material; // index
} Surfaces;

// One material per lane.
typedef struct {
    Points diffuse, specular;
    Floats kd, ks, reflectivity;
    Mask shader, exponent;
} Looks;

static void start_camera(const PeerTile *tile, uint32_t x, uint32_t y, Paths *paths)
{
    const CameraData *camera = &tile->scene->camera;
    Floats across, downward;
    Mask active;
    for (int lane = 0; lane < LANES; lane++) {
        const uint32_t column = x + (uint32_t)(lane % BLOCK_WIDTH);
        const uint32_t row = y + (uint32_t)(lane / BLOCK_WIDTH);
        across[lane] = (float)((int)(2 * column + 1) - (int)tile->scene->width);
        downward[lane] = (float)((int)(2 * row + 1) - (int)tile->scene->height);
        active[lane] = column < tile->x + tile->width && row < tile->y + tile->height ? -1 : 0;
    }
    paths->active = active;
    paths->origin = points_all(camera->eye);
    paths->direction = points_add(points_scale(points_all(camera->right_step), across),
                                  points_add(points_scale(points_all(camera->down_step), downward),
                                             points_all(camera->forward)));
    paths->color = (Points){0};
    paths->weight = all(1);
    paths->nearest = 0;
}

static inline void set_rays(Rays *rays, Points origin, Points direction, float near, Floats far)
{
    rays->origin = origin;
    rays->near = all(near);
    rays->direction = direction;
    rays->time = all(0);
    rays->far = far;
    rays->mask = (Mask){0} - 1;
    rays->flags = (Mask){0};
}

typedef float Quad __attribute__((vector_size(16)));

// Looks up the materials and interpolates the normals, which may have any length.
static inline void look_up(const PeerScene *scene, const RayHits *hits, Mask hit,
                           Surfaces *surfaces)
{
    surfaces->normal = hits->normal;
    for (int lane = 0; lane < LANES; lane++) {
        if (!hit[lane])
            continue;
        const uint32_t first = hits->geometry[lane] == PEER_TRIANGLES ? scene->sphere_count : 0;
        const TriangleLook *look = &scene->looks[first + (uint32_t)hits->primitive[lane]];
        surfaces->material[lane] = (int32_t)look->material;
        if (look->shading == NOTHING)
            continue;
        const CornerNormals *corners = &scene->normals[look->shading];
        Quad normals[3];
        memcpy(normals, corners->normals, sizeof normals);
        const float u = hits->u[lane], v = hits->v[lane];
        const Quad normal = (1 - u - v) * normals[0] + u * normals[1] + v * normals[2];
        surfaces->normal.x[lane] = normal[0];
        surfaces->normal.y[lane] = normal[1];
        surfaces->normal.z[lane] = normal[2];
    }
}

static inline Surfaces surfaces_at(const PeerScene *scene, const RayHits *hits, Mask hit)
{
    Surfaces surfaces;
    const Points direction = hits->rays.direction;
    look_up(scene, hits, hit, &surfaces);
    surfaces.normal = points_unit(surfaces.normal);
    surfaces.face = points_unit(hits->normal);
    const Floats turn = choose(points_dot(hits->normal, direction) > all(0), all(-1), all(1));
    surfaces.normal = points_scale(surfaces.normal, turn);
    surfaces.face = points_scale(surfaces.face, turn);
    surfaces.toward_viewer = points_scale(points_unit(direction), all(-1));
    surfaces.point = points_add(hits->rays.origin, points_scale(direction, hits->rays.far));
    return surfaces;
}

static inline void set_look(Looks *looks, const Material *material, int lane)
{
    looks->diffuse.x[lane] = material->diffuse[0];
    looks->diffuse.y[lane] = material->diffuse[1];
    looks->diffuse.z[lane] = material->diffuse[2];
    looks->specular.x[lane] = material->specular[0];
    looks->specular.y[lane] = material->specular[1];
    looks->specular.z[lane] = material->specular[2];
    looks->kd[lane] = material->kd;
    looks->ks[lane] = material->ks;
    looks->reflectivity[lane] = material->reflectivity;
    looks->shader[lane] = (int32_t)material->shader;
    looks->exponent[lane] = (int32_t)material->exponent;
}

static inline Looks looks_all(const Material *material)
{
    return (Looks){.diffuse = points_all(material->diffuse),
                   .specular = points_all(material->specular),
                   .kd = all(material->kd),
                   .ks = all(material->ks),
                   .reflectivity = all(material->reflectivity),
                   .shader = (Mask){0} + (int32_t)material->shader,
                   .exponent = (Mask){0} + (int32_t)material->exponent};
}

// Returns the material of each lane. Most packets see a single material.
static inline Looks looks_of(const PeerScene *scene, Mask hit, Mask material)
{
    int first = 0;
    while (!hit[first])
        first++;
    Looks looks = looks_all(&scene->materials[material[first]]);
    if (lanes_of(hit & (material != material[first])) == 0)
        return looks;
    for (int lane = 0; lane < LANES; lane++)
        if (hit[lane])
            set_look(&looks, &scene->materials[material[lane]], lane);
    return looks;
}

// Exponents must not be negative.
static inline Floats power(Floats base, Mask exponent)
{
    Floats result = all(1);
    while (lanes_of(exponent != 0) > 0) {
        result = choose((exponent & 1) != 0, result * base, result);
        base *= base;
        exponent >>= 1;
    }
    return result;
}

static inline Floats highlight(Mask exponent, const Surfaces *surfaces, Points toward_light)
{
    const Points half_vector = points_unit(points_add(toward_light, surfaces->toward_viewer));
    const Floats cosine = points_dot(surfaces->normal, half_vector);
    return power(at_least(at_most(cosine, all(1)), all(0)), exponent);
}

typedef struct {
    Floats diffuse, specular;
} Received;

// A packet's hits. If no lane has a hit, surfaces and looks are not set.
typedef struct {
    Mask hit;
    Surfaces surfaces;
    Looks looks;
    Received light;
} Met;

// Adds the light that each surface receives from one light.
static void add_light(PeerTile *tile, const PointLight *light, Met met[PACKETS])
{
    Rays rays[PACKETS];
    Points toward_light[PACKETS];
    Floats cosine[PACKETS];
    Mask lit[PACKETS];
    int count = 0;
    for (int packet = 0; packet < PACKETS; packet++) {
        const Points origin = points_all(light->position);
        const Surfaces *surfaces = &met[packet].surfaces;
        const Points direction = points_subtract(surfaces->point, origin);
        const Floats inverse = inverse_root(points_dot(direction, direction));
        toward_light[packet] = points_scale(direction, -inverse);
        cosine[packet] = points_dot(surfaces->normal, toward_light[packet]);
        const Floats height = points_dot(surfaces->face, toward_light[packet]);
        lit[packet] = met[packet].hit & (cosine[packet] > all(0)) & (height > all(0)) &
                      (met[packet].looks.shader != SHADER_SILHOUETTE);
        set_rays(&rays[packet], origin, direction, 0, 1 - AWAY * inverse);
        count += lanes_of(lit[packet]);
    }
    if (count == 0)
        return;
    tile->counts.rays[RAY_SHADOW] += (uint64_t)count;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = tile->flags[RAY_SHADOW];
    call_occluded(tile->scene->scene, &context, lit, rays);
    for (int packet = 0; packet < PACKETS; packet++) {
        const Mask open = lit[packet] & (rays[packet].far >= all(0));
        const Looks *looks = &met[packet].looks;
        const Mask shiny = open & (looks->shader == SHADER_BLINN_PHONG);
        met[packet].light.diffuse += choose(open, light->intensity * cosine[packet], all(0));
        if (lanes_of(shiny) > 0)
            met[packet].light.specular +=
                choose(shiny,
                       light->intensity * highlight(looks->exponent & shiny, &met[packet].surfaces,
                                                    toward_light[packet]),
                       all(0));
    }
}

static inline Floats clamped(Floats value)
{
    return at_least(at_most(value, all(1)), all(0));
}

static inline Points shaded(const PeerScene *scene, const Looks *looks, const Received *light)
{
    const Points diffuse =
        points_scale(looks->diffuse, scene->ambient + looks->kd * light->diffuse);
    const Points sum =
        points_add(diffuse, points_scale(looks->specular, looks->ks * light->specular));
    const Points color = {clamped(sum.x), clamped(sum.y), clamped(sum.z)};
    return points_choose(looks->shader == SHADER_SILHOUETTE, looks->diffuse, color);
}

static inline void reflect(const Surfaces *surfaces, Paths *paths)
{
    const Floats cosine = points_dot(surfaces->normal, surfaces->toward_viewer);
    const Points direction =
        points_subtract(points_scale(surfaces->normal, 2 * cosine), surfaces->toward_viewer);
    const Floats height = at_most(points_dot(direction, surfaces->face), all(0));
    paths->origin = surfaces->point;
    paths->direction = points_subtract(direction, points_scale(surfaces->face, 2 * height));
    paths->nearest = AWAY;
}

// Finds the hits of the next rays of all paths. Adds the background to the paths without a hit.
// Returns false if no path has a hit.
static bool meet(PeerTile *tile, RayKind kind, Paths paths[PACKETS], Met met[PACKETS])
{
    const PeerScene *scene = tile->scene;
    RayHits hits[PACKETS];
    Mask active[PACKETS];
    int rays = 0, hit_count = 0;
    for (int packet = 0; packet < PACKETS; packet++) {
        active[packet] = paths[packet].active;
        set_rays(&hits[packet].rays, paths[packet].origin, paths[packet].direction,
                 paths[packet].nearest, all(INFINITY));
        hits[packet].primitive = hits[packet].geometry = (Mask){0} - 1;
        rays += lanes_of(active[packet]);
    }
    if (rays == 0)
        return false;
    tile->counts.rays[kind] += (uint64_t)rays;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = tile->flags[kind];
    call_intersect(scene->scene, &context, active, hits);
    const Points background = points_all(scene->background);
    for (int packet = 0; packet < PACKETS; packet++) {
        const Mask hit = active[packet] & (hits[packet].geometry != -1);
        hit_count += lanes_of(hit);
        paths[packet].color = points_add(
            paths[packet].color,
            points_scale(background, choose(active[packet] & ~hit, paths[packet].weight, all(0))));
        paths[packet].active = met[packet].hit = hit;
        met[packet].light = (Received){0};
        if (lanes_of(hit) == 0)
            continue;
        met[packet].surfaces = surfaces_at(scene, &hits[packet], hit);
        met[packet].looks = looks_of(scene, hit, met[packet].surfaces.material);
    }
    return hit_count > 0;
}

// Adds the color of the surfaces that a packet has hit, and continues the paths at reflective
// surfaces.
static inline void follow(const PeerScene *scene, const Met *met, Paths *paths)
{
    const Points color = shaded(scene, &met->looks, &met->light);
    const Floats reflectivity = met->looks.reflectivity;
    const Floats weight = choose(met->hit, paths->weight, all(0));
    paths->color = points_add(paths->color, points_scale(color, weight * (1 - reflectivity)));
    paths->weight *= reflectivity;
    paths->active = met->hit & (reflectivity != all(0));
    reflect(&met->surfaces, paths);
}

// Traces one level of all paths. Returns false if no path has a hit.
static bool trace_level(PeerTile *tile, RayKind kind, Paths paths[PACKETS])
{
    const PeerScene *scene = tile->scene;
    Met met[PACKETS];
    if (!meet(tile, kind, paths, met))
        return false;
    for (uint32_t index = 0; index < scene->light_count; index++)
        add_light(tile, &scene->lights[index], met);
    for (int packet = 0; packet < PACKETS; packet++)
        if (lanes_of(met[packet].hit) > 0)
            follow(scene, &met[packet], &paths[packet]);
    return true;
}

static void store(const PeerTile *tile, uint32_t x, uint32_t y, const Paths *paths)
{
    // Paths that are still active after the last level see the background.
    const Points color =
        points_add(paths->color, points_scale(points_all(tile->scene->background),
                                              choose(paths->active, paths->weight, all(0))));
    for (int lane = 0; lane < LANES; lane++) {
        const uint32_t column = x + (uint32_t)(lane % BLOCK_WIDTH);
        const uint32_t row = y + (uint32_t)(lane / BLOCK_WIDTH);
        if (column >= tile->x + tile->width || row >= tile->y + tile->height)
            continue;
        float *pixel = tile->framebuffer->pixels[(size_t)row * tile->framebuffer->width + column];
        pixel[0] = color.x[lane];
        pixel[1] = color.y[lane];
        pixel[2] = color.z[lane];
    }
}

static void draw_blocks(PeerTile *tile, uint32_t x, uint32_t y)
{
    Paths paths[PACKETS];
    for (uint32_t packet = 0; packet < PACKETS; packet++)
        start_camera(tile, x + packet % BLOCKS_ABREAST * BLOCK_WIDTH,
                     y + packet / BLOCKS_ABREAST * BLOCK_HEIGHT, &paths[packet]);
    for (uint32_t level = 0; level < tile->scene->max_level; level++)
        if (!trace_level(tile, level == 0 ? RAY_CAMERA : RAY_REFLECTED, paths))
            break;
    for (uint32_t packet = 0; packet < PACKETS; packet++)
        store(tile, x + packet % BLOCKS_ABREAST * BLOCK_WIDTH,
              y + packet / BLOCKS_ABREAST * BLOCK_HEIGHT, &paths[packet]);
}

void DRAW_TILE(PeerTile *tile)
{
    for (uint32_t y = 0; y < tile->height; y += BLOCKS_DEEP * BLOCK_HEIGHT)
        for (uint32_t x = 0; x < tile->width; x += BLOCKS_ABREAST * BLOCK_WIDTH)
            draw_blocks(tile, tile->x + x, tile->y + y);
}
