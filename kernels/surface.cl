// SPDX-License-Identifier: MIT
// A hit becomes a surface: the point and its normals.  Points are interpolated on the primitive
// rather than stepped along the ray, so that their error does not grow with the distance traveled
// (pbrt, section 6.8).  New rays start and end right there: which triangles they may stop on is
// decided by the side the point lies on (triangle.cl), so no offset moves contacts and shadows.
#ifndef CLRT_SURFACE_CL
#define CLRT_SURFACE_CL
#include "fetch.cl"
#include "traverse.cl"

typedef struct {
    Real3 point;
    Real3 normal;        // unit, interpolated, what is shaded with
    Real3 face;          // unit, of the true surface, on the side the ray came from
    Real3 toward_viewer; // unit
    Count id, material;
} Surface;

static inline Truth has_length(Real3 v)
{
    return largest_component(v) > 0.0f;
}

// A collinear triangle, which only rounding lets a ray meet, has no normal: it faces the viewer.
static inline Real3 triangle_face(const Corners *corners, Real3 toward_viewer)
{
    const Real3 ab = difference(corners->b, corners->a), ac = difference(corners->c, corners->a);
    const Real3 normal = unit_vector(cross_product(ab, ac));
    return choose3(has_length(normal), normal, toward_viewer);
}

static inline Real3 weighted(Real3 weights, const Corners *corners)
{
    const Real3 a = corners->a, b = corners->b, c = corners->c;
    return real3_of(weights.x * a.x + weights.y * b.x + weights.z * c.x,
                    weights.x * a.y + weights.y * b.y + weights.z * c.y,
                    weights.x * a.z + weights.y * b.z + weights.z * c.z);
}

static inline Real3 triangle_normal(const SceneView *scene, Count normals, Real3 weights,
                                    Real3 face)
{
    const Truth is_smooth = normals != NOTHING;
    if (!any_lane(is_smooth))
        return face;
    const Corners corners = fetch_normals(scene, is_smooth ? normals : (Count)(0));
    const Real3 normal = unit_vector(weighted(weights, &corners));
    return choose3(is_smooth && has_length(normal), normal, face);
}

static inline Real3 corner_seen(Real3 corner, Real3 origin, const ShearAxes *axes)
{
    return axes_ordered(difference(corner, origin), axes);
}

static inline Surface triangle_surface(const SceneView *scene, const FrameData *frame,
                                       const Ray *ray, const Hit *hit)
{
    const Corners corners = fetch_corners(scene, hit->index);
    const Look look = fetch_look(scene, hit, frame->sphere_count);
    const ShearAxes axes = shear_axes(ray->direction);
    const Shear shear = shear_along(ray->direction, &axes);
    const Corners relative = {corner_seen(corners.a, ray->origin, &axes),
                              corner_seen(corners.b, ray->origin, &axes),
                              corner_seen(corners.c, ray->origin, &axes)};
    const Corners sheared = corners_sheared(&relative, &shear);
    const Edges edges = edges_of(&sheared);
    const Real r = 1.0f / edges.determinant;
    const Real3 weights = {edges.u * r, edges.v * r, edges.w * r};
    const Truth front = edges_face(&edges, &shear);

    Surface surface;
    surface.toward_viewer = negative3(unit_vector(ray->direction));
    surface.point = weighted(weights, &corners);
    const Real3 face = triangle_face(&corners, surface.toward_viewer);
    const Real3 normal = triangle_normal(scene, look.normals, weights, face);
    surface.face = choose3(front, face, negative3(face));
    surface.normal = choose3(front, normal, negative3(normal));
    surface.id = hit->id;
    surface.material = look.material;
    return surface;
}

// A sphere's normal points outward even where it is seen from inside, as in the course.
static inline Surface sphere_surface(const SceneView *scene, const Ray *ray, const Hit *hit)
{
    const Sphere sphere = fetch_sphere(scene, hit->index);
    Surface surface;
    surface.toward_viewer = negative3(unit_vector(ray->direction));
    surface.point = sphere_point(&sphere, ray->origin, ray->direction, hit->t, &surface.normal);
    const Truth outside = dot_product(surface.normal, surface.toward_viewer) >= 0.0f;
    surface.face = choose3(outside, surface.normal, negative3(surface.normal));
    surface.id = hit->id;
    surface.material = fetch_sphere_material(scene, hit->index);
    return surface;
}

static inline Surface choose_surface(Truth first, const Surface *a, const Surface *b)
{
    return (Surface){choose3(first, a->point, b->point),
                     choose3(first, a->normal, b->normal),
                     choose3(first, a->face, b->face),
                     a->toward_viewer,
                     first ? a->id : b->id,
                     first ? a->material : b->material};
}

// The lanes of hit that have none of `met` take the place of one that has: what they compute is
// thrown away, but must be read from somewhere.
static inline Hit hit_everywhere(const Hit *hit, Truth met)
{
    Hit filled = *hit;
    filled.id = met ? hit->id : first_lane(hit->id, met);
    filled.index = met ? hit->index : first_lane(hit->index, met);
    return filled;
}

// Where the ray meets something; other lanes hold anything.
static inline Surface surface_at(const SceneView *scene, const FrameData *frame, const Ray *ray,
                                 const Hit *hit, Truth met)
{
    if (!CLRT_TRIANGLES) {
        const Hit hits = hit_everywhere(hit, met);
        return sphere_surface(scene, ray, &hits);
    }
    const Truth on_sphere = met && hit->id < frame->sphere_count;
    const Truth on_triangle = met && hit->id >= frame->sphere_count;
    Surface triangle;
    if (!CLRT_SPHERES || any_lane(on_triangle)) {
        const Hit hits = hit_everywhere(hit, on_triangle);
        triangle = triangle_surface(scene, frame, ray, &hits);
    }
    if (!CLRT_SPHERES || !any_lane(on_sphere))
        return triangle;
    const Hit hits = hit_everywhere(hit, on_sphere);
    const Surface sphere = sphere_surface(scene, ray, &hits);
    return any_lane(on_triangle) ? choose_surface(on_sphere, &sphere, &triangle) : sphere;
}

// An interpolated normal can send the reflected ray into the surface it leaves; such a ray is
// turned out again in the mirror of the true surface, which is continuous at its horizon.
static inline Ray ray_reflected(const Surface *surface, Truth active)
{
    const Real cosine = dot_product(surface->normal, surface->toward_viewer);
    const Real3 direction =
        difference(scaled3(2.0f * cosine, surface->normal), surface->toward_viewer);
    const Real height = dot_product(direction, surface->face);
    const Real3 outward = difference(direction, scaled3(2.0f * height, surface->face));
    return (Ray){surface->point, choose3(height < 0.0f, outward, direction),
                 surface->id,    RAY_REFLECTED,
                 surface->point, active};
}

#endif
