// SPDX-License-Identifier: MIT
// clrt check: reads the scene, examines its geometry, casts rays to find leaks, and writes a
// report. Without a device, it casts no rays. The text lists each mesh with its findings. JSON
// contains every count, even if it is 0.
#include "cli/commands.h"

#include "base/clock.h"
#include "base/print.h"
#include "check/measure.h"
#include "cli/stages.h"
#include "image/json_file.h"

#include <math.h>

static json_t *fault_json(MeshFault fault)
{
    return JSON(FIELD("count", fault.count),
                FIELD("first", fault.count > 0 ? json_count(fault.first) : json_null()));
}

static json_t *feature_json(const Feature *feature)
{
    const bool found = isfinite(feature->steps);
    return JSON(FIELD("size", found ? feature->size : (double)NAN), FIELD("steps", feature->steps),
                FIELD("triangle", found ? json_count(feature->triangle) : json_null()));
}

static json_t *leaks_json(const Check *check, const MeshCensus *census)
{
    const ClrtCheckedMesh *facts = &census->facts;
    if (check->device == NULL)
        return json_null();
    return JSON(FIELD("leaks", fault_json(census->leaks)), FIELD("rays", facts->ray_count),
                FIELD("aims", facts->aim_count), FIELD("aimed_at", facts->aimed_at),
                FIELD("hidden", facts->hidden), FIELD("cap", json_count(LEAKS_AIMS)));
}

// Returns the counts of an object's faults except leaks, which the member "leak_test" contains.
static json_t *faults_json(const MeshCensus *census)
{
    json_t *all = json_object();
    for (FaultKind kind = 0; kind < FAULT_KINDS; kind++)
        if (kind != FAULT_LEAKS)
            json_object_set_new(all, fault_name(kind), fault_json(census->faults[kind]));
    return all;
}

static json_t *mesh_json(const Check *check, size_t object)
{
    const MeshCensus *census = &check->census.meshes[object];
    const ClrtCheckedMesh *facts = &census->facts;
    const Features *features = &census->features;
    return JSON(
        FIELD("path", check_mesh_path(check, object)), FIELD("triangles", facts->triangle_count),
        FIELD("vertices", facts->vertex_count), FIELD("edges", facts->edge_count),
        FIELD("closed", facts->closed), FIELD("inside_out", facts->inside_out),
        FIELD("unused_vertices", facts->unused_vertices),
        FIELD("repeated_vertices", facts->repeated_vertices), FIELD("faults", faults_json(census)),
        FIELD("shortest_edge", feature_json(&features->edge)),
        FIELD("lowest_height", feature_json(&features->height)),
        FIELD("shortest_written_edge", feature_json(&features->written_edge)),
        FIELD("leak_test", leaks_json(check, census)),
        FIELD("holds_floats", features->holds_floats));
}

static json_t *meshes_json(const Check *check)
{
    json_t *list = json_array();
    for (size_t object = 0; object < check->scene->objects.count; object++)
        json_array_append_new(list, mesh_json(check, object));
    return list;
}

static json_t *findings_json(const Check *check)
{
    json_t *list = json_array();
    for (size_t i = 0; i < check->findings.count; i++) {
        const ClrtFinding *finding = &check->findings.data[i];
        const bool is_of_mesh = finding->mesh != NOTHING;
        json_array_append_new(
            list, JSON(FIELD("kind", (const char *)finding->kind), FIELD("fails", finding->fails),
                       FIELD("mesh", is_of_mesh ? json_count(finding->mesh) : json_null()),
                       FIELD("count", finding->count), FIELD("text", (const char *)finding->text)));
    }
    return list;
}

static json_t *scene_json(const Check *check)
{
    const Scene *scene = check->scene;
    const Census *census = &check->census;
    return JSON(FIELD("path", check->scene_path), FIELD("lights", scene->lights.count),
                FIELD("spheres", scene->spheres.count), FIELD("empty_meshes", census->empty_meshes),
                FIELD("duplicate_meshes", census->duplicate_meshes),
                FIELD("duplicate_spheres", census->duplicate_spheres),
                FIELD("duplicate_lights", census->duplicate_lights),
                FIELD("unused_materials", census->unused_materials));
}

static json_t *report_json(const Check *check)
{
    return REPORT(1, FIELD("fine", (bool)(check_count_failing(check) == 0)),
                  FIELD("device", check->device), FIELD("scene", scene_json(check)),
                  FIELD("meshes", meshes_json(check)), FIELD("findings", findings_json(check)),
                  FIELD("seconds", check->seconds));
}

// Writes the findings of a mesh, or of the whole scene if `mesh` is NOTHING. The findings start at
// index *next, and *next advances past them.
static void write_findings(const Check *check, uint32_t mesh, size_t *next, FILE *stream)
{
    for (; *next < check->findings.count; ++*next) {
        const ClrtFinding *finding = &check->findings.data[*next];
        if (finding->mesh != mesh)
            return;
        fprintf(stream, "  %s: %s\n", finding->fails ? "FAULT" : "note", finding->text);
    }
}

// Returns whether the object's file has other objects. A file has one object for each material.
static bool shares_file(const Scene *scene, size_t object)
{
    const MeshObject *all = scene->objects.data;
    return (object > 0 && all[object - 1].input == all[object].input) ||
           (object + 1 < scene->objects.count && all[object + 1].input == all[object].input);
}

static void write_material(const Scene *scene, uint32_t material, FILE *stream)
{
    for (size_t i = 0; i < scene->material_names.list.count; i++)
        if (scene->material_names.list.data[i]->material == material)
            print_text(stream, ", material %s", scene->material_names.list.data[i]->name);
}

static void write_count(size_t count, const char *one, const char *many, FILE *stream)
{
    fprintf(stream, "%zu %s", count, count == 1 ? one : many);
}

static void write_mesh(const Check *check, const json_t *mesh, size_t object, FILE *stream)
{
    const ClrtCheckedMesh *facts = &check->census.meshes[object].facts;
    json_print(mesh, "{path}", stream);
    if (shares_file(check->scene, object))
        write_material(check->scene, check->scene->objects.data[object].material, stream);
    fputs(": ", stream);
    write_count(facts->triangle_count, "triangle, ", "triangles, ", stream);
    write_count(facts->vertex_count, "vertex, ", "vertices, ", stream);
    fputs(facts->closed ? "closed\n" : "not closed\n", stream);
    if (facts->triangle_count == 0)
        return;
    json_print(mesh,
               "  shortest edge {shortest_edge.size .3g}, lowest height {lowest_height.size .3g}: "
               "{shortest_edge.steps .3g} and {lowest_height.steps .3g} steps of float\n",
               stream);
    if (check->device == NULL)
        return;
    json_print(
        mesh,
        facts->aim_count > LEAKS_AIMS
            ? "  {leak_test.rays} rays at {leak_test.aimed_at} of its {leak_test.aims} edges "
              "and points (at most {leak_test.cap} are aimed at)"
            : "  {leak_test.rays} rays at {leak_test.aimed_at} of its {leak_test.aims} edges "
              "and points",
        stream);
    json_print(mesh,
               ": {leak_test.hidden} hidden by other parts, {leak_test.leaks.count} pass through",
               stream);
    fputs(facts->leaks > 0 && !facts->closed ? ", because it is not closed\n" : "\n", stream);
}

// Writes the numbers of meshes, triangles, spheres and lights. Omits spheres and lights that clrt
// has added to a lone mesh.
static void write_counts(const Check *check, FILE *stream)
{
    const Scene *scene = check->scene;
    print_text(stream, "%s: ", check->scene_path);
    write_count(scene->objects.count, "mesh, ", "meshes, ", stream);
    write_count(scene_triangle_count(scene), "triangle", "triangles", stream);
    if (scene->mesh_up == UP_AUTO) {
        fputs(", ", stream);
        write_count(scene->spheres.count, "sphere, ", "spheres, ", stream);
        write_count(scene->lights.count, "light", "lights", stream);
    }
    fputs("\n", stream);
}

static void write_text(const Check *check, FILE *stream)
{
    const Scene *scene = check->scene;
    size_t next = 0; // findings are in the order of the objects
    json_t *json = report_json(check);
    for (size_t object = 0; object < scene->objects.count; object++) {
        write_mesh(check, json_array_get(json_object_get(json, "meshes"), object), object, stream);
        write_findings(check, (uint32_t)object, &next, stream);
    }
    write_counts(check, stream);
    write_findings(check, NOTHING, &next, stream);
    json_decref(json);
    if (check->device != NULL)
        fprintf(stream, "  rays were traced on %s\n", check->device);
    else if (check->device_fault.text[0] != '\0')
        fprintf(stream, "  leaks were not tested: %s\n", check->device_fault.text);
    const size_t failing = check_count_failing(check), all = check->findings.count;
    if (all == 0) {
        fputs("fine\n", stream);
        return;
    }
    if (failing == 0)
        fputs("no faults, ", stream);
    else
        write_count(failing, "fault, ", "faults, ", stream);
    write_count(all - failing, "note\n", "notes\n", stream);
}

static bool find_leaks(Check *check, Session *session, const Options *options, Error *error)
{
    Error cause = {0};
    if (scene_triangle_count(check->scene) == 0)
        return true;
    stage_begin(session, options);
    if (session_await(session, NULL, &cause) && check_trace(check, session, &cause))
        return true;
    if (options->renderer.device != NULL || options->renderer.precision == CLRT_FP64)
        return error_set(error, "%s", cause.text);
    check->device_fault = cause;
    return true;
}

static ExitCode report(Check *check, const Options *options, Error *error)
{
    if (!check_find(check, error))
        return EXIT_SCENE;
    if (options->json_path != NULL &&
        !json_file_write(report_json(check), options->json_path, error))
        return EXIT_OUTPUT;
    if (!options->quiet && !options_print_json(options))
        write_text(check, stdout);
    return check_count_failing(check) > 0 ? EXIT_FAULTS : EXIT_DONE;
}

static void print_notes(const Options *options, const Scene *scene)
{
    for (size_t note = 0; note < scene->notes.count; note++)
        stage_note(options, "%s", scene->notes.data[note]);
}

static ExitCode perform(Check *check, const Options *options, Session *session, Scene *scene,
                        Error *error)
{
    const double start = clock_seconds();
    if (!stage_read(scene, options, error))
        return EXIT_SCENE;
    if (!command_files_check(options, scene, error))
        return EXIT_OUTPUT;
    if (!check_measure(check, error))
        return EXIT_SCENE;
    print_notes(options, scene);
    if (!find_leaks(check, session, options, error))
        return EXIT_DEVICE;
    check->seconds = clock_seconds() - start;
    return report(check, options, error);
}

ExitCode check_scene(const Options *options, Session *session, Scene *scene, Error *error)
{
    Check check = {.scene_path = options->scene_path, .scene = scene};
    const ExitCode outcome = perform(&check, options, session, scene, error);
    check_free(&check);
    return outcome;
}

bool check_geometry(const Options *options, const Scene *scene, Error *error)
{
    Error note = {0};
    if (options->bad_geometry == BAD_GEOMETRY_FAIL)
        return features_check_areas(scene, error);
    print_notes(options, scene);
    if (!features_check_dropped(scene, &note))
        stage_note(options, "%s", note.text);
    return true;
}
