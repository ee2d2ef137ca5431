// SPDX-License-Identifier: MIT
// How many processors there are, and how many of them the process may use.
#pragma once

#include <stdint.h>

uint32_t processors_present(void);

// Those that its affinity and the quotas of its control groups allow.
uint32_t processors_usable(void);
