// SPDX-License-Identifier: MIT
// Memory of the channels.
#include "image/layers.h"

#include <stdlib.h>

bool layers_make(Layers *layers, uint32_t width, uint32_t height, Error *error)
{
    layers->width = width;
    layers->height = height;
    layers->values =
        memory_zeroed((size_t)width * height, layers->count * sizeof *layers->values, error);
    return layers->values != NULL;
}

void layers_free(Layers *layers)
{
    free(layers->values);
    *layers = (Layers){0};
}
