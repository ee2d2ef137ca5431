// SPDX-License-Identifier: MIT
// A part that a scene does not need -> what leaving it out of the kernels saves, as it was measured
// on one machine (tests/bench/traits.txt).
#pragma once

#include "cli/scene_parts.h"

typedef struct {
    double with, without; // seconds of compiling
    double least, most;   // times of tracing with it, the time without being 1, over scenes
} PartCost;

// Shares of what it would take with the part; what is within SAVING_NOISE is noise.
typedef struct {
    double compiling;
    double tracing_least, tracing_most;
} Saving;

#define SAVING_NOISE 0.03
#define SAVING_TEXT  96

// The machine and the programs that were measured, as the end of a sentence.
const char *saving_source(KernelFamily family);

PartCost saving_measured(ScenePartKind kind, KernelFamily family);
Saving saving_of(ScenePartKind kind, KernelFamily family);

// Whether leaving out that part is what saves: code of trees goes with that of triangles.
bool saving_is_own(const ScenePart parts[SCENE_PARTS], ScenePartKind kind);

// "saves ..." of a part that is left out.
void saving_describe(const ScenePart parts[SCENE_PARTS], ScenePartKind kind, KernelFamily family,
                     char text[SAVING_TEXT]);
