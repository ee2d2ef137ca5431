// SPDX-License-Identifier: MIT
// Tests that clrt finds each cause of a difference in the pictures' channels.
#include "compare/difference.h"

#include "unit/cmocka_all.h"

#include <math.h>
#include <string.h>

#define CHANNELS 7
#define PIXELS   8

static const char *const names[CHANNELS] = {"R",      "G",       "B",      "primitive",
                                            "shadow", "bounces", "samples"};
enum { RED, GREEN, BLUE, PRIMITIVE, SHADOW, BOUNCES, SAMPLES };

static StoredImage gray_image(const char *settings)
{
    StoredImage image = {.width = PIXELS, .height = 1, .channel_count = CHANNELS};
    Error error = {0};
    strcpy(image.texts[STORED_SETTINGS], settings);
    for (int i = 0; i < CHANNELS; i++)
        strcpy(image.names[i], names[i]);
    assert_true(stored_image_allocate(&image, &error));
    for (int i = 0; i < CHANNELS * PIXELS; i++)
        image.values[i] = 0.5f;
    for (int pixel = 0; pixel < PIXELS; pixel++)
        image.values[pixel * CHANNELS + BOUNCES] = 1;
    return image;
}

static void add(StoredImage *image, int pixel, int channel, float value)
{
    image->values[pixel * CHANNELS + channel] += value;
}

static Causes find(StoredImage images[2])
{
    ComparedImages pair = {{&images[0], &images[1]}, {"a", "b"}, {{0}}};
    Causes causes;
    Difference difference;
    Error error = {0};
    assert_true(compared_images_check(&pair, &error));
    causes_find(&causes, &pair);
    difference_measure(&difference, &pair);
    double sum = 0;
    for (int i = 0; i < CAUSE_KINDS; i++)
        sum += causes.squares[i];
    if (causes.known)
        assert_true(fabs(sum - (difference.rmse * difference.rmse)) < 1e-12);
    stored_image_free(&images[0]);
    stored_image_free(&images[1]);
    return causes;
}

TEST(every_pixel_counts_for_its_first_cause)
{
    StoredImage images[2] = {gray_image("{\"max_level\":2,\"samples\":1,\"view\":1}"),
                             gray_image("{\"max_level\":4,\"samples\":2,\"view\":1}")};
    StoredImage *other = &images[1];
    for (int pixel = 0; pixel < PIXELS - 1; pixel++)
        add(other, pixel, GREEN, 0.0625f * (float)(1 + pixel));
    add(other, 0, PRIMITIVE, 1);
    add(other, 0, SHADOW, -0.5f);
    add(other, 1, SHADOW, -0.5f);
    add(other, 1, BOUNCES, 1);
    add(other, 2, BOUNCES, 1); // the first picture's max_level allows one bounce
    add(other, 3, BOUNCES, -1);
    add(other, 5, GREEN, -0.0625f * 6 + 0x1p-20f);
    add(other, 6, GREEN, -0.0625f * 7);
    const Causes causes = find(images);
    assert_true(causes.known);
    for (int kind = 0; kind < CAUSE_KINDS; kind++)
        assert_int_equal(causes.pixels[kind], 1);
    const double step = 0.0625 * 0.0625 / (3 * PIXELS);
    static const double steps[CAUSE_KINDS] = {1, 4, 9, 16, 25, 0};
    for (int kind = 0; kind < CAUSE_KINDS; kind++)
        assert_true(fabs(causes.squares[kind] - steps[kind] * step) < 1e-12);
}

TEST(with_the_same_samples_the_rest_is_rounding)
{
    StoredImage images[2] = {gray_image("{\"max_level\":3,\"samples\":2}"),
                             gray_image("{\"max_level\":3,\"samples\":2}")};
    add(&images[1], 4, RED, 0.25f);
    const Causes causes = find(images);
    assert_int_equal(causes.pixels[CAUSE_ROUNDING], 1);
    assert_int_equal(causes.pixels[CAUSE_COVERAGE], 0);
}

TEST(pixels_of_an_adaptive_picture_may_have_other_samples)
{
    StoredImage images[2] = {gray_image("{\"samples\":\"adaptive\"}"),
                             gray_image("{\"samples\":\"adaptive\"}")};
    add(&images[1], 4, RED, 0.25f);
    add(&images[1], 5, RED, 0.25f);
    add(&images[1], 5, SAMPLES, 8);
    const Causes causes = find(images);
    assert_int_equal(causes.pixels[CAUSE_ROUNDING], 1);
    assert_int_equal(causes.pixels[CAUSE_COVERAGE], 1);
}

TEST(paths_that_end_before_the_limit_were_not_cut)
{
    StoredImage images[2] = {gray_image("{\"max_level\":3}"), gray_image("{\"max_level\":4}")};
    add(&images[1], 2, BOUNCES, 1);
    add(&images[1], 2, BLUE, 0.25f);
    assert_int_equal(find(images).pixels[CAUSE_REFLECTION], 1);
}

TEST(files_without_the_channels_have_no_known_cause)
{
    StoredImage images[2] = {gray_image("{\"samples\":1}"), gray_image("{\"samples\":1}")};
    strcpy(images[1].names[SHADOW], "Z");
    assert_false(find(images).known);
}
