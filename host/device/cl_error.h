// SPDX-License-Identifier: MIT
// OpenCL's status codes by name.
#pragma once

#define CL_TARGET_OPENCL_VERSION 120
#include "base/error.h"

#include <CL/cl.h>

// True for CL_SUCCESS; otherwise records "cannot ATTEMPT: CL_..." and returns false.
bool cl_succeeded(cl_int status, const char *attempt, Error *error);

// "CL_OUT_OF_RESOURCES"; words that say so for a code that is not in the list.
const char *cl_error_name(cl_int status);
