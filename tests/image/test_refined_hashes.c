// SPDX-License-Identifier: MIT
// Refined pictures have the recorded pixel hashes, for two settings each of --aa-adaptive and
// --error. `test_refined_hashes list` prints the lines to record. CLRT_TEST_SCENES limits it to the
// listed scenes.
#include "image/picture.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define RECORD CLRT_SOURCE_FOLDER "/tests/image/refined_hashes.txt"
#define SIZE   64

static const char *const scenes[] = {"scenes/silhouette",  "scenes/matte",
                                     "scenes/blinn_phong", "scenes/reflections",
                                     "scenes/simple",      "scenes/creature",
                                     "scenes/figure",      "scenes/coral",
                                     "scenes/showcase",    "tests/image/every_feature"};

typedef struct {
    const char *name;
    float contrast; // of --aa-adaptive; 0 for none
    double error;   // of --error
} Setting;

static const Setting settings[] = {{"adaptive-0.1", 0.1f, 0},
                                   {"adaptive-0.02", 0.02f, 0},
                                   {"error-0.05", 0, 0.05},
                                   {"error-0.01", 0, 0.01}};
#define SETTINGS (sizeof settings / sizeof settings[0])

static bool picture_hash(const char *scene, const Setting *setting,
                         char hash[FRAMEBUFFER_HASH_SIZE], Error *error)
{
    char path[512];
    Framebuffer picture;
    snprintf(path, sizeof path, "%s/%s.scn", CLRT_SOURCE_FOLDER, scene);
    PictureRequest request = picture_request(path, 1);
    request.width = request.height = SIZE;
    request.contrasts[0] = setting->contrast;
    request.error_goal = setting->error;
    request.threads = 2;
    if (!picture_render(&picture, &request, error))
        return false;
    framebuffer_hash(&picture, hash);
    framebuffer_free(&picture);
    return true;
}

static const Setting *setting_named(const char *name)
{
    size_t i = 0;
    while (i < SETTINGS && strcmp(settings[i].name, name) != 0)
        i++;
    assert_true(i < SETTINGS);
    return &settings[i];
}

static void refined_pictures_have_the_hashes_on_record(void **state)
{
    (void)state;
    char scene[64], name[64], expected[64], hash[FRAMEBUFFER_HASH_SIZE];
    unsigned checked = 0, wrong = 0;
    const char *only = getenv("CLRT_TEST_SCENES");
    FILE *record = fopen(RECORD, "r");
    assert_non_null(record);
    while (fscanf(record, "%63s %63s %63s", scene, name, expected) == 3) {
        Error error = {0};
        if (only != NULL && strstr(only, strrchr(scene, '/') + 1) == NULL)
            continue;
        if (!picture_hash(scene, setting_named(name), hash, &error))
            fail_msg("%s %s: %s", scene, name, error.text);
        checked++;
        if (strcmp(hash, expected) == 0)
            continue;
        wrong++;
        print_error("%s %s: %s recorded, %s rendered\n", scene, name, expected, hash);
    }
    fclose(record);
    print_message("%u pictures of %ux%u checked\n", checked, SIZE, SIZE);
    assert_in_range(checked, 1, 1000);
    assert_int_equal(wrong, 0);
}

static int list(void)
{
    char hash[FRAMEBUFFER_HASH_SIZE];
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        for (size_t j = 0; j < SETTINGS; j++) {
            Error error = {0};
            if (!picture_hash(scenes[i], &settings[j], hash, &error)) {
                fprintf(stderr, "%s %s: %s\n", scenes[i], settings[j].name, error.text);
                return 1;
            }
            printf("%s %s %s\n", scenes[i], settings[j].name, hash);
        }
    return 0;
}

int main(int count, char **words)
{
    if (count == 2 && strcmp(words[1], "list") == 0)
        return list();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refined_pictures_have_the_hashes_on_record)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
