// SPDX-License-Identifier: MIT
// Computes camera rays, starts, checks, refractions and tests of bounding spheres in the same way
// as the kernels, for test_surface_bounds.

// Stores the surface of triangle `item` where the ray's line meets its plane. Returns whether the
// line passes inside the triangle's edges.
static inline bool hit_surface(const Tracer *tracer, Real3 origin, Real3 direction, uint item,
                               Surface *surface)
{
    const Ray ray = {origin, direction, NOTHING, NOTHING, RAY_CAMERA, 1};
    const Hit hit = {1.0f, item, item};
    *surface = triangle_surface(tracer, &ray, &hit);
    const Corners corners = {surface->a, surface->b, surface->c};
    const View view = view_of(&corners, origin, direction);
    return edges_contain(&view.edges);
}

static inline void store3(global Scalar *values, Real3 v)
{
    values[0] = v.x;
    values[1] = v.y;
    values[2] = v.z;
}

// A case has nine floats: {origin, direction, rate, shift, axis}. There is one triangle per case.
// Stores whether the ray hits, the coordinate on the axis and its place, the place moved in both
// directions, and for both directions whether the cube is odd.
kernel void probe_checks(global const float *cases, global const TriangleData *triangles,
                         global Scalar *results)
{
    const uint item = get_global_id(0);
    global const float *given = cases + 9 * item;
    global Scalar *values = results + 7 * item;
    const uint axis = (uint)given[8];
    const Cubes cubes = {given[6], real3_of(given[7], given[7], given[7])};
    Tracer tracer;
    Surface surface;
    tracer.triangles = (global const Triangles *)triangles;
    values[0] = hit_surface(&tracer, load3(given), load3(given + 3), item, &surface) ? 1.0f : 0.0f;
    const Real p = level_coordinate(component(surface.a, axis), component(surface.b, axis),
                                    component(surface.c, axis), component(surface.point, axis));
    const Real place = cube_place(&cubes, cubes.shift.x, p), move = place_move(&cubes);
    values[1] = p;
    values[2] = place;
    values[3] = place - move;
    values[4] = place + move;
    values[5] = axis_is_odd(&cubes, cubes.shift.x, p, 1.0f) ? 1.0f : 0.0f;
    values[6] = axis_is_odd(&cubes, cubes.shift.x, p, -1.0f) ? 1.0f : 0.0f;
}

// A case has nine floats: {previous origin, previous direction, new direction}. Stores, in this
// order: whether the previous ray hits its triangle, the surface point, the new ray's start, the
// new ray's direction, the sine of the direction's angle to the face, and the triangle's normal.
kernel void probe_starts(global const float *cases, global const TriangleData *triangles,
                         global Scalar *results)
{
    const uint item = get_global_id(0);
    global const float *given = cases + 9 * item;
    global Scalar *values = results + 14 * item;
    Tracer tracer;
    Surface surface;
    tracer.triangles = (global const Triangles *)triangles;
    values[0] = hit_surface(&tracer, load3(given), load3(given + 3), item, &surface) ? 1.0f : 0.0f;
    const Real3 unit = unit_vector(load3(given + 6));
    const Real height = dot_product(unit, surface.face);
    Heading heading = {height < 0.0f ? negative3(unit) : unit, false};
    store3(values + 7, heading.to);
    values[10] = fabs(height);
    store3(values + 1, surface.point);
    store3(values + 4, point_left(&tracer, &surface, &heading, fabs(height), 1));
    store3(values + 11,
           cross_product(difference(surface.b, surface.a), difference(surface.c, surface.a)));
}

// A case has 16 floats: {normal, vector toward the viewer, the same two vectors turned, index of
// refraction, 1 if the ray is inside the glass, bounds on how far the two unit vectors turn (only
// for probe_certain_refractions)}. The turned vectors are refracted and reflected. Stores their
// unit vectors, their cosine, the refracted ray's cosine and direction, and the reflected ray's
// direction.
kernel void probe_refractions(global const float *cases, global const Material *materials,
                              global Scalar *results)
{
    const uint item = get_global_id(0);
    global const float *given = cases + 16 * item;
    global Scalar *values = results + 14 * item;
    Tracer tracer;
    tracer.materials = materials;
    Surface surface;
    surface.index = NOTHING;
    surface.material = item;
    surface.toward_viewer = unit_vector(load3(given + 9));
    surface.face = unit_vector(load3(given + 6));
    surface.normal = given[13] > 0.0f ? negative3(surface.face) : surface.face;
    const Refraction at = refraction_of(&tracer, &surface, 1);
    store3(values, surface.face);
    store3(values + 3, surface.toward_viewer);
    values[6] = dot_product(surface.face, surface.toward_viewer);
    values[7] = at.beyond;
    store3(values + 8, refracted_direction(&at, surface.face, surface.toward_viewer));
    surface.normal = surface.face;
    const Ray reflected = ray_reflected(&tracer, &surface, 1);
    store3(values + 11, reflected.direction);
}

// Stores for each start the height over a triangle, the part of the threshold for a surface point's
// error (B7), and the height that height_over returns.
kernel void probe_heights(global const float *cases, global const TriangleData *triangles,
                          global Scalar *results)
{
    const uint item = get_global_id(0);
    global Scalar *values = results + 3 * item;
    const Real3 point = load3(cases + 9 * item);
    const Corners corners = {load3(triangles[item].a), load3(triangles[item].b),
                             load3(triangles[item].c)};
    const Real3 ab = difference(corners.b, corners.a), ac = difference(corners.c, corners.a);
    const Real3 normal = cross_product(ab, ac);
    values[0] = dot_product(normal, difference(point, corners.a));
    values[1] = UNIT_ROUNDOFF * POINT_BLUR * dot_product(magnitudes(normal), magnitudes(point));
    values[2] = height_over(&corners, point, POINT_BLUR);
}

// A case has seven floats, {origin, direction, t}, padded to nine, and two spheres: a bounding
// sphere and a sphere inside it. Stores whether the ray's line passes the bounding sphere, whether
// the ray starts outside of it and leads away, and whether the ray may meet it before t. Also
// stores the distance of the sphere inside, and its bound.
kernel void probe_sphere_trees(global const float *cases, global const SphereData *spheres,
                               global Scalar *results)
{
    const uint item = get_global_id(0);
    global Scalar *values = results + 5 * item;
    const Real3 o = load3(cases + 9 * item), d = load3(cases + 9 * item + 3);
    const Sphere bound = sphere_at(&spheres[2 * item]), inside = sphere_at(&spheres[2 * item + 1]);
    const Mask away = leads_away(&bound, o, d) && plain_side(&bound, o) > 0;
    values[0] = sphere_is_passed(&bound, o, d) ? 1.0f : 0.0f;
    values[1] = away ? 1.0f : 0.0f;
    values[2] = may_meet_before(&bound, o, d, cases[9 * item + 6], 1) ? 1.0f : 0.0f;
    values[3] = sphere_distance(&inside, o, d, 1);
    values[4] = certain_reach(&inside, o, d);
}

#ifdef CLRT_CERTIFY_CONE_CL
// Stores the cone of a camera ray: its origin, direction and radii.
kernel void probe_cones(global const FrameData *frames, global const uint *places,
                        global Scalar *results)
{
    const uint item = get_global_id(0);
    global Scalar *values = results + 8 * item;
    const FrameData frame = frames[item];
    const uint2 sample = (uint2)(places[2 * item], places[2 * item + 1]);
    const RayCone cone = camera_cone(&frame, sample, 0x1p-24f);
    store3(values, cone.origin);
    store3(values + 3, cone.along);
    values[6] = cone.around;
    values[7] = cone.spread;
}

// Stores whether the cube of the coordinate is certain and odd, for a face to each side. The cases
// are the input of probe_checks, and the coordinates are its results.
kernel void probe_certain_checks(global const float *cases, global const float *results,
                                 global int *answers)
{
    const uint item = get_global_id(0);
    const Real shift = cases[9 * item + 7];
    const Cubes cubes = {cases[9 * item + 6], real3_of(shift, shift, shift)};
    for (uint side = 0; side < 2; side++) {
        const AxisPlace at = {results[7 * item + 1], 0.0f, side == 0 ? 1.0f : -1.0f, 0.0f};
        uint odd = 0;
        answers[4 * item + 2 * side] = decide_axis(&cubes, shift, &at, 0x1p-24, &odd);
        answers[4 * item + 2 * side + 1] = (int)odd;
    }
}

// Refracts the cases of probe_refractions with the vectors that are not turned. Stores two flags:
// whether the refraction is certain, and whether it transmits light. Also stores the refracted
// direction and its doubt.
kernel void probe_certain_refractions(global const float *cases, global const Material *materials,
                                      global Scalar *results)
{
    const uint item = get_global_id(0);
    global const float *given = cases + 16 * item;
    global Scalar *values = results + 6 * item;
    const bool inside = given[13] > 0.0f;
    const Real3 normal = unit_vector(load3(given));
    Tracer tracer;
    tracer.materials = materials;
    UncertainSurface surface = {.normal = inside ? negative3(normal) : normal,
                                .toward_viewer = unit_vector(load3(given + 3)),
                                .normal_doubt = given[14],
                                .viewer_doubt = given[15],
                                .material = item,
                                .is_sphere = true,
                                .from_behind = inside};
    const UncertainRefraction at = refract_cone(&tracer, &surface, 0x1p-24 + OWN_ROUNDOFF);
    values[0] = at.is_certain ? 1.0f : 0.0f;
    values[1] = at.refracts ? 1.0f : 0.0f;
    store3(values + 2, at.direction);
    values[5] = at.doubt;
}
#else
// Stores the origin and direction of the camera ray through a sub-pixel, and whether the pixel's
// block is sky. `places` contains the sub-pixel.
kernel void probe_cameras(global const FrameData *frames, global const uint *places,
                          global float *results)
{
    const uint item = get_global_id(0);
    global float *values = results + 7 * item;
    const FrameData frame = frames[item];
    const uint x = places[2 * item], y = places[2 * item + 1];
    const Ray ray = camera_ray(&frame, x, y, 1);
    vstore3((float3)(ray.origin.x, ray.origin.y, ray.origin.z), 0, values);
    vstore3((float3)(ray.direction.x, ray.direction.y, ray.direction.z), 1, values);
    values[6] = is_sky(&frame, x / frame.samples, y / frame.samples) ? 1.0f : 0.0f;
}
#endif
