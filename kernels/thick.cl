// SPDX-License-Identifier: MIT
// A ray as thick as what is not known of it: a cone that holds the ray of real arithmetic on the
// stored scene and the one that a tracer of unit roundoff u followed in its place.  What all rays
// of the cone decide alike, under all errors of the tracer's tests as well, no rounding can change.
//
// This is computed in fp64, for a tracer in fp32 (u = 2^-24) or in fp64 (u = 2^-53): OWN_ROUNDOFF
// stands for what is lost here, whichever u is.  That a float operation is correctly rounded is
// all that is asked of the tracer's device, and that no product of two sheared coordinates
// underflows, which takes a corner nearer than 2^-51 of the frame to the ray on one axis alone.
// The bounds, in the order in which a ray needs them; |.| is Euclidean unless said otherwise:
//
//  1. Camera ray: fma(x, right, fma(y, down, forward)), of which fp32's is computed here once more;
//     fp64's two roundings are below u (|inner| + |outer|) a component.  The eye is stored.
//  2. Corners, relative to the origin and sheared to (X - S Z, ., Z), |S| <= 1: u on the
//     differences, 2u on S, u on the fma of its small result: 4u |S Z| + 2u |X - S Z| on each of
//     two axes.  For a corner at depth z, l aside of a ray that makes an angle of sine w with the
//     longest axis, that is below 4u w z + 10u l in all.  The edge functions' signs are exact
//     (vector.cl), so the tracer decides exactly about corners that lie so much aside (blur_at).
//     Where the axis passes all three edges by more than the blur, no motion of the corners within
//     it moves an edge over the axis: the triangle winds around it as often as before, in the same
//     sense.
//  3. Where it is met: edge functions carry 2u, weights 8u, of which the 5u of sum and reciprocal
//     are common to all three; depths u, their interpolation 3u, the division 2u: 14u on the
//     longest axis, hence 25u of the size of the triangle's farthest corner along the ray.  The
//     tracer's own `error` (pair.cl) is below 64u of that.
//  4. A point of a triangle: 5u common to all, 3u on each weight, 3u of the interpolation: on each
//     axis 11u of the weighted mean of the corners' sizes, off the plane; in the plane it slides by
//     the blur over the sine at which the ray falls in.
//  5. A triangle's normal: edges carry u, their products 2u each: 4u E + 3u |n_k| an axis, E the
//     product of the largest edge components: 7u E + 3u |n|.  Unit vectors add 4u.
//  6. An interpolated normal: 3u on each weight and 3u of the interpolation; what is common to all
//     does not turn it; and what sliding changes the weights by.
//  7. Directions to lights: u on the difference, 4u on the unit vector; a shadow ray ends within u
//     of its length from the light.  The side of a face that a light is on depends on stored
//     numbers alone (side_of).  Reflection turns twice as far as the normal and as far as the ray,
//     and rounds by 12u.
//  8. Spheres: sure_sphere.cl.
#ifndef CLRT_THICK_CL
#define CLRT_THICK_CL

#define OWN_ROUNDOFF 0x1p-53

// A point of a surface: of a triangle it lies within `slide` of the point in the triangle's plane,
// and from there `lift` off; of a sphere within `lift`.
typedef struct {
    Real3 point;
    Real3 face; // unit normal of the triangle's plane
    Real slide, lift;
} FatPoint;

typedef struct {
    Real3 origin, along, right, up; // unit and perpendicular; right and up span the plane across
    Real around;                    // every ray of the cone starts within this of the origin
    Real spread;                    // and leads away from `along` by at most this tangent
    Real tilt;                      // at least the sine between them and the longest axis
    Real length;                    // of a shadow ray, up to the light; else INFINITY
    Real u;                         // unit roundoff of the tracer in question
    Count own, own_index;           // as a Ray's
    RayKind kind;
    FatPoint start; // where it leaves a surface, or the eye
    FatPoint goal;  // of a shadow ray: where it ends, at the light
} ThickRay;

static inline Real length_of(Real3 v)
{
    return sqrt(dot_product(v, v));
}

static inline Real radius_of(const FatPoint *point)
{
    return point->slide + point->lift;
}

static inline Real sum_of_sizes(Real3 v)
{
    return fabs(v.x) + fabs(v.y) + fabs(v.z);
}

// Directions that differ by `chord` from a unit vector lead away from it by this tangent.
static inline Real spread_of(Real chord)
{
    return chord < 0.25f ? chord / (1.0f - chord) : INFINITY;
}

// The frame of a ray along a unit vector.
static inline void look_along(ThickRay *ray, Real3 along)
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

// The tracer searches no farther (traverse.cl), and a cone so wide would settle nothing.
static inline bool is_usable(const ThickRay *ray)
{
    return sum_of_sizes(ray->origin) < 0x1p45f && ray->spread < 0x1p-8f && ray->around < 0x1p-5f;
}

// A point in the ray's frame: across, across and along.
static inline Real3 seen_by(const ThickRay *ray, Real3 point)
{
    const Real3 apart = difference(point, ray->origin);
    return real3_of(dot_product(apart, ray->right), dot_product(apart, ray->up),
                    dot_product(apart, ray->along));
}

// The cone's radius at a depth.  Shadow rays come together again at the light.
static inline Real cone_at(const ThickRay *ray, Real z)
{
    const Real depth = fabs(z) + ray->around;
    if (ray->kind != RAY_SHADOW)
        return ray->around + ray->spread * depth;
    return ray->around * (fabs(1.0f - z / ray->length) + 2.0f * ray->spread) +
           radius_of(&ray->goal) * (depth / ray->length);
}

// How far the point may lie elsewhere, seen along any ray of the cone as the tracer rounds it.
static inline Real blur_at(const ThickRay *ray, Real3 seen)
{
    const Real depth = fabs(seen.z) + ray->around;
    const Real aside = fabs(seen.x) + fabs(seen.y) + ray->around + ray->spread * depth;
    return 1.0001f * cone_at(ray, seen.z) + ray->u * (4.01f * ray->tilt * depth + 10.0f * aside) +
           16.0f * OWN_ROUNDOFF * (depth + aside);
}

// By how much the direction is off that fp32 computes in place of this one.
static inline Real camera_rounding(const CameraData *camera, Real3 direction, float x, float y)
{
    const float *right = camera->right_step, *down = camera->down_step, *forward = camera->forward;
    const Real3 rounded = real3_of(fma(x, right[0], fma(y, down[0], forward[0])),
                                   fma(x, right[1], fma(y, down[1], forward[1])),
                                   fma(x, right[2], fma(y, down[2], forward[2])));
    return length_of(difference(rounded, direction));
}

// sample_x and sample_y as for camera_ray.  Twice the lengths bound what fp64 rounds.
static inline ThickRay thick_camera_ray(const FrameData *frame, uint2 sample, Real u)
{
    const Ray ray = camera_ray(frame, sample.x, sample.y, true);
    const int x = convert_int(2 * sample.x + 1) - (int)(frame->width * frame->samples);
    const int y = convert_int(2 * sample.y + 1) - (int)(frame->height * frame->samples);
    const Real3 forward = load_private3(frame->camera.forward);
    const Real3 down = load_private3(frame->camera.down_step);
    const Real3 inner = sum3(forward, scaled3((Real)y, down));
    const Real own = 2.0f * OWN_ROUNDOFF * (length_of(inner) + length_of(ray.direction));
    const Real rounding =
        own + (u > OWN_ROUNDOFF ? camera_rounding(&frame->camera, ray.direction, (float)x, (float)y)
                                : 0.0f);
    ThickRay thick = {
        .origin = ray.origin,
        .spread = spread_of(1.01f * rounding / length_of(ray.direction) + 8.0f * OWN_ROUNDOFF),
        .length = INFINITY,
        .u = u,
        .own = NOTHING,
        .own_index = NOTHING,
        .kind = RAY_CAMERA,
        .start = {ray.origin, unit_vector(ray.direction), 0.0f, 0.0f}};
    look_along(&thick, unit_vector(ray.direction));
    return thick;
}

#endif
