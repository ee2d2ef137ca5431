// SPDX-License-Identifier: MIT
// Checks the members of a ClrtPicture, and replaces members with the value 0 by defaults.
#include "session/request.h"

#include "scene/camera.h"

// Omitted reflections may use up this fraction of the error goal. The fraction is small, because
// additional levels cost less time than additional samples.
#define TRUNCATION_PART 0.25

// This fraction replaces TRUNCATION_PART in scenes with glass. It is larger, because each level of
// glass multiplies the time by about 1.4.
#define GLASS_PART 0.7

// The default of RenderSettings::samples if the scene is a mesh file.
#define MESH_SAMPLES 3

// The default side of a tile in pixels.
#define TILE 128

// Half the distance between neighboring floats just below 1.
#define FLOAT_HALF_STEP 0x1p-25

#define TURN_MOST 1e9 // degrees

// Error goals below this limit require fp64. The limit is four times 4e-5, which is the measured
// error of fp32.
#define ERROR_OF_FP64 1.6e-4

bool request_needs_fp64(const ClrtPicture *wanted)
{
    return wanted->error > 0 && wanted->error < ERROR_OF_FP64;
}

static bool check_numbers(const ClrtPicture *wanted, RequestFault *fault)
{
    const RequestFault ranges[] = {
        {REQUEST_NUMBER, "width", NULL, wanted->width, 0, PICTURE_SIZE_MAX},
        {REQUEST_NUMBER, "height", NULL, wanted->height, 0, PICTURE_SIZE_MAX},
        {REQUEST_NUMBER, "turn_degrees", NULL, wanted->turn_degrees, -TURN_MOST, TURN_MOST},
        {REQUEST_NUMBER, "samples", NULL, wanted->samples, 0, SAMPLES_MAX},
        {REQUEST_NUMBER, "contrast", NULL, wanted->contrast, 0, 1},
        {REQUEST_NUMBER, "error", NULL, wanted->error, 0, 1},
        {REQUEST_NUMBER, "seconds", NULL, wanted->seconds, 0, TIME_GOAL_MOST},
        {REQUEST_NUMBER, "max_level", NULL, wanted->max_level, CLRT_LEVEL_NONE, MAX_LEVEL_LIMIT},
        {REQUEST_NUMBER, "truncation", NULL, wanted->truncation, 0, 1},
        {REQUEST_NUMBER, "reference_samples", NULL, wanted->reference_samples, 0,
         REFERENCE_SAMPLES_MAX},
        {REQUEST_NUMBER, "tile_width", NULL, wanted->tile_width, 0, PICTURE_SIZE_MAX},
        {REQUEST_NUMBER, "tile_height", NULL, wanted->tile_height, 0, PICTURE_SIZE_MAX},
    };
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++)
        if (!(ranges[i].value >= ranges[i].low && ranges[i].value <= ranges[i].high)) {
            *fault = ranges[i];
            return false;
        }
    *fault = (RequestFault){.rule = REQUEST_EVEN, .setting = "reference_samples"};
    return wanted->reference_samples % 2 == 0;
}

static bool has_crop(const ClrtPicture *wanted)
{
    return wanted->left > 0 || wanted->top > 0 || wanted->crop_width > 0 || wanted->crop_height > 0;
}

static bool check_conflicts(const ClrtPicture *wanted, AovSet channels, ClrtPrecision precision,
                            RequestFault *fault)
{
    const char *goal = wanted->error > 0 ? "error" : wanted->seconds > 0 ? "seconds" : "contrast";
    const bool refines = goal_is_given(wanted);
    const bool is_certain = aov_needs(channels, AOV_NEEDS_CERTAINTY);
    const struct {
        bool is_broken;
        const char *setting, *other;
    } rules[] = {
        {wanted->contrast > 0 && wanted->error > 0, "contrast", "error"},
        {wanted->contrast > 0 && wanted->seconds > 0, "contrast", "seconds"},
        {wanted->error > 0 && wanted->seconds > 0, "error", "seconds"},
        {refines && wanted->samples > 0, "samples", goal},
        {refines && has_crop(wanted), "crop", goal},
        {refines && (wanted->tile_width > 0 || wanted->tile_height > 0), "tile", goal},
        {refines && aov_needs(channels, AOV_NEEDS_TESTS), "boxtests or tritests", goal},
        {refines && is_certain, "certainty", goal},
        {is_certain && precision != CLRT_FP32, "certainty", "fp64"},
        {wanted->truncation > 0 && wanted->max_level != 0, "truncation", "max_level"},
    };
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (rules[i].is_broken) {
            *fault = (RequestFault){
                .rule = REQUEST_CONFLICT, .setting = rules[i].setting, .other = rules[i].other};
            return false;
        }
    return true;
}

bool request_check(const ClrtPicture *wanted, AovSet channels, ClrtPrecision precision,
                   RequestFault *fault)
{
    if (!check_numbers(wanted, fault) || !check_conflicts(wanted, channels, precision, fault))
        return false;
    *fault = (RequestFault){
        .rule = REQUEST_FP64, .setting = "error", .value = wanted->error, .low = ERROR_OF_FP64};
    return precision == CLRT_FP64 || !request_needs_fp64(wanted);
}

// Returns whether an error bound determines the picture's max_level.
static bool chooses_level(const ClrtPicture *wanted)
{
    return wanted->max_level == 0 && (wanted->truncation > 0 || wanted->error > 0);
}

static uint32_t limited_level(uint32_t level, const Scene *scene)
{
    const uint32_t limit = scene_level_limit(scene);
    return level < limit ? level : limit;
}

// Returns the largest error that max_level may cause, if an error bound determines max_level.
static double level_bound(const ClrtPicture *wanted, const Scene *scene)
{
    const double part = scene_has_glass(scene) ? GLASS_PART : TRUNCATION_PART;
    return wanted->truncation > 0 ? wanted->truncation : wanted->error * part;
}

// In scenes with glass, session_choose_level may replace a max_level that an error bound
// determines.
static uint32_t max_level_of(const ClrtPicture *wanted, const Scene *scene)
{
    if (chooses_level(wanted))
        return truncation_level(scene, level_bound(wanted, scene));
    if (wanted->max_level == CLRT_LEVEL_NONE)
        return 0;
    const uint32_t level = wanted->max_level > 0 ? (uint32_t)wanted->max_level : scene->max_level;
    return limited_level(level, scene);
}

// Returns the max_level of the picture's reference, which is at least the max_level of the scene.
// If an error bound determines the picture's max_level, the rays that the reference cuts off change
// colors by at most FLOAT_HALF_STEP, unless the scene's highest level is reached.
static uint32_t reference_level(const ClrtPicture *wanted, const Scene *scene)
{
    const uint32_t level = chooses_level(wanted) ? truncation_level(scene, FLOAT_HALF_STEP)
                                                 : max_level_of(wanted, scene);
    return limited_level(level > scene->max_level ? level : scene->max_level, scene);
}

static uint32_t samples_of(const ClrtPicture *wanted, const Scene *scene)
{
    if (wanted->samples > 0 || goal_is_given(wanted))
        return wanted->samples > 0 ? wanted->samples : 1;
    return scene->mesh_up == UP_AUTO ? 1 : MESH_SAMPLES;
}

// Replaces the size of the whole picture by the crop's size and position. Returns false if the crop
// is empty or exceeds the picture.
static bool crop_settings(RenderSettings *settings, const ClrtPicture *wanted)
{
    const uint32_t width = settings->width, height = settings->height;
    if (!has_crop(wanted))
        return true;
    settings->whole_width = width;
    settings->whole_height = height;
    settings->left = wanted->left;
    settings->top = wanted->top;
    settings->width = wanted->crop_width;
    settings->height = wanted->crop_height;
    return wanted->crop_width > 0 && wanted->crop_width <= width &&
           wanted->left <= width - wanted->crop_width && wanted->crop_height > 0 &&
           wanted->crop_height <= height && wanted->top <= height - wanted->crop_height;
}

bool request_resolve(const ClrtPicture *wanted, const Scene *scene, const Viewpoint *camera,
                     SessionPicture *picture)
{
    const uint32_t level = max_level_of(wanted, scene);
    const uint32_t reference = wanted->reference_samples;
    *picture = (SessionPicture){.wanted = *wanted,
                                .reference_samples = reference > 0 ? reference : REFERENCE_SAMPLES,
                                .reference_level = reference_level(wanted, scene),
                                .truncated = truncation_bound(scene, level),
                                .includes_truncated = wanted->error > 0 && wanted->max_level == 0};
    if (chooses_level(wanted) && scene_has_glass(scene))
        picture->level_bound = level_bound(wanted, scene);
    picture->settings =
        (RenderSettings){.width = wanted->width > 0 ? wanted->width : scene->width,
                         .height = wanted->height > 0 ? wanted->height : scene->height,
                         .samples = samples_of(wanted, scene),
                         .max_level = level,
                         .tile_width = wanted->tile_width > 0 ? wanted->tile_width : TILE,
                         .tile_height = wanted->tile_height > 0 ? wanted->tile_height : TILE};
    const size_t view = wanted->view > 0 ? wanted->view - 1 : 0;
    picture->viewpoint =
        camera_turn(camera != NULL ? camera : &scene->viewpoints.data[view],
                    camera == NULL && scene->has_course_views, wanted->turn_degrees);
    return crop_settings(&picture->settings, wanted);
}
