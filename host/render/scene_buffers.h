// SPDX-License-Identifier: MIT
// FlatScene -> its arrays on a device.
#pragma once

#include "accel/flat.h"
#include "accel/traits.h"
#include "device/device.h"

// A scene on a device.
typedef struct {
    const Device *device;       // borrowed; NULL if the scene is not uploaded
    cl_mem arrays[FLAT_ARRAYS]; // in the order of the kernels' arguments
    FrameData frame;            // members that depend on the scene alone
    SceneTraits traits;         // without statistics
    float reflectivity;         // largest reflectivity of materials in use
    size_t size;                // bytes
    double seconds;             // time of the upload
} SceneBuffers;

// Uploads the scene, or shares its memory with the device. `flat` must outlive the buffers.
bool scene_buffers_make(SceneBuffers *buffers, const Device *device, const FlatScene *flat,
                        Error *error);
void scene_buffers_free(SceneBuffers *buffers);
