// SPDX-License-Identifier: MIT
// Tests the tokenizer of scene text and the suggestions for misspelled words.
#include "scene/tokens.h"

#include "base/word.h"

#include "unit/cmocka_all.h"

#include <string.h>

static Tokens tokens_in(const char *text, Error *error)
{
    return tokens_of(text, strlen(text), "a.scn", error);
}

TEST(tokens_carry_line_and_column)
{
    Error error = {0};
    Tokens tokens = tokens_in("\n\n  light\t1\n", &error);
    const Token light = tokens_next_statement(&tokens);
    assert_true(token_is(light, "light"));
    assert_int_equal(light.line, 3);
    assert_int_equal(light.column, 3);
    assert_int_equal(tokens_next(&tokens).column, 9);
    assert_null(tokens_next(&tokens).text);
    assert_null(tokens_next_statement(&tokens).text);
}

TEST(comments_end_a_line_anywhere)
{
    Error error = {0};
    Tokens tokens = tokens_in("// one\n# two\nlight // three\nsphere # four", &error);
    assert_true(token_is(tokens_next_statement(&tokens), "light"));
    assert_null(tokens_next(&tokens).text);
    assert_true(token_is(tokens_next_statement(&tokens), "sphere"));
    assert_null(tokens_next(&tokens).text);
}

TEST(slashes_inside_a_path_are_no_comment)
{
    Error error = {0};
    Tokens tokens = tokens_in("ply_file ..//a#b.ply", &error);
    tokens_next_statement(&tokens);
    assert_true(token_is(tokens_next(&tokens), "..//a#b.ply"));
}

TEST(all_three_line_ends_count_one_line)
{
    Error error = {0};
    Tokens tokens = tokens_in("a\r\nb\rc\nd", &error);
    for (unsigned line = 1; line <= 4; line++)
        assert_int_equal(tokens_next_statement(&tokens).line, line);
}

TEST(quotes_hold_blanks_together)
{
    Error error = {0};
    Tokens tokens = tokens_in("ply_file \"my model.ply\" x", &error);
    tokens_next_statement(&tokens);
    assert_true(token_is(tokens_next(&tokens), "my model.ply"));
    assert_true(token_is(tokens_next(&tokens), "x"));
}

TEST(messages_show_no_control_bytes_and_shorten_long_tokens)
{
    Error error = {0};
    Tokens tokens = tokens_in("\033[31mxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx", &error);
    const Token token = tokens_next_statement(&tokens);
    assert_false(tokens_fail(&tokens, token, "no"));
    assert_string_equal(error.text,
                        "a.scn:1:1: no: found '?[31mxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx'...");
}

TEST(an_unclosed_quote_is_part_of_the_word)
{
    Error error = {0};
    Tokens tokens = tokens_in("ply_file \"my model.ply\n\"", &error);
    tokens_next_statement(&tokens);
    assert_true(token_is(tokens_next(&tokens), "\"my"));
}

TEST(a_byte_order_mark_is_passed_over)
{
    Error error = {0};
    Tokens tokens = tokens_in("\xef\xbb\xbflight", &error);
    const Token token = tokens_next_statement(&tokens);
    assert_true(token_is(token, "light"));
    assert_int_equal(token.column, 1);
}

static const char *const words[] = {"light", "material", "sphere", "ply_file"};

static const char *nearest(const char *text)
{
    return word_nearest(text, strlen(text), words, 4);
}

TEST(a_mistyped_word_finds_the_one_meant)
{
    assert_string_equal(nearest("ligth"), "light");
    assert_string_equal(nearest("shpere"), "sphere");
    assert_string_equal(nearest("plyfile"), "ply_file");
}

TEST(a_word_unlike_all_finds_none)
{
    assert_null(nearest("zzzzzz"));
    assert_null(nearest("a word that is far longer than any keyword could be"));
    assert_null(word_nearest("x", 1, words, 0));
}
