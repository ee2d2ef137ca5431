// SPDX-License-Identifier: MIT
// Runs the probe kernels: buffers in, one buffer out.
#pragma once

#include "device/program.h"

typedef struct {
    Device device;
    Program program;
} Probe;

// One input array of a kernel, in the order of its arguments.
typedef struct {
    const void *data;
    size_t size;
} ProbeInput;

bool probe_open(Probe *probe, const KernelChoice *choice, Error *error);
void probe_close(Probe *probe);

// As a group's setup: opens it for one ray a work-item, or prints why it cannot; returns 0 or 1.
int probe_begin(Probe *probe, Precision precision);

// Runs kernel for items work-items over up to two inputs (the rest of the list has size 0) and
// reads size bytes of its output, its last argument.
bool probe_run(const Probe *probe, const char *kernel, const ProbeInput inputs[2], size_t items,
               ProbeInput output);
