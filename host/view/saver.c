// SPDX-License-Identifier: MIT
// Names the files after the scene, with the first free number.
#include "view/saver.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// File extensions for the displayed and the traced picture; NULL if this build lacks the format.
typedef struct {
    const char *shown, *traced;
} Endings;

static Endings endings(void)
{
    const char *png = image_format_named("png"), *exr = image_format_named("exr");
    return (Endings){png, exr != NULL ? exr : image_format_named("pfm")};
}

static bool is_free(const char *stem, unsigned number, const char *ending)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s-%u.%s", stem, number, ending);
    return access(path, F_OK) != 0;
}

// Stores the scene file's name in stem, without folder and extension.
static void write_stem(char stem[SAVER_TEXT_SIZE], const char *scene_path)
{
    const char *slash = strrchr(scene_path, '/');
    const char *name = slash == NULL ? scene_path : slash + 1;
    const char *dot = strrchr(name, '.');
    const size_t length = dot == NULL || dot == name ? strlen(name) : (size_t)(dot - name);
    const int kept = length < SAVER_TEXT_SIZE / 4 ? (int)length : SAVER_TEXT_SIZE / 4;
    snprintf(stem, SAVER_TEXT_SIZE, "%.*s", kept, name);
}

static bool write_one(Saver *saver, const Framebuffer *picture, const char *stem, unsigned number,
                      const char *ending)
{
    char path[PATH_MAX];
    const ImageText text = {"clrt:state", saver->settings};
    const ImageSettings settings = {.format = ending, .texts = &text, .text_count = 1};
    snprintf(path, sizeof path, "%s-%u.%s", stem, number, ending);
    return image_write(picture, path, &settings, &saver->error);
}

static void *save(void *context)
{
    Saver *saver = context;
    char stem[SAVER_TEXT_SIZE];
    unsigned number = 1;
    const Endings names = endings();
    write_stem(stem, saver->scene_path);
    while (!is_free(stem, number, names.traced) ||
           (names.shown != NULL && !is_free(stem, number, names.shown)))
        number++;
    const bool ok =
        (names.shown == NULL || write_one(saver, &saver->shown, stem, number, names.shown)) &&
        write_one(saver, &saver->traced, stem, number, names.traced);
    if (ok && names.shown != NULL)
        snprintf(saver->notice, sizeof saver->notice, "saved %.120s-%u.%s and .%s", stem, number,
                 names.shown, names.traced);
    else if (ok)
        snprintf(saver->notice, sizeof saver->notice, "saved %.120s-%u.%s", stem, number,
                 names.traced);
    atomic_store(&saver->is_done, true);
    saver->wake();
    return NULL;
}

bool saver_start(Saver *saver, void (*wake)(void), Error *error)
{
    saver->wake = wake;
    saver->notice[0] = saver->error.text[0] = '\0';
    atomic_init(&saver->is_done, false);
    saver->is_running = pthread_create(&saver->thread, NULL, save, saver) == 0;
    return saver->is_running || error_set(error, "no thread can be started");
}

bool saver_is_done(Saver *saver)
{
    if (!saver->is_running || !atomic_load(&saver->is_done))
        return false;
    saver_finish(saver);
    return true;
}

void saver_finish(Saver *saver)
{
    if (saver->is_running)
        pthread_join(saver->thread, NULL);
    saver->is_running = false;
    framebuffer_free(&saver->shown);
    framebuffer_free(&saver->traced);
}
