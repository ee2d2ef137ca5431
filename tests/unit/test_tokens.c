// SPDX-License-Identifier: MIT
// Tests the tokenizer of scene text and the suggestions for misspelled words.
#include "scene/tokens.h"

#include "base/text.h"

#include "unit/cmocka_all.h"

#include <stdio.h>
#include <string.h>

static Tokens tokens_in(const char *text, Error *error)
{
    return tokens_of(text, strlen(text), "a.scn", error);
}

// Expects these statements. Each token follows its line and column.
static void expect_tokens(const char *text, const char *expected)
{
    Error error = {0};
    char found[256] = "";
    Tokens tokens = tokens_in(text, &error);
    for (Token token; (token = tokens_next_statement(&tokens)).text != NULL; strcat(found, "; "))
        for (; token.text != NULL; token = tokens_next(&tokens))
            snprintf(found + strlen(found), sizeof found - strlen(found), "%u:%u %.*s ", token.line,
                     token.column, (int)token.length, token.text);
    assert_string_equal(found, expected);
}

TEST(tokens_carry_line_and_column)
{
    expect_tokens("\n\n  light\t1\n", "3:3 light 3:9 1 ; ");
    expect_tokens("a\r\nb\rc\nd", "1:1 a ; 2:1 b ; 3:1 c ; 4:1 d ; ");
    expect_tokens("\xef\xbb\xbflight", "1:1 light ; "); // after a byte order mark
}

TEST(comments_end_a_line_anywhere_but_inside_a_path)
{
    expect_tokens("// one\n# two\nlight // three\nsphere # four", "3:1 light ; 4:1 sphere ; ");
    expect_tokens("ply_file ..//a#b.ply", "1:1 ply_file 1:10 ..//a#b.ply ; ");
}

TEST(quotes_hold_blanks_together_and_an_unclosed_quote_is_part_of_the_word)
{
    Error error = {0};
    Tokens tokens = tokens_in("ply_file \"my model.ply\" x", &error);
    tokens_next_statement(&tokens);
    assert_true(token_is(tokens_next(&tokens), "my model.ply"));
    assert_true(token_is(tokens_next(&tokens), "x"));
    tokens = tokens_in("ply_file \"my model.ply\n\"", &error);
    tokens_next_statement(&tokens);
    assert_true(token_is(tokens_next(&tokens), "\"my"));
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
