// SPDX-License-Identifier: MIT
// Opens and closes the viewer repeatedly in one process, also without fonts. The numbers of open
// files and threads must not grow. Memory may grow by less than BYTES_A_CYCLE per cycle. In builds
// with AddressSanitizer, no byte may leak.
#include "base/file.h"
#include "device/cache.h"
#include "unit/cmocka_all.h"
#include "view/viewer.h"
#include "view/window.h"

#include <dirent.h>
#include <malloc.h>
#include <string.h>

#define CYCLES     40 // enough to detect growth
#define WARMING_UP 14 // growth in these cycles does not count

// The allowed growth of memory per cycle is three times the memory that PoCL keeps for each kernel.
// A leaked picture would take at least six times the allowed growth.
#define BYTES_A_CYCLE 32768

static Cache cache;

// Overrides dlclose of the C library, so that drivers stay loaded. The sanitizer can then report
// which driver allocated a block. The loader binds calls to this function only if it is exported.
__attribute__((visibility("default"))) int dlclose(void *handle)
{
    (void)handle;
    return 0;
}

static void show_once(const char *keys)
{
    Error error = {0};
    const ViewerSettings settings = {
        .scene_path = CLRT_SOURCE_FOLDER "/scenes/simple.scn",
        .view = 1,
        .width = 256,
        .height = 256,
        .samples = 2,
        .uses_bvh = true,
        .worker = {.session = {.wanted = {.threads = 2}}, .cache = cache},
        .keys = keys,
        .patience = 60};
    bool is_stopped;
    if (viewer_run(&settings, &is_stopped, &error) != VIEWER_CLOSED)
        fail_msg("%s", error.text);
    assert_true(is_stopped);
}

// The linker replaces calls of window_open, window_is_lost and file_read by the __wrap_ functions.
static int losses, openings;
bool __real_window_is_lost(const Window *window);
bool __wrap_window_is_lost(const Window *window);
bool __real_window_open(Window *window, const char *title, uint32_t width, uint32_t height,
                        Error *error);
bool __wrap_window_open(Window *window, const char *title, uint32_t width, uint32_t height,
                        Error *error);

bool __wrap_window_is_lost(const Window *window)
{
    return losses-- > 0 || __real_window_is_lost(window);
}

bool __wrap_window_open(Window *window, const char *title, uint32_t width, uint32_t height,
                        Error *error)
{
    openings++;
    return __real_window_open(window, title, width, height, error);
}

static int fonts_missed = -1; // number of hidden fonts; -1 hides none
bool __real_file_read(File *file, const char *path, Error *error);
bool __wrap_file_read(File *file, const char *path, Error *error);

bool __wrap_file_read(File *file, const char *path, Error *error)
{
    if (fonts_missed < 0 || strncmp(path, "/usr/share/fonts/", 17) != 0)
        return __real_file_read(file, path, error);
    fonts_missed++;
    return error_set(error, "the test hides all fonts");
}

TEST(a_window_without_a_font_shows_pictures)
{
    fonts_missed = 0;
    show_once("hrRq");
    assert_true(fonts_missed > 1);
    fonts_missed = -1;
}

TEST(a_lost_context_is_made_anew)
{
    openings = 0;
    losses = 2;
    show_once("rBnq");
    assert_int_equal(openings, 3);
    assert_true(losses < 0);
}

static int count_entries(const char *folder)
{
    int count = 0;
    DIR *entries = opendir(folder);
    assert_non_null(entries);
    while (readdir(entries) != NULL)
        count++;
    closedir(entries);
    return count;
}

typedef struct {
    size_t bytes;
    int files, threads;
} Usage;

static Usage measure(void)
{
    const struct mallinfo2 memory = mallinfo2();
    return (Usage){memory.uordblks + memory.hblkhd, count_entries("/proc/self/fd"),
                   count_entries("/proc/self/task")};
}

// Returns the number of bytes that GLFW and Mesa keep for each connection to the display. Mesa 25
// never frees the connection's 480 configurations.
static double bytes_kept_by_drivers(void)
{
    const int connections = 5;
    Usage before = {0};
    for (int i = 0; i <= connections; i++) {
        assert_true(glfwInit());
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        assert_non_null(glfwCreateWindow(64, 64, "drivers", NULL, NULL));
        glfwTerminate();
        if (i == 0)
            before = measure();
    }
    return ((double)measure().bytes - (double)before.bytes) / connections;
}

TEST(many_windows_leave_nothing_behind)
{
    const double kept_by_drivers = bytes_kept_by_drivers();
    Usage before = {0};
    for (int cycle = 0; cycle < CYCLES; cycle++) {
        show_once(cycle % 2 == 0 ? "q" : "rBq");
        if (cycle == WARMING_UP)
            before = measure();
    }
    const Usage after = measure();
    const double growth = ((double)after.bytes - (double)before.bytes) / (CYCLES - 1 - WARMING_UP);
    print_message("%.0f bytes a cycle, %.0f of them kept by drivers, %d files, %d threads\n",
                  growth, kept_by_drivers, after.files, after.threads);
    assert_int_equal(after.files, before.files);
    assert_int_equal(after.threads, before.threads);
    assert_true(growth - kept_by_drivers < BYTES_A_CYCLE);
}

SET_UP(open_cache)
{
    cache_private_open(&cache);
    return 0;
}
