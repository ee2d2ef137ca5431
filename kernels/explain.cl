// SPDX-License-Identifier: MIT
// The kernel of clrt explain SCENE X,Y. A single work-item traces one sample in its first lane, by
// the same functions as trace(), and records the path in the format of shared.h. The kernel is
// compiled after render.cl, and only if requested.

typedef struct {
    global Scalar *values; // for each level: LEVEL_VALUES, then LIGHT_VALUES for each light
    global uint *words;    // for each level: LEVEL_WORDS, then LIGHT_WORDS for each light
} Notes;

static inline Notes level_notes(const Notes *notes, const FrameData *frame, uint level)
{
    const size_t values = LEVEL_VALUES + (size_t)frame->light_count * LIGHT_VALUES;
    const size_t words = LEVEL_WORDS + (size_t)frame->light_count * LIGHT_WORDS;
    return (Notes){notes->values + level * values, notes->words + level * words};
}

static inline Notes light_notes(const Notes *level, uint light)
{
    return (Notes){level->values + LEVEL_VALUES + (size_t)light * LIGHT_VALUES,
                   level->words + LEVEL_WORDS + (size_t)light * LIGHT_WORDS};
}

static inline void note(const Notes *notes, uint place, Real value)
{
    notes->values[place] = ((const Scalar *)&value)[0];
}

static inline void note3(const Notes *notes, uint place, Real3 value)
{
    note(notes, place, value.x);
    note(notes, place + 1, value.y);
    note(notes, place + 2, value.z);
}

static inline void note_count(const Notes *notes, uint place, UInt value)
{
    notes->words[place] = ((const uint *)&value)[0];
}

// Returns a bound on the error of t at a triangle: the bound on the depth's error, divided by |z|
// of the direction (triangle.inc.cl).
static inline Real triangle_error(const Tracer *tracer, const Ray *ray, UInt index)
{
    const Corners corners = fetch_corners(tracer, index);
    const ShearAxes axes = shear_axes(ray->direction);
    const Shear shear = shear_along(ray->direction, &axes);
    const Corners relative = {corner_seen(corners.a, ray->origin, &axes),
                              corner_seen(corners.b, ray->origin, &axes),
                              corner_seen(corners.c, ray->origin, &axes)};
    const Corners sheared = corners_sheared(&relative, &shear);
    return triangle_depth_error(&sheared) * fabs(shear.inverse_z);
}

static inline Real size_of3(Real3 v)
{
    const Real3 size = magnitudes(v);
    return size.x + size.y + size.z;
}

// Returns a bound on the error of t at a sphere. The residual is |origin + t * direction -
// center|^2 - radius^2, and equals |direction|^2 * (t - first root) * (t - second root). The nearer
// root is therefore within the square root of |residual| / |direction|^2. The root is also within
// twice a Newton step, which is less unless the ray grazes the sphere. The bound adds 64 units of
// two-float rounding to the residual.
static inline Real sphere_error(const Tracer *tracer, const Ray *ray, UInt index, Real t)
{
    const Sphere sphere = fetch_sphere(tracer, index);
    const Real3 d = ray->direction;
    const TwoFloat3 on = two_stepped(sphere_to_origin(&sphere, ray->origin), t, d);
    const Real left = two_add(two_length_squared(on), two_negate(two_square(sphere.radius))).high;
    const Real3 center = real3_of(sphere.center.x.high, sphere.center.y.high, sphere.center.z.high);
    const Real reach = size_of3(ray->origin) + size_of3(center) + t * size_of3(d);
    const Real rounding =
        64.0f * UNIT_ROUNDOFF * UNIT_ROUNDOFF * sphere.radius.high * (reach + sphere.radius.high);
    const Real residue = fabs(left) + rounding;
    const Real steep = residue / fabs(two_dot(on, d).high);
    return min(steep, sqrt(residue / dot_product(d, d)));
}

static inline Real hit_error(const Tracer *tracer, const Ray *ray, const Hit *hit)
{
    if (any_lane(ray->active && hit->id < tracer->frame->sphere_count))
        return sphere_error(tracer, ray, hit->index, hit->t);
    return triangle_error(tracer, ray, hit->index);
}

// Records the contribution that shade() computes for a light.
static inline void note_light(const Notes *notes, const Tracer *tracer, uint index,
                              const Lighting *lighting)
{
    const LightSample light = sample_light(tracer, index, lighting->surface, lighting->wanted);
    note(notes, LIGHT_COSINE, light.cosine);
    note_count(notes, LIGHT_STATE,
               light.cosine > 0.0f ? (UInt)(LIGHT_BEHIND_FACE) : (UInt)(LIGHT_BEHIND));
    note_count(notes, LIGHT_BLOCKER, (UInt)(NOTHING));
    if (!any_lane(light.faces))
        return;
    const Ray ray = ray_to_light(tracer, lighting->surface, &light);
    const Hit blocker = blocking_hit(tracer, &ray);
    const Received received = receive_light(&light, lighting, light.faces && blocker.id == NOTHING);
    note_count(notes, LIGHT_STATE,
               blocker.id == NOTHING ? (UInt)(LIGHT_SEEN) : (UInt)(LIGHT_BLOCKED));
    note_count(notes, LIGHT_BLOCKER, blocker.id);
    note(notes, LIGHT_BLOCKER_T, blocker.t);
    note(notes, LIGHT_DIFFUSE, received.diffuse);
    note(notes, LIGHT_SPECULAR, received.specular);
}

// Records the last ray of the path and its hit.
static inline void note_ray(const Notes *notes, const Tracer *tracer, const Paths *paths)
{
    const Ray *ray = paths->rays;
    const Path *path = paths->paths;
    note3(notes, LEVEL_ORIGIN, ray->origin);
    note3(notes, LEVEL_DIRECTION, ray->direction);
    note(notes, LEVEL_T, paths->hits->t);
    note(notes, LEVEL_WEIGHT, path->weight);
    note_count(notes, LEVEL_PRIMITIVE, paths->hits->id);
    if (!any_lane(path->met))
        return;
    const Hit hits = hit_everywhere(paths->hits, path->met);
    note(notes, LEVEL_ERROR, hit_error(tracer, ray, &hits));
}

// Records the last surface of the path and each light's contribution to it.
static inline void note_surface(const Notes *notes, const Tracer *tracer, const Path *path)
{
    const Lighting lighting = lighting_of(&path->surface, &path->material, path->met);
    note3(notes, LEVEL_POINT, path->surface.point);
    note3(notes, LEVEL_NORMAL, path->surface.normal);
    note(notes, LEVEL_SHARE, path_share(path));
    note_count(notes, LEVEL_MATERIAL, path->surface.material);
    note3(notes, LEVEL_DIFFUSE, path->material.diffuse);
    for (uint index = 0; any_lane(lighting.wanted) && index < tracer->frame->light_count; index++) {
        const Notes light = light_notes(notes, index);
        note_light(&light, tracer, index, &lighting);
    }
}

// Traces like trace() and records the path. `end` receives the number of rays and, at index 3, the
// background's weight in the color.
static inline Real3 trace_noting(const Tracer *tracer, Ray ray, const Notes *notes,
                                 const Notes *end)
{
    Paths paths;
    const Path *path = paths.paths;
    Real3 shaded[PACKETS];
    paths_start_one(&paths, ray);
    for (bool any = paths_begin(tracer, &paths); any; any = paths_continue(tracer, &paths)) {
        paths_step(tracer, &paths);
        const Notes level = level_notes(notes, tracer->frame, paths.level - 1);
        note_ray(&level, tracer, &paths);
        if (!any_lane(path->met))
            break;
        note_surface(&level, tracer, path);
        paths_shade(tracer, &paths, shaded);
        note3(&level, LEVEL_SHADED, shaded[0]);
    }
    *end->words = paths.level;
    note(end, 3, path->weight);
    return path_color(tracer, path);
}

// Traces the sample at a column and row of the picture's sample grid. `values` and `words` have
// room for max_level levels. `result` receives the color in steps of 2^-32 and, at index 3, the
// background's weight in the color. `count` receives the number of levels.
kernel void explain_sample(TRACER_ARGUMENTS, uint column, uint row, global Scalar *values,
                           global uint *words, global Scalar *result, global uint *count)
{
    Tally tally = {0};
    const Tracer tracer = TRACER(&tally);
    const Notes notes = {values, words}, end = {result, count};
    const Ray ray = camera_ray(&frame, (UInt)(column), (UInt)(row), lanes_of(1));
    const Real3 color = trace_noting(&tracer, ray, &notes, &end);
    note3(&end, 0, in_steps3(color));
}
