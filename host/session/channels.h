// SPDX-License-Identifier: MIT
// A finished picture -> its channels and the certainty of its pixels.
#pragma once

#include "render/aov_pass.h"
#include "session/picture.h"

// If a channel needs it, computes the certainty of each pixel into *result. Pixels that are certain
// in fp64, but not in float, get the colors of fp64. Stops when the observer returns false. Fails
// on devices without double arithmetic, denormal numbers or correctly rounded division.
bool session_certify(Session *session, const SessionPicture *request,
                     const RenderObserver *observer, Framebuffer *framebuffer,
                     PictureResult *result, Error *error);

// Computes the channels of a picture with this result into *layers. Stops when the observer returns
// false. *layers must have the names of request->channels (aov_name_layers) and the picture's size.
bool session_draw_channels(Session *session, const SessionPicture *request,
                           const RenderObserver *observer, Layers *layers,
                           const PictureResult *result, Error *error);
