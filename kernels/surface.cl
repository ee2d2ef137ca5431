// SPDX-License-Identifier: MIT
// A hit becomes a surface: the point and its normals.  Points are interpolated on the primitive
// rather than stepped along the ray, so that their error does not grow with the distance traveled
// (pbrt, section 6.8).  New rays start and end right there: which triangles they may stop on is
// decided by the side the point lies on (triangle.cl), so no offset moves contacts and shadows.
#ifndef CLRT_SURFACE_CL
#define CLRT_SURFACE_CL
#include "traverse.cl"

typedef struct {
    float3 point;
    float3 normal;        // unit, interpolated, what is shaded with
    float3 face;          // unit, of the true surface, on the side the ray came from
    float3 toward_viewer; // unit
    uint id, material;
} Surface;

// A collinear triangle, which only rounding lets a ray meet, has no normal: it faces the viewer.
static inline float3 triangle_face(float3 a, float3 b, float3 c, float3 toward_viewer)
{
    const float3 normal = unit_vector(cross_product(b - a, c - a));
    return largest_component(normal) > 0.0f ? normal : toward_viewer;
}

static inline float3 triangle_normal(const SceneView *scene, uint corners, float3 weights,
                                     float3 face)
{
    if (corners == NOTHING)
        return face;
    global const CornerNormals *data = &scene->normals[corners];
    const float3 normal =
        unit_vector(weights.x * load3(data->normals[0]) + weights.y * load3(data->normals[1]) +
                    weights.z * load3(data->normals[2]));
    return largest_component(normal) > 0.0f ? normal : face;
}

static inline Surface triangle_surface(const SceneView *scene, const Ray *ray, uint index)
{
    global const TriangleData *triangle = &scene->triangles[index];
    const Shear shear = shear_along(ray);
    const ShearedTriangle sheared = triangle_sheared(triangle, &shear);
    const Edges edges = triangle_edges(&sheared);
    const float r = 1.0f / edges.determinant;
    const float3 weights = (float3)(edges.u * r, edges.v * r, edges.w * r);
    const float3 a = load3(triangle->a), b = load3(triangle->b), c = load3(triangle->c);

    Surface surface;
    surface.toward_viewer = -unit_vector(ray->direction);
    surface.point = weights.x * a + weights.y * b + weights.z * c;
    surface.face = triangle_face(a, b, c, surface.toward_viewer);
    surface.normal = triangle_normal(scene, triangle->normals, weights, surface.face);
    if (!triangle_faces(&shear, &edges)) {
        surface.face = -surface.face;
        surface.normal = -surface.normal;
    }
    surface.id = triangle->id;
    surface.material = triangle->material & ~TRIANGLE_TWO_SIDED;
    return surface;
}

// A sphere's normal points outward even where it is seen from inside, as in the course.
static inline Surface sphere_surface(const SceneView *scene, const Ray *ray, Hit hit)
{
    global const SphereData *sphere = &scene->spheres[hit.index];
    Surface surface;
    surface.toward_viewer = -unit_vector(ray->direction);
    surface.point = sphere_point(sphere, ray->origin, ray->direction, hit.t, &surface.normal);
    const bool outside = dot_product(surface.normal, surface.toward_viewer) >= 0.0f;
    surface.face = outside ? surface.normal : -surface.normal;
    surface.id = hit.id;
    surface.material = sphere->material;
    return surface;
}

static inline Surface surface_at(const SceneView *scene, const FrameData *frame, const Ray *ray,
                                 Hit hit)
{
    if (!CLRT_TRIANGLES)
        return sphere_surface(scene, ray, hit);
    if (CLRT_SPHERES && hit.id < frame->sphere_count)
        return sphere_surface(scene, ray, hit);
    return triangle_surface(scene, ray, hit.index);
}

// An interpolated normal can send the reflected ray into the surface it leaves; such a ray is
// turned out again in the mirror of the true surface, which is continuous at its horizon.
static inline Ray ray_reflected(const Surface *surface)
{
    const float cosine = dot_product(surface->normal, surface->toward_viewer);
    float3 direction = 2.0f * cosine * surface->normal - surface->toward_viewer;
    const float height = dot_product(direction, surface->face);
    if (height < 0.0f)
        direction -= 2.0f * height * surface->face;
    return (Ray){surface->point, direction, surface->id, RAY_REFLECTED, surface->point};
}

#endif
