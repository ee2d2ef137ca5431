// SPDX-License-Identifier: MIT
// CMakeLists.txt defines the version.
#include "library/clrt.h"

const char *clrt_version(void)
{
    return CLRT_VERSION;
}
