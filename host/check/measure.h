// SPDX-License-Identifier: MIT
// Scene -> the measurements of a check. The program and the library check scenes in three steps:
// check_measure, check_trace and check_find.
#pragma once

#include "check/findings.h"

// Measures the meshes of check->scene without a device.
bool check_measure(Check *check, Error *error);

// Casts rays at the meshes, after check_measure. On failure, check->device is NULL.
bool check_trace(Check *check, Session *session, Error *error);

void check_free(Check *check);
