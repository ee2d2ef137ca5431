// SPDX-License-Identifier: MIT
// Runs clrt and reads the PFM file that it writes.
#include "library/program.h"

#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *program_file(const char *name)
{
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", CLRT_SOURCE_FOLDER, name);
    return path;
}

ClrtRenderer *program_renderer(uint32_t threads)
{
    const ClrtSettings settings = {
        .size = sizeof settings, .device = getenv("CLRT_DEVICE"), .threads = threads};
    return clrt_renderer_create(&settings, NULL);
}

// The file starts with the bottom row.
float *program_read(const char *path, uint32_t width, uint32_t height)
{
    uint32_t size[2];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "PF %u %u -1.0", &size[0], &size[1]), 2);
    fgetc(file);
    assert_int_equal(size[0], width);
    assert_int_equal(size[1], height);
    const size_t row = 3 * (size_t)width;
    float *pixels = malloc(row * height * sizeof *pixels);
    assert_non_null(pixels);
    for (uint32_t y = height; y-- > 0;)
        assert_int_equal(fread(pixels + y * row, sizeof *pixels, row, file), row);
    fclose(file);
    return pixels;
}

float *program_draw(const char *scene, const char *options, uint32_t width, uint32_t height)
{
    char command[2048], path[] = "/tmp/clrt-library-XXXXXX.pfm";
    const int file = mkstemps(path, 4);
    assert_true(file >= 0);
    close(file);
    snprintf(command, sizeof command, "'%s' '%s' -q -s %ux%u %s -o %s", CLRT_PROGRAM, scene, width,
             height, options, path);
    assert_int_equal(system(command), 0);
    float *pixels = program_read(path, width, height);
    unlink(path);
    return pixels;
}

bool program_agrees(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtPicture *picture,
                    const float *expected)
{
    const size_t size = 3 * (size_t)picture->width * picture->height * sizeof(float);
    float *rgb = malloc(size);
    const bool same = rgb != NULL && clrt_render(renderer, scene, picture, rgb, NULL) &&
                      memcmp(rgb, expected, size) == 0;
    free(rgb);
    return same;
}
