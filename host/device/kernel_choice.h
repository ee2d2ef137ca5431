// SPDX-License-Identifier: MIT
// The choice of kernels by the user, as the switches of kernels/config.h. All choices with one
// precision render the same picture.
#pragma once

#include "accel/flat.h"
#include "device/device.h"

typedef enum {
    FAMILY_RAY,   // a work-item renders a pixel
    FAMILY_PACKET // a work-item renders a block of PACKET_SIDE x PACKET_SIDE pixels
} KernelFamily;

typedef enum {
    PRECISION_FP32,
    PRECISION_FP64 // the reference: the same float scene in double arithmetic
} Precision;

// Packets traverse wide nodes only; fp64 has rays and pairs only.
typedef struct {
    KernelFamily family;
    NodeLayout nodes;
    uint32_t lanes; // of the kernels' vectors: 4, 8 or 16; 0 lets the target decide
    Precision precision;
} KernelChoice;

// The user's request. 0 leaves each of the first three to the device.
typedef struct {
    int family; // 1 + a KernelFamily
    int nodes;  // 1 + a NodeLayout
    int lanes;  // 1, 2 or 3 for 4, 8 or 16
    Precision precision;
} KernelRequest;

// Rejects contradictory requests.
bool kernel_check_request(const KernelRequest *request, Error *error);

// Returns the request, completed by a fixed rule: packets on CPUs; rays over pairs on other
// devices, in fp64, and on OpenCL implementations that are slow with packets.
KernelChoice kernel_choose(const KernelRequest *request, const Device *device);

// Returns whether packets finish a picture sooner, compilation included.
bool kernel_suits_packets(const Device *device);

// Returns the side of the work-groups that suit the kernels, in work-items.
uint32_t kernel_group_side(const KernelChoice *choice);

// Fails if the device cannot run the kernels of the choice.
bool kernel_check_device(const KernelChoice *choice, const Device *device, Error *error);

#define KERNEL_OPTIONS_SIZE 80

// Writes the compiler options that set the switches, as a string of less than KERNEL_OPTIONS_SIZE
// bytes.
void kernel_write_options(const KernelChoice *choice, char options[KERNEL_OPTIONS_SIZE]);

const char *kernel_family_name(KernelFamily family);
const char *kernel_nodes_name(NodeLayout nodes);
const char *kernel_precision_name(Precision precision);
