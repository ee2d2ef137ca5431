// SPDX-License-Identifier: MIT
// A picture beside the one that the fp64 oracle draws of the same scene.
#pragma once

#include "picture.h"

typedef struct {
    size_t pixels;
    size_t differing;   // of those, by more than 1/255
    size_t unexplained; // of those: no edge or crease passes within a pixel of them
    size_t faults;      // pixels that hold a value outside [0, 1] or none
} PictureJudgment;

// Draws the scene's first viewpoint with clrt, and that of exact with the oracle: the same scene,
// or where that is undecided one beside it that is not.
PictureJudgment picture_judge(const Studio *studio, const Scene *scene, const Scene *exact,
                              const PictureSettings *settings);

// The judgment as a reported case, which fails by faults and unexplained pixels.
size_t picture_report_judgment(const char *test, const char *details,
                               const PictureJudgment *judgment);

// The same of the scene beside itself.
size_t picture_report(const char *test, const char *details, const Studio *studio,
                      const Scene *scene, const PictureSettings *settings);
