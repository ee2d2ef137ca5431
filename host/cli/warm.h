// SPDX-License-Identifier: MIT
// clrt --warm: kernels are compiled ahead, and nothing is drawn.
#pragma once

#include "cli/exit_code.h"
#include "cli/run.h"

ExitCode warm_kernels(Run *run, Error *error);
