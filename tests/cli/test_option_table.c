// SPDX-License-Identifier: MIT
// Tests that the table of options is consistent, and that --help and the parser match it.
#include "cli/commands.h"
#include "cli/options/option.h"
#include "unit/cmocka_all.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static bool is_choice(const Option *option)
{
    return option->kind == OPTION_WORD || option->set == set_normals;
}

// Copies the option's argument without the brackets of an optional argument.
static void copy_words(char words[128], const Option *option)
{
    const char *list = option->argument + (option->argument[0] == '[' ? 2 : 0);
    snprintf(words, 128, "%.*s", (int)strcspn(list, "]"), list);
}

TEST(groups_are_in_their_order)
{
    for (size_t i = 1; i < option_count; i++)
        assert_true(option_table[i - 1].group <= option_table[i].group);
    for (size_t group = 0; group < OPTION_GROUPS; group++)
        assert_non_null(option_group_names[group]);
}

TEST(names_and_letters_are_unique)
{
    for (size_t i = 0; i < option_count; i++)
        for (size_t j = 0; j < i; j++) {
            assert_string_not_equal(option_table[i].name, option_table[j].name);
            if (option_table[i].letter != 0)
                assert_int_not_equal(option_table[i].letter, option_table[j].letter);
        }
}

TEST(settings_that_cost_or_buy_speed_are_classed)
{
    for (size_t i = 0; i < option_count; i++) {
        const Option *option = &option_table[i];
        if (option->group == GROUP_SPEED)
            assert_int_equal(option->class, CLASS_EXACT);
        if (option->group == GROUP_QUALITY)
            assert_true(option->class == CLASS_BOUNDED || option->class == CLASS_STATISTICAL);
    }
}

// If an option has CLASS_BOUNDED, its help text must contain the bound of the error.
TEST(bounded_settings_name_their_bound)
{
    for (size_t i = 0; i < option_count; i++)
        if (option_table[i].class == CLASS_BOUNDED)
            assert_non_null(strstr(option_table[i].help, "the error is at most"));
}

// Returns whether the word is a name in capitals, which stands for any value.
static bool is_name(const char *word)
{
    return isupper((unsigned char)word[0]);
}

TEST(every_listed_word_is_understood)
{
    for (size_t i = 0; i < option_count; i++) {
        if (!is_choice(&option_table[i]))
            continue;
        char words[128], *rest = words;
        copy_words(words, &option_table[i]);
        for (char *word = strsep(&rest, "|"); word != NULL; word = strsep(&rest, "|")) {
            Options options = {0};
            Error error = {0};
            assert_true(is_name(word) || option_store(&option_table[i], &options, word, &error));
        }
    }
}

TEST(every_understood_word_is_listed)
{
    for (size_t i = 0; i < option_count; i++) {
        if (!is_choice(&option_table[i]) || is_name(option_table[i].argument))
            continue;
        Options options = {0};
        Error error = {0};
        char expected[256], words[128], *rest = words;
        const int start = snprintf(expected, sizeof expected, "--%s wants ", option_table[i].name);
        copy_words(words, &option_table[i]);
        for (char *word = strsep(&rest, "|"); word != NULL; word = strsep(&rest, "|")) {
            const char *gap = strcspn(expected, "\0") == (size_t)start ? "" : rest ? ", " : " or ";
            strcat(strcat(expected, gap), word);
        }
        strcat(expected, ", not 'nonsense'");
        assert_false(option_store(&option_table[i], &options, "nonsense", &error));
        assert_string_equal(error.text, expected);
    }
}

// Returns the text of --help.
static const char *help_text(void)
{
    static char text[1 << 16];
    FILE *stream = fmemopen(text, sizeof text, "w");
    assert_non_null(stream);
    options_write_help(stream);
    assert_int_equal(fclose(stream), 0);
    return text;
}

// Returns the start of the option's text in --help, and stores its end.
static const char *find_entry(const char *help, const Option *option, const char **end)
{
    char start[96], letter[8] = "    ";
    if (option->letter != 0)
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    const bool separate = option->argument != NULL && !option_argument_is_optional(option);
    if (option_key(option) != NULL)
        snprintf(start, sizeof start, "\n        %s=%s", option_key(option), option->argument);
    else
        snprintf(start, sizeof start, "\n  %s--%s%s%s", letter, option->name, separate ? " " : "",
                 option->argument == NULL ? "" : option->argument);
    const char *entry = strstr(help, start);
    assert_non_null(entry);
    *end = entry + 1 + strcspn(entry + 1, "\n");
    while (strspn(*end + 1, " ") > 8) // continuation lines
        *end += 1 + strcspn(*end + 1, "\n");
    return entry + strlen(start);
}

TEST(help_names_every_option_with_its_class)
{
    const char *help = help_text();
    for (size_t i = 0; i < option_count; i++) {
        const char *end, *entry = find_entry(help, &option_table[i], &end);
        char class[32];
        snprintf(class, sizeof class, " [%s]", option_class_names[option_table[i].class]);
        if (option_table[i].class != CLASS_NONE)
            assert_memory_equal(end - strlen(class), class, strlen(class));
        else
            assert_null(memchr(entry, '[', (size_t)(end - entry)));
    }
}

TEST(help_fits_a_wide_terminal_and_a_tall_page)
{
    int lines = 0;
    for (const char *line = help_text(); *line != '\0'; line += strcspn(line, "\n") + 1, lines++)
        assert_true(strcspn(line, "\n") <= 100);
    assert_true(lines <= 110);
}
