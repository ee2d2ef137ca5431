// SPDX-License-Identifier: MIT
// Computes the surface at a hit that is certain for a ray cone, and the cones of the rays that
// leave the surface. The point and the normals have bounds on the difference between the tracer's
// and the exact values. B13 of docs/numerics.md derives the multiples of u, unless a comment names
// another step.
#ifndef CLRT_CERTIFY_SURFACE_CL
#define CLRT_CERTIFY_SURFACE_CL
#include "certify_search.cl"

// A surface with bounds on its errors. The doubt of a unit vector bounds the distance between the
// tracer's vector and the exact vector.
typedef struct {
    UncertainPoint end;
    Real3 normal, face, toward_viewer; // as in Surface
    Real normal_doubt, face_doubt, viewer_doubt;
    UInt id, index, material; // as in Surface
    bool is_sphere;
    bool from_behind; // seen from a triangle's back or from inside a sphere
    Corners corners;  // of a triangle
    Real room, edge;  // the point is at least room / edge away from the edges
    Real area;        // lower bound of twice the triangle's area
} UncertainSurface;

// Returns a bound on the error of a unit vector: v / `length` for a vector v with an error of at
// most `doubt`.
static inline Real turn_of(Real doubt, Real length)
{
    return doubt < 0.25f * length ? 1.02f * doubt / length : INFINITY;
}

// Interpolates the normal by the weights. If the point slides along the triangle, a weight changes
// by at most the slide divided by the altitude of the weight's corner.
static inline void interpolate_normal(UncertainSurface *surface, const Corners *normals,
                                      Real3 weights, const Corners *corners, Real u)
{
    const Real3 ab = difference(corners->b, corners->a), ac = difference(corners->c, corners->a);
    const Real area = length_of(cross_product(ab, ac));
    const Real of_b = length_of(ac) / area * length_of(difference(normals->b, normals->a));
    const Real of_c = length_of(ab) / area * length_of(difference(normals->c, normals->a));
    const Real longest =
        max(max(length_of(normals->a), length_of(normals->b)), length_of(normals->c));
    const Real doubt =
        1.01f * surface->end.slide * (of_b + of_c) + (6.1f * u + 12.0f * OWN_ROUNDOFF) * longest;
    const Real3 sum = weighted(weights, normals);
    surface->normal = unit_vector(sum);
    surface->normal_doubt = turn_of(doubt, length_of(sum)) + 5.0f * (u + OWN_ROUNDOFF);
}

static inline void face_viewer(UncertainSurface *surface)
{
    if (!surface->from_behind)
        return;
    surface->normal = negative3(surface->normal);
    surface->face = negative3(surface->face);
}

// Sets the surface's members `area`, `room` and `edge`. The exact point and the tracer's point may
// be closer to an edge than end.point, so end.slide reduces the room.
static inline void note_room(UncertainSurface *surface, const Corners *corners, Real3 weights)
{
    const Real3 ab = difference(corners->b, corners->a), ac = difference(corners->c, corners->a);
    const Real sides = length_of(ab) + length_of(ac);
    surface->area = largest_component(cross_product(ab, ac));
    surface->room = min(min(weights.x, weights.y), weights.z) * surface->area -
                    1.01f * surface->end.slide * sides;
    surface->edge = 2.0f * (largest_component(ab) + largest_component(ac));
}

static inline UncertainPoint uncertain_point(const RayCone *ray, const Corners *corners,
                                             const ProjectedTriangle *projected, Real3 weights)
{
    const Real3 ab = difference(corners->b, corners->a), ac = difference(corners->c, corners->a);
    const Real3 normal = cross_product(ab, ac);
    const Real edges = largest_component(ab) * largest_component(ac);
    const Corners sizes = {magnitudes(corners->a), magnitudes(corners->b), magnitudes(corners->c)};
    const Real size = length_of(weighted(weights, &sizes));
    const Real area = length_of(normal);
    UncertainPoint end;
    end.point = weighted(weights, corners);
    end.face = scaled3(1.0f / area, normal);
    end.slide = projected->broad
                    ? 1.25f * projected->blur * area / fabs(projected->edges.determinant)
                    : INFINITY;
    end.lift = (11.1f * ray->u + 32.0f * OWN_ROUNDOFF) * size +
               16.0f * OWN_ROUNDOFF * edges / area * end.slide;
    return end;
}

static inline UncertainSurface uncertain_triangle(const Tracer *tracer, const RayCone *ray,
                                                  const Hit *hit)
{
    const Corners corners = fetch_corners(tracer, hit->index);
    const Look look = fetch_look(tracer, hit);
    const ProjectedTriangle projected = project_triangle(ray, &corners);
    const Real3 ab = difference(corners.b, corners.a), ac = difference(corners.c, corners.a);
    const Real edges = largest_component(ab) * largest_component(ac);
    const Real u = ray->u + OWN_ROUNDOFF, r = 1.0f / projected.edges.determinant;
    const Real3 weights = {projected.edges.u * r, projected.edges.v * r, projected.edges.w * r};
    UncertainSurface surface = {.end = uncertain_point(ray, &corners, &projected, weights),
                                .id = hit->id,
                                .index = hit->index,
                                .material = look.material,
                                .from_behind = !(projected.edges.determinant > 0.0f),
                                .corners = corners};
    surface.normal = surface.face = surface.end.face;
    surface.face_doubt = turn_of(8.0f * u * edges, length_of(cross_product(ab, ac))) + 8.0f * u;
    surface.normal_doubt = surface.face_doubt;
    if (look.normals != NOTHING) {
        const Corners normals = fetch_normals(tracer, look.normals);
        interpolate_normal(&surface, &normals, weights, &corners, ray->u);
    }
    note_room(&surface, &corners, weights);
    face_viewer(&surface);
    return surface;
}

// Returns the surface of a sphere. The point is projected onto the sphere, as in the tracer. The
// wall of a certain hit is known: it is the near wall for an origin outside, and the far wall for
// an origin inside (certify_sphere.cl).
static inline UncertainSurface uncertain_sphere(const Tracer *tracer, const RayCone *ray,
                                                const Nearest *nearest)
{
    const PlainSphere sphere = plain_sphere(&tracer->spheres[nearest->index]);
    const Chord chord = chord_of(ray, &sphere);
    const Real depth = 0.5f * (nearest->low + nearest->high);
    const Real3 met = sum3(ray->origin, scaled3(depth, ray->along));
    UncertainSurface surface = {.id = nearest->id,
                                .index = NOTHING,
                                .material = fetch_sphere_material(tracer, nearest->index),
                                .is_sphere = true,
                                .from_behind = nearest->id == ray->own || chord.enter.high < 0.0f};
    surface.normal = surface.face = unit_vector(difference(met, sphere.center));
    surface.end.point = sum3(sphere.center, scaled3(sphere.radius, surface.normal));
    surface.end.face = surface.normal;
    surface.end.lift = 2.0f * (nearest->high - nearest->low) + 2.0f * chord.shift +
                       2.0f * ray->spread * fabs(depth) +
                       8.0f * (ray->u + OWN_ROUNDOFF) * sum_of_sizes(surface.end.point);
    surface.normal_doubt =
        turn_of(surface.end.lift, sphere.radius) + 8.0f * (ray->u + OWN_ROUNDOFF);
    return surface;
}

static inline UncertainSurface uncertain_surface(const Tracer *tracer, const RayCone *ray,
                                                 const Nearest *nearest)
{
    const Hit hit = {nearest->low, nearest->id, nearest->index};
    UncertainSurface surface = nearest->id < tracer->frame->sphere_count
                                   ? uncertain_sphere(tracer, ray, nearest)
                                   : uncertain_triangle(tracer, ray, &hit);
    surface.toward_viewer = negative3(ray->along);
    surface.viewer_doubt = ray->spread + 5.0f * (ray->u + OWN_ROUNDOFF); // B13
    return surface;
}

// Returns the start of a ray that leaves in a direction known within `doubt`. Near an edge, the
// ray's line may miss the triangle that the ray leaves. The point's distance from the edge is then
// at most the sum of two errors, divided by the sine of the ray's angle to the face. These errors
// are 11u per axis for the point, and for a corner 14u times the corner's distance from the ray's
// start. room / edge is a lower bound of the point's distance from the edges. If this bound exceeds
// 64u / sine, the tracer ignores the edges. Otherwise, the tracer may move the start by up to 256u
// / sine along the surface, on each axis (B14).
//
// The tracer lifts a reflected or refracted ray (surface.cl) only if the ray's line misses the
// triangle from the last start that the tracer tries. This start has moved by 256u / sine toward
// the triangle's middle, but not beyond the middle. The move is at least the fraction
// min(1, 500u / (sine * edge)) of the way to the middle. Each weight of this start is at least a
// third of the fraction.
static inline UncertainPoint start_of(const UncertainSurface *surface, Real3 direction, Real doubt,
                                      Real u, bool *may_be_lifted)
{
    UncertainPoint start = surface->end;
    const Real sine = fabs(dot_product(direction, surface->face)) - doubt - surface->face_doubt;
    const Real least = min((Real)(71.0f), 24.0f + 11.0f * surface->edge) * u * surface->edge;
    const Real last_room = 0.33f * surface->area * min(sine, 500.0f * u / surface->edge);
    *may_be_lifted = false;
    if (!surface->is_sphere && !(surface->room * sine > least)) {
        start.slide += sine > 0.0f ? 450.0f * u / sine : INFINITY;
        start.lift += 4.0f * u;
        *may_be_lifted = !(last_room > least);
    }
    return start;
}

static inline RayCone shadow_cone(const UncertainSurface *surface, Real3 light, Real u)
{
    const Real3 apart = difference(light, surface->end.point);
    const Real length = length_of(apart), rounding = (u + 8.0f * OWN_ROUNDOFF) * length;
    const Real turn = turn_of(radius_of(&surface->end) + rounding, length) + 8.0f * u;
    bool may_be_lifted; // ignored, because shadow rays are never lifted
    const UncertainPoint start =
        start_of(surface, unit_vector(apart), turn, u + OWN_ROUNDOFF, &may_be_lifted);
    RayCone ray = {.origin = start.point,
                   .around = radius_of(&start),
                   .spread = spread_of(turn_of(radius_of(&start) + rounding, length)),
                   .length = length,
                   .u = u,
                   .own = surface->id,
                   .own_index = surface->index,
                   .kind = RAY_SHADOW,
                   .start = start,
                   .goal = {light, surface->face, 0.0f, 1.01f * rounding}};
    set_axis(&ray, unit_vector(apart));
    return ray;
}

static inline Answer certify_normal_facing(const UncertainSurface *surface, const RayCone *to_light)
{
    const Real cosine = dot_product(surface->normal, to_light->along);
    const Real doubt =
        surface->normal_doubt + to_light->spread + 8.0f * (to_light->u + OWN_ROUNDOFF);
    if (!(fabs(cosine) > doubt))
        return ANSWER_UNKNOWN;
    return cosine > 0.0f ? ANSWER_YES : ANSWER_NO;
}

// Returns whether the triangle's face faces the light. Corners and lights are exact, so only the
// rounding of this test can make the result unknown.
static inline Answer certify_face_facing(const UncertainSurface *surface, const RayCone *to_light)
{
    const UncertainPoint light = {to_light->goal.point, surface->face, 0.0f, 0.0f};
    const int side = side_of(&surface->corners, &light, to_light->u);
    if (side == 0)
        return ANSWER_UNKNOWN;
    return (side < 0) == surface->from_behind ? ANSWER_YES : ANSWER_NO;
}

// Returns whether the shading normal and the face both face the light. Seen from outside, a
// sphere's face normal is its shading normal. From inside, the two are opposite, so only rounding
// could make both face a light. The result is then never YES.
static inline Answer certify_facing(const UncertainSurface *surface, const RayCone *to_light)
{
    const Answer normal = certify_normal_facing(surface, to_light);
    if (!surface->is_sphere)
        return min(normal, certify_face_facing(surface, to_light));
    return surface->from_behind && normal == ANSWER_YES ? ANSWER_NO : normal;
}

// Returns the cone of a ray that leaves the surface in a direction known within `doubt`. As in
// ray_leaving, a ray that would enter the face is mirrored at the face. The mirrored and the
// unmirrored direction are equal if the ray lies in the face's plane. Near this plane, the tracer
// may use either direction, so the difference of both is added to the doubt. A sphere's face is
// parallel to its normal, so its rays are never mirrored.
static inline RayCone leaving_cone(const UncertainSurface *surface, Real3 direction, Real doubt,
                                   Real tracer_u)
{
    const Real u = tracer_u + OWN_ROUNDOFF;
    const Real height = dot_product(direction, surface->face);
    const Real height_doubt = doubt + surface->face_doubt + 4.0f * u;
    if (!surface->is_sphere && height < -height_doubt) {
        direction = difference(direction, scaled3(2.0f * height, surface->face));
        doubt = 1.01f * doubt + 4.2f * surface->face_doubt + 12.0f * u;
    } else if (!surface->is_sphere && height <= height_doubt) {
        doubt += 4.0f * height_doubt + 12.0f * u;
    }
    bool may_be_lifted;
    const UncertainPoint start = start_of(surface, direction, doubt, u, &may_be_lifted);
    RayCone ray = {.origin = start.point,
                   .around = radius_of(&start),
                   .spread = may_be_lifted ? INFINITY : spread_of(1.01f * doubt),
                   .length = INFINITY,
                   .u = tracer_u,
                   .own = surface->id,
                   .own_index = surface->index,
                   .kind = RAY_REFLECTED,
                   .start = start};
    set_axis(&ray, unit_vector(direction));
    return ray;
}

static inline RayCone reflected_cone(const UncertainSurface *surface, const RayCone *before)
{
    const Real cosine = dot_product(surface->normal, surface->toward_viewer);
    const Real3 turn = scaled3(2.0f * cosine, surface->normal);
    const Real doubt = 2.1f * surface->normal_doubt + 1.01f * surface->viewer_doubt +
                       12.0f * (before->u + OWN_ROUNDOFF);
    return leaving_cone(surface, difference(turn, surface->toward_viewer), doubt, before->u);
}

#endif
