// SPDX-License-Identifier: MIT
// clrt --explain: what of clrt a scene makes use of, what is left out, and why.
#pragma once

#include "cli/exit_code.h"
#include "cli/run.h"

ExitCode explain_scene(Run *run, Error *error);
