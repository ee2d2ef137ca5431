// SPDX-License-Identifier: MIT
// Reads one value after another from an ASCII or binary file. Line numbers are needed only in
// messages, so the reader counts line breaks only after a failure.
#include "mesh/ply_reader.h"

#include "base/number.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

static const size_t type_sizes[] = {
    [PLY_INT8] = 1,  [PLY_UINT8] = 1,  [PLY_INT16] = 2,   [PLY_UINT16] = 2,
    [PLY_INT32] = 4, [PLY_UINT32] = 4, [PLY_FLOAT32] = 4, [PLY_FLOAT64] = 8,
};

bool ply_reader_is_space(char character)
{
    return character == ' ' || (character >= '\t' && character <= '\r');
}

float ply_reader_color(PlyType type, double value)
{
    const double brightest = type == PLY_UINT8 ? 255 : type == PLY_UINT16 ? 65535 : 1;
    const double part = value / brightest;
    return !(part > 0) ? 0 : part < 1 ? (float)part : 1;
}

static size_t line_of_place(const PlyReader *reader)
{
    size_t line = 1;
    for (const char *byte = reader->start; byte < reader->place; byte++) {
        const bool pair = *byte == '\r' && byte + 1 < reader->end && byte[1] == '\n';
        line += *byte == '\n' || (*byte == '\r' && !pair);
    }
    return line;
}

bool ply_reader_fail(const PlyReader *reader, const char *format, ...)
{
    char message[256], where[64] = "", element[80] = "";
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);

    if (reader->format == PLY_ASCII && !reader->is_part)
        snprintf(where, sizeof where, ":%zu", line_of_place(reader));
    else if (!reader->is_part)
        snprintf(where, sizeof where, ": byte %td", reader->place - reader->start);
    const PlyQuote quote = ply_reader_quote(reader->element);
    if (reader->element.length > 0 && reader->index < 0)
        snprintf(element, sizeof element, "element %s: ", quote.text);
    else if (reader->element.length > 0)
        snprintf(element, sizeof element, "%s %lld: ", quote.text, (long long)reader->index);
    return error_set(reader->error, "%s%s: %s%s", reader->name, where, element, message);
}

PlyQuote ply_reader_quote(PlyWord word)
{
    const size_t longest = 32;
    PlyQuote quote = {0};
    for (size_t index = 0; index < word.length && index < longest; index++) {
        const char character = word.start[index];
        quote.text[index] = character >= ' ' && character <= '~' ? character : '?';
    }
    if (word.length > longest)
        strcpy(quote.text + longest, "...");
    return quote;
}

size_t ply_reader_value_size(const PlyReader *reader, PlyType type)
{
    return reader->format == PLY_ASCII ? 2 : type_sizes[type];
}

bool ply_reader_check_room(PlyReader *reader, int64_t count, size_t size)
{
    assert(count >= 0 && size > 0);
    const size_t left = (size_t)(reader->end - reader->next);
    // An ASCII value takes at least a digit and a blank, but the file's last value needs no blank.
    const size_t room = reader->format == PLY_ASCII ? left + 1 : left;
    if ((uint64_t)count <= room / size)
        return true;
    reader->place = reader->next;
    return ply_reader_fail(reader, "a count of %lld does not fit in the rest of the file",
                           (long long)count);
}

static bool fail_at_end(PlyReader *reader)
{
    return ply_reader_fail(reader, "the file ends too early");
}

static bool find_token(PlyReader *reader)
{
    const char *text = reader->next;
    while (text < reader->end && ply_reader_is_space(*text))
        text++;
    reader->place = reader->next = text;
    return text < reader->end || fail_at_end(reader);
}

static const char *token_end(const PlyReader *reader)
{
    const char *text = reader->place;
    while (text < reader->end && !ply_reader_is_space(*text))
        text++;
    return text;
}

// Advances past the token at reader->place. Fails unless the token ends at `stop`.
static bool take_token(PlyReader *reader, const char *stop, const char *expected)
{
    reader->next = stop;
    if (stop != NULL && (stop == reader->end || ply_reader_is_space(*stop)))
        return true;
    const PlyWord token = {reader->place, (size_t)(token_end(reader) - reader->place)};
    return ply_reader_fail(reader, "'%s' is not %s", ply_reader_quote(token).text, expected);
}

// Reads one binary value, at any alignment, into *bits. The caller must have set *bits to zero.
static bool take_bits(PlyReader *reader, PlyType type, uint64_t *bits)
{
    const size_t size = type_sizes[type];
    reader->place = reader->next;
    if ((size_t)(reader->end - reader->next) < size)
        return fail_at_end(reader);
    for (size_t index = 0; index < size; index++) {
        const size_t shift = reader->format == PLY_LITTLE_ENDIAN ? index : size - 1 - index;
        *bits |= (uint64_t)(unsigned char)reader->next[index] << (8 * shift);
    }
    reader->next += size;
    return true;
}

static int64_t bits_to_integer(uint64_t bits, PlyType type)
{
    assert(type < PLY_FLOAT32);
    if (type == PLY_UINT8 || type == PLY_UINT16 || type == PLY_UINT32)
        return (int64_t)bits;
    const int64_t sign = (int64_t)1 << (8 * type_sizes[type] - 1);
    return ((int64_t)bits ^ sign) - sign;
}

// Returns whether the next word is an infinity or a NaN. Programs spell them in many ways, for
// example inf, -nan and nan(ind).
static bool is_no_number(const PlyReader *reader)
{
    const char *word = reader->place;
    const char *end = token_end(reader);
    if (word < end && (*word == '-' || *word == '+'))
        word++;
    return end - word >= 3 &&
           (strncasecmp(word, "nan", 3) == 0 || strncasecmp(word, "inf", 3) == 0);
}

static bool read_ascii_number(PlyReader *reader, double *value)
{
    if (!find_token(reader))
        return false;
    if (!reader->is_tolerant || !is_no_number(reader))
        return take_token(reader, number_parse(reader->next, reader->end, value), "a number");
    *value = (double)NAN;
    reader->next = token_end(reader);
    return true;
}

bool ply_reader_read_number(PlyReader *reader, PlyType type, double *value)
{
    if (reader->format == PLY_ASCII)
        return read_ascii_number(reader, value);
    uint64_t bits = 0;
    if (!take_bits(reader, type, &bits))
        return false;
    const uint32_t low = (uint32_t)bits;
    float single;
    memcpy(&single, &low, sizeof single);
    if (type == PLY_FLOAT64)
        memcpy(value, &bits, sizeof *value);
    else
        *value = type == PLY_FLOAT32 ? (double)single : (double)bits_to_integer(bits, type);
    return true;
}

bool ply_reader_read_integer(PlyReader *reader, PlyType type, int64_t *value)
{
    if (reader->format == PLY_ASCII)
        return find_token(reader) &&
               take_token(reader, integer_parse(reader->next, reader->end, value),
                          "a 64-bit integer");
    uint64_t bits = 0;
    if (!take_bits(reader, type, &bits))
        return false;
    *value = bits_to_integer(bits, type);
    return true;
}

bool ply_reader_skip_values(PlyReader *reader, PlyType type, int64_t count)
{
    assert(count >= 0);
    const size_t left = (size_t)(reader->end - reader->next);
    if (reader->format != PLY_ASCII) {
        reader->place = reader->next;
        if ((uint64_t)count > left / type_sizes[type])
            return fail_at_end(reader);
        reader->next += (size_t)count * type_sizes[type];
        return true;
    }
    for (; count > 0; count--) {
        if (!find_token(reader))
            return false;
        reader->next = token_end(reader);
    }
    return true;
}
