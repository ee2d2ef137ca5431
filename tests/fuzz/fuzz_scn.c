// SPDX-License-Identifier: MIT
// libFuzzer target for scene text. Meshes resolve beside a folder that is not there, so that
// only the text is under test; PLY has a target of its own.
#include "scene/normalize.h"
#include "scene/scn.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

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
