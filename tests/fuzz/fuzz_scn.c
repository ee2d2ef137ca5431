// SPDX-License-Identifier: MIT
// libFuzzer target: parses any bytes as scene text. The scene's folder is missing, so clrt reads no
// meshes. fuzz_ply.c tests meshes.
#include "demand.h"

#include "scene/normalize.h"
#include "scene/scn.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    Scene scene;
    Error error = {0};
    if (scn_parse(&scene, (const char *)data, size, "/nowhere/fuzz.scn", &error)) {
        Error cause = {0};
        const Normalization normalization = normalization_of(&scene);
        normalization_check(&normalization, &scene, &cause);
        scene_free(&scene);
    }
    return 0;
}
