// SPDX-License-Identifier: MIT
// Needs no library, so it is there in every build.
#include "image/pfm.h"

bool pfm_write(const Framebuffer *framebuffer, FILE *stream)
{
    fprintf(stream, "PF\n%u %u\n-1.0\n", framebuffer->width, framebuffer->height);
    for (uint32_t row = framebuffer->height; row-- > 0;)
        fwrite(framebuffer->pixels[(size_t)row * framebuffer->width], sizeof(float[3]),
               framebuffer->width, stream);
    return fflush(stream) == 0 && !ferror(stream);
}
