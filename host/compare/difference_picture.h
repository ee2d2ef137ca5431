// SPDX-License-Identifier: MIT
// Two pictures -> a picture of where they differ.
#pragma once

#include "compare/difference.h"
#include "image/framebuffer.h"

// Each color is the size of its difference as it is, for files of floats, or, for the eye, its
// square root: 1/255 shows as 1/8, 4/255 as 1/4, and from 64/255 on all is full.
bool difference_picture_make(Framebuffer *picture, const ImagePair *pair, bool for_the_eye,
                             Error *error);
