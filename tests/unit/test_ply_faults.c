// SPDX-License-Identifier: MIT
// Tests that mesh/ply reports each kind of fault at its place.
#include "unit/ply_builder.h"

#define TRIANGLE HEAD "element vertex 3\n" XYZ FACES "end_header\n0 0 0\n1 0 0\n0 1 0\n"

#define STRIP                                                                                      \
    HEAD "element vertex 3\n" XYZ "element tristrips 1\nproperty list uint int "                   \
         "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"

// Expects a message that begins with `place` and contains `keyword`.
static void assert_fails(const char *bytes, size_t size, const char *place, const char *keyword)
{
    Mesh mesh;
    Error error;
    if (parse(&mesh, bytes, size, &error))
        fail_msg("parsed instead of failing at %s with '%s'", place, keyword);
    if (strncmp(error.text, place, strlen(place)) != 0 || strstr(error.text, keyword) == NULL)
        fail_msg("'%s' is not at %s or lacks '%s'", error.text, place, keyword);
}

TEST(each_fault_of_a_header_is_reported_at_its_place)
{
    static const char *const cases[][3] = {
        {"", "t.ply:1:", "begin"},
        {"plyx\n", "t.ply:1:", "begin"},
        {HEAD "element vertex 1\r\n", "t.ply:4:", "end_header"},
        {"ply\nend_header\n", "t.ply:2:", "no format"},
        {HEAD "format ascii 1.0\n", "t.ply:3:", "second format"},
        {"ply\nformat ascii 2.0\n", "t.ply:2:", "expected 'format ascii 1.0'"},
        {HEAD "vertices\x01 3\n", "t.ply:3:", "'vertices?'"},
        {HEAD "element vertex\n", "t.ply:3:", "expected 'element NAME COUNT'"},
        {HEAD "element a 1 2\n", "t.ply:3:", "expected 'element NAME COUNT'"},
        {HEAD "element a -1\n", "t.ply:3:", "'-1'"},
        {HEAD "element a 1.0\n", "t.ply:3:", "'1.0'"},
        {HEAD "element a 9223372036854775808\n", "t.ply:3:", "'9223372036854775808'"},
        {HEAD "element vertex 2147483648\n", "t.ply:3:", "above 2147483647"},
        {HEAD "element face 9223372036854775807\n", "t.ply:3:", "above 2147483647"},
        {HEAD "element face 1\nelement face 1\n", "t.ply:4:", "twice"},
        {HEAD "property float x\n", "t.ply:3:", "precedes the first"},
        {HEAD "element a 1\nproperty float\n", "t.ply:4:", "expected 'property TYPE NAME'"},
        {HEAD "element a 1\nproperty list int float\n",
         "t.ply:4:", "expected 'property TYPE NAME'"},
        {HEAD "element a 1\nproperty aVeryLongTypeNameWithoutAnyEndInSight x\n",
         "t.ply:4:", "'aVeryLongTypeNameWithoutAnyEndIn...'"},
        {HEAD "element a 1\nproperty list int list x\n", "t.ply:4:", "'list'"},
        {HEAD "element a 1\nproperty list float int b\n", "t.ply:4:", "float type"},
        {HEAD "element face 1\nproperty list int double vertex_index\n", "t.ply:4:", "float type"},
        {HEAD "element face 1\nproperty int vertex_index\n", "t.ply:4:", "not a list"},
        {HEAD FACES "property list int int vertex_index\n", "t.ply:5:", "twice"},
        {HEAD "element vertex 1\nproperty list int int ny\n", "t.ply:4:", "is a list"},
        {HEAD "element vertex 1\n" XYZ "property int x\n", "t.ply:7:", "twice"},
        {HEAD "element vertex 1\nproperty float x\nproperty float y\nend_header\n0 0 0\n",
         "t.ply:3:", "lacks x"},
        {BINARY "element face 1\nend_header\n", "t.ply:3:", "lacks the list vertex_indices"},
        {BINARY "element tristrips 1\nend_header\n", "t.ply:3:", "lacks the list vertex_indices"},
    };
    for (size_t index = 0; index < sizeof cases / sizeof *cases; index++)
        assert_fails(cases[index][0], strlen(cases[index][0]), cases[index][1], cases[index][2]);
}

TEST(each_fault_of_an_ascii_body_is_reported_at_its_place)
{
    static const char *const cases[][3] = {
        {HEAD "element vertex 2\n" XYZ "end_header\n0 0 0\n0 ",
         "t.ply:8: element vertex:", "count of 2"},
        {HEAD "element vertex 2147483647\n" XYZ "end_header\n0 0 0\n",
         "t.ply:8: element vertex:", "count of 2147483647"},
        {HEAD "element a 9223372036854775807\nproperty list int int b\nend_header\n0 0 0\n",
         "t.ply:6: element a:", "count of 9223372036854775807"},
        {HEAD "element a 4611686018427387904\nproperty int b\nproperty int c\nend_header\n0 0 0\n",
         "t.ply:7: element a:", "count of 4611686018427387904"},
        {HEAD "element vertex 2\n" XYZ "end_header\n0 0 0.00000\n0 0\n",
         "t.ply:10: vertex 1:", "too early"},
        {TRIANGLE "3 0 1 x\n", "t.ply:13: face 0:", "'x'"},
        {TRIANGLE "\r\n\r\r3 0\n1 1.0\n", "t.ply:17: face 0:", "'1.0'"},
        {TRIANGLE "3 0 1 -1\n", "t.ply:13: face 0:", "negative"},
        {TRIANGLE "3 0 1\r\n3\n", "t.ply:14: face 0:", "not below the vertex count"},
        {TRIANGLE "3 4294967296 1 2\n", "t.ply:13: face 0:", "not below the vertex count"},
        {TRIANGLE "2 0 1\n", "t.ply:13: face 0:", ", not 2"},
        {TRIANGLE "0\n", "t.ply:13: face 0:", ", not 0"},
        {TRIANGLE "-3 0 1 2\n", "t.ply:13: face 0:", "negative"},
        {TRIANGLE "5 0 1 2\n", "t.ply:13: face 0:", "count of 5"},
        {TRIANGLE "4 0 1 2 \n \n", "t.ply:15: face 0:", "too early"},
        {TRIANGLE "4294967295 0 1 2\n", "t.ply:13: face 0:", "above 2147483647"},
        {TRIANGLE "9223372036854775808\n", "t.ply:13: face 0:", "'9223372036854775808'"},
        {STRIP "3 0 1 3\n", "t.ply:13: tristrips 0:", "not below the vertex count"},
        {STRIP "3 0 1 -2\n", "t.ply:13: tristrips 0:", "negative"},
        {STRIP "5 0 1 2\n", "t.ply:13: tristrips 0:", "count of 5"},
        {STRIP "4294967295 0 1 2\n", "t.ply:13: tristrips 0:", "above 2147483647"},
        {HEAD "element vertex 1\n" XYZ "element range_grid 1\nproperty list int int b\nend_header\n"
              "0 0 0\n1 0\n",
         "t.ply:7: element range_grid:", "nothing to draw"},
        {HEAD "element a 2\nproperty list int int b\nend_header\n0\n9223372036854775807 1 2\n",
         "t.ply:7: a 1:", "count of 9223372036854775807"},
    };
    for (size_t index = 0; index < sizeof cases / sizeof *cases; index++)
        assert_fails(cases[index][0], strlen(cases[index][0]), cases[index][1], cases[index][2]);
}

static void assert_ascii_vertex_fails(const char *values, const char *keyword)
{
    Builder builder = {0};
    put_text(&builder,
             HEAD "element vertex 1\n" XYZ "property float nx\nproperty float ny\n"
                  "property float nz\nend_header\n%s\n",
             values);
    assert_fails(builder.bytes, builder.size, "t.ply:11: vertex 0:", keyword);
}

TEST(coordinates_and_normals_must_be_finite_numbers)
{
    static const char *const words[] = {"nan",  "inf",   "-inf", "NaN", "Infinity", "nan(0x1)",
                                        "0x10", "0x1p3", "1,5",  "1e",  "--1",      "1.2.3"};
    for (size_t index = 0; index < sizeof words / sizeof *words; index++) {
        char values[64], word[32];
        snprintf(values, sizeof values, "0 %s 0 0 0 1", words[index]);
        snprintf(word, sizeof word, "'%s'", words[index]);
        assert_ascii_vertex_fails(values, word);
    }
    assert_ascii_vertex_fails("1e39 0 0 0 0 1", "x is 1e+39");
    assert_ascii_vertex_fails("0 -1e30 0 0 0 1", "y is -1e+30");
    assert_ascii_vertex_fails("0 0 1e999 0 0 1", "z is inf");
    assert_ascii_vertex_fails("0 0 0 0 0 1e39", "nz is 1e+39");
    assert_ascii_vertex_fails("0 0 0 0 -1e999 0", "ny is -inf");
}

// Messages about a binary body give the byte offset of the fault.
#define VERTEX  BINARY "element vertex 1\n" XYZ "end_header\n"
#define POINT   "\0\0\0\0\0\0\0\0\0\0\0\0"
#define FACE    BINARY "element vertex 1\n" XYZ FACES "end_header\n" POINT
#define LISTS   BINARY "element a 1\nproperty list "
#define THREE   BINARY "element vertex 3\n" XYZ
#define INDICES "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
#define GOOD    "\3\0\0\0\0\0\0\0\1\0\0\0\2"
#define THIRD   THREE INDICES POINT POINT POINT GOOD GOOD
#define CASE(bytes, place, keyword)                                                                \
    {                                                                                              \
        bytes, sizeof(bytes) - 1, "t.ply: byte " place, keyword                                    \
    }

TEST(each_fault_of_a_binary_body_is_reported_at_its_place)
{
    static const struct {
        const char *bytes;
        size_t size;
        const char *place, *keyword;
    } cases[] = {
        CASE(VERTEX "\0\0\0\0\0\0\0\0\0\0\0", "112: element vertex:", "count of 1"),
        CASE(VERTEX "\0\0\0\0"
                    "\x7f\xc0\0\0"
                    "\0\0\0\0",
             "116: vertex 0:", "below 1e30"),
        CASE(FACE "\3\0\0\0\0\0\0\0\0\0\0\0\1", "187: face 0:", "not below the vertex count"),
        CASE(FACE "\3\0\0\0\0\xff\xff\xff\xff\0\0\0\1", "183: face 0:", "negative"),
        CASE(FACE "\1\0\0\0\0", "178: face 0:", ", not 1"),
        CASE(FACE "\3\0\0\0\0\0\0\0\0\0\0\0", "179: face 0:", "count of 3"),
        CASE(LISTS "uint uchar b\nproperty double c\nend_header\n\0\0\0\0\0\0\0\0\0\0\0",
             "101: element a:", "count of 1"),
        CASE(LISTS "uint double b\nend_header\n\xff\xff\xff\xff\0\0\0\0",
             "88: a 0:", "count of 4294967295"),
        CASE(LISTS "char char b\nend_header\n\x80", "82: a 0:", "negative"),
        CASE(LISTS "char char b\nproperty short c\nend_header\n\1\1\0", "101: a 0:", "too early"),
        CASE(THREE "end_header\n" POINT POINT "\x7f\x80\0\0\0\0\0\0\0\0\0\0",
             "136: vertex 2:", "below 1e30"),
        CASE(THIRD "\3\0\0\0\0\0\0\0\1\0\0\0\3", "237: face 2:", "not below the vertex count"),
        CASE(THIRD "\2\0\0\0\0\0\0\0\1\0\0\0\3", "228: face 2:", ", not 2"),
        CASE(THIRD "\3\0\0\0\0\0\0\0\1\0\0\0", "229: face 2:", "count of 3"),
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_fails(cases[i].bytes, cases[i].size, cases[i].place, cases[i].keyword);
}
