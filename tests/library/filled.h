// SPDX-License-Identifier: MIT
// A scene of everything that clrt.h can fill in. filled.scn and its meshes have the same numbers.
#pragma once

#include <clrt.h>

extern const ClrtCamera filled_cameras[2];

ClrtScene *filled_make(void);
