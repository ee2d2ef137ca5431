// SPDX-License-Identifier: MIT
// Declarations that the fuzz targets share.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// Reports a finding unless the promise holds. Unlike assert, demand does not depend on NDEBUG.
static inline void demand(bool promise)
{
    if (!promise)
        abort();
}
