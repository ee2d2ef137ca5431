// SPDX-License-Identifier: MIT
// Writes a scene as scene text. Scene text sets properties by statements that apply to all
// following objects. The writer keeps the current value of each property, and writes a statement
// only before an object with another value.
#include "scene/scn_write.h"

#include "base/array.h"
#include "base/limits.h"
#include "base/number.h"
#include "scene/material_text.h"

#include <stdlib.h>
#include <string.h>

// The following functions join meshes with one allocation per array.

static bool allocate(Mesh *mesh, const Scene *scene, Error *error)
{
    bool has_normals = false, has_colors = false;
    for (size_t i = 0; i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        mesh->vertex_count += object->mesh.vertex_count;
        mesh->triangle_count += object->mesh.triangle_count;
        has_normals |= object->mesh.normals != NULL;
        has_colors |= object->mesh.colors != NULL;
    }
    if (mesh->vertex_count > (size_t)MESH_COUNT_MOST ||
        mesh->triangle_count > (size_t)MESH_COUNT_MOST)
        return error_set(error, "its %zu vertices or %zu triangles are too many for one mesh",
                         mesh->vertex_count, mesh->triangle_count);
    mesh->triangles = memory_raw(mesh->triangle_count, sizeof *mesh->triangles, error);
    return mesh->triangles != NULL && mesh_allocate_vertices(mesh, has_normals, has_colors, error);
}

// Copies an object's vertices and triangles into *mesh, from the indices `vertex` and `triangle`
// on.
static void copy(Mesh *mesh, const MeshObject *object, const float diffuse[3], size_t vertex,
                 size_t triangle)
{
    static const float no_normal[3] = {0, 0, 0};
    const Mesh *part = &object->mesh;
    for (size_t i = 0; i < part->vertex_count; i++) {
        memcpy(mesh->positions[vertex + i], part->positions[i], sizeof *part->positions);
        if (mesh->normals != NULL)
            memcpy(mesh->normals[vertex + i], part->normals != NULL ? part->normals[i] : no_normal,
                   sizeof no_normal);
        if (mesh->colors != NULL)
            memcpy(mesh->colors[vertex + i], part->colors != NULL ? part->colors[i] : diffuse,
                   3 * sizeof *diffuse);
    }
    for (size_t i = 0; i < part->triangle_count; i++)
        for (int corner = 0; corner < 3; corner++)
            mesh->triangles[triangle + i][corner] = (uint32_t)vertex + part->triangles[i][corner];
}

bool scn_write_join(Mesh *mesh, const Scene *scene, Error *error)
{
    size_t vertex = 0, triangle = 0;
    *mesh = (Mesh){0};
    if (!allocate(mesh, scene, error)) {
        mesh_free(mesh);
        return false;
    }
    for (size_t i = 0; i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        copy(mesh, object, scene->materials.data[object->material].diffuse, vertex, triangle);
        vertex += object->mesh.vertex_count;
        triangle += object->mesh.triangle_count;
    }
    return true;
}

typedef struct {
    const Scene *scene;
    FILE *stream;
    MaterialNames names; // of the materials in the written text, except the four of the course
    MeshObject current;  // the properties that statements have set so far
    bool is_own;         // the files' colors replace the diffuse color of current.material
} Writer;

// Writes `value` with `digits` digits, or with more if this is necessary to read back the same
// value.
static void write_digits(FILE *stream, double value, int digits, bool is_float)
{
    char text[32];
    for (const int most = is_float ? 9 : 17; digits <= most; digits++) {
        double again = 0;
        const int length = snprintf(text, sizeof text, "%.*g", digits, value);
        if (number_parse(text, text + length, &again) != NULL &&
            (is_float ? (double)(float)again == value : again == value))
            break;
    }
    fprintf(stream, " %s", text);
}

static void write_number(FILE *stream, double value)
{
    write_digits(stream, value, 15, false);
}

static void write_float(FILE *stream, float value)
{
    write_digits(stream, (double)value, 6, true);
}

static void write_vector(FILE *stream, Vec3 v)
{
    write_number(stream, v.x);
    write_number(stream, v.y);
    write_number(stream, v.z);
}

static void write_picture(const Writer *writer)
{
    const Scene *scene = writer->scene;
    fprintf(writer->stream, "size %u %u\nbackground", scene->width, scene->height);
    write_vector(writer->stream, scene->background);
    fputs("\nambient", writer->stream);
    write_number(writer->stream, scene->ambient);
    fprintf(writer->stream, "\nmax_level %u\n", scene->max_level);
}

static bool is_same(Vec3 a, Vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

void scn_write_camera(const Viewpoint *camera, Vec3 up, FILE *stream)
{
    if (!is_same(up, camera->up)) {
        fputs("up", stream);
        write_vector(stream, camera->up);
        fputc('\n', stream);
    }
    fputs("camera", stream);
    write_vector(stream, camera->eye);
    write_vector(stream, camera->look_at);
    const bool orthographic = camera->height > 0;
    const double width = orthographic ? camera->width : camera->width_degrees;
    if (orthographic)
        fputs(" orthographic", stream);
    write_number(stream, orthographic ? camera->height : camera->fov_degrees);
    if (width > 0)
        write_number(stream, width);
    fputc('\n', stream);
}

static void write_cameras(const Writer *writer)
{
    const Scene *scene = writer->scene;
    Vec3 up = {0, 0, 1};
    for (size_t i = 0; !scene->has_course_views && i < scene->viewpoints.count; i++) {
        scn_write_camera(&scene->viewpoints.data[i], up, writer->stream);
        up = scene->viewpoints.data[i].up;
    }
}

bool scn_write_can_name(const char *name)
{
    for (const char *c = name; *c != '\0'; c++)
        if (*c == '"' || *c == '\n' || *c == '\r')
            return false;
    return name[0] != '\0';
}

static bool is_taken(const Writer *writer, const char *name)
{
    return material_names_find(&writer->names, name, strlen(name)) != NULL;
}

static bool is_definable(const char *name)
{
    double number;
    return scn_write_can_name(name) && strcmp(name, "own") != 0 &&
           number_parse(name, name + strlen(name), &number) == NULL;
}

// A material keeps its name if scene text can define the name and no earlier material has the name.
// Otherwise, the new name is material_INDEX, followed by underscores if that name is taken.
static bool choose_name(Writer *writer, uint32_t material, const char *given, Error *error)
{
    MaterialName name = {.material = material};
    if (given != NULL)
        strcpy(name.name, given);
    if (!is_definable(name.name) || is_taken(writer, name.name)) {
        snprintf(name.name, sizeof name.name, "material_%u", material);
        for (size_t length = strlen(name.name);
             is_taken(writer, name.name) && length + 1 < sizeof name.name; length++)
            strcpy(name.name + length, "_");
    }
    return material_names_add(&writer->names, &name, error);
}

static bool choose_names(Writer *writer, Error *error)
{
    const Scene *scene = writer->scene;
    const char **given = memory_zeroed(scene->materials.count, sizeof *given, error);
    bool ok = given != NULL;
    for (size_t i = 0; ok && i < scene->material_names.list.count; i++)
        given[scene->material_names.list.data[i]->material] =
            scene->material_names.list.data[i]->name;
    for (uint32_t i = COURSE_MATERIALS; ok && i < scene->materials.count; i++)
        ok = choose_name(writer, i, given[i], error);
    free(given);
    return ok;
}

static const char *name_of(const Writer *writer, size_t material)
{
    return writer->names.list.data[material - COURSE_MATERIALS]->name;
}

// Omits the properties that the material's shader ignores, and a checker of size 0.
static void write_material(FILE *stream, const Material *material)
{
    fputs(shader_names[material->shader], stream);
    for (size_t i = 0; i < MATERIAL_PROPERTIES; i++) {
        const MaterialProperty *property = &material_properties[i];
        const float *values = (const void *)((const char *)material + property->offset);
        const bool is_idle =
            property->use == USED_BY_BLINN_PHONG && material->shader != SHADER_BLINN_PHONG;
        if (is_idle || !material_accepts(material, property) ||
            (values == &material->check_size && material->check_size == 0))
            continue;
        fprintf(stream, " %s", property->name);
        for (int place = 0; place < property->count; place++)
            write_float(stream, values[place]);
    }
}

static void write_defines(const Writer *writer)
{
    for (size_t i = COURSE_MATERIALS; i < writer->scene->materials.count; i++) {
        fprintf(writer->stream, "define \"%s\" ", name_of(writer, i));
        write_material(writer->stream, &writer->scene->materials.data[i]);
        fputc('\n', writer->stream);
    }
}

static void write_light(FILE *stream, const Light *light, const LightArea *area)
{
    fputs(light->is_sun ? "sun" : "light", stream);
    write_vector(stream, light->position);
    write_number(stream, light->intensity);
    if (light->color.x < 1 || light->color.y < 1 || light->color.z < 1)
        write_vector(stream, light->color);
    if (area != NULL) {
        fputs(" area", stream);
        write_vector(stream, area->sides[0]);
        write_vector(stream, area->sides[1]);
        fprintf(stream, " %u", area->cells);
    }
    fputc('\n', stream);
}

static void write_lights(const Writer *writer)
{
    const Scene *scene = writer->scene;
    size_t point = 0;
    for (size_t i = 0; i < scene->area_lights.count; i++) {
        const AreaLight *next = &scene->area_lights.data[i];
        for (; point < next->first; point++)
            write_light(writer->stream, &scene->lights.data[point], NULL);
        write_light(writer->stream, &next->light, &next->area);
        point += (size_t)next->area.cells * next->area.cells;
    }
    for (; point < scene->lights.count; point++)
        write_light(writer->stream, &scene->lights.data[point], NULL);
}

static void select_material(Writer *writer, uint32_t material, bool is_own)
{
    const char *own = is_own ? "own " : "";
    if (material == writer->current.material && is_own == writer->is_own)
        return;
    writer->current.material = material;
    writer->is_own = is_own;
    if (material < COURSE_MATERIALS)
        fprintf(writer->stream, "material %s%u\n", own, material);
    else
        fprintf(writer->stream, "material %s\"%s\"\n", own, name_of(writer, material));
}

static void write_spheres(Writer *writer)
{
    for (size_t i = 0; i < writer->scene->spheres.count; i++) {
        const Sphere *sphere = &writer->scene->spheres.data[i];
        select_material(writer, sphere->material, false);
        fputs("sphere", writer->stream);
        write_vector(writer->stream, sphere->center);
        write_number(writer->stream, sphere->radius);
        fputc('\n', writer->stream);
    }
}

static void write_objects(Writer *writer, char *const *mesh_names)
{
    for (size_t i = 0; i < writer->scene->objects.count; i++) {
        const MeshObject *object = &writer->scene->objects.data[i];
        select_material(writer, object->material, object->mesh.colors != NULL);
        if (object->two_sided != writer->current.two_sided)
            fprintf(writer->stream, "sides %s\n", object->two_sided ? "two" : "one");
        writer->current.two_sided = object->two_sided;
        fprintf(writer->stream, "mesh \"%s\"\n", mesh_names[i]);
    }
}

bool scn_write(const Scene *scene, char *const *mesh_names, FILE *stream, Error *error)
{
    Writer writer = {.scene = scene, .stream = stream, .current = {.material = UINT32_MAX}};
    const bool ok = choose_names(&writer, error);
    if (ok) {
        write_picture(&writer);
        write_cameras(&writer);
        write_lights(&writer);
        write_defines(&writer);
        write_spheres(&writer);
        write_objects(&writer, mesh_names);
    }
    material_names_free(&writer.names);
    return ok && ferror(stream) == 0;
}
