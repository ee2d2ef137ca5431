// SPDX-License-Identifier: MIT
// A status of OpenCL -> success, or an error's text.
#pragma once

#define CL_TARGET_OPENCL_VERSION 120

#include "base/error.h"

#include <CL/cl.h>

// Returns true for CL_SUCCESS. Otherwise records "cannot ATTEMPT: CL_..." and returns false.
bool cl_succeeded(cl_int status, const char *attempt, Error *error);

// Returns a name like "CL_OUT_OF_RESOURCES", or a phrase for an unknown code.
const char *cl_error_name(cl_int status);
