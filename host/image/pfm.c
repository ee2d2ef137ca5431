// SPDX-License-Identifier: MIT
// Reads and writes PFM without a library, so every build supports it.
#include "image/pfm.h"

#include "base/number.h"

#include <ctype.h>
#include <string.h>

bool pfm_write(const Framebuffer *framebuffer, FILE *stream)
{
    fprintf(stream, "PF\n%u %u\n-1.0\n", framebuffer->width, framebuffer->height);
    for (uint32_t row = framebuffer->height; row-- > 0;)
        fwrite(framebuffer->pixels[(size_t)row * framebuffer->width], sizeof(float[3]),
               framebuffer->width, stream);
    return fflush(stream) == 0 && !ferror(stream);
}

static bool read_header(StoredImage *image, FILE *stream, double *scale, Error *cause)
{
    char kind[32], words[3][32];
    int64_t sides[2];
    // A single white-space character follows the header.
    bool ok = fscanf(stream, "%31s%31s%31s%31s", kind, words[0], words[1], words[2]) == 4 &&
              isspace(getc(stream)) && (strcmp(kind, "PF") == 0 || strcmp(kind, "Pf") == 0);
    for (int i = 0; ok && i < 3; i++) {
        const char *end = words[i] + strlen(words[i]);
        ok = i < 2 ? integer_parse(words[i], end, &sides[i]) == end && sides[i] > 0 &&
                         sides[i] <= UINT32_MAX
                   : number_parse(words[i], end, scale) == end && *scale != 0;
    }
    if (!ok)
        return error_set(cause, "it has no valid PFM header");
    const uint32_t channels = kind[1] == 'F' ? 3 : 1;
    *image = (StoredImage){.width = (uint32_t)sides[0],
                           .height = (uint32_t)sides[1],
                           .channel_count = channels,
                           .names = {"Y"}};
    for (uint32_t i = 0; channels == 3 && i < 3; i++)
        image->names[i][0] = "RGB"[i];
    return true;
}

static void swap_bytes(float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        bits = __builtin_bswap32(bits);
        memcpy(&values[i], &bits, sizeof bits);
    }
}

bool pfm_read(StoredImage *image, FILE *stream, uint64_t most, Error *cause)
{
    double scale;
    if (!read_header(image, stream, &scale, cause) ||
        !stored_image_check_size(image, most, cause) || !stored_image_allocate(image, cause))
        return false;
    const size_t row_values = (size_t)image->width * image->channel_count;
    for (uint32_t row = image->height; row-- > 0;) {
        float *values = image->values + row * row_values;
        if (fread(values, sizeof *values, row_values, stream) != row_values)
            return error_set(cause, "it ends early");
        if (scale > 0)
            swap_bytes(values, row_values);
    }
    return true;
}
