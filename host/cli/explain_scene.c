// SPDX-License-Identifier: MIT
// Prepares a picture without drawing it. Prints the compiled features and the uploaded buffers.
#include "cli/commands.h"

#include "cli/scene_parts.h"
#include "image/json_file.h"

#include <stdio.h>

#define SCHEMA_VERSION 2

static void write_kernels(const Run *run)
{
    const KernelChoice *choice = &run->async_device.setup.source.choice;
    printf("%s on %s\n", run->options->scene_path, run->async_device.device.name);
    printf("  %-11s %s over %s nodes in %s: %s\n", "kernels", kernel_family_name(choice->family),
           kernel_nodes_name(choice->nodes), kernel_precision_name(choice->precision),
           scene_family_reason(run));
    printf("  %-11s %s: %s\n", "program", run->renderer.is_special ? "special" : "general",
           scene_program_reason(run));
}

// Prints the compiled features whose is_needed equals the argument.
static void write_parts(const ScenePart parts[SCENE_PARTS], const char *heading, bool is_needed)
{
    bool is_headed = false;
    for (int i = 0; i < SCENE_PARTS; i++) {
        if (parts[i].is_needed != is_needed || !parts[i].is_compiled)
            continue;
        if (!is_headed)
            printf("%s\n", heading);
        is_headed = true;
        printf("  %-11s %s\n", parts[i].name, parts[i].reason);
    }
}

static void write_omissions(const ScenePart parts[SCENE_PARTS])
{
    bool is_headed = false;
    for (int i = 0; i < SCENE_PARTS; i++) {
        if (parts[i].is_compiled)
            continue;
        printf("%s", is_headed ? "" : "left out\n");
        is_headed = true;
        printf("  %-11s %s\n", parts[i].name, parts[i].reason);
    }
}

static void write_arrays(const Run *run)
{
    FlatArray arrays[FLAT_ARRAYS];
    int missing = 0;
    flat_arrays(&run->flat, arrays);
    printf("uploaded, %zu bytes\n", run->renderer.upload_size);
    for (int i = 0; i < FLAT_ARRAYS; i++)
        if (arrays[i].bytes > 0)
            printf("  %-11s %zu bytes\n", arrays[i].name, arrays[i].bytes);
    for (int i = 0; i < FLAT_ARRAYS; i++)
        if (arrays[i].bytes == 0)
            printf("%s %s", missing++ == 0 ? "not uploaded, since there are none\n " : "",
                   arrays[i].name);
    printf("%s", missing > 0 ? "\n" : "");
}

static void write_text(const Run *run)
{
    ScenePart parts[SCENE_PARTS];
    scene_parts_list(run, parts);
    write_kernels(run);
    write_parts(parts, "compiled in", true);
    write_parts(parts, "compiled in and idle, since the program is general", false);
    write_omissions(parts);
    write_arrays(run);
}

static json_t *parts_json(const Run *run)
{
    ScenePart parts[SCENE_PARTS];
    json_t *list = json_array();
    scene_parts_list(run, parts);
    for (int i = 0; i < SCENE_PARTS; i++)
        json_array_append_new(list, json_pack("{s:s, s:b, s:b, s:s}", "name", parts[i].name,
                                              "needed", parts[i].is_needed, "compiled",
                                              parts[i].is_compiled, "reason", parts[i].reason));
    return list;
}

static json_t *arrays_json(const Run *run)
{
    FlatArray arrays[FLAT_ARRAYS];
    json_t *object = json_object();
    flat_arrays(&run->flat, arrays);
    for (int i = 0; i < FLAT_ARRAYS; i++)
        json_object_set_new(object, arrays[i].name, json_integer((json_int_t)arrays[i].bytes));
    return object;
}

static json_t *whole_json(const Run *run)
{
    const KernelChoice *choice = &run->async_device.setup.source.choice;
    return json_pack(
        "{s:i, s:s, s:o, s:s, s:{s:s, s:s, s:s, s:s}, s:{s:b, s:s}, s:o, s:o}", "schema",
        SCHEMA_VERSION, "version", CLRT_VERSION, "scene", json_file_path(run->options->scene_path),
        "device", run->async_device.device.name, "kernels", "family",
        kernel_family_name(choice->family), "nodes", kernel_nodes_name(choice->nodes), "precision",
        kernel_precision_name(choice->precision), "reason", scene_family_reason(run), "program",
        "special", run->renderer.is_special, "reason", scene_program_reason(run), "parts",
        parts_json(run), "uploaded_bytes", arrays_json(run));
}

ExitCode explain_scene(Run *run, Error *error)
{
    const Options *options = run->options;
    const char *path = options->json_path != NULL ? options->json_path : "-";
    run_begin(run);
    if (!run_load_scene(run, error))
        return EXIT_SCENE;
    if (!command_files_check(options, &run->scene, error))
        return EXIT_OUTPUT;
    const ExitCode prepared = run_prepare(run, error);
    if (prepared != EXIT_DONE)
        return prepared;
    if (options->json)
        return json_file_write(whole_json(run), path, error) ? EXIT_DONE : EXIT_OUTPUT;
    write_text(run);
    return EXIT_DONE;
}
