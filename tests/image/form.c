// SPDX-License-Identifier: MIT
// Reads the form of the kernels from CLRT_TEST_KERNEL. The choice does not change during a process.
#include "image/form.h"

#include "device/device.h"
#include "image/shared_cache.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const KernelChoice form_all[FORMS] = {
    {FAMILY_RAY, NODES_PAIR, 0, CLRT_FP32},     {FAMILY_RAY, NODES_WIDE, 0, CLRT_FP32},
    {FAMILY_PACKET, NODES_WIDE, 16, CLRT_FP32}, {FAMILY_PACKET, NODES_WIDE, 8, CLRT_FP32},
    {FAMILY_PACKET, NODES_WIDE, 4, CLRT_FP32},  {FAMILY_RAY, NODES_PAIR, 0, CLRT_FP64}};

const KernelChoice form_few[FORMS_FEW] = {{FAMILY_RAY, NODES_PAIR, 0, CLRT_FP32},
                                          {FAMILY_RAY, NODES_WIDE, 0, CLRT_FP32},
                                          {FAMILY_PACKET, NODES_WIDE, 0, CLRT_FP32},
                                          {FAMILY_RAY, NODES_PAIR, 0, CLRT_FP64}};

static const struct {
    const char *name;
    KernelChoice choice;
} forms[] = {{"pair", {FAMILY_RAY, NODES_PAIR, 0, CLRT_FP32}},
             {"wide", {FAMILY_RAY, NODES_WIDE, 0, CLRT_FP32}},
             {"packet", {FAMILY_PACKET, NODES_WIDE, 0, CLRT_FP32}},
             {"packet16", {FAMILY_PACKET, NODES_WIDE, 16, CLRT_FP32}},
             {"packet8", {FAMILY_PACKET, NODES_WIDE, 8, CLRT_FP32}},
             {"packet4", {FAMILY_PACKET, NODES_WIDE, 4, CLRT_FP32}},
             {"fp64", {FAMILY_RAY, NODES_PAIR, 0, CLRT_FP64}}};

static KernelChoice named_choice(const char *name)
{
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (strcmp(name, forms[i].name) == 0)
            return forms[i].choice;
    fprintf(stderr, "CLRT_TEST_KERNEL is '%s', which names no form of the kernels\n", name);
    exit(1);
}

static KernelChoice usual_choice(void)
{
    Device device;
    Error error = {0};
    const ClrtSettings nothing = {0};
    shared_cache();
    if (!device_open(&device, getenv("CLRT_DEVICE"), &error)) {
        fprintf(stderr, "%s\n", error.text);
        exit(1);
    }
    const KernelChoice choice = kernel_choice_make(&nothing, &device);
    device_close(&device);
    return choice;
}

KernelChoice form_on_device(const KernelChoice *form, const Device *device)
{
    const bool is_gpu = (device->type & CL_DEVICE_TYPE_GPU) != 0;
    return is_gpu && form->family == FAMILY_PACKET ? form_all[0] : *form;
}

KernelChoice form_choice(void)
{
    static bool is_known;
    static KernelChoice choice;
    const char *name = getenv("CLRT_TEST_KERNEL");
    if (!is_known)
        choice = name != NULL ? named_choice(name) : usual_choice();
    is_known = true;
    return choice;
}
