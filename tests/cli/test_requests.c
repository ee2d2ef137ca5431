// SPDX-License-Identifier: MIT
// Tests that every option and command of the program has a counterpart in clrt.h, or a reason why
// only the program has it. Also tests that an option can set each member of the library's requests,
// except library_members. Also tests that small error goals select fp64.
#include "base/file.h"
#include "cli/options/option.h"
#include "unit/cmocka_all.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

// Counterparts are functions or "Struct::member", separated by spaces. A reason ends with a period.
static const char *const counterparts[][2] = {
    {"output", "The library fills memory, and other libraries write files."},
    {"format", "It is for files."},
    {"encode", "It is for 8-bit files: the library returns the traced floats."},
    {"exposure", "It is for 8-bit files: the library returns the traced floats."},
    {"aov", "ClrtPicture::channels ClrtPicture::channel_count ClrtChannel::name"},
    {"no-metadata", "It is for files."},
    {"hash", "clrt_hash"},
    {"size", "ClrtPicture::width ClrtPicture::height"},
    {"crop", "ClrtPicture::left ClrtPicture::top ClrtPicture::crop_width ClrtPicture::crop_height"},
    {"view", "ClrtPicture::view"},
    {"up", "ClrtLoad::up"},
    {"normals", "ClrtLoad::flat ClrtLoad::crease_degrees"},
    {"studio", "ClrtLoad::soft"},
    {"bad-geometry", "ClrtSceneInfo::dropped_triangle_count"},
    {"aa", "ClrtPicture::samples"},
    {"aa-adaptive", "ClrtPicture::contrast"},
    {"max-level", "ClrtPicture::max_level ClrtPicture::truncation"},
    {"error", "ClrtPicture::error ClrtResult::goal_missed"},
    {"time", "ClrtPicture::seconds"},
    {"precision", "ClrtSettings::precision"},
    {"tune", "ClrtSettings::size"},
    {"tune kernel", "ClrtSettings::kernel ClrtSettings::lanes"},
    {"tune tile", "ClrtPicture::tile_width ClrtPicture::tile_height"},
    {"tune group", "ClrtSettings::group_width ClrtSettings::group_height"},
    {"tune specialize", "ClrtSettings::specialize"},
    {"tune bvh", "ClrtSettings::tree"},
    {"turntable", "ClrtPicture::turn_degrees"},
    {"frames", "A program calls clrt_render once for each picture."},
    {"part", "Parts are files for clrt merge: the library draws crops."},
    {"resume", "It keeps tiles in a file: the caller keeps its own memory."},
    {"device", "ClrtSettings::device"},
    {"threads", "ClrtSettings::threads"},
    {"stats", "ClrtPicture::statistics ClrtResult::camera_rays ClrtResult::box_tests"},
    {"reference", "clrt_reference"},
    {"reference-samples", "ClrtPicture::reference_samples"},
    {"repeat", "A program calls clrt_render again."},
    {"fail", "It compares two files."},
    {"json", "ClrtPicture::result ClrtResult::seconds clrt_explanation_get_ray"},
    {"keys", "It is for the window."},
    {"quiet", "The library prints nothing."},
    {"verbose", "The library prints nothing."},
    {"version", "clrt_version"},
    {"help", "The header is the library's help."},
};

// For each action of command_table, the functions of clrt.h that do the same, or the reason why the
// library has none.
static const char *const commands[] = {
    [ACTION_RENDER] = "clrt_render",
    [ACTION_VIEW] = "The library opens no window.",
    [ACTION_CHECK] = "clrt_check clrt_check_get_finding",
    [ACTION_COMPARE] = "It compares two files.",
    [ACTION_MERGE] = "It joins files.",
    [ACTION_CONVERT] = "It writes files.",
    [ACTION_EXPLAIN_SCENE] = "The report on kernels is text for users.",
    [ACTION_EXPLAIN] = "clrt_explain clrt_explanation_get_light",
    [ACTION_WARM] = "A program draws a small picture, which compiles its kernel.",
    [ACTION_DEVICES] = "clrt_device_count clrt_device_get",
};

// Only C code can set these members, so no option does.
static const char library_members[] = " ClrtPicture::size ClrtPicture::camera "
                                      "ClrtPicture::progress ClrtPicture::user ClrtLoad::size ";

static File header;

SET_UP(read_header)
{
    Error error = {0};
    return !file_read(&header, CLRT_SOURCE_FOLDER "/host/library/clrt.h", &error);
}

TEAR_DOWN(free_header)
{
    file_free(&header);
    return 0;
}

static bool is_letter(char letter)
{
    return isalnum((unsigned char)letter) || letter == '_';
}

static bool has_word(const char *text, size_t size, const char *word)
{
    const size_t length = strlen(word);
    for (size_t i = 0; i + length <= size; i++)
        if (memcmp(text + i, word, length) == 0 && (i == 0 || !is_letter(text[i - 1])) &&
            (i + length == size || !is_letter(text[i + length])))
            return true;
    return false;
}

// Returns the start of a struct's body, and stores the body's size.
static const char *body_of(const char *name, size_t *size)
{
    char ending[80];
    snprintf(ending, sizeof ending, "\n} %s;", name);
    const char *end = strstr(header.bytes, ending), *start = header.bytes, *next = start;
    if (end == NULL)
        fail_msg("clrt.h has no struct %s", name);
    while ((next = strstr(next + 1, "typedef struct {")) != NULL && next < end)
        start = next;
    *size = (size_t)(end - start) + 1;
    return start;
}

static void expect_in_header(const char *option, const char *word)
{
    const char *colons = strstr(word, "::");
    char name[64];
    size_t size = header.size;
    const char *text = header.bytes;
    snprintf(name, sizeof name, "%.*s", colons != NULL ? (int)(colons - word) : 0, word);
    if (colons != NULL)
        text = body_of(name, &size);
    if (!has_word(text, size, colons != NULL ? colons + 2 : word))
        fail_msg("%s: clrt.h has no %s", option, word);
}

static bool is_reason(const char *counterpart)
{
    return counterpart[strlen(counterpart) - 1] == '.';
}

static void expect_counterpart(const char *option, const char *counterpart)
{
    char words[256];
    assert_true(strlen(counterpart) < sizeof words);
    if (is_reason(counterpart))
        return;
    strcpy(words, counterpart);
    for (char *word = strtok(words, " "); word != NULL; word = strtok(NULL, " "))
        expect_in_header(option, word);
}

TEST(every_option_is_in_the_library_or_has_a_reason)
{
    assert_int_equal(option_count, sizeof counterparts / sizeof *counterparts);
    for (size_t i = 0; i < option_count; i++) {
        size_t row = 0;
        while (row < option_count && strcmp(counterparts[row][0], option_table[i].name) != 0)
            row++;
        if (row == option_count)
            fail_msg("--%s has no counterpart", option_table[i].name);
        expect_counterpart(option_table[i].name, counterparts[row][1]);
    }
}

TEST(every_command_is_in_the_library_or_has_a_reason)
{
    for (size_t i = 0; i < command_count; i++) {
        const Action action = command_table[i].action;
        assert_true(action < sizeof commands / sizeof *commands && commands[action] != NULL);
        expect_counterpart(command_table[i].name, commands[action]);
    }
}

static bool is_reached(const char *member)
{
    for (size_t row = 0; row < sizeof counterparts / sizeof *counterparts; row++)
        if (!is_reason(counterparts[row][1]) &&
            has_word(counterparts[row][1], strlen(counterparts[row][1]), member))
            return true;
    return has_word(library_members, sizeof library_members, member);
}

// Fails unless an option sets each member of the struct. Members are the words before a semicolon
// or a comma, outside of comments.
static void expect_members_reached(const char *name)
{
    size_t size;
    char member[128];
    const char *text = body_of(name, &size);
    for (size_t i = 0; i < size; i++) {
        if (text[i] == '/' && text[i + 1] == '/')
            i += strcspn(text + i, "\n");
        if (text[i] != ';' && text[i] != ',')
            continue;
        size_t start = i;
        while (is_letter(text[start - 1]))
            start--;
        snprintf(member, sizeof member, "%s::%.*s", name, (int)(i - start), text + start);
        if (!is_reached(member))
            fail_msg("no option reaches %s", member);
    }
}

TEST(every_setting_of_a_request_is_an_option_or_the_librarys_own)
{
    expect_members_reached("ClrtPicture");
    expect_members_reached("ClrtSettings");
    expect_members_reached("ClrtLoad");
}

// Parses a command line with a small error goal and `words`, which end at NULL or after five words.
static bool parse_small_error(Options *options, const char *const words[5], Error *error)
{
    char *line[] = {"clrt", "--error=0.015%", NULL, NULL, NULL, NULL, NULL, NULL};
    int count = 2;
    for (; count < 7 && words[count - 2] != NULL; count++)
        line[count] = (char *)words[count - 2];
    memset(options, 0, sizeof *options);
    return options_parse(options, count, line, error);
}

TEST(errors_too_small_for_floats_select_doubles)
{
    static const char *const lines[][5] = {
        {"a.scn", "-o", "a.pfm"}, {"a.scn", "--hash", "--tune=kernel=pair"}, {"warm"}};
    Options options;
    Error error = {0};
    for (int i = 0; i < 3; i++) {
        assert_true(parse_small_error(&options, lines[i], &error));
        assert_int_equal(options.renderer.precision, CLRT_FP64);
    }
}

TEST(errors_too_small_for_floats_exclude_them)
{
    static const struct {
        const char *words[5], *sentence;
    } cases[] = {
        {{"a.scn", "--hash", "--precision=fp32"},
         "--error below 0.016 % needs fp64: leave out --precision fp32"},
        {{"warm", "--tune=kernel=pair", "--precision=fp32"}, "--error below 0.016 % needs fp64"},
        {{"a.scn", "--hash", "--tune=kernel=wide"},
         "with this --error, clrt traces rays one by one through pair nodes: leave out --tune "
         "kernel"}};
    Options options;
    for (int i = 0; i < 3; i++) {
        Error error = {0};
        assert_false(parse_small_error(&options, cases[i].words, &error));
        assert_non_null(strstr(error.text, cases[i].sentence));
    }
}
