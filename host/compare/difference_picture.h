// SPDX-License-Identifier: MIT
// Makes a picture of the difference of two pictures.
#pragma once

#include "compare/difference.h"
#include "image/framebuffer.h"

// Each color is the absolute difference for float files. With for_the_eye it is the square root:
// 1/255 maps to 1/8, 4/255 to 1/4, and everything from 64/255 to 1.
bool difference_picture_make(Framebuffer *picture, const ImagePair *pair, bool for_the_eye,
                             Error *error);
