// SPDX-License-Identifier: MIT
// Computes the numbers whose errors docs/numerics.md bounds, in the same way as the kernels.

// Returns the height that height_over computes, and the threshold up to which height_over returns 0
// instead.
static inline Real2 height_and_doubt(const Corners *corners, Real3 point, float blur)
{
    const Real3 ab = difference(corners->b, corners->a), ac = difference(corners->c, corners->a);
    const Real3 normal = cross_product(ab, ac), apart = difference(point, corners->a);
    const Real3 size = magnitudes(normal);
    const Real edges = largest_component(ab) * largest_component(ac);
    const Real error =
        blur * dot_product(size, magnitudes(point)) +
        8.0f * (dot_product(size, magnitudes(apart)) + edges * largest_component(apart));
    return (Real2)(dot_product(normal, apart), UNIT_ROUNDOFF * error);
}

static inline void store3(global Scalar *values, Real3 v)
{
    values[0] = v.x;
    values[1] = v.y;
    values[2] = v.z;
}

// Stores four values of a sphere. The first value is sphere_discriminant, in two-float arithmetic.
// Plain floats compute the other values: the negative of the first value as in sphere_is_passed,
// the power of the origin as in plain_side, and the projection as in leads_away. The triangle's
// corners give the sphere's center and radius.
static inline void probe_sphere(const Ray *ray, const Corners *corners, global Scalar *values)
{
    const Real3 a = corners->a, b = scaled3(0x1p-25f, corners->b), o = ray->origin;
    const Real r = fabs(corners->c.x);
    const Sphere sphere = {{{a.x, a.x * b.x}, {a.y, a.y * b.y}, {a.z, a.z * b.z}}, {r, r * b.x}};
    const TwoFloat3 f = sphere_to_origin(&sphere, o);
    const Real3 d = ray->direction, plain = difference(o, a);
    const Real dd = dot_product(d, d), along = -two_dot(f, d).high / dd;
    const Real3 foot = difference(plain, scaled3(dot_product(plain, d) / dd, d));
    values[0] = sphere_discriminant(f, d, along, dd, two_square(sphere.radius));
    values[1] = dot_product(foot, foot) - r * r;
    values[2] = dot_product(plain, plain) - r * r;
    values[3] = dot_product(plain, d);
}

// A ray has six floats: {origin, direction}. Each ray has its triangle and 45 results.
kernel void probe_bounds(global const float *rays, global const TriangleData *triangles,
                         global Scalar *results)
{
    const uint item = get_global_id(0);
    global Scalar *values = results + 45 * item;
    Tracer tracer;
    tracer.triangles = (global const Triangles *)triangles;
    Ray ray;
    ray.origin = load3(rays + 6 * item);
    ray.direction = load3(rays + 6 * item + 3);
    const Search search = search_along(&tracer, &ray, INFINITY);
    const Corners corners = fetch_corners(&tracer, item);
    const Corners relative = {corner_relative(triangles[item].a, &search),
                              corner_relative(triangles[item].b, &search),
                              corner_relative(triangles[item].c, &search)};
    const Corners sheared = corners_sheared(&relative, &search.shear);
    const Edges edges = edges_of(&sheared);
    const Real r = 1.0f / edges.determinant;
    const Real3 point = weighted(real3_of(edges.u * r, edges.v * r, edges.w * r), &corners);
    const Nearness nearness = nearness_of(&tracer, &ray, item);
    store3(values, sheared.a);
    store3(values + 3, sheared.b);
    store3(values + 6, sheared.c);
    store3(values + 9, real3_of(edges.u, edges.v, edges.w));
    values[12] = edges_contain(&edges) ? 1.0f : 0.0f;
    values[13] = triangle_depth(&sheared, &edges) * search.shear.inverse_z;
    values[14] = triangle_depth_error(&sheared) * fabs(search.shear.inverse_z);
    values[15] = search.tie;
    values[16] = search_behind(&search);
    values[17] = nearness.t.high;
    values[18] = nearness.t.low;
    store3(values + 19, point);
    vstore2(height_and_doubt(&corners, ray.origin, 0.0f), 0, values + 22);
    vstore2(height_and_doubt(&corners, point, POINT_BLUR), 0, values + 24);
    values[26] = height_over(&corners, ray.origin, 0.0f);
    values[27] = height_over(&corners, point, POINT_BLUR);
    values[28] = search.shear.inverse_z;
    store3(values + 29, search.slabs.inverse);
    store3(values + 32, search.slabs.near_offset);
    store3(values + 35, search.slabs.far_offset);
    store3(values + 38, unit_vector(ray.direction));
    probe_sphere(&ray, &corners, values + 41);
}

#ifdef CLRT_CERTIFY_CONE_CL
// Stores the bounds of certify_triangle.cl for an exact ray: margin_of, behind_of, the blur and
// size of the projected triangle, and the least and largest depth of a hit.
kernel void probe_margins(global const float *rays, global const TriangleData *triangles,
                          global Scalar *results)
{
    const uint item = get_global_id(0);
    global Scalar *values = results + 6 * item;
    const Real3 origin = load3(rays + 6 * item), direction = load3(rays + 6 * item + 3);
    RayCone ray = {.origin = origin,
                   .length = INFINITY,
                   .u = 0x1p-24,
                   .own = NOTHING,
                   .own_index = NOTHING,
                   .kind = RAY_REFLECTED,
                   .start = {origin, direction, 0.0f, 0.0f}};
    set_axis(&ray, unit_vector(direction));
    const Corners corners = {load3(triangles[item].a), load3(triangles[item].b),
                             load3(triangles[item].c)};
    const ProjectedTriangle projected = project_triangle(&ray, &corners);
    const Candidate depth = depth_of(&projected, ray.u);
    values[0] = margin_of(&projected, ray.u);
    values[1] = behind_of(&ray);
    values[2] = projected.blur;
    values[3] = projected.size;
    values[4] = projected.clear ? -INFINITY : depth.low;
    values[5] = projected.clear ? INFINITY : depth.high;
    if (projected.inside) {
        values[4] = depth.low;
        values[5] = depth.high;
    }
}
#endif
