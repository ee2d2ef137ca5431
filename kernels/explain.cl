// SPDX-License-Identifier: MIT
// The kernel of clrt explain SCENE X,Y. A single work-item traces one sample in its first lane, by
// the same functions as trace(), and records the path in the format of shared.h. The kernel is
// compiled after render.cl, and only if requested.

// A record, or the head before all records.
typedef struct {
    global Scalar *values;
    global uint *words;
} Notes;

// The records of a sample. Rays beyond `room` share a spare record after the others.
typedef struct {
    Notes head;
    uint room;     // number of records
    uint count;    // rays so far
    UInt level;    // of the last ray
    Mask refracts; // the next ray is refracted
} Explanation;

// Returns the record of the next ray.
static inline Notes next_notes(Explanation *explanation, const FrameData *frame)
{
    const size_t place = min(explanation->count, explanation->room);
    const size_t values = LEVEL_VALUES + (size_t)frame->light_count * LIGHT_VALUES;
    const size_t words = LEVEL_WORDS + (size_t)frame->light_count * LIGHT_WORDS;
    const Notes *head = &explanation->head;
    explanation->count++;
    return (Notes){head->values + HEAD_VALUES + place * values,
                   head->words + HEAD_WORDS + place * words};
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
// center|^2 - radius^2, and equals |direction|^2 * (t - first root) * (t - second root). The
// distance of t from the nearer root is therefore at most the square root of |residual| /
// |direction|^2. The distance is also at most twice a Newton step, which is the lesser bound unless
// the ray grazes the sphere. The result adds 64 units of two-float rounding (docs/numerics.md, B15)
// to the residual.
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

// Returns the distance to a light's blocker. A search for any hit may store only an upper bound on
// the distance to a sphere (sphere_blocks.cl).
static inline Real blocker_distance(const Tracer *tracer, const Ray *ray, const Hit *blocker)
{
    const Mask on_sphere = ray->active && blocker->id < tracer->frame->sphere_count;
    if (CLRT_GLASS || !any_lane(on_sphere))
        return blocker->t;
    const Hit hit = hit_everywhere(blocker, on_sphere);
    const Sphere sphere = fetch_sphere(tracer, hit.index);
    return exact_sphere_distance(&sphere, ray->origin, ray->direction);
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
    LightPath path;
    Ray ray = ray_to_light(tracer, lighting->surface, &light);
    const Real whole = dot_product(ray.direction, ray.direction);
    light_blockers(tracer, &ray, 1, light.position, &path);
    const Hit blocker = path.blockers[0];
    const Real rest = dot_product(ray.direction, ray.direction); // after the last glass
    const Real beyond = (1.0f - blocker.t) * sqrt(rest / whole);
    const Received received = receive_light(&light, lighting, light.faces && blocker.id == NOTHING);
    note_count(notes, LIGHT_STATE,
               blocker.id == NOTHING ? (UInt)(LIGHT_SEEN) : (UInt)(LIGHT_BLOCKED));
    note_count(notes, LIGHT_BLOCKER, blocker.id);
    note(notes, LIGHT_BLOCKER_T,
         CLRT_GLASS ? 1.0f - beyond : blocker_distance(tracer, &ray, &blocker));
    note(notes, LIGHT_DIFFUSE, received.diffuse);
    note(notes, LIGHT_SPECULAR, received.specular);
    note3(notes, LIGHT_TINT, tinted(&path, 0, real3_of(1.0f, 1.0f, 1.0f)));
}

// Records a ray of a level. The ray's color is the background until a hit is recorded.
static inline Notes note_ray(Explanation *explanation, const Tracer *tracer, const Ray *ray,
                             UInt level)
{
    const Notes notes = next_notes(explanation, tracer->frame);
    note3(&notes, LEVEL_ORIGIN, ray->origin);
    note3(&notes, LEVEL_DIRECTION, ray->direction);
    note3(&notes, LEVEL_SHADED, load_private3(tracer->frame->background));
    note_count(&notes, LEVEL_PRIMITIVE, (UInt)(NOTHING));
    note_count(&notes, LEVEL_NUMBER, level);
    note_count(&notes, LEVEL_REFRACTED, explanation->refracts ? (UInt)(1) : (UInt)(0));
    explanation->refracts = 0;
    return notes;
}

static inline void note_weights(const Notes *notes, Real weight, Real3 tint)
{
    note(notes, LEVEL_WEIGHT, weight);
    note(notes, LEVEL_SHARE, CLRT_GLASS ? weight : (Real)(0.0f));
    note3(notes, LEVEL_TINT, tint);
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

// Records the last ray of the path, its hit and the surface. Returns the record.
static inline Notes note_step(Explanation *explanation, const Tracer *tracer, const Paths *paths)
{
    const Path *path = paths->paths;
    const UInt level = last_level(paths, 0);
    const Notes notes = note_ray(explanation, tracer, paths->rays, level);
    note_weights(&notes, path->weight, path_tinted(path, real3_of(1.0f, 1.0f, 1.0f)));
    explanation->level = level;
    if (!any_lane(path->met))
        return notes;
    const Hit hit = hit_everywhere(paths->hits, path->met);
    note(&notes, LEVEL_T, hit.t);
    note(&notes, LEVEL_ERROR, hit_error(tracer, paths->rays, &hit));
    note_count(&notes, LEVEL_PRIMITIVE, hit.id);
    note_surface(&notes, tracer, path);
    return notes;
}

#if CLRT_GLASS
static inline void note_branch(Explanation *explanation, const Tracer *tracer, const Branch *branch)
{
    const Notes notes = note_ray(explanation, tracer, &branch->ray, explanation->level + 1);
    note_weights(&notes, branch->weight, branch->tint);
}

// Records whether the next ray is refracted, and the rays that max_level cuts off.
static inline void note_next(Explanation *explanation, const Tracer *tracer, const Paths *paths)
{
    const Successors after =
        successors_of(tracer, paths->paths, paths->rays, paths->paths->reflects);
    explanation->refracts = after.refracts;
    if (!any_lane(is_cut(tracer, paths->paths)))
        return;
    note_branch(explanation, tracer, &after.next);
    if (any_lane(after.splits))
        note_branch(explanation, tracer, &after.other);
}
#endif

// Traces like trace() and records the path.
static inline Real3 trace_noting(const Tracer *tracer, Ray ray, Explanation *explanation)
{
    Paths paths;
    Real3 shaded[PACKETS];
    paths_start_one(&paths, ray);
    for (bool any = paths_begin(tracer, &paths); any; any = paths_continue(tracer, &paths)) {
        paths_step(tracer, &paths);
        const Notes level = note_step(explanation, tracer, &paths);
        paths_shade(tracer, &paths, shaded);
        if (any_lane(paths.paths->met))
            note3(&level, LEVEL_SHADED, shaded[0]);
#if CLRT_GLASS
        note_next(explanation, tracer, &paths);
#endif
    }
    note(&explanation->head, HEAD_BACKGROUND, paths.paths->weight);
    return path_color(tracer, paths.paths);
}

// Traces the sample at a column and row of the picture's sample grid, and records the first `room`
// rays. `values` and `words` receive the head, the records and a spare record. The head has the
// number of all rays.
kernel void explain_sample(TRACER_ARGUMENTS, uint column, uint row, uint room,
                           global Scalar *values, global uint *words)
{
    Tally tally = {0};
    const Tracer tracer = TRACER(&tally);
    Explanation explanation = {.head = {values, words}, .room = room};
    const Ray ray = camera_ray(&frame, (UInt)(column), (UInt)(row), lanes_of(1));
    const Real3 color = trace_noting(&tracer, ray, &explanation);
    note3(&explanation.head, HEAD_COLOR, in_steps3(color));
    words[HEAD_RAYS] = explanation.count;
}
