// SPDX-License-Identifier: MIT
// Pictures -> files, on a thread, because loading OpenImageIO would freeze the window.
#pragma once

#include "image/image_file.h"

#include <pthread.h>
#include <stdatomic.h>

#define SAVER_TEXT_SIZE 512

// The caller fills the first four members.
typedef struct {
    Framebuffer shown;              // for the 8-bit file, in the window's values; owned
    Framebuffer traced;             // for the float file; owned
    const char *scene_path;         // names the files
    char settings[SAVER_TEXT_SIZE]; // stored in both files
    char notice[SAVER_TEXT_SIZE];   // the files written
    Error error;                    // or the reason for a failure
    pthread_t thread;
    bool is_running;
    atomic_bool is_done;
    void (*wake)(void);
} Saver;

// Starts writing both pictures to the current folder; calls wake at the end.
bool saver_start(Saver *saver, void (*wake)(void), Error *error);

// Returns true once, when writing has succeeded or failed.
bool saver_is_done(Saver *saver);

// Waits for the files and frees the pictures.
void saver_finish(Saver *saver);
