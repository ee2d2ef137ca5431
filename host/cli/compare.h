// SPDX-License-Identifier: MIT
// clrt compare: two picture files, how much they differ, and whether that keeps within limits.
#pragma once

#include "cli/exit_code.h"
#include "cli/options/options.h"

// Writes the report, and the picture of the differences where the options name one.
ExitCode compare_files(const Options *options, Error *error);
