// SPDX-License-Identifier: MIT
// The error that a picture allows -> the levels of glass that it needs.
#pragma once

#include "session/picture.h"

// If request->level_bound is at least 2^-22, sets request->settings.max_level to the smallest level
// that causes an error of at most level_bound in a coarse picture. The coarse picture shows the
// whole frame, so all parts and crops of a picture have the level of the whole.
bool session_choose_level(Session *session, SessionPicture *request, Error *error);
