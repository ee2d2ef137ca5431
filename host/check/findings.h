// SPDX-License-Identifier: MIT
// Measurements of a check -> findings. Each finding states whether the check fails because of it.
#pragma once

#include "check/census.h"
#include "session/session.h"

// The check casts rays at no more than this number of aims per mesh.
#define LEAKS_AIMS 1048576

typedef struct {
    const char *scene_path;
    const Scene *scene; // borrowed
    Normalization normalization;
    Census census;
    const char *device; // the device's name; NULL if no rays were traced
    Error scale_fault;  // the reason why the scene cannot be drawn; empty if it can be drawn
    Error device_fault; // the reason why no rays could be traced; empty otherwise
    ARRAY(ClrtFinding) findings; // for each object in order, then for the scene
    bool is_cut;                 // memory ran out, so findings are missing
    double seconds;
} Check;

// Derives the findings from the measurements. Fails if memory runs out.
bool check_find(Check *check, Error *error);

size_t check_count_failing(const Check *check);

// Returns the path of a mesh's file, or NULL if a program has made the mesh.
const char *check_mesh_path(const Check *check, size_t object);

// Returns the fault's identifier in JSON.
const char *fault_name(FaultKind kind);
