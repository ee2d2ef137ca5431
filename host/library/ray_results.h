// SPDX-License-Identifier: MIT
// The device's hits -> ClrtHits.
#pragma once

#include "library/ray_batch.h"

// Stores the results of the cast in the caller's arrays.
void ray_results_store(RayBatch *batch);
