// SPDX-License-Identifier: MIT
// In a set of pixels, each row starts at a word boundary. In other sets, each pixel does.
#include "refine/cell_set.h"

#include <stdlib.h>
#include <string.h>

#define WORD_BITS 32

bool slots_make(Slots *slots, uint32_t width, uint32_t height, Error *error)
{
    *slots = (Slots){.width = width, .height = height};
    slots->of_pixels = memory_zeroed((size_t)width * height, sizeof *slots->of_pixels, error);
    return slots->of_pixels != NULL;
}

void slots_free(Slots *slots)
{
    free(slots->of_pixels);
    *slots = (Slots){0};
}

void slots_add(Slots *slots, uint32_t column, uint32_t row)
{
    const uint32_t slot = 1 + atomic_fetch_add_explicit(&slots->count, 1, memory_order_relaxed);
    atomic_store_explicit(&slots->of_pixels[(size_t)row * slots->width + column], slot,
                          memory_order_relaxed);
}

static uint32_t word_at(const CellSet *set, size_t word)
{
    return atomic_load_explicit(&set->words[word], memory_order_relaxed);
}

static size_t words_of_pixel(const CellSet *set)
{
    return (set->scale * set->scale + WORD_BITS - 1) / WORD_BITS;
}

static size_t words_of_row(const CellSet *set)
{
    return (set->slots->width + WORD_BITS - 1) / WORD_BITS;
}

bool cell_set_make_room(CellSet *set, Error *error)
{
    const Slots *slots = set->slots;
    const size_t count = set->scale == 1 ? words_of_row(set) * slots->height
                                         : atomic_load(&slots->count) * words_of_pixel(set);
    if (!array_reserve(&set->memory, &set->capacity, count, sizeof *set->words, error))
        return false;
    if (count > set->count) {
        memset((char *)set->memory + set->count * sizeof *set->words, 0,
               (count - set->count) * sizeof *set->words);
        set->count = count;
    }
    return true;
}

void cell_set_free(CellSet *set)
{
    free(set->memory);
    *set = (CellSet){0};
}

// The position of a cell's bit.
typedef struct {
    size_t word;
    uint32_t mask;
} BitPlace;

static bool find_pixel(const CellSet *set, uint32_t column, uint32_t row, BitPlace *place)
{
    *place = (BitPlace){row * words_of_row(set) + column / WORD_BITS, 1u << column % WORD_BITS};
    return column < set->slots->width && row < set->slots->height && place->word < set->count;
}

static bool find(const CellSet *set, uint32_t column, uint32_t row, BitPlace *place)
{
    const Slots *slots = set->slots;
    if (set->scale == 1)
        return find_pixel(set, column, row, place);
    const uint32_t scale = set->scale, x = column / scale, y = row / scale;
    const size_t pixel = (size_t)y * slots->width + x;
    if (x >= slots->width || y >= slots->height)
        return false;
    const uint32_t slot = atomic_load_explicit(&slots->of_pixels[pixel], memory_order_relaxed);
    const uint32_t bit = row % scale * scale + column % scale;
    *place = (BitPlace){(slot - (size_t)1) * words_of_pixel(set) + bit / WORD_BITS,
                        1u << bit % WORD_BITS};
    return slot != 0 && place->word < set->count;
}

bool cell_set_has(const CellSet *set, uint32_t column, uint32_t row)
{
    BitPlace place;
    return find(set, column, row, &place) && (word_at(set, place.word) & place.mask) != 0;
}

bool cell_set_add(CellSet *set, uint32_t column, uint32_t row)
{
    BitPlace place;
    return find(set, column, row, &place) && (word_at(set, place.word) & place.mask) == 0 &&
           (atomic_fetch_or_explicit(&set->words[place.word], place.mask, memory_order_relaxed) &
            place.mask) == 0;
}

void cell_set_clear_pixel(CellSet *set, uint32_t column, uint32_t row)
{
    BitPlace place;
    if (!find(set, column * set->scale, row * set->scale, &place))
        return;
    for (size_t i = 0; i < words_of_pixel(set); i++)
        atomic_store_explicit(&set->words[place.word + i], 0, memory_order_relaxed);
}

// Returns a mask of the bits that lie in columns first to end - 1. word is the index of a word in
// its row.
static uint32_t mask_of(uint32_t word, uint32_t first, uint32_t end)
{
    const uint32_t start = word * WORD_BITS;
    const uint32_t from = first > start ? ~0u << (first - start) : ~0u;
    return end - start < WORD_BITS ? from & ((1u << (end - start)) - 1) : from;
}

void pixel_set_add_range(CellSet *set, uint32_t row, uint32_t first, uint32_t end)
{
    _Atomic uint32_t *words = set->words + row * words_of_row(set);
    for (uint32_t word = first / WORD_BITS; word * WORD_BITS < end; word++)
        atomic_fetch_or_explicit(&words[word], mask_of(word, first, end), memory_order_relaxed);
}

bool pixel_set_has_all(const CellSet *set, uint32_t row, uint32_t first, uint32_t end)
{
    const size_t words = row * words_of_row(set);
    uint32_t missing = 0;
    for (uint32_t word = first / WORD_BITS; word * WORD_BITS < end; word++)
        missing |= mask_of(word, first, end) & ~word_at(set, words + word);
    return missing == 0;
}

uint32_t pixel_set_bits(const CellSet *set, uint32_t left, uint32_t row)
{
    return word_at(set, row * words_of_row(set) + left / WORD_BITS);
}

void pixel_set_clear_rows(CellSet *set, uint32_t top, uint32_t bottom)
{
    const size_t row = words_of_row(set) * sizeof *set->words;
    memset((char *)set->memory + top * row, 0, (bottom - top) * row);
}

// Returns 64 pixels of a row: the 32 pixels of a word, with 16 pixels on each side. Pixels outside
// of the picture are 0.
static uint64_t pixels_around(const CellSet *set, int64_t row, int64_t word)
{
    uint32_t parts[3] = {0};
    const int64_t count = (int64_t)words_of_row(set);
    if (row < 0 || row >= set->slots->height)
        return 0;
    for (int i = 0; i < 3; i++)
        if (word + i > 0 && word + i <= count)
            parts[i] = set->words[row * count + word + i - 1];
    return parts[0] >> 16 | (uint64_t)parts[1] << 16 | (uint64_t)parts[2] << 48;
}

void pixel_set_widen_row(CellSet *wide, const CellSet *set, uint32_t row)
{
    const int64_t count = (int64_t)words_of_row(set);
    for (int64_t word = 0; word < count; word++) {
        uint64_t corners = 0;
        for (int64_t above = (int64_t)row - 2; above <= (int64_t)row + 1; above++) {
            const uint64_t both =
                pixels_around(set, above, word) & pixels_around(set, above + 1, word);
            corners |= both & both >> 1;
        }
        wide->words[row * count + word] =
            (uint32_t)((corners << 2 | corners << 1 | corners | corners >> 1) >> 16);
    }
}
