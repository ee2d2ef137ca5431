// SPDX-License-Identifier: MIT
// Tests the tokenizer of scene text.
#include "scene/tokens.h"

#include "unit/cmocka_all.h"

#include <string.h>

static Tokens tokens_in(const char *text, Error *error)
{
    return tokens_of(text, strlen(text), "a.scn", error);
}

static void tokens_carry_line_and_column(void **state)
{
    (void)state;
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

static void comments_end_a_line_anywhere(void **state)
{
    (void)state;
    Error error = {0};
    Tokens tokens = tokens_in("// one\n# two\nlight // three\nsphere # four", &error);
    assert_true(token_is(tokens_next_statement(&tokens), "light"));
    assert_null(tokens_next(&tokens).text);
    assert_true(token_is(tokens_next_statement(&tokens), "sphere"));
    assert_null(tokens_next(&tokens).text);
}

static void slashes_inside_a_path_are_no_comment(void **state)
{
    (void)state;
    Error error = {0};
    Tokens tokens = tokens_in("ply_file ..//a#b.ply", &error);
    tokens_next_statement(&tokens);
    assert_true(token_is(tokens_next(&tokens), "..//a#b.ply"));
}

static void all_three_line_ends_count_one_line(void **state)
{
    (void)state;
    Error error = {0};
    Tokens tokens = tokens_in("a\r\nb\rc\nd", &error);
    for (unsigned line = 1; line <= 4; line++)
        assert_int_equal(tokens_next_statement(&tokens).line, line);
}

static void quotes_hold_blanks_together(void **state)
{
    (void)state;
    Error error = {0};
    Tokens tokens = tokens_in("ply_file \"my model.ply\" x", &error);
    tokens_next_statement(&tokens);
    assert_true(token_is(tokens_next(&tokens), "my model.ply"));
    assert_true(token_is(tokens_next(&tokens), "x"));
}

static void messages_show_no_control_bytes_and_shorten_long_tokens(void **state)
{
    (void)state;
    Error error = {0};
    Tokens tokens = tokens_in("\033[31mxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx", &error);
    const Token token = tokens_next_statement(&tokens);
    assert_false(tokens_fail(&tokens, token, "no"));
    assert_string_equal(error.text,
                        "a.scn:1:1: no: found '?[31mxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx'...");
}

static void an_unclosed_quote_is_part_of_the_word(void **state)
{
    (void)state;
    Error error = {0};
    Tokens tokens = tokens_in("ply_file \"my model.ply\n\"", &error);
    tokens_next_statement(&tokens);
    assert_true(token_is(tokens_next(&tokens), "\"my"));
}

static void a_byte_order_mark_is_passed_over(void **state)
{
    (void)state;
    Error error = {0};
    Tokens tokens = tokens_in("\xef\xbb\xbflight", &error);
    const Token token = tokens_next_statement(&tokens);
    assert_true(token_is(token, "light"));
    assert_int_equal(token.column, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tokens_carry_line_and_column),
        cmocka_unit_test(comments_end_a_line_anywhere),
        cmocka_unit_test(slashes_inside_a_path_are_no_comment),
        cmocka_unit_test(all_three_line_ends_count_one_line),
        cmocka_unit_test(quotes_hold_blanks_together),
        cmocka_unit_test(an_unclosed_quote_is_part_of_the_word),
        cmocka_unit_test(a_byte_order_mark_is_passed_over),
        cmocka_unit_test(messages_show_no_control_bytes_and_shorten_long_tokens),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
