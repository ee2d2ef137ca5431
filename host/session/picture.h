// SPDX-License-Identifier: MIT
// A request for a picture -> its colors, its channels and the certainty of its pixels. Without a
// goal, all pixels have equally many samples. With a goal, each pixel has as many samples as it
// needs.
#pragma once

#include "render/aov.h"
#include "render/certifier.h"
#include "session/session.h"

// Returns whether the picture has a goal, so the number of samples may differ between pixels.
// Without a goal, the samples of a pixel form a square with RenderSettings::samples on each side.
static inline bool goal_is_given(const ClrtPicture *wanted)
{
    return wanted->contrast > 0 || wanted->error > 0 || wanted->seconds > 0;
}

typedef struct {
    ClrtPicture wanted; // only the goal and `statistics` are used
    RenderSettings settings;
    Viewpoint viewpoint;
    uint32_t reference_samples; // per pixel of the reference; an even number
    uint32_t reference_level;   // the reference's max_level
    double truncated;           // bound on the error that RenderSettings::max_level causes
    bool includes_truncated;    // `truncated` is a part of the error goal
    // With glass, the error by which session_choose_level and session_draw_picture choose
    // RenderSettings::max_level; 0 if the level is given.
    double level_bound;
    AovSet channels; // to draw by session_draw_channels
} SessionPicture;

typedef struct {
    // The following members are set by session_prepare_picture and session_draw_picture.
    bool is_special; // the kernels are specialized for the scene
    size_t upload_size;
    double upload_seconds, build_seconds;
    uint32_t group[2]; // size of the work-groups
    // session_prepare_picture sets facts.cached and facts.truncation. session_draw_picture also
    // sets the members about the goal, the samples and the smallest feature. With glass, it
    // measures facts.truncation. The errors include facts.truncation if
    // SessionPicture::includes_truncated.
    ClrtResult facts;
    // The following members are set by session_draw_picture.
    RenderProgress progress;
    bool is_complete;
    uint64_t pixels;         // drawn by this call
    uint32_t *pixel_samples; // by pixel; NULL unless the request has both a goal and channels
    // The following member is set by session_certify_picture.
    CertaintyMap certainty; // empty unless a channel needs it
} PictureResult;

// Frees pixel_samples and certainty.
void picture_result_free(PictureResult *result);

// Returns the kernel that draws the colors.
const KernelEntry *picture_entry(const ClrtPicture *wanted);

// Returns the camera for `samples` sub-pixels along each side of a pixel.
CameraData session_picture_camera(const Session *session, const SessionPicture *request,
                                  uint32_t samples);

// Returns the work of drawing the requested picture `pictures` times.
SessionWork session_picture_work(const SessionPicture *request, double pictures);

// Uploads the scene and compiles the kernels for session_draw_picture.
bool session_prepare_picture(Session *session, const SessionPicture *request, PictureResult *result,
                             Error *error);

// Draws the picture into *framebuffer, which must have the size from tile_frame_size. If the
// observer stops the picture, the call returns true, and result->is_complete is false. With an
// error goal and a request->level_bound above 0, the call may increase request->settings.max_level.
bool session_draw_picture(Session *session, SessionPicture *request, const RenderObserver *observer,
                          Framebuffer *framebuffer, PictureResult *result, Error *error);

// If a requested channel needs the certainty of each pixel, computes it into *result. Pixels that
// are certain in fp64, but not in float, get the colors of fp64. Stops when the observer returns
// false. Fails on devices without double arithmetic, denormal numbers or correctly rounded
// division.
bool session_certify_picture(Session *session, const SessionPicture *request,
                             const RenderObserver *observer, Framebuffer *framebuffer,
                             PictureResult *result, Error *error);

// Computes request->channels into *layers. *result must be the result of session_draw_picture and
// session_certify_picture. Stops when the observer returns false. *layers must have the names of
// request->channels (aov_name_layers) and the picture's size.
bool session_draw_channels(Session *session, const SessionPicture *request,
                           const RenderObserver *observer, Layers *layers,
                           const PictureResult *result, Error *error);
