// SPDX-License-Identifier: MIT
// Checks, allocates and converts pictures read from files. A picture's size is checked before
// memory for its values is allocated.
#include "image/stored_image.h"

#include <stdlib.h>
#include <string.h>

const char *const stored_text_names[STORED_TEXTS] = {
    [STORED_VERSION] = "clrt:version",       [STORED_SCENE_HASH] = "clrt:scene_hash",
    [STORED_MESH_HASH] = "clrt:mesh_hash",   [STORED_SETTINGS] = "clrt:settings",
    [STORED_DEVICE] = "clrt:device",         [STORED_DRIVER] = "clrt:driver",
    [STORED_PIXEL_HASH] = "clrt:pixel_hash", [STORED_COMPLETE] = "clrt:complete",
};

void stored_image_free(StoredImage *image)
{
    free(image->values);
    *image = (StoredImage){0};
}

uint64_t stored_values_most(uint64_t bytes)
{
    if (bytes >= STORED_VALUES_MAX / STORED_VALUES_PER_BYTE)
        return STORED_VALUES_MAX;
    const uint64_t most = bytes * STORED_VALUES_PER_BYTE;
    return most < STORED_VALUES_LEAST ? STORED_VALUES_LEAST : most;
}

bool stored_image_check_size(const StoredImage *image, uint64_t most, Error *cause)
{
    const uint32_t width = image->width, height = image->height, channels = image->channel_count;
    if (width < 1 || height < 1 || channels < 1)
        return error_set(cause, "it has no pixels");
    const uint64_t pixels = (uint64_t)width * height;
    if (width > STORED_SIDE_MAX || height > STORED_SIDE_MAX || channels > STORED_CHANNELS_MAX ||
        pixels > STORED_VALUES_MAX / channels)
        return error_set(cause, "%u x %u pixels of %u channels are too many", width, height,
                         channels);
    if (pixels > most / channels)
        return error_set(cause, "%u x %u pixels of %u channels are too many for so small a file",
                         width, height, channels);
    return true;
}

bool stored_image_allocate(StoredImage *image, Error *cause)
{
    const size_t pixels = (size_t)image->width * image->height;
    image->values = memory_raw(pixels * image->channel_count, sizeof *image->values, cause);
    return image->values != NULL;
}

int stored_image_channel(const StoredImage *image, const char *name)
{
    for (uint32_t i = 0; i < image->channel_count; i++)
        if (strcmp(image->names[i], name) == 0)
            return (int)i;
    return -1;
}

bool stored_image_colors(const StoredImage *image, uint32_t places[3])
{
    const char *const names[] = {"R", "G", "B"};
    const int gray = stored_image_channel(image, "Y");
    for (int i = 0; i < 3; i++) {
        const int place = stored_image_channel(image, names[i]);
        if (place < 0 && gray < 0)
            return false;
        places[i] = (uint32_t)(place < 0 ? gray : place);
    }
    return true;
}

void stored_image_values(const unsigned char *bytes, size_t count, float *values)
{
    for (size_t i = 0; i < count; i++)
        values[i] = (float)bytes[i] / 255;
}
