// SPDX-License-Identifier: MIT
// Prepares a picture without drawing it. Prints the compiled features and the uploaded buffers.
#include "cli/commands.h"

#include "image/json_file.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define SCENE_PARTS 6

// A kernel feature that can be omitted at compile time.
typedef struct {
    const char *name;
    bool is_needed;
    bool is_compiled; // general kernels also contain features that the scene does not need
    char reason[160];
} ScenePart;

__attribute__((format(printf, 3, 4))) static ScenePart part(const char *name, bool is_needed,
                                                            const char *format, ...)
{
    ScenePart made = {.name = name, .is_needed = is_needed};
    va_list values;
    va_start(values, format);
    vsnprintf(made.reason, sizeof made.reason, format, values);
    va_end(values);
    return made;
}

static ScenePart tree_part(const Session *session, const SceneForm *form, bool is_needed)
{
    const uint32_t triangles = form->flat.triangle_count, stored = form->flat.node_count;
    if (is_needed)
        return part("tree", true, "%u node%s over the triangles, uploaded as %u %s node%s",
                    form->tree.node_count, form->tree.node_count == 1 ? "" : "s", stored,
                    kernel_nodes_name(session->choice.nodes), stored == 1 ? "" : "s");
    if (triangles == 0)
        return part("tree", false, "there are no triangles to find");
    if (session->settings.tree == TREE_NEVER)
        return part("tree", false, "--tune bvh=none: every triangle is tested");
    return part("tree", false, "testing all %u triangles is faster", triangles);
}

static void scene_parts_list(const Run *run, ScenePart parts[SCENE_PARTS])
{
    const FlatScene *flat = &run->form->flat;
    const SceneTraits needed = traits_of(flat, run->options->picture.statistics);
    const ScenePart list[SCENE_PARTS] = {
        needed.spheres ? part("spheres", true, "%u of them", flat->sphere_count)
                       : part("spheres", false, "there are none"),
        needed.triangles ? part("triangles", true, "%u of them", flat->triangle_count)
                         : part("triangles", false, "there are none"),
        tree_part(&run->session, run->form, needed.bvh),
        needed.shaded
            ? part("lights", true, "%u of them shade materials in use", flat->light_count)
            : part("lights", false, "all materials in use are silhouettes: no shadow rays"),
        needed.mirrors ? part("mirrors", true, "a material in use reflects")
                       : part("mirrors", false, "no material in use reflects: no reflected rays"),
        needed.statistics ? part("statistics", true, "--stats counts rays and tests")
                          : part("statistics", false, "not requested: no --stats")};
    memcpy(parts, list, sizeof list);
    // General programs contain all features, except that statistics require --stats.
    for (int i = 0; i < SCENE_PARTS; i++)
        parts[i].is_compiled =
            parts[i].is_needed || (!run->report.drawn.is_special && i < SCENE_PARTS - 1);
}

static const char *scene_family_reason(const Session *session)
{
    const KernelRequest *wanted = &session->settings.kernel;
    if (wanted->precision == PRECISION_FP64)
        return "--precision fp64 traces rays one by one";
    if (wanted->form != KERNEL_AUTO)
        return "--tune kernel requests it";
    if (session->is_quick)
        return "packets are not compiled yet, and compiling takes longer than they would save";
    if (kernel_suits_packets(&session->device))
        return "it suits CPUs";
    return session->device.is_cpu ? "it suits this OpenCL implementation" : "it suits GPUs";
}

static const char *scene_program_reason(Specialization wanted, bool is_special)
{
    if (wanted != SPECIALIZE_AUTO)
        return is_special ? "--tune specialize=always" : "--tune specialize=never";
    return is_special
               ? "the kernels are compiled already, or save more than compiling costs"
               : "special kernels are not compiled yet, and would save less than compiling costs";
}

static json_t *parts_json(const Run *run)
{
    ScenePart parts[SCENE_PARTS];
    json_t *list = json_array();
    scene_parts_list(run, parts);
    for (const ScenePart *part = parts; part < parts + SCENE_PARTS; part++)
        json_array_append_new(
            list, JSON(FIELD("name", part->name), FIELD("needed", part->is_needed),
                       FIELD("compiled", part->is_compiled), FIELD("reason", part->reason)));
    return list;
}

static json_t *arrays_json(const FlatScene *flat)
{
    FlatArray arrays[FLAT_ARRAYS];
    json_t *object = json_object();
    flat_arrays(flat, arrays);
    for (int i = 0; i < FLAT_ARRAYS; i++)
        json_object_set_new(object, arrays[i].name, json_count(arrays[i].bytes));
    return object;
}

static json_t *report_json(const Run *run)
{
    const KernelChoice *choice = &run->session.choice;
    json_t *kernels = JSON(FIELD("family", kernel_family_name(choice->family)),
                           FIELD("nodes", kernel_nodes_name(choice->nodes)),
                           FIELD("precision", kernel_precision_name(choice->precision)),
                           FIELD("reason", scene_family_reason(&run->session)));
    const bool is_special = run->report.drawn.is_special;
    const Specialization wanted = run->session.settings.specialization;
    json_t *program = JSON(FIELD("special", is_special),
                           FIELD("reason", scene_program_reason(wanted, is_special)));
    return REPORT(2, FIELD("scene", run->options->scene_path),
                  FIELD("device", run->session.device.name), FIELD("kernels", kernels),
                  FIELD("program", program), FIELD("parts", parts_json(run)),
                  FIELD("uploaded_bytes", arrays_json(&run->form->flat)));
}

// Prints the features with these properties below the heading, if there are any.
static void write_parts(const ScenePart parts[SCENE_PARTS], const char *heading, bool is_needed,
                        bool is_compiled)
{
    for (int i = 0; i < SCENE_PARTS; i++) {
        if (parts[i].is_needed != is_needed || parts[i].is_compiled != is_compiled)
            continue;
        printf("%s  %-11s %s\n", heading, parts[i].name, parts[i].reason);
        heading = "";
    }
}

static void write_arrays(const FlatScene *flat, size_t upload_size)
{
    FlatArray arrays[FLAT_ARRAYS];
    int missing = 0;
    flat_arrays(flat, arrays);
    printf("uploaded, %zu bytes\n", upload_size);
    for (int i = 0; i < FLAT_ARRAYS; i++)
        if (arrays[i].bytes > 0)
            printf("  %-11s %zu bytes\n", arrays[i].name, arrays[i].bytes);
    for (int i = 0; i < FLAT_ARRAYS; i++)
        if (arrays[i].bytes == 0)
            printf("%s %s", missing++ == 0 ? "not uploaded, because they are empty\n " : "",
                   arrays[i].name);
    printf("%s", missing > 0 ? "\n" : "");
}

static void write_text(const Run *run)
{
    ScenePart parts[SCENE_PARTS];
    json_t *json = report_json(run);
    scene_parts_list(run, parts);
    json_print(json,
               "{scene} on {device}\n"
               "  kernels     {kernels.family} over {kernels.nodes} nodes in {kernels.precision}: "
               "{kernels.reason}\n"
               "  program     ",
               stdout);
    fputs(run->report.drawn.is_special ? "special" : "general", stdout);
    json_print(json, ": {program.reason}\n", stdout);
    json_decref(json);
    write_parts(parts, "compiled in\n", true, true);
    write_parts(parts, "compiled in but idle, because the program is general\n", false, true);
    write_parts(parts, "left out\n", false, false);
    write_arrays(&run->form->flat, run->report.drawn.upload_size);
}

ExitCode explain_scene(Run *run, Error *error)
{
    const Options *options = run->options;
    ExitCode code = run_start(run, error);
    if (code == EXIT_DONE)
        code = run_prepare(run, error);
    if (code != EXIT_DONE)
        return code;
    if (!session_prepare(&run->session, &run->request, &run->report.drawn, error))
        return EXIT_DEVICE;
    if (options->json_path != NULL)
        return json_file_write(report_json(run), options->json_path, error) ? EXIT_DONE
                                                                            : EXIT_OUTPUT;
    write_text(run);
    return EXIT_DONE;
}
