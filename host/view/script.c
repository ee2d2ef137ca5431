// SPDX-License-Identifier: MIT
// All keys are played before frames are counted.
#include "view/script.h"

#include <stddef.h>

static bool has_keys(const Script *script)
{
    return script->keys != NULL && script->keys[0] != '\0';
}

bool script_is_running(const Script *script)
{
    return has_keys(script) || script->quit_after > 0;
}

int script_take_key(Script *script)
{
    return has_keys(script) ? (unsigned char)*script->keys++ : 0;
}

bool script_count_frame(Script *script)
{
    if (has_keys(script) || script->quit_after == 0)
        return false;
    return --script->quit_after == 0;
}
