// SPDX-License-Identifier: MIT
// Tests the exact message of mesh/ply for each kind of faulty file.
#include "unit/ply_builder.h"

#define TRIANGLE HEAD "element vertex 3\n" XYZ FACES "end_header\n0 0 0\n1 0 0\n0 1 0\n"

#define STRIP                                                                                      \
    HEAD "element vertex 3\n" XYZ "element tristrips 1\nproperty list uint int "                   \
         "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"

static void assert_fails(const char *bytes, size_t size, const char *sentence)
{
    Mesh mesh;
    Error error;
    if (parse(&mesh, bytes, size, &error))
        fail_msg("parsed instead of failing with '%s'", sentence);
    assert_string_equal(error.text, sentence);
}

TEST(each_fault_of_a_header_has_its_sentence)
{
    static const char *const cases[][2] = {
        {"", "t.ply:1: the file does not begin with 'ply'"},
        {"plyx\n", "t.ply:1: the file does not begin with 'ply'"},
        {HEAD "element vertex 1\r\n", "t.ply:4: the file ends before 'end_header'"},
        {"ply\nend_header\n", "t.ply:2: the header gives no format"},
        {HEAD "format ascii 1.0\n", "t.ply:3: a second format is given"},
        {"ply\nformat ascii 2.0\n",
         "t.ply:2: expected 'format ascii 1.0', 'format binary_little_endian 1.0' or 'format "
         "binary_big_endian 1.0'"},
        {HEAD "vertices\x01 3\n", "t.ply:3: 'vertices?' is not a header keyword"},
        {HEAD "element vertex\n", "t.ply:3: expected 'element NAME COUNT'"},
        {HEAD "element a 1 2\n", "t.ply:3: expected 'element NAME COUNT'"},
        {HEAD "element a -1\n", "t.ply:3: '-1' is not an element count"},
        {HEAD "element a 1.0\n", "t.ply:3: '1.0' is not an element count"},
        {HEAD "element a 9223372036854775808\n",
         "t.ply:3: '9223372036854775808' is not an element count"},
        {HEAD "element vertex 2147483648\n",
         "t.ply:3: vertex count 2147483648 is above 2147483647"},
        {HEAD "element face 9223372036854775807\n",
         "t.ply:3: face count 9223372036854775807 is above 2147483647"},
        {HEAD "element face 1\nelement face 1\n", "t.ply:4: element face is declared twice"},
        {HEAD "property float x\n", "t.ply:3: a property precedes the first element"},
        {HEAD "element a 1\nproperty float\n", "t.ply:4: expected 'property TYPE NAME' or "
                                               "'property list TYPE TYPE NAME'"},
        {HEAD "element a 1\nproperty list int float\n",
         "t.ply:4: expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'"},
        {HEAD "element a 1\nproperty aVeryLongTypeNameWithoutAnyEndInSight x\n",
         "t.ply:4: 'aVeryLongTypeNameWithoutAnyEndIn...' is not a property type"},
        {HEAD "element a 1\nproperty list int list x\n", "t.ply:4: 'list' is not a property type"},
        {HEAD "element a 1\nproperty list float int b\n",
         "t.ply:4: the length of list b has a float type"},
        {HEAD "element face 1\nproperty list int double vertex_index\n",
         "t.ply:4: the items of list vertex_index have a float type"},
        {HEAD "element face 1\nproperty int vertex_index\n", "t.ply:4: vertex_index is not a list"},
        {HEAD FACES "property list int int vertex_index\n",
         "t.ply:5: vertex_index is declared twice"},
        {HEAD "element vertex 1\nproperty list int int ny\n", "t.ply:4: ny is a list"},
        {HEAD "element vertex 1\n" XYZ "property int x\n", "t.ply:7: x is declared twice"},
        {HEAD "element vertex 1\nproperty float x\nproperty float y\nend_header\n0 0 0\n",
         "t.ply:3: element vertex lacks x, y or z"},
        {BINARY "element face 1\nend_header\n",
         "t.ply:3: element face lacks the list vertex_indices"},
        {BINARY "element tristrips 1\nend_header\n",
         "t.ply:3: element tristrips lacks the list vertex_indices"},
    };
    for (size_t index = 0; index < sizeof cases / sizeof *cases; index++)
        assert_fails(cases[index][0], strlen(cases[index][0]), cases[index][1]);
}

TEST(each_fault_of_an_ascii_body_has_its_sentence)
{
    static const char *const cases[][2] = {
        {HEAD "element vertex 2\n" XYZ "end_header\n0 0 0\n0 ",
         "t.ply:8: element vertex: a count of 2 does not fit in the rest of the file"},
        {HEAD "element vertex 2147483647\n" XYZ "end_header\n0 0 0\n",
         "t.ply:8: element vertex: a count of 2147483647 does not fit in the rest of the file"},
        {HEAD "element a 9223372036854775807\nproperty list int int b\nend_header\n0 0 0\n",
         "t.ply:6: element a: a count of 9223372036854775807 does not fit in the rest of the "
         "file"},
        {HEAD "element a 4611686018427387904\nproperty int b\nproperty int c\nend_header\n0 0 0\n",
         "t.ply:7: element a: a count of 4611686018427387904 does not fit in the rest of the "
         "file"},
        {HEAD "element vertex 2\n" XYZ "end_header\n0 0 0.00000\n0 0\n",
         "t.ply:10: vertex 1: the file ends too early"},
        {TRIANGLE "3 0 1 x\n", "t.ply:13: face 0: 'x' is not a 64-bit integer"},
        {TRIANGLE "\r\n\r\r3 0\n1 1.0\n", "t.ply:17: face 0: '1.0' is not a 64-bit integer"},
        {TRIANGLE "3 0 1 -1\n", "t.ply:13: face 0: vertex index -1 is negative"},
        {TRIANGLE "3 0 1\r\n3\n",
         "t.ply:14: face 0: vertex index 3 is not below the vertex count 3"},
        {TRIANGLE "3 4294967296 1 2\n",
         "t.ply:13: face 0: vertex index 4294967296 is not below the vertex count 3"},
        {TRIANGLE "2 0 1\n", "t.ply:13: face 0: a face needs 3 or more corners, not 2"},
        {TRIANGLE "0\n", "t.ply:13: face 0: a face needs 3 or more corners, not 0"},
        {TRIANGLE "-3 0 1 2\n", "t.ply:13: face 0: list length -3 is negative"},
        {TRIANGLE "5 0 1 2\n",
         "t.ply:13: face 0: a count of 5 does not fit in the rest of the file"},
        {TRIANGLE "4 0 1 2 \n \n", "t.ply:15: face 0: the file ends too early"},
        {TRIANGLE "4294967295 0 1 2\n", "t.ply:13: face 0: its 4294967295 corners bring the "
                                        "triangle count above 2147483647"},
        {TRIANGLE "9223372036854775808\n",
         "t.ply:13: face 0: '9223372036854775808' is not a 64-bit integer"},
        {STRIP "3 0 1 3\n",
         "t.ply:13: tristrips 0: vertex index 3 is not below the vertex count 3"},
        {STRIP "3 0 1 -2\n", "t.ply:13: tristrips 0: vertex index -2 is negative"},
        {STRIP "5 0 1 2\n", "t.ply:13: tristrips 0: a count of 5 does not fit in the rest of the "
                            "file"},
        {STRIP "4294967295 0 1 2\n", "t.ply:13: tristrips 0: its 4294967295 corners bring the "
                                     "triangle count above 2147483647"},
        {HEAD "element vertex 1\n" XYZ "element range_grid 1\nproperty list int int b\nend_header\n"
              "0 0 0\n1 0\n",
         "t.ply:7: element range_grid: there is nothing to draw: the file has no triangles, and "
         "clrt "
         "does not read this element"},
        {HEAD "element a 2\nproperty list int int b\nend_header\n0\n9223372036854775807 1 2\n",
         "t.ply:7: a 1: a count of 9223372036854775807 does not fit in the rest of the file"},
    };
    for (size_t index = 0; index < sizeof cases / sizeof *cases; index++)
        assert_fails(cases[index][0], strlen(cases[index][0]), cases[index][1]);
}

static void assert_ascii_vertex_fails(const char *values, const char *complaint)
{
    Builder builder = {0};
    char sentence[256];
    put_text(&builder,
             HEAD "element vertex 1\n" XYZ "property float nx\nproperty float ny\n"
                  "property float nz\nend_header\n%s\n",
             values);
    snprintf(sentence, sizeof sentence, "t.ply:11: vertex 0: %s", complaint);
    assert_fails(builder.bytes, builder.size, sentence);
}

TEST(coordinates_and_normals_must_be_finite_numbers)
{
    static const char *const words[] = {"nan",  "inf",   "-inf", "NaN", "Infinity", "nan(0x1)",
                                        "0x10", "0x1p3", "1,5",  "1e",  "--1",      "1.2.3"};
    for (size_t index = 0; index < sizeof words / sizeof *words; index++) {
        char values[64], complaint[64];
        snprintf(values, sizeof values, "0 %s 0 0 0 1", words[index]);
        snprintf(complaint, sizeof complaint, "'%s' is not a number", words[index]);
        assert_ascii_vertex_fails(values, complaint);
    }
    assert_ascii_vertex_fails("1e39 0 0 0 0 1",
                              "x is 1e+39, not a finite number below 1e30 in size");
    assert_ascii_vertex_fails("0 -1e30 0 0 0 1",
                              "y is -1e+30, not a finite number below 1e30 in size");
    assert_ascii_vertex_fails("0 0 1e999 0 0 1",
                              "z is inf, not a finite number below 1e30 in size");
    assert_ascii_vertex_fails("0 0 0 0 0 1e39",
                              "nz is 1e+39, not a finite single precision number");
    assert_ascii_vertex_fails("0 0 0 0 -1e999 0",
                              "ny is -inf, not a finite single precision number");
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
#define LEFT    " does not fit in the rest of the file"
#define CASE(bytes, sentence)                                                                      \
    {                                                                                              \
        bytes, sizeof(bytes) - 1, "t.ply: byte " sentence                                          \
    }

TEST(each_fault_of_a_binary_body_has_its_sentence)
{
    static const struct {
        const char *bytes;
        size_t size;
        const char *sentence;
    } cases[] = {
        CASE(VERTEX "\0\0\0\0\0\0\0\0\0\0\0", "112: element vertex: a count of 1" LEFT),
        CASE(VERTEX "\0\0\0\0"
                    "\x7f\xc0\0\0"
                    "\0\0\0\0",
             "116: vertex 0: y is nan, not a finite number below 1e30 in size"),
        CASE(FACE "\3\0\0\0\0\0\0\0\0\0\0\0\1",
             "187: face 0: vertex index 1 is not below the vertex count 1"),
        CASE(FACE "\3\0\0\0\0\xff\xff\xff\xff\0\0\0\1", "183: face 0: vertex index -1 is negative"),
        CASE(FACE "\1\0\0\0\0", "178: face 0: a face needs 3 or more corners, not 1"),
        CASE(FACE "\3\0\0\0\0\0\0\0\0\0\0\0", "179: face 0: a count of 3" LEFT),
        CASE(LISTS "uint uchar b\nproperty double c\nend_header\n\0\0\0\0\0\0\0\0\0\0\0",
             "101: element a: a count of 1" LEFT),
        CASE(LISTS "uint double b\nend_header\n\xff\xff\xff\xff\0\0\0\0",
             "88: a 0: a count of 4294967295" LEFT),
        CASE(LISTS "char char b\nend_header\n\x80", "82: a 0: list length -128 is negative"),
        CASE(LISTS "char char b\nproperty short c\nend_header\n\1\1\0",
             "101: a 0: the file ends too early"),
        CASE(THREE "end_header\n" POINT POINT "\x7f\x80\0\0\0\0\0\0\0\0\0\0",
             "136: vertex 2: x is inf, not a finite number below 1e30 in size"),
        CASE(THIRD "\3\0\0\0\0\0\0\0\1\0\0\0\3",
             "237: face 2: vertex index 3 is not below the vertex count 3"),
        CASE(THIRD "\2\0\0\0\0\0\0\0\1\0\0\0\3",
             "228: face 2: a face needs 3 or more corners, not 2"),
        CASE(THIRD "\3\0\0\0\0\0\0\0\1\0\0\0", "229: face 2: a count of 3" LEFT),
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_fails(cases[i].bytes, cases[i].size, cases[i].sentence);
}
