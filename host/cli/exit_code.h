// SPDX-License-Identifier: MIT
// What the process tells whoever started it; 128 + signal when stopped.
#pragma once

typedef enum {
    EXIT_DONE = 0,
    EXIT_FAULTS = 1, // that a check was to find, limits that a comparison breaks, missed goals
    EXIT_USAGE = 2,
    EXIT_SCENE = 3, // or a picture that is read
    EXIT_DEVICE = 4,
    EXIT_OUTPUT = 5
} ExitCode;
