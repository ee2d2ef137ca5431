// SPDX-License-Identifier: MIT
// A scene with every kind of object that clrt.h can add, except area lights. filled.scn and its
// meshes describe the same scene, except for max_level.
#pragma once

#include <clrt.h>

extern const ClrtCamera filled_cameras[2];
extern const ClrtMesh filled_meshes[2];

ClrtScene *filled_make(void);
