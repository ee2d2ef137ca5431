// SPDX-License-Identifier: MIT
// The version, as CMakeLists.txt gives it.
#include "library/clrt.h"

const char *clrt_version(void)
{
    return CLRT_VERSION;
}
