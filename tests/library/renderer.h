// SPDX-License-Identifier: MIT
// Opens a renderer with default settings on the device that CLRT_DEVICE names. All tests of a
// program share it.
#pragma once

#include "library/program.h"
#include "unit/cmocka_all.h"

static ClrtRenderer *renderer;

SET_UP(open_renderer)
{
    renderer = program_renderer(0);
    return renderer == NULL;
}

TEAR_DOWN(close_renderer)
{
    clrt_renderer_free(renderer);
    return 0;
}
