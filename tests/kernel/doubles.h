// SPDX-License-Identifier: MIT
// Kernel text -> how many of its lines name a double although they are compiled without fp64.
#pragma once

#include <stddef.h>

// By the preprocessor's conditions: lines between "#if CLRT_FP64" and its #else or #elif, and
// behind the #else of "#if !CLRT_FP64", are left to fp64, with all conditions within; comments do
// not count.
size_t doubles_without_fp64(const char *source);
