// SPDX-License-Identifier: MIT
// The faults that libpng reports by a jump. Whether its files hold the picture is checked by
// cli/test_files.py.
#include "image/formats.h"

#include "unit/cmocka_all.h"

#include <stdlib.h>

static const ImageSettings plain = {.format = "png"};

// Returns a picture of different pixels. Its file is too large to stay in the buffers of libpng or
// streams.
static Framebuffer noise(uint32_t width, uint32_t height)
{
    Framebuffer framebuffer;
    Error error = {0};
    assert_true(framebuffer_make(&framebuffer, width, height, &error));
    uint32_t state = 1;
    for (size_t i = 0; i < (size_t)3 * width * height; i++) {
        state = state * 1664525 + 1013904223;
        framebuffer.pixels[i / 3][i % 3] = (float)(state >> 8) / 0x1p24f;
    }
    return framebuffer;
}

TEST(a_full_device_is_a_fault_with_its_reason)
{
    FREED_BY(framebuffer_free) Framebuffer framebuffer = noise(256, 256);
    FILE *full = fopen("/dev/full", "wb");
    assert_non_null(full);
    Error error = {0};
    assert_false(png_file_write(&framebuffer, &plain, full, &error));
    assert_string_equal(error.text, "No space left on device");
    fclose(full);
}

TEST(what_libpng_refuses_is_a_fault_and_says_nothing_itself)
{
    // The width exceeds libpng's limit, which fails before any pixel is read.
    const Framebuffer wide = {NULL, 1000001, 1};
    char *written = NULL, *said = NULL;
    size_t size, said_size;
    FILE *stream = open_memstream(&written, &size);
    FILE *console = stderr;
    stderr = open_memstream(&said, &said_size);
    Error error = {0};
    const bool ok = png_file_write(&wide, &plain, stream, &error);
    fclose(stderr);
    stderr = console;
    fclose(stream);
    assert_false(ok);
    assert_string_equal(error.text, "Invalid IHDR data");
    assert_string_equal(said, "");
    free(written);
    free(said);
}
