// SPDX-License-Identifier: MIT
// A ray cone contains two rays: the exact ray in the stored scene, and the ray of a tracer with
// unit roundoff u. If all rays of the cone lead to one decision, despite all errors of the tracer's
// tests, rounding cannot change this decision.
//
// The bounds are computed in fp64, for a tracer in fp32 (u = 2^-24) or in fp64 (u = 2^-53).
// OWN_ROUNDOFF covers the rounding of the bounds themselves. docs/numerics.md derives the bounds as
// B1, B2 and so on. The bounds require two things:
//  - The tracer's device rounds float operations correctly.
//  - No rounding error of a product in fp32's edge functions underflows (B3). This holds if each
//    sheared coordinate of a corner is 0 or at least 2^-51 in magnitude, in normalized coordinates.
//    The kernel does not check for underflow. If an error underflows, only decisions about
//    triangles that are seen edge-on or have an area below 2^-147 can be wrong (B10).
//
// A camera ray's direction is fma(x, right, fma(y, down, forward)). If the camera is orthographic,
// the origin is fma(x, right, fma(y, down, eye)) (B18). For fp32, camera_rounding computes the
// error of these sums. For fp64, the inner and the outer fma together round by less than
// u (|inner| + |outer|) per component. The end of a shadow ray misses the light by at most u times
// the ray's length.
#ifndef CLRT_CERTIFY_CONE_CL
#define CLRT_CERTIFY_CONE_CL

#define OWN_ROUNDOFF 0x1p-53

// A point with bounds on its error. The exact point and the tracer's point are at most `slide` from
// `point` along the triangle's plane, and at most `lift` off the plane. On a sphere, they are at
// most `lift` from `point`.
typedef struct {
    Real3 point;
    Real3 face; // unit normal of the triangle's plane
    Real slide, lift;
} UncertainPoint;

typedef struct {
    Real3 origin, along, right, up; // along, right and up are perpendicular unit vectors
    Real around;         // bound on the distance between the origin and the starts of the rays
    Real spread;         // bound on the tangent of the angle between a ray and `along`
    Real tilt;           // bound on the sine of a ray's angle to the nearest coordinate axis
    Real length;         // of a shadow ray, up to the light; else INFINITY
    Real u;              // unit roundoff of the tracer being checked
    UInt own, own_index; // as in Ray
    RayKind kind;
    UncertainPoint start; // the surface point that the ray leaves, or the eye
    UncertainPoint goal;  // the end of a shadow ray, at the light
} RayCone;

static inline Real length_of(Real3 v)
{
    return sqrt(dot_product(v, v));
}

static inline Real radius_of(const UncertainPoint *point)
{
    return point->slide + point->lift;
}

static inline Real sum_of_sizes(Real3 v)
{
    return fabs(v.x) + fabs(v.y) + fabs(v.z);
}

// Returns a bound on the tangent of the angle between two unit vectors whose tips are `chord`
// apart.
static inline Real spread_of(Real chord)
{
    return chord < 0.25f ? chord / (1.0f - chord) : INFINITY;
}

// Sets the ray's axes and tilt. `along` is the unit direction. ray->spread must be set.
static inline void set_axis(RayCone *ray, Real3 along)
{
    const Real3 size = magnitudes(along);
    const bool x_least = size.x <= min(size.y, size.z), y_least = size.y <= size.z;
    const Real3 aside = real3_of(x_least ? 1.0f : 0.0f, !x_least && y_least ? 1.0f : 0.0f,
                                 !x_least && !y_least ? 1.0f : 0.0f);
    ray->along = along;
    ray->right = unit_vector(cross_product(along, aside));
    ray->up = cross_product(along, ray->right);
    const ShearAxes axes = shear_axes(along);
    const Real x = component(along, axes.x), y = component(along, axes.y);
    ray->tilt = sqrt(x * x + y * y) + 2.0f * ray->spread;
}

// Returns whether the tracer certainly accepts the ray (is_searchable in intersect.cl), and the
// cone is narrow enough for the bounds.
static inline bool is_usable(const RayCone *ray)
{
    return sum_of_sizes(ray->origin) < 0x1p45f && ray->spread < 0x1p-8f && ray->around < 0x1p-5f;
}

// Returns a point in the ray's frame, with the axes right, up and along.
static inline Real3 to_cone_frame(const RayCone *ray, Real3 point)
{
    const Real3 apart = difference(point, ray->origin);
    return real3_of(dot_product(apart, ray->right), dot_product(apart, ray->up),
                    dot_product(apart, ray->along));
}

// Returns the cone's radius at a depth. The cone of a shadow ray narrows toward the light.
static inline Real cone_at(const RayCone *ray, Real z)
{
    const Real depth = fabs(z) + ray->around;
    if (ray->kind != RAY_SHADOW)
        return ray->around + ray->spread * depth;
    return ray->around * (fabs(1.0f - z / ray->length) + 2.0f * ray->spread) +
           radius_of(&ray->goal) * (depth / ray->length);
}

// Returns a bound on the distance between two projections of a point: along the cone's axis, and
// along any ray of the cone. The bound includes the tracer's rounding (B10). `seen` is the point in
// the cone's frame.
static inline Real blur_at(const RayCone *ray, Real3 seen)
{
    const Real depth = fabs(seen.z) + ray->around;
    const Real aside = fabs(seen.x) + fabs(seen.y) + ray->around + ray->spread * depth;
    return 1.0001f * cone_at(ray, seen.z) + ray->u * (4.01f * ray->tilt * depth + 10.0f * aside) +
           16.0f * OWN_ROUNDOFF * (depth + aside);
}

// Returns the vector to which the camera adds its steps: the eye if orthographic, else forward.
static inline const float *camera_middle(const CameraData *camera)
{
    return camera->orthographic != 0 ? camera->eye : camera->forward;
}

// Returns the distance between two vectors: `moved`, computed in fp64, and its fp32 counterpart.
static inline Real camera_rounding(const CameraData *camera, Real3 moved, float x, float y)
{
    const float *right = camera->right_step, *down = camera->down_step;
    const float *middle = camera_middle(camera);
    const Real3 rounded = real3_of(fma(x, right[0], fma(y, down[0], middle[0])),
                                   fma(x, right[1], fma(y, down[1], middle[1])),
                                   fma(x, right[2], fma(y, down[2], middle[2])));
    return length_of(difference(rounded, moved));
}

// Returns the cone of a camera ray. `sample` contains the arguments sample_x and sample_y of
// camera_ray. The variable `own` is twice the bound on the camera ray's rounding in fp64 (B18).
static inline RayCone camera_cone(const FrameData *frame, uint2 sample, Real u)
{
    const Ray ray = camera_ray(frame, sample.x, sample.y, true);
    const int x = convert_int(2 * sample.x + 1) - (int)(frame->width * frame->samples);
    const int y = convert_int(2 * sample.y + 1) - (int)(frame->height * frame->samples);
    const CameraData *camera = &frame->camera;
    const bool orthographic = camera->orthographic != 0;
    const Real3 moved = orthographic ? ray.origin : ray.direction;
    const Real3 down = load_private3(camera->down_step);
    const Real3 inner = sum3(load_private3(camera_middle(camera)), scaled3((Real)y, down));
    const Real own = 2.0f * OWN_ROUNDOFF * (length_of(inner) + length_of(moved));
    const Real rounding =
        1.01f *
        (own + (u > OWN_ROUNDOFF ? camera_rounding(camera, moved, (float)x, (float)y) : 0.0f));
    const Real around = orthographic ? rounding : 0.0f;
    const Real turn = orthographic ? 0.0f : rounding;
    RayCone cone = {.origin = ray.origin,
                    .around = around,
                    .spread = spread_of(turn / length_of(ray.direction) + 8.0f * OWN_ROUNDOFF),
                    .length = INFINITY,
                    .u = u,
                    .own = NOTHING,
                    .own_index = NOTHING,
                    .kind = RAY_CAMERA,
                    .start = {ray.origin, unit_vector(ray.direction), 0.0f, around}};
    set_axis(&cone, unit_vector(ray.direction));
    return cone;
}

#endif
