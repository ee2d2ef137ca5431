// SPDX-License-Identifier: MIT
// clrt --explain-pixel: how one pixel's color comes about.
#pragma once

#include "cli/exit_code.h"
#include "cli/run.h"

ExitCode explain_pixel(Run *run, Error *error);
