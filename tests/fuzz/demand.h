// SPDX-License-Identifier: MIT
// Declarations that the fuzz targets share.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// Aborts if the promise is false. libFuzzer reports this. Unlike assert, demand ignores NDEBUG.
static inline void demand(bool promise)
{
    if (!promise)
        abort();
}
