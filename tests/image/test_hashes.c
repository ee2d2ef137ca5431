// SPDX-License-Identifier: MIT
// Pictures must have the recorded hashes on every device, PoCL target and compiler setting.
// Usage: test_hashes [list] [SIZE [VIEWS]], or test_hashes [list] refined
// The first form checks the recorded pictures of views 1 to VIEWS (default: all) at SIZE x SIZE
// pixels (default: 128). The second form checks refined pictures, with two settings each of
// --aa-adaptive and --error. With `list`, the test prints the records with rendered hashes. A new
// record starts with the hash 0. CLRT_TEST_SCENES limits the scenes to the listed ones, and
// CLRT_TEST_OMIT omits the scenes whose names contain it.
// CLRT_TEST_OPTIONS contains options for the compiler of kernels.
#include "image/course.h"
#include "image/rendered.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define RECORDS      CLRT_SOURCE_FOLDER "/tests/image/"
#define REFINED_SIZE 64

static bool is_refined, is_list;
static unsigned wanted_size = 128, most_views = 99;

static const struct {
    const char *name;
    float contrast; // of --aa-adaptive; 0 for none
    double error;   // of --error
} settings[] = {{"adaptive-0.1", 0.1f, 0},
                {"adaptive-0.02", 0.02f, 0},
                {"error-0.05", 0, 0.05},
                {"error-0.01", 0, 0.01}};
#define SETTINGS (sizeof settings / sizeof settings[0])

// `number` is the view or, for a refined picture, the index in settings.
typedef struct {
    char scene[64], hash[FRAMEBUFFER_HASH_SIZE];
    unsigned number, size;
} Record;

static bool is_course(const char *scene)
{
    return strncmp(scene, "course/", 7) == 0;
}

// The scene "course/cow" is in the course's folder, "cow" is in scenes/, and other paths start at
// the source folder.
static void scene_path(char path[COURSE_PATH_SIZE], const char *scene)
{
    char file[128];
    snprintf(file, sizeof file, "%s.scn", is_course(scene) ? scene + 7 : scene);
    if (is_course(scene))
        course_path(path, file);
    else
        snprintf(path, COURSE_PATH_SIZE, "%s/%s%s", CLRT_SOURCE_FOLDER,
                 strchr(scene, '/') == NULL ? "scenes/" : "", file);
}

static Scene scene; // of the last picture

// Sets the request's scene. All views of a scene share one Scene and one tree.
static void set_scene(PictureRequest *request, const Record *record)
{
    static char name[sizeof record->scene];
    request->scene = &scene;
    request->has_last_tree = strcmp(name, record->scene) == 0;
    if (request->has_last_tree)
        return;
    scene_free(&scene);
    scene = rendered_scene(request->scene_path);
    strcpy(name, record->scene);
}

static void picture_hash(const Record *record, char hash[FRAMEBUFFER_HASH_SIZE])
{
    char path[COURSE_PATH_SIZE];
    scene_path(path, record->scene);
    PictureRequest request = picture_request(path, is_refined ? 1 : record->number);
    set_scene(&request, record);
    request.width = request.height = record->size;
    request.extra_options = getenv("CLRT_TEST_OPTIONS");
    request.threads = 2;
    if (is_refined) {
        request.contrast = settings[record->number].contrast;
        request.error_goal = settings[record->number].error;
    }
    FREED_BY(framebuffer_free) Framebuffer picture = rendered(&request);
    framebuffer_hash(&picture, hash);
}

static bool is_wanted(const Record *record)
{
    char path[COURSE_PATH_SIZE];
    const char *only = getenv("CLRT_TEST_SCENES"), *omitted = getenv("CLRT_TEST_OMIT");
    if (!is_refined && (record->size != wanted_size || record->number > most_views))
        return false;
    if (only != NULL &&
        strstr(only, is_refined ? strrchr(record->scene, '/') + 1 : record->scene) == NULL)
        return false;
    if (omitted != NULL && strstr(record->scene, omitted) != NULL)
        return false;
    scene_path(path, record->scene);
    return !is_course(record->scene) || course_has(path);
}

static bool read_record(FILE *file, Record *record)
{
    char name[64];
    if (!is_refined)
        return fscanf(file, "%63s %u %u %32s", record->scene, &record->number, &record->size,
                      record->hash) == 4;
    if (fscanf(file, "%63s %63s %32s", record->scene, name, record->hash) != 3)
        return false;
    record->size = REFINED_SIZE;
    for (record->number = 0; strcmp(settings[record->number].name, name) != 0; record->number++)
        assert_true(record->number + 1 < SETTINGS);
    return true;
}

static void print_record(const Record *record, const char *hash)
{
    if (is_refined)
        printf("%s %s %s\n", record->scene, settings[record->number].name, hash);
    else
        printf("%s %u %u %s\n", record->scene, record->number, record->size, hash);
}

TEST(pictures_have_the_hashes_on_record)
{
    Record record;
    unsigned checked = 0, wrong = 0;
    FILE *file = fopen(is_refined ? RECORDS "refined_hashes.txt" : RECORDS "hashes.txt", "r");
    assert_non_null(file);
    while (read_record(file, &record)) {
        char hash[FRAMEBUFFER_HASH_SIZE];
        if (!is_wanted(&record))
            continue;
        picture_hash(&record, hash);
        checked++;
        wrong += strcmp(hash, record.hash) != 0;
        if (is_list || strcmp(hash, record.hash) != 0)
            print_record(&record, hash);
    }
    fclose(file);
    print_message("%u pictures checked, %u have another hash\n", checked, wrong);
    assert_in_range(checked, 1, 1000);
    assert_true(is_list || wrong == 0);
}

int main(int count, char **words)
{
    is_list = count > 1 && strcmp(words[1], "list") == 0;
    words += is_list;
    count -= is_list;
    is_refined = count > 1 && strcmp(words[1], "refined") == 0;
    if (count > 1 && !is_refined)
        wanted_size = (unsigned)atoi(words[1]);
    if (count > 2)
        most_views = (unsigned)atoi(words[2]);
    return tests_run();
}
