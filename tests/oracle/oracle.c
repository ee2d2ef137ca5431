// SPDX-License-Identifier: MIT
// Traces and shades by the rules of clrt and of the UvA course (docs/scenes.md). A light shines on
// a point if the interpolated normal faces the light, and nothing but glass occludes the light. A
// ray never hits the triangle that it leaves. A ray that leaves a sphere can hit this sphere only
// at the far wall. A reflected ray that would enter the surface is mirrored out of the surface.
#include "oracle/oracle.h"

// A light grazes a face if the sine of the light's height over the face is below this limit. A
// float tracer moves a point off its face by up to 2^-20 of the scene. A grazing light may then
// reach the point over the edge of a neighboring face, up to 2^-12 of the scene away.
#define HORIZON 0x1p-8

bool oracle_make(Oracle *oracle, const Scene *scene, Error *error)
{
    *oracle = (Oracle){.scene = scene};
    return blocks_make(&oracle->blocks, scene, error);
}

void oracle_free(Oracle *oracle)
{
    blocks_free(&oracle->blocks);
    *oracle = (Oracle){0};
}

OracleView oracle_view(const Oracle *oracle, const Viewpoint *viewpoint, uint32_t width,
                       uint32_t height, uint32_t max_level)
{
    const bool is_parallel = viewpoint->height > 0;
    const double radians = viewpoint->fov_degrees * (acos(-1) / 180);
    const double least = viewpoint->width * height / width;
    const double side = is_parallel ? fmax(viewpoint->height, least) : 2 * tan(radians / 2);
    const double pixel = side / height;
    const Vec3 forward = vec3_normalize(vec3_sub(viewpoint->look_at, viewpoint->eye));
    const Vec3 right = vec3_normalize(vec3_cross(forward, vec3_normalize(viewpoint->up)));
    return (OracleView){.oracle = oracle,
                        .eye = viewpoint->eye,
                        .forward = forward,
                        .right = vec3_scale(right, pixel),
                        .down = vec3_scale(vec3_cross(forward, right), pixel),
                        .is_parallel = is_parallel,
                        .width = width,
                        .height = height,
                        .max_level = max_level};
}

// Solves the quadratic equation in long double, whose 64 bits make cancellation harmless. A ray
// inside hits the far wall. A ray can hit only the far wall of the sphere on which it starts.
static double sphere_distance(const Sphere *sphere, const OracleRay *ray, double near)
{
    const Vec3 d = ray->direction;
    const long double x = (long double)ray->origin.x - sphere->center.x;
    const long double y = (long double)ray->origin.y - sphere->center.y;
    const long double z = (long double)ray->origin.z - sphere->center.z;
    const long double a = (long double)d.x * d.x + (long double)d.y * d.y + (long double)d.z * d.z;
    const long double b = 2 * (x * d.x + y * d.y + z * d.z);
    const long double c = x * x + y * y + z * z - (long double)sphere->radius * sphere->radius;
    const long double discriminant = b * b - 4 * a * c;
    if (!(discriminant >= 0))
        return INFINITY;
    const double nearer = (double)((-b - sqrtl(discriminant)) / (2 * a));
    const double farther = (double)((-b + sqrtl(discriminant)) / (2 * a));
    return nearer > near ? nearer : farther > near ? farther : INFINITY;
}

static OracleHit meet_spheres(const Scene *scene, const OracleRay *ray)
{
    OracleHit hit = {INFINITY, NOTHING};
    for (uint32_t id = 0; id < scene->spheres.count; id++) {
        const Sphere *sphere = &scene->spheres.data[id];
        const double near = id == ray->own ? 1e-9 * sphere->radius : ray->near;
        const double t = sphere_distance(sphere, ray, near);
        if (t < hit.t && t < ray->far)
            hit = (OracleHit){t, id};
    }
    return hit;
}

static void sign(OracleDecisions *decisions, uint64_t word)
{
    decisions->signature = (decisions->signature + word + 1) * UINT64_C(0x9e3779b97f4a7c15);
    decisions->signature ^= decisions->signature >> 29;
}

static OracleHit meet(const Oracle *oracle, const OracleRay *ray)
{
    OracleHit hit = meet_spheres(oracle->scene, ray);
    blocks_meet(&oracle->blocks, ray, &hit);
    return hit;
}

static bool is_glass(const Oracle *oracle, const OracleSurface *surface)
{
    return oracle->scene->materials.data[surface->material].shader == SHADER_GLASS;
}

static Vec3 times(Vec3 a, Vec3 b)
{
    return vec3(a.x * b.x, a.y * b.y, a.z * b.z);
}

// Returns for each color channel the fraction of a light that passes the glass along a ray. Returns
// 0 if the ray also hits anything else. As in the renderer, a new ray starts at each crossing.
static Vec3 light_let_through(const Oracle *oracle, OracleRay ray, OracleDecisions *decisions)
{
    Vec3 passed = {1, 1, 1};
    for (int crossings = 0; crossings <= 64; crossings++) {
        const OracleHit hit = meet(oracle, &ray);
        if (hit.id == NOTHING || hit.t >= ray.far)
            return passed;
        const OracleSurface surface = surface_at(oracle->scene, &ray, hit);
        if (!is_glass(oracle, &surface))
            break;
        sign(decisions, 2 * (uint64_t)surface.object + surface.front);
        passed = times(passed, surface.body);
        ray = (OracleRay){surface.point, ray.direction, surface.near, ray.far - hit.t, surface.id};
    }
    return (Vec3){0, 0, 0};
}

// A light as seen from a surface.
typedef struct {
    Vec3 toward; // direction to the light, of length 1
    double cosine;
    bool shines; // the light reaches the surface
    Vec3 passed; // the part of the light that passes the glass on its way
} OracleLight;

static OracleLight see_light(const Oracle *oracle, const OracleSurface *surface, const Light *light,
                             OracleDecisions *decisions)
{
    const Vec3 apart = light->is_sun ? light->position : vec3_sub(light->position, surface->point);
    const Vec3 toward = vec3_normalize(apart);
    const double distance = light->is_sun ? (double)INFINITY : sqrt(vec3_dot(apart, apart));
    const OracleRay ray = {surface->point, toward, surface->near, distance, surface->id};
    const double cosine = vec3_dot(surface->normal, toward);
    const bool faces = cosine > 0 && !surface_blocks(surface, toward);
    const bool clear = faces && meet_spheres(oracle->scene, &ray).id == NOTHING &&
                       !blocks_block(&oracle->blocks, &ray);
    Vec3 passed = {1, 1, 1};
    if (faces && !clear)
        passed = light_let_through(oracle, ray, decisions);
    return (OracleLight){toward, cosine, faces && vec3_extent(passed) > 0, passed};
}

static double highlight(const Material *material, const OracleSurface *surface, Vec3 toward_light)
{
    Vec3 half_vector = vec3_normalize(vec3_add(toward_light, surface->toward_viewer));
    if (!(vec3_extent(half_vector) > 0))
        half_vector = surface->normal;
    const double cosine = vec3_dot(surface->normal, half_vector);
    return pow(fmin(fmax(cosine, 0), 1), (double)material->shininess);
}

typedef struct {
    Vec3 diffuse, specular;
} Received;

static Received light_received(const Oracle *oracle, const OracleSurface *surface,
                               OracleDecisions *decisions)
{
    const Scene *scene = oracle->scene;
    const Material *material = &scene->materials.data[surface->material];
    Received received = {{0, 0, 0}, {0, 0, 0}};
    for (size_t i = 0; i < scene->lights.count; i++) {
        const OracleLight light = see_light(oracle, surface, &scene->lights.data[i], decisions);
        const Vec3 color = times(scene->lights.data[i].color, light.passed);
        const Vec3 power = vec3_scale(color, scene->lights.data[i].intensity);
        sign(decisions, light.shines);
        if (light.cosine > 0 && fabs(vec3_dot(surface->face, light.toward)) < HORIZON)
            decisions->grazes = true;
        if (!light.shines)
            continue;
        received.diffuse = vec3_add(received.diffuse, vec3_scale(power, light.cosine));
        if (material->shader == SHADER_BLINN_PHONG)
            received.specular = vec3_add(
                received.specular, vec3_scale(power, highlight(material, surface, light.toward)));
    }
    return received;
}

static double clamped(double value)
{
    return fmin(fmax(value, 0), 1);
}

static Vec3 shade(const Oracle *oracle, const OracleSurface *surface, OracleDecisions *decisions)
{
    const Material *material = &oracle->scene->materials.data[surface->material];
    const Vec3 body = surface->body;
    if (material->shader == SHADER_SILHOUETTE)
        return body;
    const Received received = light_received(oracle, surface, decisions);
    const Vec3 gloss = {(double)material->specular[0], (double)material->specular[1],
                        (double)material->specular[2]};
    const double ambient = oracle->scene->ambient, kd = (double)material->kd,
                 ks = (double)material->ks;
    const Vec3 lit = received.diffuse, shine = received.specular;
    return vec3(clamped(body.x * (ambient + kd * lit.x) + gloss.x * ks * shine.x),
                clamped(body.y * (ambient + kd * lit.y) + gloss.y * ks * shine.y),
                clamped(body.z * (ambient + kd * lit.z) + gloss.z * ks * shine.z));
}

static Vec3 reflected(const OracleSurface *surface)
{
    const double cosine = vec3_dot(surface->normal, surface->toward_viewer);
    const Vec3 direction =
        vec3_sub(vec3_scale(surface->normal, 2 * cosine), surface->toward_viewer);
    const double height = vec3_dot(direction, surface->face);
    const Vec3 outward =
        height < 0 ? vec3_sub(direction, vec3_scale(surface->face, 2 * height)) : direction;
    return vec3_normalize(outward);
}

// The refracted direction, and the share of the light that is reflected.
typedef struct {
    Vec3 direction;
    double reflectance; // 1 for total reflection
} Bent;

// Applies Snell's law to the direction's component along the surface. Fresnel's equations take the
// sines and tangents of the sum and of the difference of both rays' angles to the normal. For a ray
// along the normal, both angles are 0, and the reflectance depends only on the index.
static Bent bend(const OracleSurface *surface, double ior)
{
    const bool is_sphere = vec3_dot(surface->normal, surface->face) < 0;
    const Vec3 normal = vec3_scale(surface->normal, is_sphere ? -1 : 1);
    const double ratio = surface->front ? 1 / ior : ior;
    const double cosine = fmin(vec3_dot(normal, surface->toward_viewer), 1);
    if (ratio == 1)
        return (Bent){vec3_scale(surface->toward_viewer, -1), 0};
    const Vec3 along = vec3_sub(vec3_scale(normal, cosine), surface->toward_viewer);
    const Vec3 bent = vec3_scale(along, ratio);
    const double sine = sqrt(vec3_dot(bent, bent));
    if (cosine <= 0 || sine >= 1)
        return (Bent){{0, 0, 0}, 1};
    Vec3 direction = vec3_sub(bent, vec3_scale(normal, sqrt(1 - sine * sine)));
    const double height = vec3_dot(direction, surface->face);
    if (height > 0)
        direction = vec3_sub(direction, vec3_scale(surface->face, 2 * height));
    const double incoming = acos(cosine), outgoing = asin(sine);
    const double upright = (ratio - 1) / (ratio + 1);
    if (incoming < 1e-4)
        return (Bent){direction, upright * upright};
    const double s = sin(incoming - outgoing) / sin(incoming + outgoing);
    const double p = tan(incoming - outgoing) / tan(incoming + outgoing);
    return (Bent){direction, (s * s + p * p) / 2};
}

static Vec3 trace(const OracleView *view, OracleRay ray, uint32_t level,
                  OracleDecisions *decisions);

static Vec3 trace_glass(const OracleView *view, const OracleSurface *surface, uint32_t level,
                        OracleDecisions *decisions)
{
    const Material *material = &view->oracle->scene->materials.data[surface->material];
    const Bent bent = bend(surface, (double)material->ior);
    OracleRay next = {surface->point, bent.direction, surface->near, INFINITY, surface->id};
    Vec3 color = {0, 0, 0};
    sign(decisions, bent.reflectance < 1);
    if (bent.reflectance < 1)
        color = vec3_scale(times(surface->body, trace(view, next, level + 1, decisions)),
                           1 - bent.reflectance);
    next.direction = reflected(surface);
    if (bent.reflectance > 0)
        color =
            vec3_add(color, vec3_scale(trace(view, next, level + 1, decisions), bent.reflectance));
    return color;
}

static Vec3 trace(const OracleView *view, OracleRay ray, uint32_t level, OracleDecisions *decisions)
{
    const Oracle *oracle = view->oracle;
    const Scene *scene = oracle->scene;
    if (level >= view->max_level)
        return scene->background;
    const OracleHit hit = meet(oracle, &ray);
    if (hit.id == NOTHING) {
        sign(decisions, NOTHING);
        return scene->background;
    }
    const OracleSurface surface = surface_at(scene, &ray, hit);
    sign(decisions, 4 * (uint64_t)surface.object + 2 * surface.odd + surface.front);
    if (is_glass(oracle, &surface))
        return trace_glass(view, &surface, level, decisions);
    const Vec3 shaded = shade(oracle, &surface, decisions);
    const double reflectivity = (double)scene->materials.data[surface.material].reflectivity;
    if (!(reflectivity > 0))
        return shaded;
    const OracleRay next = {surface.point, reflected(&surface), surface.near, INFINITY, surface.id};
    const Vec3 mirrored = trace(view, next, level + 1, decisions);
    return vec3_add(vec3_scale(shaded, 1 - reflectivity), vec3_scale(mirrored, reflectivity));
}

static OracleRay ray_through(const OracleView *view, double x, double y)
{
    const Vec3 across = vec3_add(vec3_scale(view->right, x - view->width / 2.0),
                                 vec3_scale(view->down, y - view->height / 2.0));
    if (view->is_parallel)
        return (OracleRay){vec3_add(view->eye, across), vec3_normalize(view->forward), 0, INFINITY,
                           NOTHING};
    const Vec3 direction = vec3_normalize(vec3_add(view->forward, across));
    return (OracleRay){view->eye, direction, 0, INFINITY, NOTHING};
}

OracleSample oracle_sample(const OracleView *view, double x, double y)
{
    OracleSample sample = {.color = {0, 0, 0}};
    sample.color = trace(view, ray_through(view, x, y), 0, &sample.decisions);
    return sample;
}

static uint32_t lights_reaching(const Oracle *oracle, const OracleSurface *surface)
{
    uint32_t count = 0;
    OracleDecisions ignored = {0};
    for (size_t i = 0; i < oracle->scene->lights.count; i++)
        count += see_light(oracle, surface, &oracle->scene->lights.data[i], &ignored).shines;
    return count;
}

static OraclePath follow(const OracleView *view, OracleRay ray)
{
    const Oracle *oracle = view->oracle;
    OraclePath path = {.depth = INFINITY};
    const double slope = vec3_dot(ray.direction, view->forward);
    for (uint32_t level = 0; level < view->max_level; level++) {
        path.bounces = level;
        const OracleHit hit = meet(oracle, &ray);
        if (hit.id == NOTHING)
            break;
        const OracleSurface surface = surface_at(oracle->scene, &ray, hit);
        if (level == 0) {
            path.depth = hit.t * slope;
            path.surface = surface;
            path.lights = lights_reaching(oracle, &surface);
        }
        if (!(oracle->scene->materials.data[surface.material].reflectivity > 0))
            break;
        ray = (OracleRay){surface.point, reflected(&surface), surface.near, INFINITY, surface.id};
    }
    return path;
}

OraclePath oracle_follow(const OracleView *view, Vec3 direction)
{
    return follow(view, (OracleRay){view->eye, direction, 0, INFINITY, NOTHING});
}

OraclePath oracle_path(const OracleView *view, double x, double y)
{
    return follow(view, ray_through(view, x, y));
}

typedef struct {
    Vec3 low, high;
} ColorRange;

static void range_include(ColorRange *range, Vec3 color)
{
    range->low =
        vec3(fmin(range->low.x, color.x), fmin(range->low.y, color.y), fmin(range->low.z, color.z));
    range->high = vec3(fmax(range->high.x, color.x), fmax(range->high.y, color.y),
                       fmax(range->high.z, color.z));
}

static bool spans(double low, double high, float value)
{
    return (double)value >= low - 1e-5 && (double)value <= high + 1e-5;
}

Explanation oracle_explains(const OracleView *view, uint32_t x, uint32_t y, const float color[3])
{
    const OracleSample center = oracle_sample(view, x + 0.5, y + 0.5);
    ColorRange range = {center.color, center.color};
    for (int row = 0; row < 5; row++)
        for (int column = 0; column < 5; column++) {
            const OracleSample sample =
                oracle_sample(view, x + (column - 1) / 2.0, y + (row - 1) / 2.0);
            if (sample.decisions.signature != center.decisions.signature)
                return EXPLAINED_BY_EDGE;
            range_include(&range, sample.color);
        }
    const bool spanned = spans(range.low.x, range.high.x, color[0]) &&
                         spans(range.low.y, range.high.y, color[1]) &&
                         spans(range.low.z, range.high.z, color[2]);
    if (spanned)
        return EXPLAINED_BY_CREASE;
    return center.decisions.grazes ? EXPLAINED_BY_HORIZON : EXPLAINED_NOT;
}
