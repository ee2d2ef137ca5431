// SPDX-License-Identifier: MIT
// A request for a picture -> a reference picture with many more samples and the accuracy of fp64.
#pragma once

#include "session/picture.h"

typedef struct {
    Framebuffer picture; // owned; empty if the observer stopped the reference
    double own_error;    // its RMSE, estimated from two independent halves
} ReferencePicture;

// Draws the reference of the requested picture. The observer sees the tiles of all passes.
bool reference_draw(Session *session, const SessionPicture *request, const RenderObserver *observer,
                    ReferencePicture *reference, Error *error);
