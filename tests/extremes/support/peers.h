// SPDX-License-Identifier: MIT
// Embree 3 on the rays that clrt is judged by, in its default and in its robust mode, where it is
// installed and CLRT_TEST_PEERS is set.  It has no frame of its own, so it gets triangles and rays
// in the file's coordinates, as its users would give them.
#pragma once

#include "ray_batch.h"
#include "stage.h"

// How many rays each mode fails.
typedef struct {
    bool known;
    size_t plain, robust;
} PeerFails;

// Counts the rays whose hits are wrong.
typedef struct {
    size_t (*count_wrong)(void *context, const TestRay *rays, const TestHit *hits, size_t count);
    void *context; // count_wrong may keep its own notes there
} Judgment;

typedef struct {
    void *device, *plain, *robust; // NULL where there is no Embree
    Normalization normalization;
} Peers;

// Only scenes of triangles alone are known to the peers.
void peers_open(Peers *peers, const Stage *stage);
void peers_close(Peers *peers);

PeerFails peers_judge(const Peers *peers, const TestRay *rays, size_t count,
                      const Judgment *judgment);
