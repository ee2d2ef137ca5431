// SPDX-License-Identifier: MIT
// A ClrtPicture of clrt.h -> a picture of a scene, and ClrtSettings -> the settings of a session.
// The library and the program share the defaults and the rules, and word the faults themselves.
#pragma once

#include "library/clrt.h"
#include "render/aov.h"
#include "session/picture.h"

#define REFERENCE_SAMPLES     256
#define REFERENCE_SAMPLES_MAX 65536
#define TIME_GOAL_MOST        1000000 // seconds
#define GROUP_SIDE_MOST       1024

typedef enum {
    REQUEST_NUMBER,  // a number is out of range
    REQUEST_EVEN,    // a number is odd
    REQUEST_CONFLICT // two settings exclude each other
} RequestRule;

// A rule that a request breaks.
typedef struct {
    RequestRule rule;
    const char *setting, *other; // names of members of ClrtPicture, of channels, "crop", "tile" or
                                 // "fp64"; other is NULL unless they conflict
    double value, low, high;     // of a number
} RequestFault;

// Returns whether a request that needs these channels and this precision is valid for some scene.
bool request_check(const ClrtPicture *wanted, AovSet channels, ClrtPrecision precision,
                   RequestFault *fault);

// Returns whether the error goal is too small for fp32.
bool request_needs_fp64(const ClrtPicture *wanted);

// Fills the settings of a session. Returns whether precision, kernel and lanes fit together.
bool request_settings(const ClrtSettings *wanted, SessionSettings *settings);

// Returns the goal without the error that max_level causes.
PictureGoal request_goal(const ClrtPicture *wanted);

// Fills in the scene's defaults. If camera is NULL, the scene must have the view. Returns whether
// the crop is inside the picture. request_check has accepted the request.
bool request_resolve(const ClrtPicture *wanted, const Scene *scene, const Viewpoint *camera,
                     SessionPicture *picture);
