// SPDX-License-Identifier: MIT
// Tests mesh/ply with files of every type and encoding, in usual and unusual layouts, and with
// truncated and damaged files.
#include "unit/ply_builder.h"
#include "unit/random.h"

#include <math.h>

static const char *const encodings[] = {"ascii", "binary_little_endian", "binary_big_endian"};
enum { ASCII, LITTLE, BIG };

static Builder builder_start(int encoding)
{
    Builder builder = {.encoding = encoding};
    put_text(&builder, "ply\nformat %s 1.0\n", encodings[encoding]);
    return builder;
}

static void put_bits(Builder *builder, uint64_t bits, size_t size)
{
    for (size_t index = 0; index < size; index++) {
        const size_t shift = builder->encoding == LITTLE ? index : size - 1 - index;
        builder->bytes[builder->size++] = (char)(bits >> (8 * shift));
    }
}

typedef struct {
    const char *name;
    size_t size;
    bool is_float, is_signed;
} Type;

static const Type types[] = {
    {"char", 1, false, true},    {"int8", 1, false, true},    {"uchar", 1, false, false},
    {"uint8", 1, false, false},  {"short", 2, false, true},   {"int16", 2, false, true},
    {"ushort", 2, false, false}, {"uint16", 2, false, false}, {"int", 4, false, true},
    {"int32", 4, false, true},   {"uint", 4, false, false},   {"uint32", 4, false, false},
    {"float", 4, true, true},    {"float32", 4, true, true},  {"double", 8, true, true},
    {"float64", 8, true, true},
};
enum { TYPE_COUNT = sizeof types / sizeof *types };

static const Type *type_of(const char *name)
{
    for (size_t index = 0; index < TYPE_COUNT; index++) {
        if (strcmp(types[index].name, name) == 0)
            return &types[index];
    }
    fail_msg("no type %s", name);
    return NULL;
}

static void put_value(Builder *builder, const Type *type, double value)
{
    uint64_t bits = (uint64_t)(int64_t)value;
    if (builder->encoding == ASCII) {
        put_text(builder, "%.17g ", value);
        return;
    }
    if (type->size == 4 && type->is_float) {
        const float narrowed = (float)value;
        uint32_t low;
        memcpy(&low, &narrowed, sizeof low);
        bits = low;
    } else if (type->is_float) {
        memcpy(&bits, &value, sizeof bits);
    }
    put_bits(builder, bits, type->size);
}

static void put_values(Builder *builder, const char *type, size_t count, const double *values)
{
    for (size_t index = 0; index < count; index++)
        put_value(builder, type_of(type), values[index]);
}

// Returns a file of vertices with normals and other values, a quad and a triangle.
static Builder square_with_extras(int encoding)
{
    static const double vertices[4][6] = {
        {0, 0, 0, 0, 0, 1}, {1, 0, 0, 0, 0.5, 1}, {1, 1, 0, 0, 0, -2}, {0, 1, 0.25, 0, 0, 0}};
    static const double quad[] = {0, 1, 2, 3}, triangle[] = {3, 2, 1}, extras[] = {7, 8};
    Builder builder = builder_start(encoding);
    put_text(&builder, "element camera 1\nproperty double focus\nproperty list uchar short stops\n"
                       "element vertex 4\nproperty uchar red\nproperty float x\nproperty float y\n"
                       "property float z\nproperty ushort green\nproperty float blue\n"
                       "property list char int links\nproperty float nx\n"
                       "property float ny\nproperty float nz\n"
                       "element face 2\nproperty float area\n"
                       "property list uchar int vertex_indices\n"
                       "property list uchar float weights\nelement nothing 3\nend_header\n");
    put_values(&builder, "double", 1, (double[]){2.5});
    put_values(&builder, "uchar", 1, (double[]){2});
    put_values(&builder, "short", 2, extras);
    for (size_t vertex = 0; vertex < 4; vertex++) {
        put_values(&builder, "uchar", 1, (double[]){255});
        put_values(&builder, "float", 3, vertices[vertex]);
        put_values(&builder, "ushort", 1, (double[]){(double)(vertex * 1000)});
        put_values(&builder, "float", 1, (double[]){0.25});
        put_values(&builder, "char", 1, (double[]){(double)(vertex % 3)});
        put_values(&builder, "int", vertex % 3, extras);
        put_values(&builder, "float", 3, vertices[vertex] + 3);
    }
    for (size_t face = 0; face < 2; face++) {
        put_values(&builder, "float", 1, extras);
        put_values(&builder, "uchar", 1, (double[]){face == 0 ? 4 : 3});
        put_values(&builder, "int", face == 0 ? 4 : 3, face == 0 ? quad : triangle);
        put_values(&builder, "uchar", 1, (double[]){face == 0 ? 0 : 1});
        put_values(&builder, "float", face, extras);
    }
    // The file ends in a single digit, so a truncated file cannot end in a shorter number.
    builder.size -= encoding == ASCII;
    return builder;
}

static void check_square(const Mesh *mesh)
{
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(mesh->triangle_count, 3);
    assert_int_equal(mesh->dropped.count, 0);
    assert_triangle(mesh, 0, 0, 1, 2);
    assert_triangle(mesh, 1, 0, 2, 3);
    assert_triangle(mesh, 2, 3, 2, 1);
    assert_true(mesh->positions[3][1] == 1 && mesh->positions[3][2] == 0.25);
    assert_true(mesh->normals[1][1] == 0.5F && mesh->normals[2][2] == -2);
    assert_true(mesh->normals[3][2] == 0);
    assert_true(mesh->colors[3][0] == 1 && mesh->colors[3][1] == (float)(3000.0 / 65535) &&
                mesh->colors[3][2] == 0.25F);
}

TEST(elements_that_a_mesh_does_not_use_are_skipped)
{
    for (int encoding = ASCII; encoding <= BIG; encoding++) {
        const Builder builder = square_with_extras(encoding);
        FREED_BY(mesh_free) Mesh mesh = parse_good(&builder);
        check_square(&mesh);
    }
}

TEST(every_type_gives_coordinates_in_every_encoding)
{
    for (size_t test = 0; test < 3 * TYPE_COUNT; test++) {
        const Type *type = &types[test / 3];
        const double largest = type->is_float    ? 1.0 / 3
                               : type->is_signed ? ldexp(1, 8 * (int)type->size - 1) - 1
                                                 : ldexp(1, 8 * (int)type->size) - 1;
        const double point[] = {type->is_signed ? -largest : 0, largest, 5};
        Builder builder = builder_start((int)(test % 3));
        put_text(&builder,
                 "element vertex 1\nproperty %s x\nproperty %s y\nproperty %s z\n"
                 "end_header\n",
                 type->name, type->name, type->name);
        put_values(&builder, type->name, 3, point);
        FREED_BY(mesh_free) Mesh mesh = parse_good(&builder);
        const bool is_rounded = test % 3 != ASCII && type->is_float && type->size == 4;
        for (size_t axis = 0; axis < 3; axis++)
            assert_true(mesh.positions[0][axis] ==
                        (is_rounded ? (double)(float)point[axis] : point[axis]));
        assert_null(mesh.normals);
    }
}

// Without lists, the vertices of binary files are read in bulk.
TEST(the_largest_value_of_a_type_is_the_brightest_color)
{
    static const struct {
        const char *type;
        double values[3];
        float colors[3];
    } cases[] = {
        {"uchar", {255, 0, 51}, {1, 0, 0.2F}},
        {"ushort", {65535, 0, 13107}, {1, 0, 0.2F}},
        {"float", {1, 0, 0x1.99999ap-3}, {1, 0, 0.2F}},
        {"double", {2.5, -1, 0.2}, {1, 0, 0.2F}},
    };
    for (size_t test = 0; test < 3 * sizeof cases / sizeof *cases; test++) {
        const char *type = cases[test / 3].type;
        Builder builder = builder_start((int)(test % 3));
        put_text(&builder,
                 "element vertex 2\nproperty %s red\nproperty float x\nproperty float y\n"
                 "property float z\nproperty %s green\nproperty %s blue\nend_header\n",
                 type, type, type);
        for (int vertex = 0; vertex < 2; vertex++) {
            put_values(&builder, type, 1, cases[test / 3].values);
            put_values(&builder, "float", 3, (double[]){7, 8, 9});
            put_values(&builder, type, 2, cases[test / 3].values + 1);
        }
        FREED_BY(mesh_free) Mesh mesh = parse_good(&builder);
        for (int vertex = 0; vertex < 2; vertex++)
            assert_memory_equal(mesh.colors[vertex], cases[test / 3].colors, sizeof *mesh.colors);
        assert_true(mesh.positions[1][0] == 7);
    }
}

TEST(colors_without_a_component_or_of_another_type_are_skipped)
{
    static const char *const headers[] = {
        "property uchar red\nproperty uchar green\nproperty uchar alpha\n",
        "property int red\nproperty int green\nproperty int blue\n",
        "property list uchar uchar red\nproperty uchar green\nproperty uchar blue\n"};
    for (int test = 0; test < 3; test++) {
        Builder builder = builder_start(ASCII);
        put_text(&builder,
                 "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                 "%send_header\n7 8 9 1 1 1 1 ",
                 headers[test]);
        FREED_BY(mesh_free) Mesh mesh = parse_good(&builder);
        assert_null(mesh.colors);
        assert_true(mesh.positions[0][2] == 9);
    }
}

// Returns a file of one triangle. Its list has these types for the length and the items.
static Builder triangle_with_types(int encoding, const char *length, const char *item)
{
    Builder builder = builder_start(encoding);
    put_text(&builder,
             "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 1\nproperty list %s %s vertex_index\nend_header\n",
             length, item);
    put_values(&builder, "float", 9, (double[]){0, 0, 0, 1, 0, 0, 0, 1, 0});
    put_values(&builder, length, 1, (double[]){3});
    put_values(&builder, item, 3, (double[]){2, 0, 1});
    return builder;
}

TEST(every_integer_type_counts_and_numbers_corners)
{
    for (int test = 0; test < 3 * TYPE_COUNT * TYPE_COUNT; test++) {
        const Type *length = &types[test / 3 % TYPE_COUNT], *item = &types[test / 3 / TYPE_COUNT];
        const Builder builder = triangle_with_types(test % 3, length->name, item->name);
        Mesh mesh;
        Error error;
        const bool ok = parse(&mesh, builder.bytes, builder.size, &error);
        assert_true(ok == (!length->is_float && !item->is_float));
        if (ok)
            assert_triangle(&mesh, 0, 2, 0, 1);
        mesh_free(&mesh);
    }
}

// Unused properties are between the properties of the mesh. A quad is among the triangles.
TEST(unusual_elements_among_usual_ones_are_read_in_their_order)
{
    static const double faces[4][4] = {{0, 1, 2}, {0, 1, 2, 3}, {3, 2, 1}, {1, 2, 3}};
    for (int encoding = ASCII; encoding <= BIG; encoding++) {
        Builder builder = builder_start(encoding);
        put_text(&builder, "element vertex 4\nproperty float nx\nproperty float ny\n"
                           "property float nz\nproperty uchar red\nproperty double x\n"
                           "property float y\nproperty double z\nelement face 4\n"
                           "property short group\nproperty list uchar uint vertex_indices\n"
                           "property float area\nend_header\n");
        for (int vertex = 0; vertex < 4; vertex++) {
            put_values(&builder, "float", 3, (double[]){vertex, 2, -3});
            put_values(&builder, "uchar", 1, (double[]){255});
            put_values(&builder, "double", 1, (double[]){vertex + 1e-9});
            put_values(&builder, "float", 1, (double[]){vertex * vertex});
            put_values(&builder, "double", 1, (double[]){-vertex});
        }
        for (int face = 0; face < 4; face++) {
            const size_t corners = face == 1 ? 4 : 3;
            put_values(&builder, "short", 1, (double[]){-1});
            put_values(&builder, "uchar", 1, (double[]){(double)corners});
            put_values(&builder, "uint", corners, faces[face]);
            put_values(&builder, "float", 1, (double[]){0.5});
        }
        FREED_BY(mesh_free) Mesh mesh = parse_good(&builder);
        assert_int_equal(mesh.triangle_count, 5);
        assert_triangle(&mesh, 0, 0, 1, 2);
        assert_triangle(&mesh, 2, 0, 2, 3);
        assert_triangle(&mesh, 3, 3, 2, 1);
        assert_triangle(&mesh, 4, 1, 2, 3);
        assert_true(mesh.positions[3][0] == 3 + 1e-9 && mesh.positions[3][1] == 9);
        assert_true(mesh.positions[2][2] == -2 && mesh.normals[2][0] == 2);
        assert_true(mesh.normals[3][1] == 2 && mesh.normals[0][2] == -3);
    }
}

// The body of the binary file begins with bytes that equal line ends.
TEST(any_line_ends_and_blanks_are_read)
{
    static const char *const breaks[] = {"\n", "\r\n", "\r"};
    for (size_t index = 0; index < 3; index++) {
        const char *end = breaks[index];
        const char *text = "ply|comment two  words|format ascii\t1.0  |obj_info|||element vertex 3|"
                           "property float x|property float y|property float z||element face 1|"
                           "property list uchar int vertex_indices|end_header||  0 0 0 ||1 0|0 0|"
                           "1\t0  | 3 0|1|| 2 |||trailing words";
        Builder ascii = {0}, binary = {0};
        for (; *text != '\0'; text++)
            put_text(&ascii, "%.*s", *text == '|' ? 2 : 1, *text == '|' ? end : text);
        put_text(&binary,
                 "ply%sformat binary_big_endian 1.0%selement vertex 1%sproperty char x%s"
                 "property char y%sproperty char z%send_header%s\n\r\n",
                 end, end, end, end, end, end, end);
        FREED_BY(mesh_free) Mesh one = parse_good(&ascii), other = parse_good(&binary);
        assert_triangle(&one, 0, 0, 1, 2);
        assert_true(other.positions[0][0] == 10 && other.positions[0][1] == 13);
    }
}

TEST(a_truncated_file_fails)
{
    for (int encoding = ASCII; encoding <= BIG; encoding++) {
        const Builder builder = square_with_extras(encoding);
        for (size_t size = 0; size < builder.size; size++) {
            Mesh mesh;
            Error error;
            if (parse(&mesh, builder.bytes, size, &error))
                fail_msg("%s cut at byte %zu of %zu passes", encodings[encoding], size,
                         builder.size);
        }
    }
}

TEST(random_damage_neither_crashes_nor_allocates_much)
{
    Builder whole[3];
    for (int encoding = ASCII; encoding <= BIG; encoding++)
        whole[encoding] = square_with_extras(encoding);
    uint64_t random = 1;
    size_t parsed = 0;
    for (size_t round = 0; round < 1000; round++) {
        Builder damaged = whole[round % 3];
        for (int change = 0; change < 100; change++) {
            if (change % 4 == 0) // more than four changes would break every header
                damaged = whole[round % 3];
            damaged.bytes[random_below(&random, (uint32_t)damaged.size)] =
                (char)random_below(&random, 256);
            Mesh mesh;
            Error error;
            parsed += parse(&mesh, damaged.bytes, damaged.size, &error);
            assert_true(mesh.vertex_count <= damaged.size && mesh.triangle_count <= damaged.size);
            mesh_free(&mesh);
        }
    }
    assert_true(parsed > 0 && parsed < 100000);
}
