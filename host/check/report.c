// SPDX-License-Identifier: MIT
// The text lists each mesh with its findings. JSON contains every count, including zeros.
#include "check/findings.h"

#include "image/json_file.h"

#include <math.h>

#define SCHEMA_VERSION 1

static const char *mesh_path(const Check *check, size_t object)
{
    const Scene *scene = &check->scene;
    return scene->inputs.data[scene->objects.data[object].input];
}

// Writes the findings from index *next on that are about this object, and advances *next.
static void write_findings(const Check *check, size_t object, size_t *next, FILE *stream)
{
    for (; *next < check->findings.count; ++*next) {
        const Finding *finding = &check->findings.data[*next];
        if (finding->object != object)
            return;
        fprintf(stream, "  %s: %s\n", finding->fails ? "FAULT" : "note", finding->text);
    }
}

static void write_leaks(const Check *check, size_t object, FILE *stream)
{
    const LeakCount *leaks = &check->leaks[object];
    fprintf(stream, "  %zu rays at %zu of its %zu edges and points", leaks->rays, leaks->aimed,
            leaks->total);
    if (leaks->total > LEAKS_AIMS)
        fprintf(stream, " (at most %d are aimed at)", LEAKS_AIMS);
    const bool is_closed = check->census.meshes[object].closedness.is_closed;
    fprintf(stream, ": %zu hidden by other parts, %zu pass through%s\n", leaks->hidden,
            leaks->leaks.count,
            leaks->leaks.count > 0 && !is_closed ? ", because it is not closed" : "");
}

static void write_mesh(const Check *check, size_t object, size_t *next, FILE *stream)
{
    const Mesh *mesh = &check->scene.objects.data[object].mesh;
    const MeshCensus *census = &check->census.meshes[object];
    const Features *features = &census->features;
    const Closedness *closedness = &census->closedness;
    fprintf(stream, "%s: %zu triangles, %zu vertices, %s\n", mesh_path(check, object),
            mesh->triangle_count, mesh->vertex_count,
            closedness->is_closed ? "closed" : "not closed");
    if (mesh->triangle_count > 0)
        fprintf(stream, "  shortest edge %.3g, lowest height %.3g: %.3g and %.3g steps of float\n",
                features->edge.size, features->height.size, features->edge.steps,
                features->height.steps);
    if (mesh->triangle_count > 0 && check->leaks != NULL)
        write_leaks(check, object, stream);
    write_findings(check, object, next, stream);
}

void check_report_write_text(const Check *check, FILE *stream)
{
    const Scene *scene = &check->scene;
    size_t next = 0; // findings are in the order of the objects
    for (size_t object = 0; object < scene->objects.count; object++)
        write_mesh(check, object, &next, stream);
    fprintf(stream, "%s: %zu meshes, %zu triangles, %zu spheres, %zu lights\n", check->scene_path,
            scene->objects.count, scene_triangle_count(scene), scene->spheres.count,
            scene->lights.count);
    write_findings(check, FINDING_SCENE, &next, stream);
    if (check->leaks != NULL)
        fprintf(stream, "  rays were traced on %s\n", check->device);
    else if (check->device_fault.text[0] != '\0')
        fprintf(stream, "  leaks were not tested: %s\n", check->device_fault.text);
    const size_t failing = check_count_failing(check), all = check->findings.count;
    if (all == 0)
        fputs("fine\n", stream);
    else if (failing == 0)
        fprintf(stream, "no faults, %zu note%s\n", all, all == 1 ? "" : "s");
    else
        fprintf(stream, "%zu of %zu findings are faults\n", failing, all);
}

static json_t *fault_json(MeshFault fault)
{
    return json_pack("{s:o, s:o}", "count", json_count(fault.count), "first",
                     fault.count > 0 ? json_count(fault.first) : json_null());
}

static json_t *feature_json(const Feature *feature)
{
    const bool found = isfinite(feature->steps);
    return json_pack("{s:o, s:o, s:o}", "size", found ? json_finite(feature->size) : json_null(),
                     "steps", json_finite(feature->steps), "triangle",
                     found ? json_count(feature->triangle) : json_null());
}

static json_t *leaks_json(const Check *check, size_t object)
{
    if (check->leaks == NULL)
        return json_null();
    const LeakCount *leaks = &check->leaks[object];
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "leaks", fault_json(leaks->leaks), "rays",
                     json_count(leaks->rays), "aims", json_count(leaks->total), "aimed_at",
                     json_count(leaks->aimed), "hidden", json_count(leaks->hidden), "cap",
                     json_count(LEAKS_AIMS));
}

// Omits leaks, which "leak_test" contains.
static json_t *faults_json(const Check *check, size_t object)
{
    MeshFault counts[FAULT_KINDS];
    json_t *all = json_object();
    check_count_faults(check, object, counts);
    for (FaultKind kind = 0; kind < FAULT_KINDS; kind++)
        if (kind != FAULT_LEAKS)
            json_object_set_new(all, fault_name(kind), fault_json(counts[kind]));
    return all;
}

static json_t *mesh_json(const Check *check, size_t object)
{
    const Mesh *mesh = &check->scene.objects.data[object].mesh;
    const MeshCensus *census = &check->census.meshes[object];
    const Features *features = &census->features;
    return json_pack("{s:o, s:o, s:o, s:o, s:b, s:b, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:b}",
                     "path", json_file_path(mesh_path(check, object)), "triangles",
                     json_count(mesh->triangle_count), "vertices", json_count(mesh->vertex_count),
                     "edges", json_count(census->closedness.edge_count), "closed",
                     census->closedness.is_closed, "inside_out", census->closedness.is_inside_out,
                     "unused_vertices", json_count(census->unused_vertices), "repeated_vertices",
                     json_count(census->repeated_vertices), "faults", faults_json(check, object),
                     "shortest_edge", feature_json(&features->edge), "lowest_height",
                     feature_json(&features->height), "shortest_written_edge",
                     feature_json(&features->written_edge), "leak_test", leaks_json(check, object),
                     "holds_floats", features->holds_floats);
}

static json_t *meshes_json(const Check *check)
{
    json_t *list = json_array();
    for (size_t object = 0; object < check->scene.objects.count; object++)
        json_array_append_new(list, mesh_json(check, object));
    return list;
}

static json_t *findings_json(const Check *check)
{
    json_t *list = json_array();
    for (size_t i = 0; i < check->findings.count; i++) {
        const Finding *finding = &check->findings.data[i];
        json_array_append_new(
            list,
            json_pack("{s:s, s:b, s:o, s:o, s:s}", "kind", finding->kind, "fails", finding->fails,
                      "mesh",
                      finding->object == FINDING_SCENE ? json_null() : json_count(finding->object),
                      "count", json_count(finding->count), "text", finding->text));
    }
    return list;
}

static json_t *scene_json(const Check *check)
{
    const Scene *scene = &check->scene;
    const Census *census = &check->census;
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "path",
                     json_file_path(check->scene_path), "lights", json_count(scene->lights.count),
                     "spheres", json_count(scene->spheres.count), "empty_meshes",
                     json_count(census->empty_meshes), "duplicate_meshes",
                     json_count(census->duplicate_meshes), "duplicate_spheres",
                     json_count(census->duplicate_spheres), "duplicate_lights",
                     json_count(census->duplicate_lights), "unused_materials",
                     json_count(census->unused_materials));
}

bool check_report_write_json(const Check *check, const char *path, Error *error)
{
    json_t *device = check->device != NULL ? json_file_path(check->device) : json_null();
    json_t *root =
        json_pack("{s:i, s:s, s:b, s:o, s:o, s:o, s:o, s:f}", "schema", SCHEMA_VERSION, "version",
                  CLRT_VERSION, "fine", check_count_failing(check) == 0, "device", device, "scene",
                  scene_json(check), "meshes", meshes_json(check), "findings", findings_json(check),
                  "seconds", check->seconds);
    return json_file_write(root, path, error);
}
