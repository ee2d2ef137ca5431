// SPDX-License-Identifier: MIT
// Scenes with features that no scene of the course has: open two-sided meshes, a mirror ball seen
// from inside, a huge sphere far away, distant lights, orthographic cameras, suns, and checkers.
#pragma once

#define UNUSUAL(name) CLRT_SOURCE_FOLDER "/tests/image/" name ".scn"

static const char *const unusual_scenes[] = {
    UNUSUAL("open_sheet"),   UNUSUAL("mirrors"), UNUSUAL("far_away"), UNUSUAL("distant_lights"),
    UNUSUAL("orthographic"), UNUSUAL("suns"),    UNUSUAL("checkered")};
#define UNUSUAL_COUNT (sizeof unusual_scenes / sizeof *unusual_scenes)
