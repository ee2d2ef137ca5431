// SPDX-License-Identifier: MIT
// Pictures have the recorded pixel hashes, on every device, PoCL target and compiler setting.
// Usage: test_hashes SIZE [VIEWS] checks the recorded pictures of that size and of views up to
// VIEWS. CLRT_TEST_SCENES limits it to the listed scenes. `test_hashes list SIZE` prints the lines
// to record. CLRT_TEST_OPTIONS contains options for the compiler of kernels.
#include "image/course.h"
#include "image/picture.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define RECORD CLRT_SOURCE_FOLDER "/tests/image/hashes.txt"

static unsigned wanted_size, most_views = 99;

static const char *const own_scenes[] = {"silhouette", "matte",    "blinn_phong", "reflections",
                                         "simple",     "creature", "figure",      "coral",
                                         "showcase",   "lamps"};
static const char *const course_scenes[] = {"silhouette", "matte", "blinn_phong", "reflections",
                                            "simple",     "cow",   "buddha"};

// "course/cow" is in the course's folder, "cow" in scenes/.
static void scene_path(char path[COURSE_PATH_SIZE], const char *scene)
{
    char file[128];
    const bool is_course = strncmp(scene, "course/", 7) == 0;
    snprintf(file, sizeof file, "%s.scn", is_course ? scene + 7 : scene);
    if (is_course)
        course_path(path, "scenes", file);
    else
        snprintf(path, COURSE_PATH_SIZE, "%s/scenes/%s", CLRT_SOURCE_FOLDER, file);
}

static bool picture_hash(const char *scene, unsigned view, unsigned size,
                         char hash[FRAMEBUFFER_HASH_SIZE], Error *error)
{
    char path[COURSE_PATH_SIZE];
    Framebuffer picture;
    scene_path(path, scene);
    PictureRequest request = picture_request(path, view);
    request.width = request.height = size;
    request.extra_options = getenv("CLRT_TEST_OPTIONS");
    if (!picture_render(&picture, &request, error))
        return false;
    framebuffer_hash(&picture, hash);
    framebuffer_free(&picture);
    return true;
}

static bool is_wanted(const char *scene, unsigned view, unsigned size)
{
    char path[COURSE_PATH_SIZE];
    const char *only = getenv("CLRT_TEST_SCENES");
    if (size != wanted_size || view > most_views)
        return false;
    if (only != NULL && strstr(only, scene) == NULL)
        return false;
    scene_path(path, scene);
    return strncmp(scene, "course/", 7) != 0 || course_has(path);
}

static void pictures_have_the_hashes_on_record(void **state)
{
    (void)state;
    char scene[64], expected[64], hash[FRAMEBUFFER_HASH_SIZE];
    unsigned view, size, checked = 0, wrong = 0;
    FILE *record = fopen(RECORD, "r");
    assert_non_null(record);
    while (fscanf(record, "%63s %u %u %63s", scene, &view, &size, expected) == 4) {
        Error error = {0};
        if (!is_wanted(scene, view, size))
            continue;
        if (!picture_hash(scene, view, size, hash, &error))
            fail_msg("%s", error.text);
        checked++;
        if (strcmp(hash, expected) == 0)
            continue;
        wrong++;
        print_error("%s view %u: %s recorded, %s rendered\n", scene, view, expected, hash);
    }
    fclose(record);
    print_message("%u pictures of %ux%u checked\n", checked, wanted_size, wanted_size);
    assert_in_range(checked, 1, 1000);
    assert_int_equal(wrong, 0);
}

static void list_scene(const char *scene, unsigned size)
{
    char hash[FRAMEBUFFER_HASH_SIZE];
    for (unsigned view = 1;; view++) {
        Error error = {0};
        if (!picture_hash(scene, view, size, hash, &error))
            return;
        printf("%s %u %u %s\n", scene, view, size, hash);
    }
}

static int list(unsigned size)
{
    char course[64];
    for (size_t i = 0; i < sizeof own_scenes / sizeof own_scenes[0]; i++)
        list_scene(own_scenes[i], size);
    for (size_t i = 0; i < sizeof course_scenes / sizeof course_scenes[0]; i++) {
        snprintf(course, sizeof course, "course/%s", course_scenes[i]);
        list_scene(course, size);
    }
    return 0;
}

int main(int count, char **words)
{
    if (count == 3 && strcmp(words[1], "list") == 0)
        return list((unsigned)atoi(words[2]));
    wanted_size = count > 1 ? (unsigned)atoi(words[1]) : 128;
    most_views = count > 2 ? (unsigned)atoi(words[2]) : 99;
    const struct CMUnitTest tests[] = {cmocka_unit_test(pictures_have_the_hashes_on_record)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
