// SPDX-License-Identifier: MIT
// Turns counts and measurements into findings with texts. The check fails if the scene cannot be
// drawn, if it has only points, or if a fault can cause holes or wrong pixels. Such faults are
// values that are not finite, triangles without area, leaks of closed meshes, and duplicates of
// meshes, triangles or spheres. The scene's author may have intended all other findings, so they do
// not fail the check.
#include "check/findings.h"

#include "scene/camera.h"
#include "scene/scene.h"

#include <stdarg.h>
#include <stdio.h>

typedef struct {
    size_t count;  // views whose eye is inside a sphere or a closed mesh
    size_t view;   // the first such view; views are numbered from 1
    size_t sphere; // the sphere that contains the view's eye, numbered from 1; 0 for a mesh
    size_t object; // the mesh that contains the view's eye, if `sphere` is 0
} EnclosedEyes;

// A mesh contains a point if its triangles cover more than half of all directions from the point.
// Signed solid angles are summed (Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle",
// 1983).

#define TAU 6.283185307179586477

// A corner is out of view beyond this distance from the picture's center, in halves of the
// picture's side. The excess over 1 is larger than rounding errors.
#define MARGIN 1.001

// Returns half of a triangle's signed solid angle.
static double half_solid_angle(Vec3 a, Vec3 b, Vec3 c)
{
    return atan2(vec3_dot(a, vec3_cross(b, c)),
                 1 + vec3_dot(a, b) + vec3_dot(b, c) + vec3_dot(c, a));
}

static bool mesh_contains(const Mesh *mesh, Vec3 eye)
{
    double sum = 0;
    const BoundingBox box = mesh_bounds(mesh);
    const Vec3 low = box.low, high = box.high;
    if (eye.x < low.x || eye.y < low.y || eye.z < low.z || eye.x > high.x || eye.y > high.y ||
        eye.z > high.z)
        return false;
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
        Vec3 seen[3];
        for (int corner = 0; corner < 3; corner++)
            seen[corner] = vec3_normalize(vec3_sub(mesh_corner(mesh, triangle, corner), eye));
        sum += half_solid_angle(seen[0], seen[1], seen[2]);
    }
    return fabs(sum) > TAU / 2;
}

static bool sphere_contains(const Sphere *sphere, Vec3 eye)
{
    const Vec3 apart = vec3_scale(vec3_sub(eye, sphere->center), 1 / sphere->radius);
    return vec3_dot(apart, apart) < 1;
}

// Stores the first object that contains the eye. Returns false if no object contains the eye.
static bool find_container(EnclosedEyes *found, const Scene *scene, const Census *census, Vec3 eye)
{
    for (size_t i = 0; i < scene->spheres.count; i++) {
        found->sphere = i + 1;
        if (sphere_contains(&scene->spheres.data[i], eye))
            return true;
    }
    found->sphere = 0;
    for (size_t i = 0; i < scene->objects.count; i++) {
        found->object = i;
        if (census->meshes[i].facts.closed && mesh_contains(&scene->objects.data[i].mesh, eye))
            return true;
    }
    return false;
}

// Finds the views whose eye is inside an object. If the views are the six default views, only the
// first view is examined, because clrt draws the other views only on request.
static EnclosedEyes enclosed_eyes_find(const Scene *scene, const Census *census)
{
    EnclosedEyes first = {0};
    const size_t views = scene->has_course_views ? 1 : scene->viewpoints.count;
    for (size_t view = 0; view < views; view++) {
        EnclosedEyes found = {.count = first.count + 1, .view = view + 1};
        if (!find_container(&found, scene, census, scene->viewpoints.data[view].eye))
            continue;
        if (first.count == 0)
            first = found;
        first.count = found.count;
    }
    return first;
}

// Returns a point's coordinate along a side of the picture. The unit is half of the side's length
// at depth 1.
static double across(Vec3 point, const float half_step[3], uint32_t side)
{
    const Vec3 step = vec3_of_floats(half_step);
    return vec3_dot(point, step) / (vec3_dot(step, step) * side);
}

// Returns whether all corners of a box are behind the eye, or all are beyond the same edge of the
// picture.
static bool is_outside(const CameraData *camera, const Vec3 corners[8], const Scene *scene)
{
    bool all[5] = {true, true, true, true, true};
    for (int corner = 0; corner < 8; corner++) {
        const Vec3 point = vec3_sub(corners[corner], vec3_of_floats(camera->eye));
        const double depth = vec3_dot(point, vec3_of_floats(camera->forward));
        const double x = across(point, camera->right_step, scene->width);
        const double y = across(point, camera->down_step, scene->height);
        const double edge = MARGIN * camera_reduction(camera, depth);
        const bool outside[5] = {depth<0, x> edge, -x > edge, y > edge, -y > edge};
        for (int plane = 0; plane < 5; plane++)
            all[plane] = all[plane] && outside[plane];
    }
    return all[0] || all[1] || all[2] || all[3] || all[4];
}

// Returns whether the bounding box of an object with triangles is outside every view.
static bool is_out_of_view(const Scene *scene, const Normalization *normalization, size_t object)
{
    Vec3 corners[8];
    const Mesh *mesh = &scene->objects.data[object].mesh;
    const BoundingBox box = mesh_bounds(mesh);
    const Vec3 low = box.low, high = box.high;
    for (int i = 0; i < 8; i++)
        corners[i] =
            normalize_point(normalization, vec3(i & 1 ? low.x : high.x, i & 2 ? low.y : high.y,
                                                i & 4 ? low.z : high.z));
    bool is_out = mesh->triangle_count > 0;
    for (size_t view = 0; is_out && view < scene->viewpoints.count; view++) {
        const CameraData camera = camera_make(&scene->viewpoints.data[view], normalization,
                                              scene->width, scene->height, 1);
        is_out = is_outside(&camera, corners, scene);
    }
    return is_out;
}

// Rounding can change the length of an edge by half a step at each end. If an edge has fewer steps
// than this, the change is visible.
#define FEW_STEPS 16.0

// Advice on short edges blames the mesh's offset, or the scene's size, only if the offset or the
// scene's size is more than MUCH times the mesh's size.
#define MUCH 4.0

typedef struct {
    const char *kind;
    const char *one, *many; // words for one and for several, to be followed by `rest`
    const char *rest;
    bool fails;
    const char *place; // printed before the index of the first vertex or triangle
} Counted;

static const Counted faults[FAULT_KINDS] = {
    [FAULT_BAD_POSITIONS] = {"not_finite_positions", "vertex", "vertices",
                             "with a coordinate that is not finite or past 1e30", true, "vertex"},
    [FAULT_BAD_NORMALS] = {"not_finite_normals", "normal that is", "normals that are", "not finite",
                           true, "vertex"},
    [FAULT_LOST_CORNERS] = {"lost_triangles", "triangle", "triangles",
                            "with such a vertex, left out", true, "triangle"},
    [FAULT_EQUAL_CORNERS] = {"equal_corners", "triangle", "triangles",
                             "with two equal corners, left out", true, "triangle"},
    [FAULT_FLAT] = {"zero_area", "triangle", "triangles", "without area (corners on a line)", true,
                    "triangle"},
    [FAULT_DUPLICATES] = {"duplicate_triangles", "triangle", "triangles",
                          "with the corners of another", true, "triangle"},
    [FAULT_LEAKS] = {"leaks", "ray that passes", "rays that pass", "between adjacent triangles",
                     true, "at triangle"},
    [FAULT_OPEN] = {"open_edges", "edge", "edges", "of a single triangle", false, "at triangle"},
    [FAULT_CROWDED] = {"crowded_edges", "edge", "edges", "of more than two triangles", false,
                       "at triangle"},
    [FAULT_TURNED] = {"turned_edges", "edge", "edges", "whose triangles face opposite sides", false,
                      "at triangle"},
    [FAULT_PINCHED] = {"pinched_points", "point", "points", "where parts touch that share no edge",
                       false, "at triangle"},
};

// Adds a finding unless its count is 0.
__attribute__((format(printf, 4, 5))) static void add(Check *check, const char *kind,
                                                      ClrtFinding finding, const char *format, ...)
{
    Error error = {0};
    if (finding.count == 0)
        return;
    snprintf(finding.kind, sizeof finding.kind, "%s", kind);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(finding.text, sizeof finding.text, format, arguments);
    va_end(arguments);
    text_hide_controls(finding.text);
    check->is_cut |= !array_push(&check->findings, finding, &error);
}

static ClrtFinding note(size_t object, size_t count)
{
    return (ClrtFinding){.mesh = (uint32_t)object, .count = count};
}

const char *fault_name(FaultKind kind)
{
    return faults[kind].kind;
}

static void add_mesh_faults(Check *check, size_t object)
{
    for (FaultKind kind = 0; kind < FAULT_KINDS; kind++) {
        const Counted *fault = &faults[kind];
        const MeshFault *found = &check->census.meshes[object].faults[kind];
        const bool is_untested = kind == FAULT_LEAKS && check->device == NULL;
        const ClrtFinding finding = {.fails = fault->fails,
                                     .mesh = (uint32_t)object,
                                     .count = is_untested ? 0 : found->count,
                                     .first = found->first};
        add(check, fault->kind, finding, "%zu %s %s%s %s %zu", found->count,
            found->count == 1 ? fault->one : fault->many, fault->rest,
            found->count == 1 ? ":" : ", the first", fault->place, found->first);
    }
}

static void add_shape(Check *check, size_t object)
{
    const MeshObject *mesh = &check->scene->objects.data[object];
    const MeshCensus *census = &check->census.meshes[object];
    const bool is_glass = check->scene->materials.data[mesh->material].shader == SHADER_GLASS;
    const bool is_open = mesh->mesh.triangle_count > 0 && !census->facts.closed;
    add(check, "empty_mesh", note(object, mesh->mesh.triangle_count == 0),
        "the mesh has no triangles");
    const bool is_inside_out = census->facts.inside_out;
    add(check, "inside_out", note(object, is_inside_out && !is_glass && !mesh->two_sided),
        "its fronts face inwards, so only its far side is visible from outside");
    add(check, "inside_out", note(object, is_inside_out && is_glass),
        "its fronts face inwards, so the space around it counts as its glass");
    add(check, "open_glass", note(object, is_glass && is_open),
        "it is glass but not closed, so light that enters it may never leave it");
    const size_t unused = census->facts.unused_vertices;
    add(check, "unused_vertices", note(object, unused), "%zu %s that no triangle uses", unused,
        unused == 1 ? "vertex" : "vertices");
    const bool is_placed = check->scale_fault.text[0] == '\0';
    add(check, "out_of_view",
        note(object, is_placed && is_out_of_view(check->scene, &check->normalization, object)),
        "it is outside every camera's view, so only reflections and shadows can show it");
}

// Adds at most one finding that advises on an object. Advice to recenter the file takes precedence,
// because tracing cannot restore details that the file has lost.
static void add_advice(Check *check, size_t object, double scene_size)
{
    const Features *features = &check->census.meshes[object].features;
    const double ratio = features->extent > 0 ? scene_size / features->extent : 0;
    if (features->holds_floats && features->written_edge.steps < FEW_STEPS &&
        features->offset > MUCH * features->extent)
        add(check, "advice_recenter", note(object, 1),
            "recenter it before writing the file: its coordinates are floats, and at %.3g from the "
            "origin its shortest edge is only %.3g steps of float",
            features->offset, features->written_edge.steps);
    else if (features->edge.steps < FEW_STEPS && ratio > MUCH)
        add(check, "advice_scale", note(object, 1),
            "the scale is too mixed: the scene is %.3g times as large as this mesh, whose "
            "shortest edge is only %.3g steps of float; render them separately",
            ratio, features->edge.steps);
    else if (features->edge.steps < FEW_STEPS)
        add(check, "advice_thin", note(object, 1),
            "its shortest edge, at triangle %zu, is only %.3g steps of float: merge vertices "
            "this close",
            features->edge.triangle, features->edge.steps);
    else if (features->height.steps < 1)
        add(check, "advice_thin", note(object, 1),
            "the height of triangle %zu is %.3g steps of float: rounding can make it a line",
            features->height.triangle, features->height.steps);
}

const char *check_mesh_path(const Check *check, size_t object)
{
    const Scene *scene = check->scene;
    const size_t input =
        object < scene->objects.count ? scene->objects.data[object].input : NO_INPUT;
    return input < scene->inputs.count ? scene->inputs.data[input] : NULL;
}

static void add_enclosed_eyes(Check *check)
{
    const Scene *scene = check->scene;
    const EnclosedEyes eyes = enclosed_eyes_find(scene, &check->census);
    const char *path = check_mesh_path(check, eyes.object);
    const ClrtFinding finding = note(NOTHING, eyes.count);
    char container[sizeof finding.text] = "a mesh";
    if (eyes.sphere > 0)
        snprintf(container, sizeof container, "sphere %zu", eyes.sphere);
    else if (path != NULL)
        snprintf(container, sizeof container, "%s", path);
    add(check, "eye_inside", finding, "%zu camera%s inside an object%s view %zu in %s", eyes.count,
        eyes.count == 1 ? " is" : "s are", eyes.count == 1 ? ":" : ", the first is", eyes.view,
        container);
}

static void add_scene(Check *check)
{
    const Census *census = &check->census;
    static const Counted parts[] = {
        {"duplicate_meshes", "mesh", "meshes", "with the triangles of another", true, NULL},
        {"duplicate_spheres", "sphere that is", "spheres that are", "the same as another", true,
         NULL},
        {"duplicate_lights", "light", "lights", "at the place of another", false, NULL},
        {"unused_materials", "material that is", "materials that are", "defined and not used",
         false, NULL},
    };
    const size_t counts[] = {census->duplicate_meshes, census->duplicate_spheres,
                             census->duplicate_lights, census->unused_materials};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        const ClrtFinding finding = {.fails = parts[i].fails, .mesh = NOTHING, .count = counts[i]};
        add(check, parts[i].kind, finding, "%zu %s %s", counts[i],
            counts[i] == 1 ? parts[i].one : parts[i].many, parts[i].rest);
    }
    add_enclosed_eyes(check);
    const MissingPart missing = scene_missing(check->scene);
    const ClrtFinding lack = {.fails = missing.is_fault, .mesh = NOTHING, .count = 1};
    if (missing.kind != NULL)
        add(check, missing.kind, lack, "%s", missing.text);
    Error coarse = {0};
    const bool is_fine = normalization_is_fine(&check->normalization, check->scene, &coarse);
    add(check, "coarse", note(NOTHING, !is_fine), "%s", coarse.text);
    const ClrtFinding fault = {
        .fails = true, .mesh = NOTHING, .count = check->scale_fault.text[0] != '\0'};
    add(check, "scale", fault, "the scene cannot be drawn: %s", check->scale_fault.text);
}

bool check_find(Check *check, Error *error)
{
    const double scene_size = normalization_extent(check->scene);
    for (size_t object = 0; object < check->scene->objects.count; object++) {
        add_mesh_faults(check, object);
        add_shape(check, object);
        add_advice(check, object, scene_size);
    }
    add_scene(check);
    return !check->is_cut || error_set(error, "out of memory for the findings");
}

size_t check_count_failing(const Check *check)
{
    size_t count = 0;
    for (size_t i = 0; i < check->findings.count; i++)
        count += check->findings.data[i].fails;
    return count;
}
