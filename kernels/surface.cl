// SPDX-License-Identifier: MIT
// Computes the surface at a hit (a point with normals) and the rays that leave it. The point is
// interpolated on the triangle or projected onto the sphere, so its error does not grow with the
// distance traveled (Pharr, Jakob and Humphreys, "Physically based rendering", 4th edition,
// section 6.8).
//
// New rays start at the point. The side of a triangle's plane on which the point lies decides
// whether a new ray may stop on the triangle (triangle.inc.cl). No offset is necessary, so contacts
// and shadows stay in place. The start moves only if the new ray's line passes through a corner of
// its own triangle or, because of rounding, misses the triangle.
//
// The shading normal and the face's normal can point to opposite sides of the surface. Two rules
// then decide which light reaches the surface and which rays leave it. The face's normal always
// points to the side from which the ray comes.
//  - A light reaches a point only if both the shading normal and the face point toward the light
//    (shade.cl). The course's renderers (docs/scenes.md) have the same effect: they start shadow
//    rays slightly off the surface, so that the face blocks lights behind it. A sphere seen from
//    inside keeps its outward normal, as in the course. Its face points inward, so no light is in
//    front of both face and normal, and the inside stays unlit.
//  - If the shading normal sends a reflected ray into the face, the ray is mirrored at the face.
#ifndef CLRT_SURFACE_CL
#define CLRT_SURFACE_CL
#include "intersect.cl"

typedef struct {
    Real3 point;
    Real3 normal;        // the shading normal, of length 1
    Real3 face;          // the normal of the plane or sphere, of length 1, on the ray's side
    Real3 a, b, c;       // the triangle's exact corners; for a sphere, all are `point`
    Real3 toward_viewer; // unit
    UInt id, material;
    UInt index;      // of a triangle; NOTHING for spheres
    Real room, edge; // the point is at least room / (2 * edge) away from the edges
    Mask colored;    // lanes whose diffuse color is `color`; unspecified without CLRT_COLORS
    Real3 color;     // unspecified unless any lane is colored
} Surface;

static inline Mask has_length(Real3 v)
{
    return largest_component(v) > 0.0f;
}

// Returns the normal of the triangle's plane. If the corners are on a line, there is no plane, and
// a ray hits the triangle only by rounding. The result is then toward_viewer.
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

static inline Real3 triangle_normal(const Tracer *tracer, UInt normals, Real3 weights, Real3 face)
{
    const Mask is_smooth = normals != NOTHING;
    if (!any_lane(is_smooth))
        return face;
    const Corners corners = fetch_normals(tracer, is_smooth ? normals : (UInt)(0));
    const Real3 normal = unit_vector(weighted(weights, &corners));
    return choose3(is_smooth && has_length(normal), normal, face);
}

// Interpolates the surface's color from the vertex colors. Rounding can make a weight slightly
// negative, so the color is clamped.
static inline void note_color(const Tracer *tracer, Surface *surface, UInt colors, Real3 weights)
{
    surface->colored = colors != NOTHING;
    if (!any_lane(surface->colored))
        return;
    const Corners corners = fetch_colors(tracer, surface->colored ? colors : (UInt)(0));
    const Real3 color = weighted(weights, &corners);
    surface->color = real3_of(clamp_to_one(color.x), clamp_to_one(color.y), clamp_to_one(color.z));
}

static inline Real3 corner_seen(Real3 corner, Real3 origin, const ShearAxes *axes)
{
    return axes_ordered(difference(corner, origin), axes);
}

// A triangle as a ray sees it.
typedef struct {
    Shear shear;
    Edges edges;
} View;

static inline View view_along(const Corners *corners, Real3 origin, Real3 direction,
                              const ShearAxes *axes)
{
    View view;
    view.shear = shear_along(direction, axes);
    const Corners relative = {corner_seen(corners->a, origin, axes),
                              corner_seen(corners->b, origin, axes),
                              corner_seen(corners->c, origin, axes)};
    const Corners sheared = corners_sheared(&relative, &view.shear);
    view.edges = edges_of(&sheared);
    return view;
}

// Returns view_along for rays whose ShearAxes::z all equal `z`. If `z` is a constant, the compiler
// removes the selection of components.
static inline View view_along_one(const Corners *corners, Real3 origin, Real3 direction, uint z)
{
    const ShearAxes axes = {(UInt)((z + 1) % 3), (UInt)((z + 2) % 3), (UInt)(z)};
    return view_along(corners, origin, direction, &axes);
}

static inline View view_of(const Corners *corners, Real3 origin, Real3 direction)
{
    const ShearAxes axes = shear_axes(direction);
    if (CLRT_LANES > 1 && !any_lane(axes.z != (UInt)(0)))
        return view_along_one(corners, origin, direction, 0);
    if (CLRT_LANES > 1 && !any_lane(axes.z != (UInt)(1)))
        return view_along_one(corners, origin, direction, 1);
    if (CLRT_LANES > 1 && !any_lane(axes.z != (UInt)(2)))
        return view_along_one(corners, origin, direction, 2);
    return view_along(corners, origin, direction, &axes);
}

// Records a bound on the point's distance from the edges (see Surface). The distance from an edge
// is the opposite corner's weight times the altitude over the edge. This altitude is twice the
// area, divided by the edge's length.
static inline void note_edges(Surface *surface, const Corners *corners, Real3 weights)
{
    const Real3 ab = difference(corners->b, corners->a), ac = difference(corners->c, corners->a);
    const Real area = largest_component(cross_product(ab, ac));
    surface->room = min(min(weights.x, weights.y), weights.z) * area;
    surface->edge = largest_component(ab) + largest_component(ac);
}

static inline Surface triangle_surface(const Tracer *tracer, const Ray *ray, const Hit *hit)
{
    const Corners corners = fetch_corners(tracer, hit->index);
    const Look look = fetch_look(tracer, hit);
    const View view = view_of(&corners, ray->origin, ray->direction);
    const Real r = 1.0f / view.edges.determinant;
    const Real3 weights = {view.edges.u * r, view.edges.v * r, view.edges.w * r};
    const Mask front = edges_face(&view.edges, &view.shear);

    Surface surface;
    surface.toward_viewer = negative3(unit_vector(ray->direction));
    surface.point = weighted(weights, &corners);
    const Real3 face = triangle_face(&corners, surface.toward_viewer);
    const Real3 normal = triangle_normal(tracer, look.normals, weights, face);
    surface.face = choose3(front, face, negative3(face));
    surface.a = corners.a;
    surface.b = corners.b;
    surface.c = corners.c;
    surface.normal = choose3(front, normal, negative3(normal));
    surface.id = hit->id;
    surface.index = hit->index;
    note_edges(&surface, &corners, weights);
    surface.material = look.material;
    if (CLRT_COLORS)
        note_color(tracer, &surface, look.colors, weights);
    return surface;
}

// Returns whether a ray that hits the sphere comes from outside. sphere_distance uses the same
// sphere_power to choose between the near and the far wall. The result is therefore right even for
// a grazing ray, although rounding may turn the normal away from this ray.
static inline Mask comes_from_outside(const Sphere *sphere, const Ray *ray, const Hit *hit)
{
    const Mask enters = ray->own != hit->id;
    const Mask side = plain_side(sphere, ray->origin);
    if (!any_lane(enters && side == 0))
        return enters && side > 0;
    const TwoFloat3 f = sphere_to_origin(sphere, ray->origin);
    return enters && sphere_power(f, sphere->radius) > 0.0f;
}

static inline Surface sphere_surface(const Tracer *tracer, const Ray *ray, const Hit *hit)
{
    const Sphere sphere = fetch_sphere(tracer, hit->index);
    Surface surface;
    surface.toward_viewer = negative3(unit_vector(ray->direction));
    surface.point = sphere_point(&sphere, ray->origin, ray->direction, hit->t, &surface.normal);
    const Mask outside = comes_from_outside(&sphere, ray, hit);
    surface.face = choose3(outside, surface.normal, negative3(surface.normal));
    surface.a = surface.point;
    surface.b = surface.point;
    surface.c = surface.point;
    surface.id = hit->id;
    surface.index = NOTHING;
    surface.room = 0.0f;
    surface.edge = 0.0f;
    surface.material = fetch_sphere_material(tracer, hit->index);
    if (CLRT_COLORS)
        surface.colored = 0;
    return surface;
}

static inline Surface choose_surface(Mask first, const Surface *a, const Surface *b)
{
    return (Surface){choose3(first, a->point, b->point),
                     choose3(first, a->normal, b->normal),
                     choose3(first, a->face, b->face),
                     choose3(first, a->a, b->a),
                     choose3(first, a->b, b->b),
                     choose3(first, a->c, b->c),
                     a->toward_viewer,
                     first ? a->id : b->id,
                     first ? a->material : b->material,
                     first ? a->index : b->index,
                     first ? a->room : b->room,
                     first ? a->edge : b->edge,
                     first ? a->colored : b->colored,
                     b->color};
}

// Fills the lanes outside `met` with the hit of a lane in `met`. Results in the filled lanes are
// discarded, but these lanes must read valid memory.
static inline Hit hit_everywhere(const Hit *hit, Mask met)
{
    Hit filled = *hit;
    if (lane_bits(met) == ALL_LANES)
        return filled;
    filled.id = met ? hit->id : first_lane(hit->id, met);
    filled.index = met ? hit->index : first_lane(hit->index, met);
    return filled;
}

// Returns the surfaces of the lanes in `met`, which have a hit. The values of other lanes are
// unspecified.
static inline Surface surface_at(const Tracer *tracer, const Ray *ray, const Hit *hit, Mask met)
{
    if (!CLRT_TRIANGLES) {
        const Hit hits = hit_everywhere(hit, met);
        return sphere_surface(tracer, ray, &hits);
    }
    const Mask on_sphere = met && hit->id < tracer->frame->sphere_count;
    const Mask on_triangle = met && hit->id >= tracer->frame->sphere_count;
    if (CLRT_LANES == 1) { // on GPUs, this takes 14 fewer registers than making both surfaces
        if (CLRT_SPHERES && any_lane(on_sphere))
            return sphere_surface(tracer, ray, hit);
        return triangle_surface(tracer, ray, hit);
    }
    Surface triangle;
    if (!CLRT_SPHERES || any_lane(on_triangle)) {
        const Hit hits = hit_everywhere(hit, on_triangle);
        triangle = triangle_surface(tracer, ray, &hits);
    }
    if (!CLRT_SPHERES || !any_lane(on_sphere))
        return triangle;
    const Hit hits = hit_everywhere(hit, on_sphere);
    const Surface sphere = sphere_surface(tracer, ray, &hits);
    return any_lane(on_triangle) ? choose_surface(on_sphere, &sphere, &triangle) : sphere;
}

// The target of a ray that leaves a surface: a direction or a place.
typedef struct {
    Real3 to;
    bool is_place;
} Heading;

static inline Real3 direction_from(Real3 point, const Heading *heading)
{
    return heading->is_place ? difference(heading->to, point) : heading->to;
}

// The triangle on which a ray starts, and the side to which the ray leaves.
typedef struct {
    Corners corners;
    Mask to_front;
} Leaving;

static inline Leaving leaving_from(const Tracer *tracer, const Surface *surface, Mask known)
{
    Leaving leaving;
    Corners corners = {surface->a, surface->b, surface->c};
    if (CLRT_GPU) // keeping b and c between the surface's rays would take 18 more registers
        corners = fetch_corners(tracer, known ? surface->index : (UInt)(0));
    const Real3 ab = difference(corners.b, corners.a), ac = difference(corners.c, corners.a);
    leaving.corners = corners;
    leaving.to_front = dot_product(cross_product(ab, ac), surface->face) > 0.0f;
    return leaving;
}

// Returns whether the ray's line crosses the triangle in the right direction: to the front if
// to_front is set, otherwise to the back. A line through a corner may touch the surface there
// without crossing it, so the result is then false.
static inline Mask passes(const Leaving *leaving, Real3 point, Real3 direction)
{
    const View view = view_of(&leaving->corners, point, direction);
    const Mask from_front = edges_face(&view.edges, &view.shear);
    const Mask crosses = edges_contain(&view.edges) && !edges_meet_at_ray(&view.edges);
    return crosses && (leaving->to_front ? !from_front : from_front);
}

// If a ray is almost parallel to the plane of the triangle that it leaves, its line can miss this
// triangle from every start of point_inside. Such a ray is lifted by 2^-8, 2^-4 or 1 times the
// face's normal, until its line passes through the triangle.
static inline Real3 lifted_direction(const Leaving *leaving, Real3 point, Real3 direction,
                                     Real3 face, Mask misses)
{
    Real3 lifted = direction;
    for (float lift = 0x1p-8f; lift <= 1.0f && any_lane(misses); lift *= 16.0f) {
        lifted = choose3(misses, sum3(direction, scaled3(lift, face)), lifted);
        misses = misses && !passes(leaving, point, lifted);
    }
    return lifted;
}

// Returns the start of a ray near an edge. There, the surface point may be a corner, or rounding
// may have put it outside its triangle and beyond the neighbor that should stop the ray. While the
// ray's line does not pass through the triangle, the start moves toward the triangle's middle. Its
// distance from the surface point is then UNIT_ROUNDOFF / `sine` times 1, 2, 4 and so on to 256, on
// the axis on which this distance is largest. The start never moves beyond the middle. If a
// reflected or refracted ray still misses the triangle, the ray is lifted.
static NOT_INLINE Real3 point_inside(const Tracer *tracer, const Surface *surface, Heading *heading,
                                     Real sine, Mask near_edge)
{
    const Leaving leaving = leaving_from(tracer, surface, near_edge);
    const Real third = RATIO(1.0f, 3.0f);
    const Real3 middle = weighted(real3_of(third, third, third), &leaving.corners);
    const Real3 inward = difference(middle, surface->point);
    const Real unit = UNIT_ROUNDOFF / (sine * largest_component(inward));
    Real3 point = read3(&surface->point);
    Mask misses = near_edge;
    for (uint step = 1; step <= 256 && any_lane(misses); step *= 2) {
        misses = misses && !passes(&leaving, point, direction_from(point, heading));
        const Real part = min(step * unit, (Real)(1.0f));
        point = choose3(misses, sum3(surface->point, scaled3(part, inward)), point);
    }
    if (!heading->is_place && any_lane(misses)) {
        misses = misses && !passes(&leaving, point, heading->to);
        heading->to = lifted_direction(&leaving, point, heading->to, surface->face, misses);
    }
    return point;
}

// Returns the start of a ray that leaves the surface, and may lift the ray's direction. The ray's
// line should pass through the surface's triangle. Rounding can prevent this only near edges. The
// point is off its plane by a few units of rounding. This error, divided by the sine of the line's
// angle to the plane, is the error of the line along the plane (docs/numerics.md, B14).
static inline Real3 point_left(const Tracer *tracer, const Surface *surface, Heading *heading,
                               Real sine, Mask active)
{
    const Real least = 8.0f * POINT_BLUR * UNIT_ROUNDOFF * surface->edge;
    const Mask near_edge = active && surface->index != NOTHING && !(surface->room * sine > least);
    if (!CLRT_TRIANGLES || !any_lane(near_edge))
        return read3(&surface->point);
    return point_inside(tracer, surface, heading, sine, near_edge);
}

// Returns the ray that leaves the surface in a direction. An interpolated normal can send a ray
// into the surface that the ray leaves. Such a ray is mirrored at the face and leads outward again.
// Its direction still changes continuously with the normal.
static inline Ray ray_leaving(const Tracer *tracer, const Surface *surface, Real3 direction,
                              Mask active)
{
    const Real height = dot_product(direction, surface->face);
    const Real3 outward = difference(direction, scaled3(2.0f * height, surface->face));
    const Real3 turned = choose3(height < 0.0f, outward, direction);
    Heading heading = {turned, false};
    const Real sine = fabs(dot_product(surface->face, turned));
    const Real3 point = point_left(tracer, surface, &heading, sine, active);
    return (Ray){read3(&point),  read3(&heading.to), surface->id,
                 surface->index, RAY_REFLECTED,      active};
}

static inline Ray ray_reflected(const Tracer *tracer, const Surface *surface, Mask active)
{
    const Real cosine = dot_product(surface->normal, surface->toward_viewer);
    const Real3 turn = scaled3(2.0f * cosine, surface->normal);
    return ray_leaving(tracer, surface, difference(turn, surface->toward_viewer), active);
}

#endif
