// SPDX-License-Identifier: MIT
// A request for a picture -> the picture's reference, which has many samples and the accuracy of
// fp64.
#pragma once

#include "session/picture.h"

typedef struct {
    Framebuffer picture; // owned; empty if the observer stopped the reference
    double own_error;    // the reference's RMSE, estimated from its two independent halves
} ReferencePicture;

// Draws the reference of the requested picture. The observer receives one count of tiles for all
// passes together.
bool reference_draw(Session *session, const SessionPicture *request, const RenderObserver *observer,
                    ReferencePicture *reference, Error *error);
