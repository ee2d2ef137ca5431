// SPDX-License-Identifier: MIT
// Pictures -> files, on a thread of its own: loading OpenImageIO would freeze the window.
#pragma once

#include "image/image_file.h"

#include <pthread.h>
#include <stdatomic.h>

#define SAVER_TEXT_SIZE 512

// The first four are the caller's to fill.
typedef struct {
    Framebuffer shown;              // for the 8-bit file, in the window's own values; owned
    Framebuffer traced;             // for the float file; owned
    const char *scene_path;         // which names the files
    char settings[SAVER_TEXT_SIZE]; // told in both
    char notice[SAVER_TEXT_SIZE];   // what was written
    Error error;                    // or why not
    pthread_t thread;
    bool is_running;
    atomic_bool is_done;
    void (*wake)(void);
} Saver;

// Starts writing both pictures beside each other in the current folder; wake is called in the end.
bool saver_start(Saver *saver, void (*wake)(void), Error *error);

// Whether the files have been written, or could not be, since it was asked last.
bool saver_is_done(Saver *saver);

// Waits for the files and frees the pictures.
void saver_finish(Saver *saver);
