// SPDX-License-Identifier: MIT
// make_models FOLDER: writes the models of the scenes as PLY files. Each file is a closed triangle
// mesh, made from a signed distance field of smooth shapes: field -> grid -> surface net -> relaxed
// and checked surface -> file. With IEEE arithmetic and -ffp-contract=off, every machine writes the
// same bytes.
#include "models/closed.h"
#include "models/grid.h"
#include "models/ply_file.h"
#include "models/relax.h"

#include <stdio.h>

static const Model *const models[] = {&model_creature, &model_figure, &model_coral, &model_vase};

static bool make_surface(Surface *surface, const Model *model, Error *error)
{
    Grid grid = {0};
    const bool extracted = grid_make(&grid, model, error) && surface_extract(surface, &grid, error);
    grid_free(&grid);
    return extracted && relax_surface(surface, model, error) &&
           closed_check(surface, model->name, error);
}

static bool write_file(const Surface *surface, const Model *model, const char *folder, Error *error)
{
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/%s.ply", folder, model->name);
    if (length < 0 || (size_t)length >= sizeof path)
        return error_set(error, "the folder's name is too long: %s", folder);
    if (!ply_file_write(surface, model->color, path, error))
        return false;
    printf("%s: %zu vertices, %zu triangles\n", model->name, surface->vertex_count,
           surface->quad_count * 2);
    return true;
}

static bool make_file(const Model *model, const char *folder, Error *error)
{
    Surface surface = {0};
    const bool made =
        make_surface(&surface, model, error) && write_file(&surface, model, folder, error);
    surface_free(&surface);
    return made;
}

int main(int argument_count, char **arguments)
{
    if (argument_count != 2) {
        fputs("usage: make_models FOLDER\n", stderr);
        return 2;
    }
    Error error = {0};
    bool made = true;
    for (size_t model = 0; made && model < sizeof models / sizeof models[0]; model++)
        made = make_file(models[model], arguments[1], &error);
    if (!made)
        fprintf(stderr, "make_models: %s\n", error.text);
    return made ? 0 : 1;
}
