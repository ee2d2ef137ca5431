// SPDX-License-Identifier: MIT
// clrt rejects faulty files with the position of the fault, or repairs them as documented, and
// never crashes. Coordinates with many digits keep them.
#include "support/check.h"
#include "support/random.h"
#include "support/report.h"
#include "support/scene_text.h"
#include "support/tier.h"

#include "accel/triangles.h"
#include "base/file.h"
#include "mesh/ply.h"
#include "scene/scn.h"

#include <dirent.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>

static void spheres_without_a_size_are_refused_t36(void **state)
{
    static const char *const refused[] = {
        "sphere 0 0 0 0\n",   "sphere 0 0 0 -1\n",  "sphere 0 0 0 nan\n",    "sphere 0 0 0 inf\n",
        "sphere nan 0 0 1\n", "sphere 0 inf 0 1\n", "\n\nsphere 0 0 0 -0\n", NULL};
    (void)state;
    assert_int_equal(scene_text_report("T-36", "refused", refused), 0);
}

#define VERTICES(first)                                                                            \
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"                     \
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n" first                   \
    " 0 0\n1 0 0\n0 1 0\n"
#define ASCII "ply\nformat ascii 1.0\n"

// Texts of meshes, and whether they can be read.
static const struct {
    const char *name, *text;
    bool readable;
} meshes[] = {
    {"plain", ASCII VERTICES("0") "3 0 1 2\n", true},
    {"nan", ASCII VERTICES("nan") "3 0 1 2\n", false},
    {"infinity", ASCII VERTICES("inf") "3 0 1 2\n", false},
    {"overflow", ASCII VERTICES("1e39") "3 0 1 2\n", false},
    {"nan_payload", ASCII VERTICES("nan(0x1)") "3 0 1 2\n", false},
    {"denormal", ASCII VERTICES("1e-45") "3 0 1 2\n", true},
    {"index_below", ASCII VERTICES("0") "3 0 1 -1\n", false},
    {"index_above", ASCII VERTICES("0") "3 0 1 3\n", false},
    {"index_2^32", ASCII VERTICES("0") "3 0 1 4294967296\n", false},
    {"two_corners", ASCII VERTICES("0") "2 0 1\n", false},
    {"five_corners", ASCII VERTICES("0") "5 0 1 2 0 1\n", true},
    {"truncated", ASCII VERTICES("0") "3 0 1", false},
    {"no_body",
     ASCII "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
           "end_header\n",
     false},
    {"lying_header",
     ASCII "element vertex 4000000000\nproperty float x\nproperty float y\n"
           "property float z\nend_header\n0 0 0\n",
     false},
    {"crlf",
     "ply\r\nformat ascii 1.0\r\nelement vertex 0\r\nproperty float x\r\n"
     "property float y\r\nproperty float z\r\nend_header\r\n",
     true},
    {"no_faces",
     ASCII "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
     true},
};

static void meshes_that_are_wrong_are_refused_with_a_place_t61(void **state)
{
    size_t wrong = 0;
    const size_t count = sizeof meshes / sizeof *meshes;
    (void)state;
    for (size_t i = 0; i < count; i++) {
        Mesh mesh;
        Error error = {0};
        const char *text = meshes[i].text;
        const bool readable = ply_parse(&mesh, text, strlen(text), "extremes.ply", &error);
        if (readable)
            mesh_free(&mesh);
        const bool placed = readable || strncmp(error.text, "extremes.ply:", 13) == 0;
        if (readable != meshes[i].readable || !placed)
            print_message("%s: %s\n", meshes[i].name, readable ? "read" : error.text);
        wrong += readable != meshes[i].readable || !placed;
    }
    report_case("T-61", "corpus", count, wrong);
    assert_int_equal(wrong, 0);
}

typedef bool (*Reading)(const char *bytes, size_t size, Error *error);

static bool read_ply(const char *bytes, size_t size, Error *error)
{
    Mesh mesh;
    const bool ok = ply_parse(&mesh, bytes, size, "extremes.ply", error);
    if (ok)
        mesh_free(&mesh);
    return ok;
}

static bool read_scn(const char *bytes, size_t size, Error *error)
{
    Scene scene;
    const bool ok = scn_parse(&scene, bytes, size, "/nonexistent/extremes.scn", error);
    if (ok)
        scene_free(&scene);
    return ok;
}

// Changes, removes, repeats or swaps a few bytes; the new size.
static size_t damage(char *bytes, size_t size, Random *random)
{
    const uint32_t faults = 1 + random_below(random, 4);
    for (uint32_t fault = 0; fault < faults && size > 1; fault++) {
        const uint32_t place = random_below(random, (uint32_t)size);
        switch (random_below(random, 4)) {
        case 0:
            bytes[place] = (char)random_below(random, 256);
            break;
        case 1:
            bytes[place] = (char)(bytes[place] ^ (1 << random_below(random, 8)));
            break;
        case 2:
            size = place + 1;
            break;
        default:
            bytes[place] = bytes[random_below(random, (uint32_t)size)];
        }
    }
    return size;
}

// Reads damaged copies of the file; the number of those refused without a reason.
static size_t damage_file(const File *file, size_t copies, Reading read, Random *random)
{
    Error error = {0};
    size_t silent = 0;
    char *bytes = memory_raw(file->size + 1, 1, &error);
    require(bytes != NULL, &error);
    for (size_t copy = 0; copy < copies; copy++) {
        Error fault = {0};
        memcpy(bytes, file->bytes, file->size);
        const size_t size = damage(bytes, file->size, random);
        silent += !read(bytes, size, &fault) && fault.text[0] == 0;
    }
    free(bytes);
    return silent;
}

static size_t fuzz(const char *test, const char *format, Reading read)
{
    char folder[512], details[64];
    size_t seeds = 0, silent = 0, copies = 0;
    Random random = {61};
    const size_t all = tier() == 0 ? 2000 : tier() == 1 ? 20000 : 100000;
    snprintf(folder, sizeof folder, CLRT_SOURCE_FOLDER "/tests/fuzz/corpus/%s", format);
    DIR *corpus = opendir(folder);
    assert_non_null(corpus);
    size_t files = 0;
    for (struct dirent *entry; (entry = readdir(corpus)) != NULL;)
        files += entry->d_name[0] != '.';
    rewinddir(corpus);
    for (struct dirent *entry; (entry = readdir(corpus)) != NULL;) {
        char path[1024];
        Error error = {0};
        File file = {0};
        if (entry->d_name[0] == '.')
            continue;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        require(file_read(&file, path, &error), &error);
        const size_t share = file.size > 0 ? all / files + 1 : 0;
        silent += damage_file(&file, share, read, &random);
        copies += share;
        seeds++;
        file_free(&file);
    }
    closedir(corpus);
    assert_in_range(copies, all, 2 * all);
    snprintf(details, sizeof details, "damaged seeds=%zu", seeds);
    return report_case(test, details, copies, silent);
}

static void damaged_meshes_never_crash_the_reader_t61(void **state)
{
    (void)state;
    assert_int_equal(fuzz("T-61", "ply", read_ply), 0);
}

static void damaged_scenes_never_crash_the_reader_t62(void **state)
{
    (void)state;
    assert_int_equal(fuzz("T-62", "scn", read_scn), 0);
}

static void scenes_that_are_wrong_are_refused_with_a_place_t62(void **state)
{
    static const char *const refused[] = {"sphere 1 2 3\n",
                                          "light\n",
                                          "sphere 1 2 3 1e400\n",
                                          "sphere 1,5 2 3 1\n",
                                          "material\n",
                                          "camera 1 2 3\n",
                                          "size 1e9 1e9\n",
                                          "max_level -1\n",
                                          "background 2 0 0\n",
                                          "ambient nan\n",
                                          "define a matte kd\n",
                                          "material nothing\n",
                                          "sphere 0x1 0 0 1\n1 2",
                                          "ply_file\n",
                                          "spheer 0 0 0 1\n",
                                          NULL};
    (void)state;
    size_t accepted = scene_text_report("T-62", "refused", refused);
    // Where a comma is the decimal point, numbers still have a point.
    const char *const locales[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "nl_NL.UTF-8"};
    for (size_t i = 0; i < 3; i++)
        if (setlocale(LC_ALL, locales[i]) != NULL)
            break;
    Scene scene = scene_text_parse("sphere 1.5 2 3 0.25\n");
    accepted += scene.spheres.data[0].center.x != 1.5 || scene.spheres.data[0].radius != 0.25;
    scene_free(&scene);
    setlocale(LC_ALL, "C");
    assert_int_equal(accepted, 0);
}

#define PLACES 3000

// Coordinates like those of maps: a million and nine decimals.
static void places_of_many_digits_are_kept_to_the_last_bit_t63(void **state)
{
    Error error = {0};
    Random random = {63};
    size_t wrong = 0, size = 0;
    static long double exact[PLACES][3];
    char *text = NULL;
    Scene scene;
    MeshObject object = {.two_sided = true};
    FILE *stream = open_memstream(&text, &size);
    (void)state;
    fprintf(stream,
            ASCII "element vertex %d\nproperty double x\nproperty double y\nproperty double z\n"
                  "element face %d\nproperty list uchar int vertex_indices\nend_header\n",
            PLACES, PLACES / 3);
    for (int i = 0; i < PLACES; i++)
        for (int axis = 0; axis < 3; axis++) {
            char number[32];
            snprintf(number, sizeof number, "%d.%09u", 1000000 + axis * 5000,
                     random_below(&random, 1000000000));
            exact[i][axis] = strtold(number, NULL);
            fprintf(stream, "%s%s", number, axis == 2 ? "\n" : " ");
        }
    for (int i = 0; i < PLACES; i += 3)
        fprintf(stream, "3 %d %d %d\n", i, i + 1, i + 2);
    fclose(stream);
    Triangles triangles = {0};
    require(scene_init(&scene, &error) &&
                ply_parse(&object.mesh, text, size, "extremes.ply", &error) &&
                array_push(&scene.objects, object, &error),
            &error);
    const Normalization frame = normalization_of(&scene);
    require(triangles_make(&triangles, &scene, &frame, NULL, &error), &error);
    const long double center[3] = {frame.center.x, frame.center.y, frame.center.z};
    for (int i = 0; i < PLACES; i++)
        for (int axis = 0; axis < 3; axis++) {
            const long double place = (exact[i][axis] - center[axis]) * frame.scale;
            const long double unit = scalbnl(1, ilogbl(place) - 23);
            const long double parsed = 0x1p-53L * exact[i][axis] * frame.scale;
            wrong += fabsl(triangles.points[i][axis] - place) > 0.5L * unit + parsed;
        }
    report_case("T-63", "offset=1e6 decimals=9", 3 * PLACES, wrong);
    triangles_free(&triangles);
    scene_free(&scene);
    free(text);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres_without_a_size_are_refused_t36),
        cmocka_unit_test(meshes_that_are_wrong_are_refused_with_a_place_t61),
        cmocka_unit_test(damaged_meshes_never_crash_the_reader_t61),
        cmocka_unit_test(damaged_scenes_never_crash_the_reader_t62),
        cmocka_unit_test(scenes_that_are_wrong_are_refused_with_a_place_t62),
        cmocka_unit_test(places_of_many_digits_are_kept_to_the_last_bit_t63),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
