// SPDX-License-Identifier: MIT
// clrt rejects faulty files with the position of the fault, or repairs them as documented, and
// never crashes. Coordinates with many digits keep them.
#include "support/random.h"
#include "support/scene_text.h"

#include "accel/triangles.h"
#include "base/file.h"
#include "mesh/ply.h"
#include "scene/scn.h"

#include <dirent.h>
#include <locale.h>
#include <string.h>

static void spheres_without_a_size_are_refused_t36(void **state)
{
    static const char *const refused[] = {
        "sphere 0 0 0 0\n",   "sphere 0 0 0 -1\n",  "sphere 0 0 0 nan\n",    "sphere 0 0 0 inf\n",
        "sphere nan 0 0 1\n", "sphere 0 inf 0 1\n", "\n\nsphere 0 0 0 -0\n", NULL};
    (void)state;
    outcome_report(scene_text_refusals("T-36", refused), "refused");
}

#define HEADER(count) "ply\nformat ascii 1.0\nelement vertex " count "\n"
#define POINT         "property float x\nproperty float y\nproperty float z\n"
#define FACES(count)  "element face " count "\nproperty list uchar int vertex_indices\nend_header\n"
// Starts with a triangle whose first coordinate is `first`.
#define START(first) HEADER("3") POINT FACES("1") first " 0 0\n1 0 0\n0 1 0\n"

// Texts of meshes, and whether they can be read.
static const struct {
    const char *name, *text;
    bool readable;
} meshes[] = {
    {"plain", START("0") "3 0 1 2\n", true},
    {"nan", START("nan") "3 0 1 2\n", false},
    {"infinity", START("inf") "3 0 1 2\n", false},
    {"overflow", START("1e39") "3 0 1 2\n", false},
    {"nan_payload", START("nan(0x1)") "3 0 1 2\n", false},
    {"denormal", START("1e-45") "3 0 1 2\n", true},
    {"index_below", START("0") "3 0 1 -1\n", false},
    {"index_above", START("0") "3 0 1 3\n", false},
    {"index_2^32", START("0") "3 0 1 4294967296\n", false},
    {"two_corners", START("0") "2 0 1\n", false},
    {"five_corners", START("0") "5 0 1 2 0 1\n", true},
    {"truncated", START("0") "3 0 1", false},
    {"no_body", HEADER("3") POINT "end_header\n", false},
    {"lying_header", HEADER("4000000000") POINT "end_header\n0 0 0\n", false},
    {"crlf",
     "ply\r\nformat ascii 1.0\r\nelement vertex 0\r\nproperty float x\r\n"
     "property float y\r\nproperty float z\r\nend_header\r\n",
     true},
    {"no_faces", HEADER("1") POINT FACES("0") "0 0 0\n", true},
};

// Reads a file and frees the result. Returns false and fills error if clrt rejects it.
typedef bool Reading(const char *bytes, size_t size, Error *error);

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

static void meshes_that_are_wrong_are_refused_with_a_place_t61(void **state)
{
    size_t wrong = 0;
    (void)state;
    for (size_t i = 0; i < COUNT(meshes); i++) {
        Error error = {0};
        const bool readable = read_ply(meshes[i].text, strlen(meshes[i].text), &error);
        const bool has_place = strncmp(error.text, "extremes.ply:", 13) == 0;
        const bool right = readable == meshes[i].readable && (readable || has_place);
        if (!right)
            print_message("%s: %s\n", meshes[i].name, readable ? "read" : error.text);
        wrong += !right;
    }
    outcome_report(outcome_of("T-61", COUNT(meshes), wrong), "corpus");
}

// Changes, flips or repeats bits of a few bytes, or truncates the file. Returns the new size.
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

// Reads damaged copies of a file. Returns how many clrt rejects without a reason.
static Outcome read_damaged(const char *test, const char *path, size_t copies, Reading *read)
{
    Error error = {0};
    File file = {0};
    Random random = {61};
    Outcome outcome = {.test = test};
    require(file_read(&file, path, &error), &error);
    char *bytes = require_memory(file.size + 1, 1);
    for (; file.size > 0 && outcome.count < copies; outcome.count++) {
        Error fault = {0};
        memcpy(bytes, file.bytes, file.size);
        const size_t size = damage(bytes, file.size, &random);
        outcome.failures[BY_CLRT] += !read(bytes, size, &fault) && fault.text[0] == 0;
    }
    free(bytes);
    file_free(&file);
    return outcome;
}

static int is_visible(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

// Damages the files of the fuzzers' corpus for a format.
static void fuzz(const char *test, const char *format, Reading *read)
{
    static const size_t copies[3] = {2000, 20000, 100000};
    struct dirent **entries;
    char path[1024];
    Outcome sum = {0};
    const int folder =
        snprintf(path, sizeof path, CLRT_SOURCE_FOLDER "/tests/fuzz/corpus/%s/", format);
    const int files = scandir(path, &entries, is_visible, alphasort);
    assert_in_range(files, 1, 100000);
    for (int i = 0; i < files; i++) {
        snprintf(path + folder, sizeof path - (size_t)folder, "%s", entries[i]->d_name);
        outcome_add(&sum, read_damaged(test, path, copies[tier()] / (size_t)files + 1, read));
        free(entries[i]);
    }
    free(entries);
    assert_in_range(sum.count, copies[tier()], 2 * copies[tier()]);
    outcome_report(sum, "damaged seeds=%d", files);
}

static void damaged_meshes_never_crash_the_reader_t61(void **state)
{
    (void)state;
    fuzz("T-61", "ply", read_ply);
}

static void damaged_scenes_never_crash_the_reader_t62(void **state)
{
    (void)state;
    fuzz("T-62", "scn", read_scn);
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
    outcome_report(scene_text_refusals("T-62", refused), "refused");
}

static void numbers_have_a_point_where_a_comma_is_usual_t62(void **state)
{
    static const char *const locales[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "nl_NL.UTF-8"};
    (void)state;
    for (size_t i = 0; i < COUNT(locales); i++)
        if (setlocale(LC_ALL, locales[i]) != NULL)
            break;
    Scene scene = scene_text_parse("sphere 1.5 2 3 0.25\n");
    setlocale(LC_ALL, "C");
    assert_true(scene.spheres.data[0].center.x == 1.5);
    assert_true(scene.spheres.data[0].radius == 0.25);
    scene_free(&scene);
}

#define PLACES 3000

// Fills a mesh's text with coordinates of maps: a million and nine decimals. exact gets the
// coordinates. The caller frees the text.
static char *write_places(long double exact[PLACES][3], size_t *size)
{
    char *text = NULL;
    Random random = {63};
    FILE *stream = open_memstream(&text, size);
    fprintf(stream,
            HEADER("%d") "property double x\nproperty double y\nproperty double z\n" FACES("%d"),
            PLACES, PLACES / 3);
    for (int i = 0; i < 3 * PLACES; i++) {
        char number[32];
        snprintf(number, sizeof number, "%d.%09u", 1000000 + i % 3 * 5000,
                 random_below(&random, 1000000000));
        exact[i / 3][i % 3] = strtold(number, NULL);
        fprintf(stream, "%s%s", number, i % 3 == 2 ? "\n" : " ");
    }
    for (int i = 0; i < PLACES; i += 3)
        fprintf(stream, "3 %d %d %d\n", i, i + 1, i + 2);
    fclose(stream);
    return text;
}

static void places_of_many_digits_are_kept_to_the_last_bit_t63(void **state)
{
    static long double exact[PLACES][3];
    Error error = {0};
    size_t wrong = 0, size = 0;
    Scene scene;
    MeshObject object = {.two_sided = true};
    Triangles triangles = {0};
    char *text = write_places(exact, &size);
    (void)state;
    require(scene_init(&scene, &error) &&
                ply_parse(&object.mesh, text, size, "extremes.ply", &error) &&
                array_push(&scene.objects, object, &error),
            &error);
    const Normalization frame = normalization_of(&scene);
    require(triangles_make(&triangles, &scene, &frame, NULL, &error), &error);
    const long double center[3] = {frame.center.x, frame.center.y, frame.center.z};
    for (int i = 0; i < 3 * PLACES; i++) {
        const int axis = i % 3;
        const long double place = (exact[i / 3][axis] - center[axis]) * frame.scale;
        const long double unit = scalbnl(1, ilogbl(place) - 23);
        const long double parsed = 0x1p-53L * exact[i / 3][axis] * frame.scale;
        wrong += fabsl(triangles.points[i / 3][axis] - place) > 0.5L * unit + parsed;
    }
    outcome_report(outcome_of("T-63", 3 * PLACES, wrong), "offset=1e6 decimals=9");
    triangles_free(&triangles);
    scene_free(&scene);
    free(text);
}

RUN_TESTS(NULL, NULL, EXTREME(spheres_without_a_size_are_refused_t36),
          EXTREME(meshes_that_are_wrong_are_refused_with_a_place_t61),
          EXTREME(damaged_meshes_never_crash_the_reader_t61),
          EXTREME(damaged_scenes_never_crash_the_reader_t62),
          EXTREME(scenes_that_are_wrong_are_refused_with_a_place_t62),
          EXTREME(numbers_have_a_point_where_a_comma_is_usual_t62),
          EXTREME(places_of_many_digits_are_kept_to_the_last_bit_t63))
