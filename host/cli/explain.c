// SPDX-License-Identifier: MIT
// clrt explain SCENE X,Y: explains a pixel. Text is printed after each sample, and JSON after the
// last sample. clrt explain SCENE: prints the compiled features and the uploaded buffers.
#include "cli/commands.h"
#include "cli/stages.h"

#include "explain/report.h"
#include "image/json_file.h"
#include "session/level.h"

#include <stdio.h>

static bool has_pixel(const uint32_t pixel[2], const RenderSettings *settings, Error *error)
{
    return (pixel[0] < settings->width && pixel[1] < settings->height) ||
           error_set(error, "pixel %u,%u: the picture has %u x %u pixels, counted from 0", pixel[0],
                     pixel[1], settings->width, settings->height);
}

// Prepares the picture of the options, without drawing it.
static ExitCode begin(const Options *options, Session *session, Scene *scene,
                      SessionPicture *request, Error *error)
{
    StageSeconds unused = {0};
    const ExitCode code = stage_start(session, scene, options, &unused, error);
    if (code != EXIT_DONE)
        return code;
    if (!stage_request(request, options, scene, error))
        return EXIT_SCENE;
    if (options->action == ACTION_EXPLAIN && !has_pixel(options->pixel, &request->settings, error))
        return EXIT_USAGE;
    return stage_prepare(session, options, NULL, &unused, error);
}

static ExitCode explain(const ExplainReport *report, Explainer *explainer, const Options *options,
                        Error *error)
{
    if (options->json_path == NULL)
        return explain_write_text(report, explainer, stdout, error) ? EXIT_DONE : EXIT_DEVICE;
    json_t *json = explain_json(report, explainer, error);
    if (json == NULL)
        return EXIT_DEVICE;
    return json_file_write(json, options->json_path, error) ? EXIT_DONE : EXIT_OUTPUT;
}

ExitCode explain_pixel(const Options *options, Session *session, Scene *scene, Error *error)
{
    Explainer explainer;
    SessionPicture request;
    ExitCode code = begin(options, session, scene, &request, error);
    if (code != EXIT_DONE)
        return code;
    if (!session_choose_level(session, &request, error))
        return EXIT_DEVICE;
    const ExplainReport report = {.scene_path = options->scene_path,
                                  .scene = scene,
                                  .settings = &request.settings,
                                  .view = options->picture.view,
                                  .pixel = {options->pixel[0], options->pixel[1]},
                                  .encoding = options->encoding};
    if (!explainer_open(&explainer, session, &request.settings, &request.viewpoint, error))
        return EXIT_DEVICE;
    code = explain(&report, &explainer, options, error);
    explainer_close(&explainer);
    return code;
}

// The following functions explain a scene.

static json_t *tree_reason(const Session *session, const SceneForm *form, bool is_needed)
{
    const FlatScene *flat = &form->flat;
    const uint32_t triangles = flat->triangle_count;
    const uint32_t stored = flat->sphere_root != NOTHING ? flat->sphere_root : flat->node_count;
    if (is_needed && triangles == 0)
        return json_string("the spheres have one");
    if (is_needed)
        return json_sprintf("%u node%s over the triangles, uploaded as %u %s node%s",
                            form->stages.bvh.node_count,
                            form->stages.bvh.node_count == 1 ? "" : "s", stored,
                            kernel_nodes_name(session->choice.nodes), stored == 1 ? "" : "s");
    if (triangles == 0)
        return json_string("there are no triangles to find");
    if (session->settings.wanted.tree == CLRT_TREE_NONE)
        return json_string("--tune bvh=none: every triangle and every sphere is tested");
    return json_sprintf("testing all %u triangles is faster", triangles);
}

static json_t *count_reason(uint32_t count)
{
    return count > 0 ? json_sprintf("%u of them", count) : json_string("there are none");
}

// Returns the reason why the scene needs, or does not need, the kernel feature of a trait. Reasons
// without numbers come from the table of traits.
static json_t *part_reason(const Session *session, const SceneForm *form, const Trait *trait,
                           bool is_needed)
{
    const FlatScene *flat = &form->flat;
    if (trait->absent != NULL)
        return json_string(is_needed ? trait->present : trait->absent);
    switch (trait->offset) {
    case offsetof(SceneTraits, spheres):
        if (flat->sphere_root != NOTHING)
            return json_sprintf("%u of them, with a tree of %u wide node%s", flat->sphere_count,
                                flat->node_count - flat->sphere_root,
                                flat->node_count - flat->sphere_root == 1 ? "" : "s");
        return flat->sphere_entries > flat->sphere_count
                   ? json_sprintf("%u of them, with a tree over them", flat->sphere_count)
                   : count_reason(flat->sphere_count);
    case offsetof(SceneTraits, triangles):
        return count_reason(flat->triangle_count);
    case offsetof(SceneTraits, bvh):
        return tree_reason(session, form, is_needed);
    case offsetof(SceneTraits, colors):
        return is_needed ? json_sprintf("%u triangles have colors of vertices", flat->colors_count)
                         : json_string("no mesh shows colors of vertices");
    default:
        return is_needed ? json_sprintf("%u of them shade materials in use", flat->light_count)
                         : json_string("no material in use is shaded: no shadow rays");
    }
}

// Lists the kernel features that the compiler can omit. General programs also contain features that
// the scene does not need.
static json_t *parts_json(const Session *session, const SceneForm *form, bool counts,
                          bool is_special)
{
    json_t *parts = json_array();
    const SceneTraits needed = traits_of(&form->flat, counts);
    const SceneTraits compiled = is_special ? needed : traits_general(needed);
    for (size_t i = 0; i < TRAIT_COUNT; i++) {
        const Trait *trait = &trait_table[i];
        const bool is_needed = trait_of(&needed, trait);
        json_array_append_new(parts,
                              JSON(FIELD("name", trait->name), FIELD("needed", is_needed),
                                   FIELD("compiled", trait_of(&compiled, trait)),
                                   FIELD("reason", part_reason(session, form, trait, is_needed))));
    }
    return parts;
}

static const char *scene_family_reason(const Session *session)
{
    const ClrtSettings *wanted = &session->settings.wanted;
    if (wanted->precision == CLRT_FP64)
        return "fp64 traces rays one by one";
    if (wanted->kernel != CLRT_KERNEL_AUTO)
        return "--tune kernel requests it";
    if (session->is_quick)
        return "packets are not compiled yet, and compiling takes longer than they would save";
    if (kernel_choice_suits_packets(&session->device))
        return "this form suits CPUs";
    return session->device.is_cpu ? "this form suits this OpenCL implementation"
                                  : "this form suits GPUs";
}

static const char *scene_program_reason(ClrtSpecialize wanted, bool is_special)
{
    if (wanted != CLRT_SPECIALIZE_AUTO)
        return is_special ? "--tune specialize=always" : "--tune specialize=never";
    return is_special
               ? "the kernels are compiled already, or save more than compiling costs"
               : "special kernels are not compiled yet, and would save less than compiling costs";
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

static json_t *report_json(const Options *options, const Session *session, const SceneForm *form,
                           bool is_special)
{
    const KernelChoice *choice = &session->choice;
    const bool counts = options->picture.statistics;
    json_t *kernels = JSON(FIELD("family", kernel_family_name(choice->family)),
                           FIELD("nodes", kernel_nodes_name(choice->nodes)),
                           FIELD("precision", kernel_precision_name(choice->precision)),
                           FIELD("reason", scene_family_reason(session)));
    json_t *program = JSON(
        FIELD("special", is_special),
        FIELD("reason", scene_program_reason(session->settings.wanted.specialize, is_special)));
    return REPORT(2, FIELD("scene", options->scene_path),
                  FIELD("device", session->device.facts.name), FIELD("kernels", kernels),
                  FIELD("program", program),
                  FIELD("parts", parts_json(session, form, counts, is_special)),
                  FIELD("uploaded_bytes", arrays_json(&form->flat)));
}

// Prints the heading and the features whose fields "needed" and "compiled" equal the flags. Prints
// nothing if there is no such feature.
static void write_parts(const json_t *parts, const char *heading, bool is_needed, bool is_compiled)
{
    for (size_t i = 0; i < json_array_size(parts); i++) {
        const json_t *part = json_array_get(parts, i);
        if (json_is_true(json_object_get(part, "needed")) != is_needed ||
            json_is_true(json_object_get(part, "compiled")) != is_compiled)
            continue;
        printf("%s  %-11s", heading, json_string_value(json_object_get(part, "name")));
        json_print(part, " {reason}\n", stdout);
        heading = "";
    }
}

static void write_arrays(json_t *arrays)
{
    const char *name;
    json_t *bytes;
    int missing = 0;
    json_object_foreach(arrays, name, bytes)
    {
        if (json_integer_value(bytes) > 0)
            printf("  %-11s %lld bytes\n", name, (long long)json_integer_value(bytes));
    }
    json_object_foreach(arrays, name, bytes)
    {
        if (json_integer_value(bytes) == 0)
            printf("%s %s", missing++ == 0 ? "not uploaded, because they are empty\n " : "", name);
    }
    printf("%s", missing > 0 ? "\n" : "");
}

static void write_text(const json_t *report, size_t upload_size)
{
    const json_t *parts = json_object_get(report, "parts");
    const json_t *program = json_object_get(report, "program");
    json_print(report,
               "{scene} on {device}\n"
               "  kernels     {kernels.family} over {kernels.nodes} nodes in {kernels.precision}: "
               "{kernels.reason}\n"
               "  program     ",
               stdout);
    fputs(json_is_true(json_object_get(program, "special")) ? "special" : "general", stdout);
    json_print(program, ": {reason}\n", stdout);
    write_parts(parts, "compiled in\n", true, true);
    write_parts(parts, "compiled in but idle, because the program is general\n", false, true);
    write_parts(parts, "left out\n", false, false);
    printf("uploaded, %zu bytes\n", upload_size);
    write_arrays(json_object_get(report, "uploaded_bytes"));
}

ExitCode explain_scene(const Options *options, Session *session, Scene *scene, Error *error)
{
    SessionPicture request;
    PictureResult prepared;
    const ExitCode code = begin(options, session, scene, &request, error);
    if (code != EXIT_DONE)
        return code;
    if (!session_prepare_picture(session, &request, &prepared, error))
        return EXIT_DEVICE;
    json_t *report =
        report_json(options, session, session_scene_own_form(session, error), prepared.is_special);
    if (options->json_path != NULL)
        return json_file_write(report, options->json_path, error) ? EXIT_DONE : EXIT_OUTPUT;
    write_text(report, prepared.upload_size);
    json_decref(report);
    return EXIT_DONE;
}
