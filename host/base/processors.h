// SPDX-License-Identifier: MIT
// The number of processors, and how many of them the process may use.
#pragma once

#include <stdint.h>

uint32_t processors_present(void);

// Returns the number allowed by the process's affinity and by its control groups' quotas.
uint32_t processors_usable(void);
