// SPDX-License-Identifier: MIT
// One machine-readable line for each case of a test:
// T-03 form=packet k=10 rays=100000 fail=0 limit=0 embree_default=33859 embree_robust=1245
// gather.py makes a table of them.  `rays` counts the items of the case: rays, pixels or boxes.
#pragma once

#include "peers.h"

typedef struct {
    const char *test, *details;
    size_t rays, fail, limit;
    PeerFails peers;
} Case;

// Prints the line and returns by how much fail is past the limit, for the test to add up: all its
// cases are to be seen, not only those before the first failure.
size_t report(const Case *made);

// The same with limit 0 and without peers.
size_t report_case(const char *test, const char *details, size_t rays, size_t fail);

// Prints that a test has nothing to run on here, and why.
void report_passed_over(const char *test, const char *reason);
