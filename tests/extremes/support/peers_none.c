// SPDX-License-Identifier: MIT
// Replaces peers.c without Embree 3.
#include "peers.h"

void peers_open(Peers *peers, const Stage *stage)
{
    (void)stage;
    *peers = (Peers){0};
}

void peers_close(Peers *peers)
{
    (void)peers;
}

TestHit *peers_trace(const Peers *peers, RayTracer tracer, Rays rays)
{
    (void)peers, (void)tracer, (void)rays;
    return NULL;
}
