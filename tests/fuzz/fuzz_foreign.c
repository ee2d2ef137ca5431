// SPDX-License-Identifier: MIT
// libFuzzer target: parses any bytes as the output of clrt-foreign. A parsed model must satisfy
// mesh/foreign_stream.h. A failure must return a message and no model.
#include "demand.h"

#include "mesh/foreign_stream.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void check_material(const ForeignMaterial *material)
{
    demand(memchr(material->name, '\0', sizeof material->name) != NULL);
    for (const char *c = material->name; *c != '\0'; c++)
        demand(*c > ' ' && *c <= '~' && *c != '"' && *c != '#');
    for (int channel = 0; channel < 3; channel++) {
        demand(material->diffuse[channel] >= 0 && material->diffuse[channel] <= 1);
        demand(material->specular[channel] >= 0 && material->specular[channel] <= 1);
    }
    demand(material->shininess >= 0 && material->shininess <= 1e9f);
}

static void check_part(const ForeignModel *model, const ForeignPart *part)
{
    const Mesh *mesh = &part->mesh;
    demand(part->material == FOREIGN_NO_MATERIAL || part->material < model->materials.count);
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++)
        for (int axis = 0; axis < 3; axis++)
            demand(fabs(mesh->positions[vertex][axis]) < 1e30);
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++)
        for (int corner = 0; corner < 3; corner++)
            demand(mesh->triangles[triangle][corner] < mesh->vertex_count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    ForeignModel model;
    Error error = {0};
    const File stream = {(char *)(uintptr_t)data, size};
    if (foreign_stream_parse(&model, &stream, "fuzz.obj", false, &error)) {
        demand(model.files.count == model.hashes.count);
        for (size_t i = 0; i < model.materials.count; i++)
            check_material(&model.materials.data[i]);
        for (size_t i = 0; i < model.parts.count; i++)
            check_part(&model, &model.parts.data[i]);
    } else {
        demand(error.text[0] != '\0' && model.parts.data == NULL && model.files.data == NULL);
    }
    foreign_model_free(&model);
    return 0;
}
