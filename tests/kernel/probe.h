// SPDX-License-Identifier: MIT
// Runs the probe kernels with input buffers and one output buffer.
#pragma once

#include "device/program.h"

typedef struct {
    Device device;
    Program program;
} Probe;

// An input or output array of a kernel. Inputs have the order of the kernel's arguments.
typedef struct {
    const void *data;
    size_t size;
} ProbeInput;

// Sets up a group of tests: compiles the file for one ray per work-item. Returns 0, or prints the
// error and returns 1.
int probe_begin(Probe *probe, const char *path, ClrtPrecision precision);
void probe_close(Probe *probe);

// Runs kernel with `items` work-items and up to two inputs; unused inputs have size 0. Reads
// output.size bytes of the kernel's last argument.
bool probe_run(const Probe *probe, const char *kernel, const ProbeInput inputs[2], size_t items,
               ProbeInput output);
