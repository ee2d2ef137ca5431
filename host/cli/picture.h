// SPDX-License-Identifier: MIT
// Options -> a picture file.
#pragma once

#include "cli/exit_code.h"
#include "cli/run.h"

ExitCode picture_make(Run *run, Error *error);
