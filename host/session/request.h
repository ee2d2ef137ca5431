// SPDX-License-Identifier: MIT
// ClrtPicture of clrt.h -> SessionPicture. The library and the program share these rules and
// defaults. Each has its own messages about a RequestFault.
#pragma once

#include "library/clrt.h"
#include "render/aov.h"
#include "session/picture.h"

#define REFERENCE_SAMPLES     256
#define REFERENCE_SAMPLES_MAX 65536
#define TIME_GOAL_MOST        1000000 // seconds
#define GROUP_SIDE_MOST       1024

typedef enum {
    REQUEST_NUMBER,   // a number is out of range
    REQUEST_EVEN,     // a number is odd
    REQUEST_CONFLICT, // two settings exclude each other
    REQUEST_FP64      // a number is too small for fp32
} RequestRule;

// A rule that a request breaks. `other` is NULL unless the rule is REQUEST_CONFLICT.
typedef struct {
    RequestRule rule;
    const char *setting, *other; // a member of ClrtPicture, a channel, "crop", "tile" or "fp64"
    double value, low, high;     // for REQUEST_NUMBER; REQUEST_FP64 has no `high`
} RequestFault;

// Returns whether a request with these channels and this precision obeys all rules that do not
// depend on the scene. If the request breaks a rule, fills *fault.
bool request_check(const ClrtPicture *wanted, AovSet channels, ClrtPrecision precision,
                   RequestFault *fault);

// Returns whether the error goal is too small for fp32. With fp32, request_check rejects this goal.
bool request_needs_fp64(const ClrtPicture *wanted);

// Completes a request with the scene's defaults. request_check must have accepted the request. If
// `camera` is NULL, the scene must have the view wanted->view. Returns false if the crop is empty
// or exceeds the picture.
bool request_resolve(const ClrtPicture *wanted, const Scene *scene, const Viewpoint *camera,
                     SessionPicture *picture);
