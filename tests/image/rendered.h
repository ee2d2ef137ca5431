// SPDX-License-Identifier: MIT
// Pictures for tests that are about their pixels: what cannot be drawn fails the test.
#pragma once

#include "image/picture.h"

// The caller frees the picture.
Framebuffer rendered(const PictureRequest *request);

// Fails the test unless both are the same bits.
void rendered_expect_same(const PictureRequest *one, const PictureRequest *other);

// The root mean square difference of the values of two pictures of one size.
double rendered_error(const Framebuffer *one, const Framebuffer *other);
