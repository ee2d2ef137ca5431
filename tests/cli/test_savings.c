// SPDX-License-Identifier: MIT
// What --explain tells of savings is what was measured: the table in the code is that of
// tests/bench/traits.txt.
#include "cli/savings.h"
#include "unit/cmocka_all.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TABLE CLRT_SOURCE_FOLDER "/tests/bench/traits.txt"

static const char *const columns[SCENE_PARTS] = {"spheres", "triangles", "tree",
                                                 "lights",  "mirrors",   "statistics"};

typedef struct {
    FILE *file;
    char line[200];
} Table;

static bool table_read(Table *table)
{
    return fgets(table->line, sizeof table->line, table->file) != NULL;
}

// Goes to the columns under a heading that begins like this, and asserts that they are the parts.
static void table_open(Table *table, const char *heading)
{
    table->file = fopen(TABLE, "r");
    assert_non_null(table->file);
    do
        assert_true(table_read(table));
    while (strncmp(table->line, heading, strlen(heading)) != 0);
    assert_true(table_read(table));
    const char *rest = table->line;
    for (int i = 0; i < SCENE_PARTS; i++) {
        rest += strspn(rest, " ");
        assert_memory_equal(rest, columns[i], strlen(columns[i]));
        rest += strlen(columns[i]);
    }
}

// Reads the figures of a line behind its name; 0 stands for "-".
static void read_figures(const char *line, double figures[SCENE_PARTS])
{
    const char *rest = strpbrk(line, "-0123456789");
    for (int i = 0; i < SCENE_PARTS; i++) {
        char *end;
        assert_non_null(rest);
        figures[i] = strtod(rest, &end);
        rest = (end == rest ? rest + 1 : end);
        rest += strspn(rest, " ");
    }
}

static void assert_tracing(const char *heading, KernelFamily family)
{
    Table table;
    double least[SCENE_PARTS] = {0}, most[SCENE_PARTS] = {0}, figures[SCENE_PARTS];
    table_open(&table, heading);
    while (table_read(&table) && table.line[0] == ' ') {
        read_figures(table.line, figures);
        for (int i = 0; i < SCENE_PARTS; i++) {
            if (figures[i] > 0 && (least[i] <= 0 || figures[i] < least[i]))
                least[i] = figures[i];
            if (figures[i] > most[i])
                most[i] = figures[i];
        }
    }
    fclose(table.file);
    for (int i = 0; i < SCENE_PARTS; i++) {
        const PartCost cost = saving_measured((ScenePartKind)i, family);
        assert_true(least[i] > 0);
        assert_true(cost.least == least[i]);
        assert_true(cost.most == most[i]);
    }
}

static void assert_compiling(Table *table, KernelFamily family)
{
    double with[SCENE_PARTS], without[SCENE_PARTS];
    assert_true(table_read(table));
    read_figures(table->line, with);
    assert_true(table_read(table));
    read_figures(strstr(table->line, "without"), without);
    for (int i = 0; i < SCENE_PARTS; i++) {
        const PartCost cost = saving_measured((ScenePartKind)i, family);
        assert_true(without[i] > 0);
        assert_true(cost.with == with[i]);
        assert_true(cost.without == without[i]);
    }
}

static void every_part_has_the_times_of_tracing_that_were_measured(void **state)
{
    (void)state;
    assert_tracing("Time of tracing, packets", FAMILY_PACKET);
    assert_tracing("Time of tracing, single rays", FAMILY_RAY);
}

static void every_part_has_the_times_of_compiling_that_were_measured(void **state)
{
    (void)state;
    Table table;
    table_open(&table, "Time of compiling");
    assert_compiling(&table, FAMILY_PACKET);
    assert_compiling(&table, FAMILY_RAY);
    fclose(table.file);
}

static void assert_described(ScenePartKind kind, KernelFamily family, const char *expected)
{
    ScenePart parts[SCENE_PARTS] = {0};
    char text[SAVING_TEXT];
    parts[PART_TRIANGLES].is_compiled = kind == PART_TREE;
    saving_describe(parts, kind, family, text);
    assert_string_equal(text, expected);
}

static void what_is_within_the_noise_is_called_so(void **state)
{
    (void)state;
    assert_described(PART_TRIANGLES, FAMILY_PACKET,
                     "saves 47 % of compiling; tracing within noise");
    assert_described(PART_LIGHTS, FAMILY_PACKET, "saves 9 % of tracing; compiling within noise");
    assert_described(PART_MIRRORS, FAMILY_PACKET,
                     "saves up to 15 % of tracing; compiling within noise");
    assert_described(PART_MIRRORS, FAMILY_RAY, "saves 9 % of compiling and 7 to 32 % of tracing");
    assert_described(PART_TREE, FAMILY_RAY, "saves 4 % of compiling; tracing within noise");
}

static void a_tree_saves_nothing_of_its_own_where_there_are_no_triangles(void **state)
{
    (void)state;
    const ScenePart parts[SCENE_PARTS] = {0};
    char text[SAVING_TEXT];
    saving_describe(parts, PART_TREE, FAMILY_PACKET, text);
    assert_string_equal(text, "counted with the triangles");
    assert_false(saving_is_own(parts, PART_TREE));
    assert_true(saving_is_own(parts, PART_TRIANGLES));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_part_has_the_times_of_tracing_that_were_measured),
        cmocka_unit_test(every_part_has_the_times_of_compiling_that_were_measured),
        cmocka_unit_test(what_is_within_the_noise_is_called_so),
        cmocka_unit_test(a_tree_saves_nothing_of_its_own_where_there_are_no_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
