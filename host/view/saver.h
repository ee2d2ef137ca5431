// SPDX-License-Identifier: MIT
// Pictures -> files. A thread writes them, because loading OpenImageIO would freeze the window.
#pragma once

#include "image/image_file.h"

#include <pthread.h>
#include <stdatomic.h>

#define SAVER_TEXT_SIZE 512

// The caller fills the first four members.
typedef struct {
    Framebuffer shown;              // for the 8-bit file, in the window's values; owned
    Framebuffer traced;             // for the float file; owned
    const char *scene_path;         // determines the files' names
    char settings[SAVER_TEXT_SIZE]; // stored in both files
    char notice[SAVER_TEXT_SIZE];   // message with the written files
    Error error;                    // the reason for a failure
    pthread_t thread;
    bool is_running;
    atomic_bool is_done;
    void (*wake)(void);
} Saver;

// Starts a thread that writes both pictures to the current folder and then calls wake.
bool saver_start(Saver *saver, void (*wake)(void), Error *error);

// Returns true once after writing has succeeded or failed, and then frees the pictures.
bool saver_is_done(Saver *saver);

// Waits for the files and frees the pictures.
void saver_finish(Saver *saver);
