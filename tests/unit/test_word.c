// SPDX-License-Identifier: MIT
// Tests the suggestions for misspelled words.
#include "base/word.h"

#include "unit/cmocka_all.h"

#include <string.h>

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
