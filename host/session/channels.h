// SPDX-License-Identifier: MIT
// A finished picture -> its channels and the certainty of its pixels.
#pragma once

#include "render/aov_pass.h"
#include "session/picture.h"

// Computes the certainty of each pixel. Pixels that are certain in fp64, but not in float, get the
// colors of fp64. Stops when the observer returns false. Fails on devices without double
// arithmetic, denormal numbers or correctly rounded division.
bool session_certify(Session *session, const SessionPicture *request,
                     const RenderObserver *observer, const CertifiedPicture *picture, Error *error);

typedef struct {
    AovSet set;
    const uint32_t *pixel_samples; // PictureResult::pixel_samples
    const CertaintyMap *certainty; // NULL if no channel needs it
} ChannelRequest;

// Computes the channels into *layers. Stops when the observer returns false. *layers must have the
// names of channels->set (aov_name_layers) and the picture's size.
bool session_draw_channels(Session *session, const SessionPicture *request,
                           const ChannelRequest *channels, const RenderObserver *observer,
                           Layers *layers, Error *error);
