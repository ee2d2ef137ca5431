// SPDX-License-Identifier: MIT
// Setters of options whose values fit none of the table's kinds.
#pragma once

#include "cli/options/option.h"

SetOption set_output, set_format, set_aov, set_expect_hash, set_crop, set_max_level, set_error,
    set_time, set_no_bvh, set_frames, set_part, set_list_devices, set_stats, set_reference,
    set_reference_samples, set_explain_pixel, set_fail, set_json;
