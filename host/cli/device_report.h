// SPDX-License-Identifier: MIT
// clrt --list-devices: the OpenCL devices on standard output.
#pragma once

#include "base/error.h"
#include "cli/exit_code.h"

// As clinfo prints them, or as versioned JSON.
ExitCode device_report_write(bool as_json, Error *error);
