// SPDX-License-Identifier: MIT
// The error that a picture allows -> the levels of glass that it needs.
#pragma once

#include "session/picture.h"

// Sets request->settings.max_level if request->level_bound is above 0. The level is the smallest
// whose cut rays cause an error of at most level_bound in a coarse picture. The coarse picture
// shows the whole frame, so all parts and crops of a picture have the level of the whole.
bool session_choose_level(Session *session, SessionPicture *request, Error *error);
