// SPDX-License-Identifier: MIT
// A request for a picture -> its colors. Without a goal, all pixels have equally many samples. With
// a goal, each pixel has as many as it needs.
#pragma once

#include "image/framebuffer.h"
#include "session/session.h"

// The point at which refinement stops. At most one of contrast, error and seconds is above 0. If
// all three are 0, the samples of a pixel form a square with RenderSettings::samples on each side.
typedef struct {
    double contrast;  // refine while neighboring samples differ by more than this
    double error;     // refine until the root mean square error is this small
    double seconds;   // refine for this time
    double truncated; // bound on the error that RenderSettings::max_level causes
} PictureGoal;

// Returns whether the number of samples may differ between pixels.
static inline bool goal_is_given(const PictureGoal *goal)
{
    return goal->contrast > 0 || goal->error > 0 || goal->seconds > 0;
}

typedef struct {
    RenderSettings settings;
    Viewpoint viewpoint;
    PictureGoal goal;
    uint32_t reference_samples; // per pixel of the reference; an even number
    uint32_t reference_level;   // the reference's max_level
    double truncated;           // bound on the error that RenderSettings::max_level causes
    double level_bound; // above 0, only with glass: the error by which session_choose_level and
                        // session_draw choose RenderSettings::max_level
    bool counts;        // rays and tests
    bool keeps_samples; // stores PictureResult::pixel_samples
} SessionPicture;

typedef struct {
    // Set by session_prepare.
    bool is_special;   // the kernels are specialized for the scene
    bool was_compiled; // an earlier process compiled the kernels
    size_t upload_size;
    double upload_seconds, build_seconds;
    uint32_t group[2]; // size of the work-groups
    double truncated;  // SessionPicture::truncated; with glass, session_draw measures it
    // Set by session_draw.
    RenderProgress progress;
    bool is_complete;
    bool goal_missed;
    double estimate;         // of the RMSE, including PictureGoal::truncated; for error and time
                             // goals
    double bound;            // upper bound of the RMSE with 95 % confidence
    double feature;          // the smallest diameter that the samples find (session/feature.h)
    uint64_t pixels;         // drawn by this call
    uint64_t samples;        // total of these pixels
    uint32_t *pixel_samples; // by pixel; NULL unless a goal and keeps_samples are given; the caller
                             // frees it
} PictureResult;

// Returns the kernel that draws the colors.
const KernelEntry *picture_entry(const PictureGoal *goal);

// Returns the camera for `samples` sub-pixels along each side of a pixel.
CameraData session_camera(const Session *session, const SessionPicture *request, uint32_t samples);

// Returns the work of drawing the request `pictures` times.
SessionWork session_work(const SessionPicture *request, double pictures);

// Uploads the scene and compiles the kernels for session_draw.
bool session_prepare(Session *session, const SessionPicture *request, PictureResult *result,
                     Error *error);

// Draws the picture into framebuffer, whose size is given by tile_frame_size. If the observer stops
// the picture, the call returns true and result->is_complete is false. If request->level_bound is
// above 0, the call may increase settings.max_level for an error goal.
bool session_draw(Session *session, SessionPicture *request, const RenderObserver *observer,
                  Framebuffer *framebuffer, PictureResult *result, Error *error);
