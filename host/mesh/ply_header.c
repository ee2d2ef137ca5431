// SPDX-License-Identifier: MIT
// Header lines -> elements and their properties, in one pass. The elements and properties that a
// mesh uses may each occur only once.
#include "mesh/ply_header.h"

#include "base/number.h"
#include "base/text.h"

#include <stdlib.h>

#define WORD_LIMIT 6 // one more than the number of words of the longest statement

typedef struct {
    PlyHeader *header;
    PlyReader *reader;
    PlyWord words[WORD_LIMIT]; // words of the current line
    size_t word_count;
    bool breaks_are_returns; // lines end with CR alone, so a line feed after the last CR belongs to
                             // the body
    bool has_format;
    PlyFormat format;
} Parser;

static const struct {
    const char *name;
    PlyType type;
} types[] = {
    {"char", PLY_INT8},       {"int8", PLY_INT8},       {"uchar", PLY_UINT8},
    {"uint8", PLY_UINT8},     {"short", PLY_INT16},     {"int16", PLY_INT16},
    {"ushort", PLY_UINT16},   {"uint16", PLY_UINT16},   {"int", PLY_INT32},
    {"int32", PLY_INT32},     {"uint", PLY_UINT32},     {"uint32", PLY_UINT32},
    {"float", PLY_FLOAT32},   {"float32", PLY_FLOAT32}, {"double", PLY_FLOAT64},
    {"float64", PLY_FLOAT64},
};

static const struct {
    PlyKind kind;
    const char *name;
    PlyRole role;
} roles[] = {
    {PLY_VERTEX, "x", PLY_X},
    {PLY_VERTEX, "y", PLY_Y},
    {PLY_VERTEX, "z", PLY_Z},
    {PLY_VERTEX, "nx", PLY_NORMAL_X},
    {PLY_VERTEX, "ny", PLY_NORMAL_Y},
    {PLY_VERTEX, "nz", PLY_NORMAL_Z},
    {PLY_VERTEX, "red", PLY_RED},
    {PLY_VERTEX, "green", PLY_GREEN},
    {PLY_VERTEX, "blue", PLY_BLUE},
    {PLY_FACE, "vertex_indices", PLY_CORNERS},
    {PLY_FACE, "vertex_index", PLY_CORNERS},
    {PLY_STRIPS, "vertex_indices", PLY_CORNERS},
    {PLY_STRIPS, "vertex_index", PLY_CORNERS},
};

#define COUNT_OF(table) (sizeof(table) / sizeof *(table))

static bool word_is(PlyWord word, const char *text)
{
    return text_is(word.start, word.length, text);
}

static void split_line(Parser *parser, const char *text, const char *end)
{
    parser->word_count = 0;
    while (parser->word_count < WORD_LIMIT) {
        while (text < end && ply_reader_is_space(*text))
            text++;
        const char *start = text;
        while (text < end && !ply_reader_is_space(*text))
            text++;
        if (text == start)
            return;
        parser->words[parser->word_count++] = (PlyWord){start, (size_t)(text - start)};
    }
}

// Splits the next line into words and advances past the line.
static bool read_line(Parser *parser)
{
    PlyReader *reader = parser->reader;
    reader->place = reader->next;
    if (reader->next == reader->end)
        return ply_reader_fail(reader, "the file ends before 'end_header'");
    const char *stop = reader->next;
    while (stop < reader->end && *stop != '\n' && *stop != '\r')
        stop++;
    split_line(parser, reader->next, stop);

    const bool is_return = stop < reader->end && *stop == '\r';
    stop += stop < reader->end;
    const bool is_pair = is_return && stop < reader->end && *stop == '\n';
    if (reader->place == reader->start)
        parser->breaks_are_returns = is_return && !is_pair;
    reader->next = stop + (is_pair && !parser->breaks_are_returns);
    return true;
}

static bool read_format(Parser *parser)
{
    static const char *const names[] = {
        [PLY_ASCII] = "ascii",
        [PLY_LITTLE_ENDIAN] = "binary_little_endian",
        [PLY_BIG_ENDIAN] = "binary_big_endian",
    };
    if (parser->has_format)
        return ply_reader_fail(parser->reader, "a second format is given");
    for (size_t index = 0; index < COUNT_OF(names) && parser->word_count == 3; index++) {
        if (word_is(parser->words[1], names[index]) && word_is(parser->words[2], "1.0")) {
            parser->format = (PlyFormat)index;
            parser->has_format = true;
            return true;
        }
    }
    return ply_reader_fail(parser->reader, "expected 'format ascii 1.0', 'format "
                                           "binary_little_endian 1.0' or 'format "
                                           "binary_big_endian 1.0'");
}

// Fails if an element that a mesh uses occurs twice or has too large a count.
static bool check_kind(const Parser *parser, const PlyElement *element)
{
    const PlyHeader *header = parser->header;
    const PlyQuote name = ply_reader_quote(element->name);
    if (element->kind == PLY_OTHER)
        return true;
    for (size_t index = 0; index < header->elements.count; index++) {
        if (header->elements.data[index].kind == element->kind)
            return ply_reader_fail(parser->reader, "element %s is declared twice", name.text);
    }
    if (element->count > PLY_COUNT_LIMIT)
        return ply_reader_fail(parser->reader, "%s count %lld is above %lld", name.text,
                               (long long)element->count, (long long)PLY_COUNT_LIMIT);
    return true;
}

static bool read_element(Parser *parser)
{
    PlyHeader *header = parser->header;
    PlyElement element = {.kind = PLY_OTHER, .first_property = header->properties.count};
    if (parser->word_count != 3)
        return ply_reader_fail(parser->reader, "expected 'element NAME COUNT'");
    element.name = parser->words[1];
    if (word_is(element.name, "vertex"))
        element.kind = PLY_VERTEX;
    else if (word_is(element.name, "face"))
        element.kind = PLY_FACE;
    else if (word_is(element.name, "tristrips"))
        element.kind = PLY_STRIPS;

    const PlyWord count = parser->words[2];
    const char *end = count.start + count.length;
    if (integer_parse(count.start, end, &element.count) != end || element.count < 0)
        return ply_reader_fail(parser->reader, "'%s' is not an element count",
                               ply_reader_quote(count).text);
    return check_kind(parser, &element) &&
           array_push(&header->elements, element, parser->reader->error);
}

static bool find_type(const Parser *parser, PlyWord word, PlyType *type)
{
    for (size_t index = 0; index < COUNT_OF(types); index++) {
        if (word_is(word, types[index].name)) {
            *type = types[index].type;
            return true;
        }
    }
    return ply_reader_fail(parser->reader, "'%s' is not a property type",
                           ply_reader_quote(word).text);
}

// Checks a property's types. List lengths and corner indices must be integers. Corners must be a
// list, and vertex components must not be lists.
static bool check_property(const Parser *parser, const PlyProperty *property, PlyWord name)
{
    const PlyReader *reader = parser->reader;
    const PlyQuote quote = ply_reader_quote(name);
    if (property->is_list && property->length_type >= PLY_FLOAT32)
        return ply_reader_fail(reader, "the length of list %s has a float type", quote.text);
    if (property->role == PLY_CORNERS && !property->is_list)
        return ply_reader_fail(reader, "%s is not a list", quote.text);
    if (property->role == PLY_CORNERS && property->type >= PLY_FLOAT32)
        return ply_reader_fail(reader, "the items of list %s have a float type", quote.text);
    if (property->role < PLY_CORNERS && property->is_list)
        return ply_reader_fail(reader, "%s is a list", quote.text);
    return true;
}

// Returns whether the property can be a color. Integer types other than uchar and ushort have no
// known brightest value.
static bool has_color_type(const PlyProperty *property)
{
    return !property->is_list && (property->type == PLY_UINT8 || property->type == PLY_UINT16 ||
                                  property->type >= PLY_FLOAT32);
}

// Stores the property's role. Fails if an earlier property of the element has this role, unless the
// role is PLY_UNUSED.
static bool find_role(const Parser *parser, PlyElement *element, PlyWord name,
                      PlyProperty *property)
{
    PlyRole role = PLY_UNUSED;
    for (size_t index = 0; index < COUNT_OF(roles); index++) {
        if (roles[index].kind == element->kind && word_is(name, roles[index].name))
            role = roles[index].role;
    }
    if (role >= PLY_RED && role <= PLY_BLUE && !has_color_type(property))
        role = PLY_UNUSED;
    property->role = role;
    if (role == PLY_UNUSED)
        return true;
    if (element->roles & 1u << role)
        return ply_reader_fail(parser->reader, "%s is declared twice", ply_reader_quote(name).text);
    element->roles |= 1u << role;
    return true;
}

static bool read_property(Parser *parser)
{
    PlyHeader *header = parser->header;
    PlyProperty property = {.is_list = word_is(parser->words[1], "list")};
    const size_t word_count = property.is_list ? 5 : 3;
    if (parser->word_count != word_count)
        return ply_reader_fail(parser->reader, "expected 'property TYPE NAME' or 'property list "
                                               "TYPE TYPE NAME'");
    if (header->elements.count == 0)
        return ply_reader_fail(parser->reader, "a property precedes the first element");

    PlyElement *element = &header->elements.data[header->elements.count - 1];
    const PlyWord name = parser->words[word_count - 1];
    if (property.is_list && !find_type(parser, parser->words[2], &property.length_type))
        return false;
    if (!find_type(parser, parser->words[word_count - 2], &property.type) ||
        !find_role(parser, element, name, &property) || !check_property(parser, &property, name) ||
        !array_push(&header->properties, property, parser->reader->error))
        return false;
    element->property_count++;
    return true;
}

static bool read_remark(Parser *parser)
{
    (void)parser;
    return true;
}

static const struct {
    const char *keyword;
    bool (*read)(Parser *);
} statements[] = {
    {"property", read_property}, {"element", read_element}, {"format", read_format},
    {"comment", read_remark},    {"obj_info", read_remark},
};

static bool read_statement(Parser *parser)
{
    for (size_t index = 0; index < COUNT_OF(statements); index++) {
        if (word_is(parser->words[0], statements[index].keyword))
            return statements[index].read(parser);
    }
    return ply_reader_fail(parser->reader, "'%s' is not a header keyword",
                           ply_reader_quote(parser->words[0]).text);
}

static bool read_statements(Parser *parser)
{
    while (read_line(parser)) {
        if (parser->word_count == 0)
            continue;
        if (word_is(parser->words[0], "end_header"))
            return parser->has_format ||
                   ply_reader_fail(parser->reader, "the header gives no format");
        if (!read_statement(parser))
            return false;
    }
    return false;
}

#define ROLE_BITS(first, last) ((2u << (last)) - (1u << (first)))

static bool has_roles(const PlyElement *element, unsigned bits)
{
    return (element->roles & bits) == bits;
}

// Returns whether the element has properties with the role `first` and the next two roles. If one
// of the three properties is missing, marks the other properties as unused.
static bool has_vector(PlyHeader *header, const PlyElement *element, PlyRole first)
{
    const PlyRole last = first + 2;
    if (has_roles(element, ROLE_BITS(first, last)))
        return true;
    for (size_t index = 0; index < element->property_count; index++) {
        PlyRole *role = &header->properties.data[element->first_property + index].role;
        if (*role >= first && *role <= last)
            *role = PLY_UNUSED;
    }
    return false;
}

static bool check_element(PlyHeader *header, PlyReader *reader, const PlyElement *element)
{
    reader->place = element->name.start;
    if (element->kind == PLY_VERTEX) {
        header->vertex_count = element->count;
        header->has_normals = has_vector(header, element, PLY_NORMAL_X);
        header->has_colors = has_vector(header, element, PLY_RED);
        if (element->count > 0 && !has_roles(element, ROLE_BITS(PLY_X, PLY_Z)))
            return ply_reader_fail(reader, "element vertex lacks x, y or z");
    }
    const bool needs_corners = element->kind == PLY_FACE || element->kind == PLY_STRIPS;
    if (needs_corners && element->count > 0 &&
        !has_roles(element, ROLE_BITS(PLY_CORNERS, PLY_CORNERS)))
        return ply_reader_fail(reader, "element %s lacks the list vertex_indices",
                               ply_reader_quote(element->name).text);
    return true;
}

bool ply_header_parse(PlyHeader *header, PlyReader *reader)
{
    Parser parser = {.header = header, .reader = reader};
    *header = (PlyHeader){0};
    reader->next = reader->place = reader->start;
    reader->format = PLY_ASCII;
    if (reader->start == reader->end || !read_line(&parser) || parser.word_count != 1 ||
        !word_is(parser.words[0], "ply"))
        return ply_reader_fail(reader, "the file does not begin with 'ply'");
    if (!read_statements(&parser))
        return false;
    for (size_t index = 0; index < header->elements.count; index++) {
        if (!check_element(header, reader, &header->elements.data[index]))
            return false;
    }
    reader->format = parser.format;
    return true;
}

PlyProperties ply_header_properties(const PlyHeader *header, const PlyElement *element)
{
    return (PlyProperties){&header->properties.data[element->first_property],
                           element->property_count};
}

void ply_header_free(PlyHeader *header)
{
    free(header->elements.memory);
    free(header->properties.memory);
    *header = (PlyHeader){0};
}
