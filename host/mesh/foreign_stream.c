// SPDX-License-Identifier: MIT
// Reads the records one after another. For each kind of record, one function checks the data and
// adds them to the model. The parser stops at the first invalid record and frees the model.
#include "mesh/foreign_stream.h"

#include "base/limits.h"
#include "base/text.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define LONGEST_TEXT PATH_MAX // largest size of a message or a path, in bytes

// Assimp 5's file extensions. The list omits .ply, which clrt reads itself, .scn, which is clrt's
// own, and plain .xml, which identifies no format.
static const char *const endings[] = {
    "3d",      "3ds", "3mf",   "ac",   "ac3d",     "acc", "amf",    "ase",     "ask",
    "assbin",  "b3d", "blend", "bsp",  "bvh",      "cob", "csm",    "dae",     "dxf",
    "enff",    "fbx", "glb",   "gltf", "hmp",      "ifc", "ifczip", "iqm",     "irr",
    "irrmesh", "lwo", "lws",   "lxo",  "m3d",      "md2", "md3",    "md5anim", "md5camera",
    "md5mesh", "mdc", "mdl",   "mesh", "mesh.xml", "mot", "ms3d",   "ndo",     "nff",
    "obj",     "off", "ogex",  "pk3",  "pmx",      "prj", "q3o",    "q3s",     "raw",
    "sib",     "smd", "step",  "stl",  "stp",      "ter", "uc",     "vrm",     "vta",
    "x",       "x3d", "x3db",  "xgl",  "zae",      "zgl",
};

bool foreign_format_is(const char *path)
{
    const size_t length = strlen(path);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        const size_t ending = strlen(endings[i]);
        if (length > ending && path[length - ending - 1] == '.' &&
            strcasecmp(path + length - ending, endings[i]) == 0)
            return true;
    }
    return false;
}

typedef struct {
    ForeignModel *model;
    const char *next, *end;
    ForeignHead head; // head of the record whose data begins at `next`
    const char *name;
    char object[64]; // ", object NAME" if the next part has an invalid vertex and the name is known
    bool is_tolerant;
    Error *error;
} Parser;

static bool fail_damaged(const Parser *parser)
{
    return error_set(parser->error, "%s: the output of clrt-foreign, which reads it, is damaged",
                     parser->name);
}

// Returns a zero-terminated copy of a record's text, or NULL on failure.
static char *copy_text(const Parser *parser, const char *start, size_t size)
{
    if (size == 0 || size > LONGEST_TEXT || memchr(start, '\0', size) != NULL) {
        fail_damaged(parser);
        return NULL;
    }
    return text_format(parser->error, "%.*s", (int)size, start);
}

static bool take_file(Parser *parser)
{
    ForeignHash hash;
    if (parser->head.size < sizeof hash)
        return fail_damaged(parser);
    memcpy(&hash, parser->next, sizeof hash);
    char *path =
        copy_text(parser, parser->next + sizeof hash, (size_t)parser->head.size - sizeof hash);
    if (path == NULL || !array_push(&parser->model->files, path, parser->error)) {
        free(path);
        return false;
    }
    return array_push(&parser->model->hashes, hash, parser->error);
}

// Clamps `value` to [0, most], and replaces NaN by 0.
static float within(float value, float most)
{
    return !(value > 0) ? 0 : value > most ? most : value;
}

// Replaces unprintable characters, and characters that have a meaning in scene text, by '_'.
static void make_word(char *name)
{
    foreign_make_printable(name, strlen(name), '_');
    for (char *c = name; *c != '\0'; c++)
        if (strchr(" \"#/", *c) != NULL)
            *c = '_';
}

static bool take_material(Parser *parser)
{
    ForeignMaterial material;
    if (parser->head.size != sizeof material)
        return fail_damaged(parser);
    memcpy(&material, parser->next, sizeof material);
    material.name[sizeof material.name - 1] = '\0';
    make_word(material.name);
    for (int channel = 0; channel < 3; channel++) {
        material.diffuse[channel] = within(material.diffuse[channel], 1);
        material.specular[channel] = within(material.specular[channel], 1);
    }
    material.shininess = within(material.shininess, (float)SHININESS_MOST);
    return array_push(&parser->model->materials, material, parser->error);
}

static bool take_object(Parser *parser)
{
    char *name = copy_text(parser, parser->next, (size_t)parser->head.size);
    if (name == NULL)
        return false;
    foreign_make_printable(name, strlen(name), '?');
    if (parser->object[0] == '\0')
        snprintf(parser->object, sizeof parser->object, ", object %.50s", name);
    free(name);
    return true;
}

static bool take_part(Parser *parser)
{
    ForeignPart part = {.material = parser->head.number};
    ForeignModel *model = parser->model;
    char name[LONGEST_TEXT];
    if (part.material != FOREIGN_NO_MATERIAL && part.material >= model->materials.count)
        return fail_damaged(parser);
    const char *material =
        part.material == FOREIGN_NO_MATERIAL ? "" : model->materials.data[part.material].name;
    snprintf(name, sizeof name, "%s: part %zu%s%s%s", parser->name, model->parts.count,
             material[0] != '\0' ? ", material " : "", material, parser->object);
    parser->object[0] = '\0';
    const PlySource source = {.bytes = parser->next,
                              .size = (size_t)parser->head.size,
                              .name = name,
                              .is_tolerant = parser->is_tolerant,
                              .is_part = true};
    if (!ply_parse(&part.mesh, &source, parser->error))
        return false;
    if (array_push(&model->parts, part, parser->error))
        return true;
    mesh_free(&part.mesh);
    return false;
}

static bool take_note(Parser *parser)
{
    if (parser->model->note != NULL)
        return fail_damaged(parser);
    parser->model->note = copy_text(parser, parser->next, (size_t)parser->head.size);
    if (parser->model->note == NULL)
        return false;
    foreign_make_printable(parser->model->note, strlen(parser->model->note), '?');
    return true;
}

static bool take_failure(Parser *parser)
{
    char *reason = copy_text(parser, parser->next, (size_t)parser->head.size);
    if (reason == NULL)
        return false;
    foreign_make_printable(reason, strlen(reason), '?');
    error_set(parser->error, "%s: %s", parser->name, reason);
    free(reason);
    return false;
}

static bool take_record(Parser *parser)
{
    switch (parser->head.kind) {
    case FOREIGN_FILE:
        return take_file(parser);
    case FOREIGN_MATERIAL:
        return take_material(parser);
    case FOREIGN_OBJECT:
        return take_object(parser);
    case FOREIGN_PART:
        return take_part(parser);
    case FOREIGN_NOTE:
        return take_note(parser);
    case FOREIGN_FAILURE:
        return take_failure(parser);
    default:
        return fail_damaged(parser);
    }
}

static bool read_head(Parser *parser)
{
    if ((size_t)(parser->end - parser->next) < sizeof parser->head)
        return fail_damaged(parser);
    memcpy(&parser->head, parser->next, sizeof parser->head);
    parser->next += sizeof parser->head;
    return parser->head.size <= (size_t)(parser->end - parser->next) || fail_damaged(parser);
}

static bool read_records(Parser *parser)
{
    while (read_head(parser)) {
        if (parser->head.kind == FOREIGN_END)
            return (parser->head.size == 0 && parser->next == parser->end) || fail_damaged(parser);
        if (!take_record(parser))
            return false;
        parser->next += parser->head.size;
    }
    return false;
}

bool foreign_stream_parse(ForeignModel *model, const File *stream, const char *name,
                          bool is_tolerant, Error *error)
{
    *model = (ForeignModel){0};
    Parser parser = {.model = model,
                     .next = stream->bytes,
                     .end = stream->size == 0 ? stream->bytes : stream->bytes + stream->size,
                     .name = name,
                     .is_tolerant = is_tolerant,
                     .error = error};
    if (read_records(&parser))
        return true;
    foreign_model_free(model);
    return false;
}

void foreign_model_free(ForeignModel *model)
{
    for (size_t part = 0; part < model->parts.count; part++)
        mesh_free(&model->parts.data[part].mesh);
    for (size_t file = 0; file < model->files.count; file++)
        free(model->files.data[file]);
    free(model->parts.memory);
    free(model->materials.memory);
    free(model->files.memory);
    free(model->hashes.memory);
    free(model->note);
    *model = (ForeignModel){0};
}
