// SPDX-License-Identifier: MIT
// The error that a picture with glass allows -> the picture's max_level.
#pragma once

#include "session/picture.h"

// If request->level_bound is at least 2^-22, sets request->settings.max_level. The level is the
// smallest one from 3 to GLASS_LEVELS whose error in a coarse picture is at most level_bound. If
// all errors are larger, the level is GLASS_LEVELS. The coarse picture shows the whole frame, so
// all parts and crops of a picture have the same level.
bool session_choose_level(Session *session, SessionPicture *request, Error *error);
