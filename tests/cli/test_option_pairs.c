// SPDX-License-Identifier: MIT
// Tests every pair of options with every command, in both orders. Among options that the command
// accepts, clrt must reject exactly the documented pairs. Its message must name one of the options.
// If clrt accepts a pair, each option must have the effect that it has alone.
#include "cli/options/option.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <string.h>

#define WORDS_MOST 12

// The words of a command with only the options that it needs.
typedef const char *Words[WORDS_MOST];
static const Words lines[] = {
    {"a.scn"},
    {"a.scn", "-o", "b.exr"},
    {"a.scn", "-o", "b.png"},
    {"a.scn", "-o", "b.pfm"},
    {"a.scn", "-o", "-"},
    {"a.scn", "--hash"},
    {"check", "a.scn"},
    {"compare", "a.exr", "b.exr"},
    {"compare", "a.exr", "b.exr", "-o", "c.png"},
    {"merge", "a.exr", "b.exr", "-o", "c.exr"},
    {"convert", "a.scn", "b.scn"},
    {"explain", "a.scn"},
    {"explain", "a.scn", "1,2"},
    {"warm"},
    {"warm", "a.scn"},
    {"devices"},
};
#define LINES (sizeof lines / sizeof *lines)

// Each option that requires an argument has a value here. The value differs from the default.
static const struct {
    const char *name, *value;
} samples[] = {
    {"format", "png"},
    {"encode", "srgb"},
    {"exposure", "1"},
    {"aov", "depth"},
    {"hash", "0123456789abcdef0123456789abcdef"},
    {"size", "8x6"},
    {"crop", "0,0,4,4"},
    {"view", "2"},
    {"up", "x"},
    {"studio", "soft"},
    {"normals", "flat"},
    {"bad-geometry", "fail"},
    {"aa", "3"},
    {"aa-adaptive", "0.1"},
    {"max-level", "2"},
    {"error", "0.1"},
    {"time", "2"},
    {"precision", "fp64"},
    {"tune kernel", "packet:8"},
    {"tune tile", "8x4"},
    {"tune group", "4x2"},
    {"tune specialize", "always"},
    {"tune bvh", "none"},
    {"turntable", "4"},
    {"frames", "2-3"},
    {"part", "1/2"},
    {"device", "0:0"},
    {"threads", "1"},
    {"reference", "r.exr"},
    {"reference-samples", "4"},
    {"repeat", "2"},
    {"fail", "rmse=1%"},
    {"json", "j.json"},
    {"keys", "q"},
};

// Returns whether this test covers the option. Other tests cover the rest. --help and --version
// ignore the other options. Keys of --tune have rows of their own. A second -o is an error.
static bool is_walked(const Option *option)
{
    return option->kind != OPTION_ACTION && option->set != set_tune && option->set != set_output;
}

// Each option as a word of the command line, and the value within this word. Parsed options point
// into these words, so only command lines with the same words can be compared.
static char texts[OPTIONS_MOST][80];
static const char *values[OPTIONS_MOST];

SET_UP(write_options)
{
    for (size_t i = 0; i < option_count; i++) {
        const Option *option = &option_table[i];
        const char *key = option_key(option), *sample = NULL;
        for (size_t j = 0; j < sizeof samples / sizeof *samples; j++)
            if (strcmp(samples[j].name, option->name) == 0)
                sample = samples[j].value;
        const int length =
            snprintf(texts[i], sizeof texts[i], "--%.*s%s%s%s%s", (int)strcspn(option->name, " "),
                     option->name, key != NULL ? "=" : "", key != NULL ? key : "",
                     sample != NULL ? "=" : "", sample != NULL ? sample : "");
        values[i] = sample != NULL ? texts[i] + length - strlen(sample) : NULL;
        if (is_walked(option) && (sample == NULL) != (option->argument == NULL))
            return 1;
    }
    return 0;
}

typedef struct {
    bool ok;
    Options options;
    Error error;
} Parsed;

// Parses the line with two more options. An option may be NULL.
static void parse(Parsed *parsed, const Words line, const Option *first, const Option *second)
{
    const Option *added[] = {first, second};
    char *words[WORDS_MOST + 4] = {"clrt"};
    int count = 1;
    for (int i = 0; line[i] != NULL; i++)
        words[count++] = (char *)line[i];
    for (int i = 0; i < 2; i++)
        if (added[i] != NULL)
            words[count++] = texts[added[i] - option_table];
    memset(parsed, 0, sizeof *parsed);
    parsed->ok = options_parse(&parsed->options, count, words, &parsed->error);
}

// Copies the members that no single option determines.
static void copy_derived(Options *to, const Options *from)
{
    to->action = from->action;
    to->format = from->format;
    to->frames = from->frames;
    to->resume = from->resume;                         // frames have skips_finished instead
    to->picture.statistics = from->picture.statistics; // implied by --json
    to->part_paths = from->part_paths;
}

// Fails unless `found` equals the options of `line` plus both options of the pair.
static void expect_effects(const Options *found, const Words line, const Option *pair[2])
{
    Parsed expected;
    parse(&expected, line, NULL, NULL);
    assert_true(expected.ok);
    for (int i = 0; i < 2; i++) {
        Error error = {0};
        assert_true(
            option_store(pair[i], &expected.options, values[pair[i] - option_table], &error));
        expected.options.given |= found->given;
        assert_true(option_is_given(found, pair[i]->name));
    }
    copy_derived(&expected.options, found);
    assert_memory_equal(&expected.options, found, sizeof *found);
}

// Returns whether the text names the option. For keys of --tune, the text must name --tune.
static bool names(const char *text, const Option *option)
{
    char name[32];
    snprintf(name, sizeof name, "--%.*s", (int)strcspn(option->name, " "), option->name);
    return strstr(text, name) != NULL;
}

static void expect_sentence(const char *text, const Option *pair[2])
{
    if (!names(text, pair[0]) && !names(text, pair[1]))
        fail_msg("--%s and --%s: %s", pair[0]->name, pair[1]->name, text);
}

// clrt rejects these pairs, but accepts some of them with certain values or with further options.
// The pairs of exclusion_table always exclude each other, and --help lists them.
static const char *const conflicts[][2] = {
    {"resume", "aa-adaptive"}, {"resume", "error"},          {"resume", "time"},
    {"frames", "view"},        {"frames", "reference"},      {"frames", "hash"},
    {"turntable", "hash"},     {"turntable", "reference"},   {"format", "aov"},
    {"format", "part"},        {"precision", "tune kernel"},
};

static bool is_listed(const char *name, const char *const *names)
{
    for (int i = 0; i < EXCLUSION_NAMES && names[i] != NULL; i++)
        if (strcmp(name, names[i]) == 0)
            return true;
    return false;
}

static bool is_conflict(const char *one, const char *other)
{
    for (size_t i = 0; i < sizeof conflicts / sizeof *conflicts; i++)
        if (strcmp(conflicts[i][0], one) == 0 && strcmp(conflicts[i][1], other) == 0)
            return true;
    for (size_t i = 0; i < exclusion_count; i++) {
        const Exclusion *row = &exclusion_table[i];
        if (is_listed(one, row->names) &&
            is_listed(other, row->others[0] != NULL ? row->others : row->names))
            return true;
    }
    return false;
}

// Fails if clrt rejects an undocumented pair although it accepts each option alone. Also fails if
// clrt accepts a documented pair.
static void expect_documented(const Parsed *both, const Words line, const Option *pair[2])
{
    static Parsed one, other;
    const char *name[] = {pair[0]->name, pair[1]->name};
    parse(&one, line, pair[0], NULL);
    parse(&other, line, pair[1], NULL);
    const bool is_documented = is_conflict(name[0], name[1]) || is_conflict(name[1], name[0]);
    // --hash selects another command, whose message for an unsuitable option starts with "clrt ".
    const bool is_of_command = strncmp(both->error.text, "clrt ", 5) == 0;
    const bool is_rejected = !both->ok && one.ok && other.ok && !is_of_command;
    if (is_rejected ? !is_documented : is_documented && both->ok)
        fail_msg("--%s and --%s are %s", name[0], name[1],
                 both->ok ? "accepted" : both->error.text);
}

TEST(each_pair_is_rejected_or_has_both_effects)
{
    static Parsed one, other;
    for (size_t line = 0; line < LINES; line++)
        for (size_t i = 0; i < option_count; i++)
            for (size_t j = 0; j < i; j++) {
                const Option *pair[] = {&option_table[i], &option_table[j]};
                if (!is_walked(pair[0]) || !is_walked(pair[1]))
                    continue;
                parse(&one, lines[line], pair[0], pair[1]);
                parse(&other, lines[line], pair[1], pair[0]);
                assert_int_equal(one.ok, other.ok);
                assert_string_equal(one.error.text, other.error.text);
                if (one.ok) {
                    expect_effects(&one.options, lines[line], pair);
                    expect_effects(&other.options, lines[line], pair);
                } else {
                    expect_sentence(one.error.text, pair);
                }
                expect_documented(&one, lines[line], pair);
            }
}
