// SPDX-License-Identifier: MIT
// Tests the parser of clrt-foreign's output with every kind of record, and with hostile streams.
#include "mesh/foreign_stream.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DAMAGED "m.obj:", "damaged"

#define TRIANGLE                                                                                   \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                \
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"       \
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"

typedef struct {
    char bytes[8192];
    size_t size;
} Builder;

static void put_bytes(Builder *builder, const void *bytes, size_t size)
{
    assert_true(builder->size + size <= sizeof builder->bytes);
    memcpy(builder->bytes + builder->size, bytes, size);
    builder->size += size;
}

static void put_record(Builder *builder, uint32_t kind, uint32_t number, const void *bytes,
                       size_t size)
{
    const ForeignHead head = {.kind = kind, .number = number, .size = size};
    put_bytes(builder, &head, sizeof head);
    put_bytes(builder, bytes, size);
}

static void put_text(Builder *builder, uint32_t kind, const char *text)
{
    put_record(builder, kind, 0, text, strlen(text));
}

static void put_part(Builder *builder, uint32_t material, const char *ply)
{
    put_record(builder, FOREIGN_PART, material, ply, strlen(ply));
}

static void put_file(Builder *builder, const char *path)
{
    const size_t length = strlen(path);
    const ForeignHead head = {.kind = FOREIGN_FILE, .size = sizeof(ForeignHash) + length};
    put_bytes(builder, &head, sizeof head);
    put_bytes(builder, "0123456789abcdef", sizeof(ForeignHash));
    put_bytes(builder, path, length);
}

// Parses a copy without spare bytes, so that sanitizers detect every access beyond the end.
static bool parse(ForeignModel *model, const char *bytes, size_t size, Error *error)
{
    char *copy = malloc(size + (size == 0));
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    *error = (Error){0};
    const File stream = {copy, size};
    const bool ok = foreign_stream_parse(model, &stream, "m.obj", false, error);
    free(copy);
    const ForeignModel empty = {0};
    if (ok ? error->text[0] != '\0' : memcmp(model, &empty, sizeof empty) != 0)
        fail_msg("a parse that %s left '%s'", ok ? "succeeded" : "failed", error->text);
    if (!ok && (strncmp(error->text, "m.obj: ", 7) != 0 || strchr(error->text, '\n') != NULL))
        fail_msg("no sentence about the file: %s", error->text);
    return ok;
}

static Builder whole_stream(void)
{
    Builder builder = {0};
    const ForeignMaterial red = {.name = "red", .diffuse = {1, 0.25f, 0}, .shininess = 8};
    put_file(&builder, "./m.obj");
    put_file(&builder, "./m.mtl");
    put_record(&builder, FOREIGN_MATERIAL, 0, &red, sizeof red);
    put_part(&builder, FOREIGN_NO_MATERIAL, TRIANGLE);
    put_part(&builder, 0, TRIANGLE);
    put_text(&builder, FOREIGN_NOTE, "3 lines are left out");
    put_text(&builder, FOREIGN_END, "");
    return builder;
}

static ForeignModel parsed(const Builder *builder)
{
    ForeignModel model;
    Error error;
    if (!parse(&model, builder->bytes, builder->size, &error))
        fail_msg("%s", error.text);
    return model;
}

// Expects a message that begins with `place` and contains `keyword`.
static void expect_message(const Error *error, const char *place, const char *keyword)
{
    if (strncmp(error->text, place, strlen(place)) != 0 || strstr(error->text, keyword) == NULL)
        fail_msg("'%s' is not at %s or lacks '%s'", error->text, place, keyword);
}

static void expect_failure(const Builder *builder, const char *place, const char *keyword)
{
    ForeignModel model;
    Error error;
    assert_false(parse(&model, builder->bytes, builder->size, &error));
    expect_message(&error, place, keyword);
}

TEST(a_stream_becomes_files_materials_parts_and_a_note)
{
    const Builder builder = whole_stream();
    FREED_BY(foreign_model_free) ForeignModel model = parsed(&builder);
    assert_int_equal(model.files.count, 2);
    assert_string_equal(model.files.data[1], "./m.mtl");
    assert_memory_equal(&model.hashes.data[1], "0123456789abcdef", 16);
    assert_int_equal(model.materials.count, 1);
    assert_string_equal(model.materials.data[0].name, "red");
    assert_true(model.materials.data[0].diffuse[1] == 0.25f);
    assert_int_equal(model.parts.count, 2);
    assert_true(model.parts.data[0].material == FOREIGN_NO_MATERIAL);
    assert_int_equal(model.parts.data[1].material, 0);
    assert_int_equal(model.parts.data[1].mesh.triangle_count, 1);
    assert_string_equal(model.note, "3 lines are left out");
}

TEST(a_path_may_be_as_long_as_the_system_has_them)
{
    char path[4001];
    memset(path, 'd', sizeof path - 1);
    path[sizeof path - 1] = '\0';
    Builder builder = {0};
    put_file(&builder, path);
    put_text(&builder, FOREIGN_END, "");
    FREED_BY(foreign_model_free) ForeignModel model = parsed(&builder);
    assert_string_equal(model.files.data[0], path);
}

TEST(a_part_goes_through_the_checks_of_ply)
{
    const char *const bad = "ply\nformat ascii 1.0\nelement vertex 1\nend_header\n";
    const ForeignMaterial red = {.name = "red"};
    Builder plain = {0}, builder = {0};
    put_part(&plain, FOREIGN_NO_MATERIAL, bad);
    expect_failure(&plain, "m.obj: part 0:", "lacks x");
    put_record(&builder, FOREIGN_MATERIAL, 0, &red, sizeof red);
    put_part(&builder, FOREIGN_NO_MATERIAL, TRIANGLE);
    put_part(&builder, 0, bad);
    put_text(&builder, FOREIGN_END, "");
    expect_failure(&builder, "m.obj: part 1, material red:", "lacks x");
}

TEST(messages_name_the_first_invalid_object_of_their_part)
{
    const char *const bad = "ply\nformat ascii 1.0\nelement vertex 1\nend_header\n";
    Builder builder = {0};
    put_text(&builder, FOREIGN_OBJECT, "other");
    put_part(&builder, FOREIGN_NO_MATERIAL, TRIANGLE);
    put_text(&builder, FOREIGN_OBJECT, "chair\x1b");
    put_text(&builder, FOREIGN_OBJECT, "lamp");
    put_part(&builder, FOREIGN_NO_MATERIAL, bad);
    expect_failure(&builder, "m.obj: part 1, object chair?:", "lacks x");
}

TEST(a_reason_is_reported_in_plain_letters)
{
    Builder builder = {0};
    put_text(&builder, FOREIGN_FAILURE, "bad\x1b[31m\nthing \xc3\xa9");
    expect_failure(&builder, "m.obj:", "bad?[31m?thing ??");
}

TEST(colors_come_into_range_and_names_into_one_word)
{
    const ForeignMaterial wild = {.name = "a b\"#\n\xff/c",
                                  .diffuse = {-1, 2, NAN},
                                  .specular = {INFINITY, 0.5f, -0.0f},
                                  .shininess = INFINITY};
    Builder builder = {0};
    put_record(&builder, FOREIGN_MATERIAL, 0, &wild, sizeof wild);
    put_text(&builder, FOREIGN_END, "");
    FREED_BY(foreign_model_free) ForeignModel model = parsed(&builder);
    const ForeignMaterial *tame = &model.materials.data[0];
    assert_string_equal(tame->name, "a_b_____c");
    assert_true(tame->diffuse[0] == 0 && tame->diffuse[1] == 1 && tame->diffuse[2] == 0);
    assert_true(tame->specular[0] == 1 && tame->specular[1] == 0.5f && tame->specular[2] == 0);
    assert_true(tame->shininess == 1e9f);
}

TEST(a_name_without_an_end_gets_one)
{
    ForeignMaterial endless = {0};
    memset(endless.name, 'x', sizeof endless.name);
    Builder builder = {0};
    put_record(&builder, FOREIGN_MATERIAL, 0, &endless, sizeof endless);
    put_text(&builder, FOREIGN_END, "");
    FREED_BY(foreign_model_free) ForeignModel model = parsed(&builder);
    assert_int_equal(strlen(model.materials.data[0].name), sizeof endless.name - 1);
}

TEST(every_stream_that_ends_early_is_damaged)
{
    const Builder builder = whole_stream();
    for (size_t size = 0; size < builder.size; size++) {
        ForeignModel model;
        Error error;
        assert_false(parse(&model, builder.bytes, size, &error));
        expect_message(&error, DAMAGED);
    }
}

TEST(bytes_after_the_end_are_damage)
{
    Builder builder = whole_stream();
    put_bytes(&builder, "x", 1);
    expect_failure(&builder, DAMAGED);
}

TEST(a_part_of_a_material_that_was_not_sent_is_damage)
{
    Builder builder = {0};
    put_part(&builder, 0, TRIANGLE);
    put_text(&builder, FOREIGN_END, "");
    expect_failure(&builder, DAMAGED);
}

TEST(records_of_a_wrong_size_or_kind_are_damage)
{
    const struct {
        uint32_t kind;
        size_t size;
    } wrong[] = {{FOREIGN_FILE, 3},
                 {FOREIGN_FILE, 16},
                 {FOREIGN_MATERIAL, 7},
                 {FOREIGN_NOTE, 0},
                 {FOREIGN_NOTE, 4097},
                 {FOREIGN_END, 1},
                 {0, 0},
                 {FOREIGN_END + 1, 0},
                 {UINT32_MAX, 4},
                 {FOREIGN_FILE, 5000}};
    const char filler[100] = "filler without a zero byte would be text";
    char text[5000];
    memset(text, 't', sizeof text);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        Builder builder = {0};
        put_record(&builder, wrong[i].kind, 0, text, wrong[i].size);
        put_text(&builder, FOREIGN_END, "");
        expect_failure(&builder, DAMAGED);
    }
    Builder builder = {0};
    put_record(&builder, FOREIGN_NOTE, 0, filler, sizeof filler); // zero bytes within a text
    put_text(&builder, FOREIGN_END, "");
    expect_failure(&builder, DAMAGED);
}

static void demand_sound(const Mesh *mesh)
{
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++)
        for (int axis = 0; axis < 3; axis++)
            assert_true(fabs(mesh->positions[vertex][axis]) < 1e30);
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            assert_true(mesh->triangles[triangle][corner] < mesh->vertex_count);
}

TEST(a_changed_stream_gives_a_sound_model_or_a_sentence)
{
    const Builder whole = whole_stream();
    uint64_t random = 1;
    size_t survivors = 0;
    for (int run = 0; run < 20000; run++) {
        Builder changed = whole;
        for (int i = 0; i <= run % 3; i++)
            changed.bytes[random_below(&random, (uint32_t)whole.size)] =
                (char)random_below(&random, 256);
        ForeignModel model;
        Error error;
        if (!parse(&model, changed.bytes, changed.size, &error))
            continue;
        survivors++;
        for (size_t part = 0; part < model.parts.count; part++)
            demand_sound(&model.parts.data[part].mesh);
        foreign_model_free(&model);
    }
    assert_in_range(survivors, 1, 19999);
}
