// SPDX-License-Identifier: MIT
// The options whose values are numbers, names and sizes, or which have none.
#pragma once

#include "cli/options.h"

// Takes an option's value, NULL where it was given none; false where it is not understood.
typedef bool ReadValue(Options *options, const char *value, Error *error);

ReadValue read_aa, read_aa_adaptive, read_error, read_time, read_aov, read_explain_pixel,
    read_explain, read_no_metadata, read_hash, read_crop, read_part_of, read_resume, read_frames,
    read_turntable, read_expect_hash, read_output, read_format, read_view, read_size, read_repeat,
    read_tile, read_group, read_no_bvh, read_max_level, read_device, read_warm, read_threads,
    read_stats, read_keys, read_quit_after, read_reference, read_reference_samples, read_json,
    read_fail, read_quiet, read_verbose, read_help, read_version;
