// SPDX-License-Identifier: MIT
// Draws a reference picture. Takes samples until the estimate of the picture's own error is at most
// ERROR, or until each pixel has MOST samples. Prints the number of samples and the estimated error
// as JSON. Arguments: SCENE WIDTH HEIGHT ERROR MOST FILE.pfm
//
// Every pixel has two independent sequences, and the picture is the mean of both. A sequence is
// Sobol's in two dimensions after Owen's nested scrambling ("Randomly permuted (t,m,s)-nets and
// (t,s)-sequences", 1995). Its mean is an unbiased estimate. The random numbers of pixels and
// sequences are independent, so regular scenes do not alias. The ladder of --error scrambles
// Sobol's sequence by another hash (kernels/samples.cl), so its errors are independent of the
// errors of the reference.
#include "image/image_file.h"
#include "image/rendered.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// Sub-pixels along a pixel's side.
#define GRID_BITS 12
#define GRID      (1u << GRID_BITS)

#define FIRST_SAMPLES 16
#define LIST_SAMPLES  (1u << 20)

// In the generated scenes, later reflections add less to a color than a float can show.
#define LEVELS 200

typedef struct {
    double wanted;           // own error
    uint32_t most;           // samples of a pixel
    uint32_t samples;        // taken in each pixel
    double own_error;        // of the picture
    double (*halves[2])[3];  // sums of the colors of both sequences, by pixel
    SamplePlace *places;     // room for LIST_SAMPLES
    SampleData *results;     // of the listed samples
    const Framebuffer *size; // of the picture
} Reference;

// Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014.
static uint64_t mix(uint64_t value)
{
    value += 0x9e3779b97f4a7c15;
    value = (value ^ value >> 30) * 0xbf58476d1ce4e5b9;
    value = (value ^ value >> 27) * 0x94d049bb133111eb;
    return value ^ value >> 31;
}

// Flips each bit by a hash of the bits above it.
static uint32_t scrambled(uint32_t coordinate, uint64_t seed)
{
    uint32_t result = coordinate;
    for (uint32_t bit = 0; bit < GRID_BITS; bit++) {
        const uint64_t above = (uint64_t)coordinate >> (bit + 1);
        result ^= (uint32_t)(mix(seed ^ (above << 8 | bit)) & 1) << bit;
    }
    return result;
}

// Computes an unscrambled point. The direction numbers of y are rows of Pascal's triangle mod 2.
static void sobol_point(uint32_t index, uint32_t point[2])
{
    uint32_t y_bits = GRID / 2;
    point[0] = point[1] = 0;
    for (uint32_t x_bit = GRID / 2; x_bit != 0; x_bit /= 2, index /= 2) {
        point[0] ^= (index & 1) * x_bit;
        point[1] ^= (index & 1) * y_bits;
        y_bits ^= y_bits / 2;
    }
}

// A range of samples in both sequences (halves) of each pixel.
typedef struct {
    uint32_t first, count;
} SampleRange;

static void list_samples(const Reference *reference, uint32_t pixel, SampleRange range,
                         SamplePlace *places)
{
    const uint32_t width = reference->size->width;
    for (uint32_t half = 0; half < 2; half++) {
        const uint64_t seed = mix((uint64_t)pixel << 1 | half);
        for (uint32_t i = 0; i < range.count; i++) {
            uint32_t point[2];
            sobol_point(range.first + i, point);
            *places++ = (SamplePlace){pixel % width * GRID + scrambled(point[0], mix(seed)),
                                      pixel / width * GRID + scrambled(point[1], mix(~seed))};
        }
    }
}

static void add_samples(Reference *reference, uint32_t pixel, SampleRange range,
                        const SampleData *results)
{
    for (uint32_t half = 0; half < 2; half++)
        for (uint32_t i = 0; i < range.count; i++, results++)
            for (int channel = 0; channel < 3; channel++)
                reference->halves[half][pixel][channel] += (double)results->color[channel];
}

static bool take_range(Reference *reference, Renderer *renderer, const FrameData *frame,
                       SampleRange range, Error *error)
{
    const uint32_t pixels = reference->size->width * reference->size->height;
    const uint32_t each = 2 * range.count, most = LIST_SAMPLES / each;
    for (uint32_t first = 0; first < pixels; first += most) {
        const uint32_t count = pixels - first < most ? pixels - first : most;
        const SampleList list = {reference->places, reference->results, count * each, 0};
        for (uint32_t i = 0; i < count; i++)
            list_samples(reference, first + i, range, reference->places + (size_t)i * each);
        if (!sampler_trace(renderer, frame, &list, NULL, error))
            return false;
        for (uint32_t i = 0; i < count; i++)
            add_samples(reference, first + i, range, reference->results + (size_t)i * each);
    }
    return true;
}

// Stores the mean of the two halves, and estimates its error from the difference of the halves.
static void store(Reference *reference, Framebuffer *picture)
{
    const size_t pixels = (size_t)picture->width * picture->height;
    double squares = 0;
    for (size_t pixel = 0; pixel < pixels; pixel++)
        for (int channel = 0; channel < 3; channel++) {
            const double one = reference->halves[0][pixel][channel] / reference->samples;
            const double other = reference->halves[1][pixel][channel] / reference->samples;
            picture->pixels[pixel][channel] = (float)(one + other);
            squares += (one - other) * (one - other);
        }
    reference->own_error = sqrt(squares / (3 * (double)pixels));
}

static bool draw(void *context, Renderer *renderer, const CameraData *camera, Framebuffer *picture,
                 Error *error)
{
    Reference *reference = context;
    FrameData frame = renderer_frame(renderer, camera);
    const size_t pixels = (size_t)picture->width * picture->height;
    bool ok = true;
    frame.samples = GRID;
    reference->size = picture;
    for (int half = 0; half < 2; half++)
        ok = (reference->halves[half] =
                  memory_zeroed(pixels, sizeof *reference->halves[half], error)) != NULL &&
             ok;
    SampleRange range = {0, FIRST_SAMPLES / 2};
    while (ok) {
        ok = take_range(reference, renderer, &frame, range, error);
        reference->samples = 2 * (range.first + range.count);
        store(reference, picture);
        if (reference->own_error <= reference->wanted || 2 * reference->samples > reference->most)
            break;
        range = (SampleRange){reference->samples / 2, reference->samples / 2};
    }
    for (int half = 0; half < 2; half++)
        free(reference->halves[half]);
    return ok;
}

int main(int count, char **words)
{
    if (count != 7)
        return 2;
    Error error = {0};
    Framebuffer picture = {0};
    Reference reference = {.wanted = atof(words[4]), .most = (uint32_t)atoi(words[5])};
    PictureRequest request = picture_request(words[1], 1);
    const ImageSettings settings = {.format = "pfm"};
    request.width = (uint32_t)atoi(words[2]);
    request.height = (uint32_t)atoi(words[3]);
    request.samples = GRID;
    request.max_level = LEVELS;
    request.draw = draw;
    request.draw_context = &reference;
    reference.places = malloc(LIST_SAMPLES * sizeof *reference.places);
    reference.results = malloc(LIST_SAMPLES * sizeof *reference.results);
    const bool ok = reference.places != NULL && reference.results != NULL &&
                    picture_render(&picture, &request, &error) &&
                    image_write(&picture, words[6], &settings, &error);
    if (ok)
        printf("{\"samples\": %u, \"own_error\": %.9g}\n", reference.samples, reference.own_error);
    else
        fprintf(stderr, "%s\n", error.text);
    free(reference.places);
    free(reference.results);
    framebuffer_free(&picture);
    return ok ? 0 : 1;
}
