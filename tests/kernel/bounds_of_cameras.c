// SPDX-License-Identifier: MIT
// Measures B17 and B18 of docs/numerics.md: the rounding of camera rays, and how close rays of a
// block without primitives come to the box around all primitives.
#include "kernel/surface_bounds.h"

#include "scene/camera.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

typedef struct {
    float origin[3], direction[3], sky;
} CameraRay;

typedef struct {
    double origin[3], along[3], around, spread;
} CameraCone;

enum { ROUNDING, TURN, SPREAD, AROUND, SKY, BOUNDS };

static Share shares[BOUNDS] = {
    [ROUNDING] = {"B18: camera ray, u (|m + y down| + |result|)", 0},
    [TURN] = {"B17: turn of a camera ray, 8 u", 0},
    [SPREAD] = {"B18: camera_cone, spread", 0},
    [AROUND] = {"B18: camera_cone, around", 0},
    [SKY] = {"B17: distance of sky from the box, 34 u (b + r)", 0},
};

static FrameData frames[CASES];
static uint32_t places[CASES][2];
static CameraRay rays[CASES];
static CameraCone cones[CASES];
static float boxes[CASES][2][3];
static uint64_t seed = 1801;

static Vec3 random_vector(double range)
{
    const double x = random_between(&seed, -range, range);
    const double y = random_between(&seed, -range, range);
    return vec3(x, y, random_between(&seed, -range, range));
}

// Makes a box around all primitives, and grows it as the host does.
static void make_box(int i)
{
    float b = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double middle = random_between(&seed, -0.5, 0.5);
        const double half = random_between(&seed, 0, 0.5);
        boxes[i][0][axis] = (float)(middle - half);
        boxes[i][1][axis] = (float)(middle + half);
        b = fmaxf(b, fmaxf(fabsf(boxes[i][0][axis]), fabsf(boxes[i][1][axis])));
    }
    for (int axis = 0; axis < 3; axis++) {
        frames[i].low[axis] = boxes[i][0][axis] - 0x1p-12f * b;
        frames[i].high[axis] = boxes[i][1][axis] + 0x1p-12f * b;
    }
}

// Returns the number of the pixel at which the camera sees v on an axis, or nearby. `step` is the
// axis in the picture.
static uint32_t pixel_at(const FrameData *frame, const float step[4], Vec3 v, uint32_t size)
{
    const Vec3 axis = vec3_of_floats(step), forward = vec3_of_floats(frame->camera.forward);
    const Vec3 apart = vec3_sub(v, vec3_of_floats(frame->camera.eye));
    const double depth = frame->camera.orthographic != 0 ? 1 : vec3_dot(apart, forward);
    const double place = vec3_dot(apart, axis) / (vec3_dot(axis, axis) * depth) + size;
    const double moved = place / 2 + random_between(&seed, -2, 2);
    return (uint32_t)fmax(0, fmin(size - 1, floor(moved)));
}

// Makes a camera that looks at a corner of the box, or close to it, and chooses a pixel there.
static void make_camera(int i)
{
    FrameData *frame = &frames[i];
    const double far = ldexp(random_between(&seed, 1, 2), (int)random_below(&seed, 16) - 4);
    const Vec3 corner = vec3((double)boxes[i][random_below(&seed, 2)][0],
                             (double)boxes[i][random_below(&seed, 2)][1],
                             (double)boxes[i][random_below(&seed, 2)][2]);
    Viewpoint viewpoint = {.eye = vec3_add(corner, random_vector(far)),
                           .up = random_vector(1),
                           .fov_degrees = random_between(&seed, 1, 150)};
    viewpoint.look_at = vec3_add(corner, random_vector(far * random_unit(&seed)));
    if (random_below(&seed, 3) == 0)
        viewpoint.height = ldexp(1, (int)random_below(&seed, 12) - 6);
    frame->width = 1u << random_below(&seed, 24);
    frame->height = 1u << random_below(&seed, 24);
    frame->samples = 1;
    frame->camera =
        camera_make(&viewpoint, &(Normalization){.scale = 1}, frame->width, frame->height, 1);
    places[i][0] = pixel_at(frame, frame->camera.right_step, corner, frame->width);
    places[i][1] = pixel_at(frame, frame->camera.down_step, corner, frame->height);
}

// Stores the exact sum of the camera's vectors for the ray, and the sum without `right_step`.
static void exact_ray(int i, Quad sum[3], Quad inner[3])
{
    const CameraData *camera = &frames[i].camera;
    const Quad x = 2.0 * places[i][0] + 1 - frames[i].width;
    const Quad y = 2.0 * places[i][1] + 1 - frames[i].height;
    for (int axis = 0; axis < 3; axis++) {
        const float middle = camera->orthographic != 0 ? camera->eye[axis] : camera->forward[axis];
        inner[axis] = middle + y * camera->down_step[axis];
        sum[axis] = inner[axis] + x * camera->right_step[axis];
    }
}

static void check_rounding(int i)
{
    Quad sum[3], inner[3], error[3];
    const bool orthographic = frames[i].camera.orthographic != 0;
    const float *found = orthographic ? rays[i].origin : rays[i].direction;
    exact_ray(i, sum, inner);
    for (int axis = 0; axis < 3; axis++) {
        error[axis] = found[axis] - sum[axis];
        share_note(&shares[ROUNDING], magnitude(error[axis]),
                   (magnitude(inner[axis]) + magnitude(sum[axis])) * U * (1 + 2 * U));
    }
    if (!orthographic)
        share_note(&shares[TURN], length3(error), 8 * U * length3(sum));
}

static void check_cone(int i)
{
    const CameraCone *cone = &cones[i];
    const Quad along[3] = {cone->along[0], cone->along[1], cone->along[2]};
    Quad apart[3], d[3], across[3];
    for (int axis = 0; axis < 3; axis++) {
        apart[axis] = rays[i].origin[axis] - cone->origin[axis];
        d[axis] = rays[i].direction[axis];
    }
    const Quad ahead = dot3(d, along) / dot3(along, along);
    for (int axis = 0; axis < 3; axis++)
        across[axis] = d[axis] - ahead * along[axis];
    share_note(&shares[SPREAD], length3(across) / (ahead * length3(along)), cone->spread);
    if (frames[i].camera.orthographic != 0)
        share_note(&shares[AROUND], length3(apart), cone->around);
}

// Returns whether the ray meets the box of case i after it has grown by `margin`.
static bool meets_box(int i, Quad margin)
{
    Quad first = 0, last = (Quad)INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        const Quad o = rays[i].origin[axis], d = rays[i].direction[axis];
        const Quad low = boxes[i][0][axis] - margin - o, high = boxes[i][1][axis] + margin - o;
        if (d == 0 && (low > 0 || high < 0))
            return false;
        if (d == 0)
            continue;
        first = larger(first, d > 0 ? low / d : high / d);
        last = smaller(last, d > 0 ? high / d : low / d);
    }
    return first <= last;
}

// Measures how close a ray of a block that counts as sky comes to the box. Bisects the margin by
// which the box must grow so that the ray meets the box.
static void check_sky(int i)
{
    Quad b = 0, r = 0;
    if (rays[i].sky == 0)
        return;
    for (int side = 0; side < 2; side++)
        for (int axis = 0; axis < 3; axis++) {
            const Quad v = boxes[i][side][axis];
            b = larger(b, magnitude(v));
            r = larger(r, magnitude(v - frames[i].camera.eye[axis]));
        }
    const Quad least = 34 * U * (b + r);
    Quad low = 0, high = shares[SKY].share > 0 ? least / shares[SKY].share : 1;
    if (!meets_box(i, high))
        return;
    for (int step = 0; step < 30; step++) {
        const Quad middle = (low + high) / 2;
        *(meets_box(i, middle) ? &high : &low) = middle;
    }
    share_note(&shares[SKY], least, high);
}

TEST(camera_rays_round_within_their_bounds_and_sky_has_no_hits)
{
    for (int round = 0; round < bound_rounds(); round++) {
        for (int i = 0; i < CASES; i++) {
            make_box(i);
            make_camera(i);
        }
        RUN_PROBE(surface_probe, "probe_cameras", frames, places, rays);
        RUN_PROBE(surface_probe_fp64, "probe_cones", frames, places, cones);
        for (int i = 0; i < CASES; i++) {
            check_rounding(i);
            check_cone(i);
            check_sky(i);
        }
    }
    shares_check(shares, BOUNDS);
}
