// SPDX-License-Identifier: MIT
// clrt merge: the parts of a picture -> the whole.
#pragma once

#include "cli/exit_code.h"
#include "cli/options/options.h"

ExitCode merge_parts(const Options *options, Error *error);
