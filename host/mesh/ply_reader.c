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
    char message[256], where[64], element[80] = "";
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);

    if (reader->format == PLY_ASCII)
        snprintf(where, sizeof where, ":%zu", line_of_place(reader));
    else
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
    // An ASCII value takes a character and a blank, but the last value of the file needs no blank.
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

// Advances past the token at reader->place. Fails unless the token ends at stop.
static bool take_token(PlyReader *reader, const char *stop, const char *expected)
{
    reader->next = stop;
    if (stop != NULL && (stop == reader->end || ply_reader_is_space(*stop)))
        return true;
    const PlyWord token = {reader->place, (size_t)(token_end(reader) - reader->place)};
    return ply_reader_fail(reader, "'%s' is not %s", ply_reader_quote(token).text, expected);
}

// Stores one binary value, at any alignment, in *bits, which must be zero.
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

// The following functions are the fast path for elements whose values have fixed offsets. They read
// a value by one load, without a function call, a bounds check or a stored position for messages.

#define COMPONENTS 9 // x y z nx ny nz red green blue, in the order of PlyRole

// The offsets and types of the vertex values that a mesh uses, by PlyRole.
typedef struct {
    size_t offsets[COMPONENTS];
    PlyType types[COMPONENTS];
    size_t stride;
    bool swapped; // the file's byte order differs from the processor's
} VertexLayout;

typedef struct {
    size_t length_offset, stride;
} FaceLayout;

static bool is_swapped(const PlyReader *reader)
{
    return (reader->format == PLY_LITTLE_ENDIAN) != (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
}

static inline uint32_t load_word(const char *bytes, bool swapped)
{
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
    return swapped ? __builtin_bswap32(word) : word;
}

static inline double load_float(const char *bytes, PlyType type, bool swapped)
{
    if (type == PLY_FLOAT32) {
        const uint32_t word = load_word(bytes, swapped);
        float value;
        memcpy(&value, &word, sizeof value);
        return (double)value;
    }
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
    word = swapped ? __builtin_bswap64(word) : word;
    double value;
    memcpy(&value, &word, sizeof value);
    return value;
}

static bool find_vertex_layout(VertexLayout *layout, const PlyReader *reader,
                               PlyProperties properties)
{
    *layout = (VertexLayout){.swapped = is_swapped(reader)};
    for (size_t index = 0; index < properties.count; index++) {
        const PlyProperty *property = &properties.data[index];
        if (property->is_list || (property->role < PLY_RED && property->type < PLY_FLOAT32))
            return false;
        if (property->role < COMPONENTS) {
            layout->offsets[property->role] = layout->stride;
            layout->types[property->role] = property->type;
        }
        layout->stride += ply_reader_value_size(reader, property->type);
    }
    return reader->format != PLY_ASCII;
}

static inline bool load_position(const VertexLayout *layout, const char *bytes, double position[3])
{
    bool valid = true;
    for (int axis = 0; axis < 3; axis++) {
        const int role = PLY_X + axis;
        position[axis] =
            load_float(bytes + layout->offsets[role], layout->types[role], layout->swapped);
        valid = valid && fabs(position[axis]) < PLY_COORDINATE_BOUND;
    }
    return valid;
}

static inline bool load_normal(const VertexLayout *layout, const char *bytes, float normal[3])
{
    bool valid = true;
    for (int axis = 0; axis < 3; axis++) {
        const int role = PLY_NORMAL_X + axis;
        normal[axis] =
            (float)load_float(bytes + layout->offsets[role], layout->types[role], layout->swapped);
        valid = valid && isfinite(normal[axis]);
    }
    return valid;
}

static inline double load_component(const char *bytes, PlyType type, bool swapped)
{
    if (type >= PLY_FLOAT32)
        return load_float(bytes, type, swapped);
    if (type == PLY_UINT8)
        return (unsigned char)*bytes;
    uint16_t word;
    memcpy(&word, bytes, sizeof word);
    return swapped ? __builtin_bswap16(word) : word;
}

static inline void load_color(const VertexLayout *layout, const char *bytes, float color[3])
{
    for (int channel = 0; channel < 3; channel++) {
        const PlyType type = layout->types[PLY_RED + channel];
        const char *value = bytes + layout->offsets[PLY_RED + channel];
        color[channel] = ply_reader_color(type, load_component(value, type, layout->swapped));
    }
}

void ply_bulk_vertices(PlyReader *reader, PlyProperties properties, int64_t count, Mesh *mesh)
{
    VertexLayout layout;
    if (!find_vertex_layout(&layout, reader, properties))
        return;
    const char *bytes = reader->next;
    int64_t index = reader->index;
    while (index < count && (size_t)(reader->end - bytes) >= layout.stride) {
        if (!load_position(&layout, bytes, mesh->positions[index]) ||
            (mesh->normals != NULL && !load_normal(&layout, bytes, mesh->normals[index])))
            break;
        if (mesh->colors != NULL)
            load_color(&layout, bytes, mesh->colors[index]);
        bytes += layout.stride;
        index++;
    }
    reader->next = bytes;
    reader->index = index;
}

// Stores the layout of a face with three corners. Returns false if the layout is unusual.
static bool find_face_layout(FaceLayout *layout, const PlyReader *reader, PlyProperties properties)
{
    *layout = (FaceLayout){0};
    bool has_corners = false;
    for (size_t index = 0; index < properties.count; index++) {
        const PlyProperty *property = &properties.data[index];
        const size_t size = ply_reader_value_size(reader, property->type);
        if (property->role != PLY_CORNERS && property->is_list)
            return false;
        if (property->role == PLY_CORNERS) {
            if (property->length_type > PLY_UINT8 || size != sizeof(uint32_t))
                return false;
            has_corners = true;
            layout->length_offset = layout->stride;
            layout->stride += 1 + 3 * size;
        } else {
            layout->stride += size;
        }
    }
    return has_corners && reader->format != PLY_ASCII;
}

size_t ply_bulk_triangle_size(const PlyReader *reader, PlyProperties properties)
{
    FaceLayout layout;
    return find_face_layout(&layout, reader, properties) ? layout.stride : 0;
}

size_t ply_bulk_triangles(PlyReader *reader, PlyProperties properties, int64_t vertex_count,
                          size_t room, uint32_t (*triangles)[3])
{
    FaceLayout layout;
    if (!find_face_layout(&layout, reader, properties))
        return 0;
    const bool swapped = is_swapped(reader);
    // As an unsigned number, a negative index exceeds every vertex count.
    const uint32_t limit = (uint32_t)vertex_count;
    const char *bytes = reader->next;
    size_t done = 0;
    while (done < room && (size_t)(reader->end - bytes) >= layout.stride) {
        const char *list = bytes + layout.length_offset;
        uint32_t *triangle = triangles[done];
        triangle[0] = load_word(list + 1, swapped);
        triangle[1] = load_word(list + 5, swapped);
        triangle[2] = load_word(list + 9, swapped);
        if (*list != 3 || triangle[0] >= limit || triangle[1] >= limit || triangle[2] >= limit)
            break;
        bytes += layout.stride;
        done++;
    }
    reader->next = bytes;
    reader->index += (int64_t)done;
    return done;
}
