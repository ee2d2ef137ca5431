// SPDX-License-Identifier: MIT
// All difference pictures have the same scale, so that users can compare them.
#include "compare/difference_picture.h"

#include <math.h>

#define FULL (64 / 255.0) // the difference that maps to 1

static double shown(double difference)
{
    return fmin(1, sqrt(difference / FULL));
}

bool difference_picture_make(Framebuffer *picture, const ImagePair *pair, bool for_the_eye,
                             Error *error)
{
    const StoredImage *image = pair->images[0];
    if (!framebuffer_make(picture, image->width, image->height, error))
        return false;
    const size_t pixels = (size_t)image->width * image->height;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int color = 0; color < 3; color++) {
            const double off = fabs(image_pair_difference(pair, pixel, color));
            picture->pixels[pixel][color] = (float)(for_the_eye ? shown(off) : off);
        }
    return true;
}
