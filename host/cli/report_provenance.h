// SPDX-License-Identifier: MIT
// Report -> Provenance and the hash of the pixels.
#pragma once

#include "cli/report.h"
#include "image/provenance.h"

void report_fill_provenance(Provenance *provenance, const Report *report);

// Prints the hash of the pixels if the options ask for it.  Fails if it differs from the expected
// hash.
bool report_print_hash(const Options *options, const char *hash, Error *error);
