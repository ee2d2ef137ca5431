// SPDX-License-Identifier: MIT
// Pictures -> files.
#pragma once

#include "image/image_file.h"

#define SAVER_TEXT_SIZE 512

typedef struct {
    Framebuffer shown;              // for the 8-bit file, in the window's values; owned
    const char *scene_path;         // determines the files' names
    char settings[SAVER_TEXT_SIZE]; // stored in both files
    char notice[SAVER_TEXT_SIZE];   // message with the written files; empty after a failure
    Error error;                    // empty without a failure
} Saver;

// Writes the shown picture and the traced one to the current folder. Fills notice or error.
void saver_write(Saver *saver, const Framebuffer *traced);
