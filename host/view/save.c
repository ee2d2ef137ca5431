// SPDX-License-Identifier: MIT
// Names the files after the scene, with the first free number.
#include "view/viewer_inside.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define NAME_SIZE 512

static bool is_free(const char *stem, const char *ending)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s.%s", stem, ending);
    return access(path, F_OK) != 0;
}

// Stores the scene file's name without folder and extension, and with a number.
static void write_stem(char stem[NAME_SIZE], const char *scene_path, const char *float_ending)
{
    const char *slash = strrchr(scene_path, '/');
    const char *name = slash == NULL ? scene_path : slash + 1;
    const char *dot = strrchr(name, '.');
    const size_t length = dot == NULL || dot == name ? strlen(name) : (size_t)(dot - name);
    const int kept = length < NAME_SIZE / 4 ? (int)length : NAME_SIZE / 4;
    unsigned number = 1;
    do
        snprintf(stem, NAME_SIZE, "%.*s-%u", kept, name, number++);
    while (!is_free(stem, "png") || !is_free(stem, float_ending));
}

static bool write_one(const Framebuffer *picture, const char *stem, const char *ending,
                      const char *state, Error *error)
{
    char path[PATH_MAX];
    const ImageText text = {"clrt:state", state};
    const ImageSettings settings = {.format = ending, .texts = &text, .text_count = 1};
    snprintf(path, sizeof path, "%s.%s", stem, ending);
    return image_write(picture, path, &settings, error);
}

bool pictures_save(const Framebuffer *shown, const Framebuffer *traced, const SaveText *text,
                   Error *error)
{
    char stem[NAME_SIZE];
    const char *float_ending = image_format_named("exr") != NULL ? "exr" : "pfm";
    write_stem(stem, text->scene_path, float_ending);
    if (!write_one(shown, stem, "png", text->state, error) ||
        !write_one(traced, stem, float_ending, text->state, error))
        return false;
    snprintf(text->notice, NOTICE_SIZE, "saved %.160s.png and .%s", stem, float_ending);
    return true;
}
