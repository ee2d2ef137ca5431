// SPDX-License-Identifier: MIT
// The error that a picture with glass allows -> the picture's max_level.
#pragma once

#include "session/picture.h"

// If request->level_bound is at least 2^-22, sets request->settings.max_level to the smallest level
// above 2 that causes an error of at most level_bound in a coarse picture, but not above
// GLASS_LEVELS. The coarse picture shows the whole frame, so all parts and crops of a picture have
// the same level.
bool session_choose_level(Session *session, SessionPicture *request, Error *error);
