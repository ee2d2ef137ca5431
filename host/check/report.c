// SPDX-License-Identifier: MIT
// The text lists each mesh with its findings. JSON contains every count, including zeros.
#include "check/report.h"

#include "image/json_file.h"

#include <math.h>

#define SCHEMA_VERSION 1

static const char *mesh_path(const CheckReport *report, size_t object)
{
    const Scene *scene = report->result->scene;
    return scene->inputs.data[scene->objects.data[object].input];
}

static void write_findings(const CheckReport *report, size_t object, FILE *stream)
{
    const Findings *findings = report->findings;
    for (size_t i = 0; i < findings->list.count; i++) {
        const Finding *finding = &findings->list.data[i];
        if (finding->object == object)
            fprintf(stream, "  %s: %s\n", finding->fails ? "FAULT" : "note", finding->text);
    }
}

static void write_leaks(const CheckReport *report, size_t object, FILE *stream)
{
    const LeakCount *leaks = &report->result->leaks[object];
    fprintf(stream, "  %zu rays at %zu of its %zu edges and points", leaks->rays, leaks->aimed,
            leaks->total);
    if (leaks->total > LEAKS_AIMS)
        fprintf(stream, " (at most %d are aimed at)", LEAKS_AIMS);
    fprintf(stream, ": %zu hidden by other parts, %zu pass through\n", leaks->hidden,
            leaks->leaks.count);
}

static void write_mesh(const CheckReport *report, size_t object, FILE *stream)
{
    const Mesh *mesh = &report->result->scene->objects.data[object].mesh;
    const MeshCensus *census = &report->result->census->meshes[object];
    const Features *features = &census->features;
    const Closedness *closedness = &census->closedness;
    fprintf(stream, "%s: %zu triangles, %zu vertices, %s\n", mesh_path(report, object),
            mesh->triangle_count, mesh->vertex_count,
            closedness->is_closed ? "closed" : "not closed");
    if (mesh->triangle_count > 0)
        fprintf(stream, "  shortest edge %.3g, lowest height %.3g: %.3g and %.3g steps of float\n",
                features->edge.size, features->height.size, features->edge.steps,
                features->height.steps);
    if (mesh->triangle_count > 0 && report->result->leaks != NULL)
        write_leaks(report, object, stream);
    write_findings(report, object, stream);
}

void check_report_write_text(const CheckReport *report, FILE *stream)
{
    const CheckResult *result = report->result;
    const Scene *scene = result->scene;
    for (size_t object = 0; object < scene->objects.count; object++)
        write_mesh(report, object, stream);
    fprintf(stream, "%s: %zu meshes, %zu triangles, %zu spheres, %zu lights\n", report->scene_path,
            scene->objects.count, scene_triangle_count(scene), scene->spheres.count,
            scene->lights.count);
    write_findings(report, FINDING_SCENE, stream);
    if (result->device_name != NULL)
        fprintf(stream, "  rays were traced on %s\n", result->device_name);
    else if (result->device_fault[0] != '\0')
        fprintf(stream, "  leaks were not looked for: %s\n", result->device_fault);
    const size_t failing = findings_count_failing(report->findings);
    if (failing == 0)
        fputs("fine\n", stream);
    else
        fprintf(stream, "%zu of %zu findings are faults\n", failing, report->findings->list.count);
}

static json_t *integer(uint64_t value)
{
    return json_integer((json_int_t)value);
}

// Returns null if `value` is not finite, because JSON has no infinity.
static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *fault_json(MeshFault fault)
{
    return json_pack("{s:o, s:o}", "count", integer(fault.count), "first",
                     fault.count > 0 ? integer(fault.first) : json_null());
}

static json_t *feature_json(const Feature *feature)
{
    const bool found = isfinite(feature->steps);
    return json_pack("{s:o, s:o, s:o}", "size", found ? number(feature->size) : json_null(),
                     "steps", number(feature->steps), "triangle",
                     found ? integer(feature->triangle) : json_null());
}

static json_t *leaks_json(const CheckReport *report, size_t object)
{
    if (report->result->leaks == NULL)
        return json_null();
    const LeakCount *leaks = &report->result->leaks[object];
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "leaks", fault_json(leaks->leaks), "rays",
                     integer(leaks->rays), "aims", integer(leaks->total), "aimed_at",
                     integer(leaks->aimed), "hidden", integer(leaks->hidden), "cap",
                     integer(LEAKS_AIMS));
}

static json_t *faults_json(const Mesh *mesh, const MeshCensus *census)
{
    const Closedness *closedness = &census->closedness;
    return json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "not_finite_positions",
        fault_json(mesh->bad_positions), "not_finite_normals", fault_json(mesh->bad_normals),
        "lost_triangles", fault_json(mesh->lost_corners), "equal_corners",
        fault_json(mesh->equal_corners), "zero_area", fault_json(census->features.flat),
        "duplicate_triangles", fault_json(closedness->duplicates), "open_edges",
        fault_json(closedness->open), "crowded_edges", fault_json(closedness->crowded),
        "turned_edges", fault_json(closedness->turned), "pinched_points",
        fault_json(closedness->pinched));
}

static json_t *mesh_json(const CheckReport *report, size_t object)
{
    const Mesh *mesh = &report->result->scene->objects.data[object].mesh;
    const MeshCensus *census = &report->result->census->meshes[object];
    const Features *features = &census->features;
    return json_pack(
        "{s:o, s:o, s:o, s:o, s:b, s:b, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:b}", "path",
        json_file_path(mesh_path(report, object)), "triangles", integer(mesh->triangle_count),
        "vertices", integer(mesh->vertex_count), "edges", integer(census->closedness.edge_count),
        "closed", census->closedness.is_closed, "inside_out", census->closedness.is_inside_out,
        "unused_vertices", integer(census->unused_vertices), "repeated_vertices",
        integer(census->repeated_vertices), "faults", faults_json(mesh, census), "shortest_edge",
        feature_json(&features->edge), "lowest_height", feature_json(&features->height),
        "shortest_written_edge", feature_json(&features->written_edge), "leak_test",
        leaks_json(report, object), "holds_floats", features->holds_floats);
}

static json_t *meshes_json(const CheckReport *report)
{
    json_t *list = json_array();
    for (size_t object = 0; object < report->result->scene->objects.count; object++)
        json_array_append_new(list, mesh_json(report, object));
    return list;
}

static json_t *findings_json(const CheckReport *report)
{
    json_t *list = json_array();
    for (size_t i = 0; i < report->findings->list.count; i++) {
        const Finding *finding = &report->findings->list.data[i];
        json_array_append_new(
            list,
            json_pack("{s:s, s:b, s:o, s:o, s:s}", "kind", finding->kind, "fails", finding->fails,
                      "mesh",
                      finding->object == FINDING_SCENE ? json_null() : integer(finding->object),
                      "count", integer(finding->count), "text", finding->text));
    }
    return list;
}

static json_t *scene_json(const CheckReport *report)
{
    const Scene *scene = report->result->scene;
    const Census *census = report->result->census;
    return json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "path", json_file_path(report->scene_path),
        "lights", integer(scene->lights.count), "spheres", integer(scene->spheres.count),
        "empty_meshes", integer(census->empty_meshes), "duplicate_meshes",
        integer(census->duplicate_meshes), "duplicate_spheres", integer(census->duplicate_spheres),
        "duplicate_lights", integer(census->duplicate_lights), "unused_materials",
        integer(census->unused_materials));
}

bool check_report_write_json(const CheckReport *report, const char *path, Error *error)
{
    const CheckResult *result = report->result;
    json_t *device =
        result->device_name != NULL ? json_file_path(result->device_name) : json_null();
    json_t *root =
        json_pack("{s:i, s:s, s:b, s:o, s:o, s:o, s:o, s:f}", "schema", SCHEMA_VERSION, "version",
                  CLRT_VERSION, "fine", findings_count_failing(report->findings) == 0, "device",
                  device, "scene", scene_json(report), "meshes", meshes_json(report), "findings",
                  findings_json(report), "seconds", result->seconds);
    return json_file_write(root, path, error);
}
