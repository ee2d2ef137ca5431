// SPDX-License-Identifier: MIT
// The same rays and the same judge for all.
#include "trial.h"

#include "check.h"

#include <math.h>
#include <stdlib.h>

void trial_open(Trial *trial, const char *test, RayBatch *batch, const Stage *stage)
{
    *trial = (Trial){.test = test, .batch = batch};
    ray_batch_upload(batch, &stage->flat);
    peers_open(&trial->peers, stage);
}

void trial_close(Trial *trial)
{
    peers_close(&trial->peers);
}

void fails_add(Fails *sum, const Fails *more)
{
    sum->ours += more->ours;
    sum->peers.known = more->peers.known;
    sum->peers.plain += more->peers.plain;
    sum->peers.robust += more->peers.robust;
}

Fails trial_fails(const Trial *trial, const TestRay *rays, size_t count, const Judgment *judgment)
{
    Error error = {0};
    TestHit *hits = memory_raw(count, sizeof *hits, &error);
    require(hits != NULL, &error);
    ray_batch_trace(trial->batch, BATCH_NEAREST, rays, count, hits);
    const size_t wrong = judgment->count_wrong(judgment->context, rays, hits, count);
    free(hits);
    return (Fails){wrong, peers_judge(&trial->peers, rays, count, judgment)};
}

size_t report_fails(const char *test, const char *details, size_t rays, const Fails *fails)
{
    return report(&(Case){test, details, rays, fails->ours, 0, fails->peers});
}

size_t trial_judge(const Trial *trial, const char *details, const TestRay *rays, size_t count,
                   const Judgment *judgment)
{
    const Fails fails = trial_fails(trial, rays, count, judgment);
    return report_fails(trial->test, details, count, &fails);
}

static size_t count_misses(void *context, const TestRay *rays, const TestHit *hits, size_t count)
{
    size_t misses = 0;
    (void)context;
    (void)rays;
    for (size_t i = 0; i < count; i++)
        misses += hits[i].id == NOTHING || !(hits[i].t < INFINITY);
    return misses;
}

const Judgment judgment_misses = {count_misses, NULL};

size_t trial_misses(const Trial *trial, const char *details, const TestRay *rays, size_t count)
{
    return trial_judge(trial, details, rays, count, &judgment_misses);
}
