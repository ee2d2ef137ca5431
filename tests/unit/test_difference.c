// SPDX-License-Identifier: MIT
// Compares differences of small pictures with values computed by hand, and tests the limits.
#include "compare/difference.h"

#include "unit/cmocka_all.h"

#include <math.h>
#include <string.h>

#define PIXELS 4

// Returns an image of 2 x 2 pixels. The fourth channel contains the first hits.
static StoredImage image_of(const float (*values)[4])
{
    StoredImage image = {
        .width = 2, .height = 2, .channel_count = 4, .names = {"B", "G", "R", DIFFERENCE_HITS}};
    Error error = {0};
    assert_true(stored_image_allocate(&image, &error));
    memcpy(image.values, values, PIXELS * sizeof values[0]);
    return image;
}

static const float plain[PIXELS][4] = {{0, 0, 0, 1}, {1, 1, 1, 2}, {0, 0.5f, 1, 3}, {0, 0, 0, 4}};

static bool measure(Difference *difference, StoredImage images[2], Error *error)
{
    ComparedImages pair = {{&images[0], &images[1]}, {"a", "b"}, {{0}}};
    const bool ok = compared_images_check(&pair, error);
    if (ok)
        difference_measure(difference, &pair);
    stored_image_free(&images[0]);
    stored_image_free(&images[1]);
    return ok;
}

static Difference measured(const float (*a)[4], const float (*b)[4])
{
    Difference difference;
    Error error = {0};
    StoredImage images[2] = {image_of(a), image_of(b)};
    assert_true(measure(&difference, images, &error));
    return difference;
}

TEST(all_three_colors_of_all_pixels_count_alike)
{
    float other[PIXELS][4];
    memcpy(other, plain, sizeof other);
    other[1][0] = 0.5f;   // blue
    other[2][2] = 0.75f;  // red
    other[3][1] = 0.003f; // less than 1/255
    const Difference difference = measured(plain, (const float(*)[4])other);
    const double small = (double)0.003f;
    assert_true(difference.rmse == sqrt((0.25 + 0.0625 + small * small) / 12));
    assert_true(difference_psnr(&difference) == -20 * log10(difference.rmse));
    assert_true(difference.maximum == 0.5);
    assert_int_equal(difference.maximum_x, 1);
    assert_int_equal(difference.maximum_y, 0);
    assert_int_equal(difference.maximum_color, 2);
    assert_int_equal(difference.off_by_1, 2);
    assert_int_equal(difference.off_by_4, 2);
}

TEST(a_step_of_8_bits_is_not_more_than_a_step)
{
    for (int step = 1; step <= 5; step++)
        for (int level = 0; level + step <= 255; level++) {
            const unsigned char bytes[2] = {(unsigned char)level, (unsigned char)(level + step)};
            float values[2];
            stored_image_values(bytes, 2, values);
            const float a[PIXELS][4] = {{values[0], 0, 0, 0}},
                        b[PIXELS][4] = {{values[1], 0, 0, 0}};
            const Difference difference = measured(a, b);
            assert_int_equal(difference.off_by_1, step > 1);
            assert_int_equal(difference.off_by_4, step > 4);
        }
}

TEST(first_hits_are_compared_where_both_files_have_them)
{
    float other[PIXELS][4];
    memcpy(other, plain, sizeof other);
    other[0][3] = 7;
    assert_int_equal(measured(plain, (const float(*)[4])other).wrong_hits, 1);
    assert_true(measured(plain, (const float(*)[4])other).rmse == 0);
    StoredImage images[2] = {image_of(plain), image_of((const float(*)[4])other)};
    strcpy(images[1].names[3], "A");
    Difference difference;
    Error error = {0};
    assert_true(measure(&difference, images, &error));
    assert_false(difference.has_hits);
}

// cli/test_compare.py tests other pairs that cannot be compared, and the map of differences.
TEST(pictures_without_colors_are_refused)
{
    Difference difference;
    Error error = {0};
    StoredImage images[2] = {image_of(plain), image_of(plain)};
    strcpy(images[0].names[2], "red");
    assert_false(measure(&difference, images, &error));
    assert_non_null(strstr(error.text, "no channels R, G and B"));
}

TEST(limits_are_kept_up_to_their_value)
{
    Limits limits = {0};
    Error error = {0};
    assert_true(limits_parse(&limits, "rmse=0.5,max=25%,psnr=6,share1=1,share4=.5,hits=0", &error));
    Difference difference = {.pixels = 2, .rmse = 0.5, .maximum = 0.25, .has_hits = true};
    difference.off_by_1 = 2;
    difference.off_by_4 = 1;
    for (int kind = 0; kind < LIMIT_KINDS; kind++)
        assert_true(limit_is_kept(&limits, (LimitKind)kind, &difference));
    difference = (Difference){.pixels = 2, .rmse = 0.51, .maximum = 0.26, .has_hits = true};
    difference.off_by_1 = 3;
    difference.off_by_4 = 2;
    difference.wrong_hits = 1;
    for (int kind = 0; kind < LIMIT_KINDS; kind++)
        assert_false(limit_is_kept(&limits, (LimitKind)kind, &difference));
}

TEST(limits_that_are_not_understood_are_refused)
{
    const char *const wrong[] = {"",         "rmse",       "rmse=",        "rmse=x",  "mse=1",
                                 "rmse=1,",  "rmse=1 ",    "rmse=1;max=1", "rmse=-1", "psnr=4%",
                                 "rmse=1%%", "rmse=1e999", "rm=1",         "rmse=inf"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        Limits limits = {0};
        Error error = {0};
        assert_false(limits_parse(&limits, wrong[i], &error));
        assert_non_null(strstr(error.text, "needs limits like rmse=0.01"));
    }
}
