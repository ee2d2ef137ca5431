// SPDX-License-Identifier: MIT
// Reads a scene file statement by statement. The table of statements is the grammar. Each statement
// has a keyword, a usage text that messages quote, and a function that reads its arguments.
#include "scene/scn.h"

#include "base/file.h"
#include "base/limits.h"
#include "base/text.h"
#include "mesh/foreign_stream.h"
#include "scene/statements.h"
#include "scene/tokens.h"

#include <string.h>

typedef struct {
    Tokens tokens;
    Scene *scene;
    MaterialChoice material; // of the objects that follow
    MeshLoadOptions mesh;    // options of the meshes that follow, except the material
    Vec3 up;                 // up vector of the cameras that follow
    Token waiting_up;        // the latest `up` statement, if no camera has followed it
    Error *error;
} Parser;

static bool next_is(const Tokens *tokens, const char *word)
{
    Tokens ahead = *tokens;
    return token_is(tokens_next(&ahead), word);
}

// If the next token is `word`, skips the token and returns true.
static bool skip_word(Tokens *tokens, const char *word)
{
    const bool found = next_is(tokens, word);
    if (found)
        tokens_next(tokens);
    return found;
}

static bool read_color(Tokens *tokens, Vec3 *color)
{
    return tokens_number_within(tokens, &color->x, 0, 1) &&
           tokens_number_within(tokens, &color->y, 0, 1) &&
           tokens_number_within(tokens, &color->z, 0, 1);
}

// Reads the position, intensity and color of a light or sun. A sun's position is a vector toward
// the sun.
static bool read_light_or_sun(Tokens *tokens, Light *light)
{
    double position[3];
    if (!tokens_numbers(tokens, 3, position) ||
        !tokens_number_within(tokens, &light->intensity, 0, INTENSITY_MOST))
        return false;
    light->position = vec3_of_doubles(position);
    light->color = vec3(1, 1, 1);
    return !tokens_have_more(tokens) || next_is(tokens, "area") ||
           read_color(tokens, &light->color);
}

static bool read_light(Parser *parser)
{
    Light light = {.is_sun = false};
    Tokens *tokens = &parser->tokens;
    double sides[6] = {0};
    int64_t cells = 1;
    if (!read_light_or_sun(tokens, &light) ||
        (skip_word(tokens, "area") &&
         !(tokens_numbers(tokens, 6, sides) && tokens_integer(tokens, &cells, 1, AREA_CELLS_MOST))))
        return false;
    const LightArea area = {{vec3_of_doubles(sides), vec3_of_doubles(sides + 3)}, (uint32_t)cells};
    return scene_add_area_light(parser->scene, &light, &area, parser->error);
}

static bool read_sun(Parser *parser)
{
    Light sun = {.is_sun = true};
    if (!read_light_or_sun(&parser->tokens, &sun))
        return false;
    if (vec3_extent(sun.position) == 0)
        return tokens_fail(&parser->tokens, parser->tokens.last,
                           "the direction of a sun must not be zero");
    return array_push(&parser->scene->lights, sun, parser->error);
}

static bool read_sphere(Parser *parser)
{
    double center[3], radius;
    if (!tokens_numbers(&parser->tokens, 3, center) ||
        !tokens_number_within(&parser->tokens, &radius, RADIUS_LEAST, RADIUS_MOST))
        return false;
    const Sphere sphere = {vec3_of_doubles(center), radius, parser->material.plain};
    return array_push(&parser->scene->spheres, sphere, parser->error);
}

static bool read_material(Parser *parser)
{
    return material_statement_read(parser->scene, &parser->tokens, &parser->material);
}

static bool read_define(Parser *parser)
{
    return define_statement_read(parser->scene, &parser->tokens);
}

static bool read_mesh_file(Parser *parser, bool is_plain_ply)
{
    MeshLoadOptions options = parser->mesh;
    options.object.material = parser->material.plain;
    options.colored_material = parser->material.colored;
    options.is_plain_ply = is_plain_ply;
    options.takes_own_materials = parser->material.is_own;
    return mesh_statement_read(parser->scene, &parser->tokens, &options);
}

static bool read_mesh(Parser *parser)
{
    return read_mesh_file(parser, false);
}

static bool read_ply_file(Parser *parser)
{
    return read_mesh_file(parser, true);
}

// Reads the picture's vertical angle or height, and the optional least horizontal angle or width.
static bool read_picture_sides(Tokens *tokens, double low, double high, double sides[2])
{
    return tokens_number_within(tokens, &sides[0], low, high) &&
           (!tokens_have_more(tokens) || tokens_number_within(tokens, &sides[1], low, high));
}

static bool read_camera(Parser *parser)
{
    double numbers[6], angles[2] = {0}, lengths[2] = {0};
    Tokens *tokens = &parser->tokens;
    const Token start = tokens->last;
    if (!tokens_numbers(tokens, 6, numbers) ||
        !(skip_word(tokens, "orthographic")
              ? read_picture_sides(tokens, HEIGHT_LEAST, HEIGHT_MOST, lengths)
              : read_picture_sides(tokens, FOV_LEAST, FOV_MOST, angles)))
        return false;
    const Viewpoint viewpoint = {.eye = vec3_of_doubles(numbers),
                                 .look_at = vec3_of_doubles(numbers + 3),
                                 .up = parser->up,
                                 .fov_degrees = angles[0],
                                 .width_degrees = angles[1],
                                 .height = lengths[0],
                                 .width = lengths[1]};
    const char *fault = viewpoint_fault(&viewpoint);
    if (fault != NULL)
        return tokens_fail(&parser->tokens, start, "%s", fault);
    parser->waiting_up.text = NULL;
    return array_push(&parser->scene->viewpoints, viewpoint, parser->error);
}

static bool read_up(Parser *parser)
{
    double up[3];
    parser->waiting_up = parser->tokens.last;
    if (!tokens_numbers(&parser->tokens, 3, up))
        return false;
    parser->up = vec3_of_doubles(up);
    return vec3_extent(parser->up) > 0 ||
           tokens_fail(&parser->tokens, parser->tokens.last, "'up' must not be zero");
}

static bool read_size(Parser *parser)
{
    int64_t width, height;
    if (!tokens_integer(&parser->tokens, &width, 1, PICTURE_SIZE_MAX) ||
        !tokens_integer(&parser->tokens, &height, 1, PICTURE_SIZE_MAX))
        return false;
    parser->scene->width = (uint32_t)width;
    parser->scene->height = (uint32_t)height;
    return true;
}

static bool read_background(Parser *parser)
{
    return read_color(&parser->tokens, &parser->scene->background);
}

static bool read_ambient(Parser *parser)
{
    return tokens_number_within(&parser->tokens, &parser->scene->ambient, 0, 1);
}

static bool read_max_level(Parser *parser)
{
    int64_t level;
    if (!tokens_integer(&parser->tokens, &level, 0, MAX_LEVEL_LIMIT))
        return false;
    parser->scene->max_level = (uint32_t)level;
    return true;
}

static bool read_choice(Parser *parser, const char *yes, const char *no, bool *chosen)
{
    const Token token = tokens_next(&parser->tokens);
    *chosen = token_is(token, yes);
    return *chosen || token_is(token, no) ||
           tokens_fail(&parser->tokens, token, "expected '%s' or '%s'", yes, no);
}

static bool read_sides(Parser *parser)
{
    return read_choice(parser, "two", "one", &parser->mesh.object.two_sided);
}

static bool read_normals(Parser *parser)
{
    MeshLoadOptions *mesh = &parser->mesh;
    if (!read_choice(parser, "flat", "smooth", &mesh->is_flat))
        return false;
    mesh->crease_degrees = CREASE_DEGREES;
    return mesh->is_flat || !tokens_have_more(&parser->tokens) ||
           tokens_number_within(&parser->tokens, &mesh->crease_degrees, 0, 180);
}

static const struct {
    const char *keyword;
    const char *usage;
    bool (*read)(Parser *);
} statements[] = {
    {"ambient", "ambient INTENSITY", read_ambient},
    {"background", "background R G B", read_background},
    {"camera", "camera EYE_X EYE_Y EYE_Z AT_X AT_Y AT_Z FOV_DEGREES|orthographic HEIGHT [WIDTH]",
     read_camera},
    {"define", "define NAME silhouette|matte|blinn_phong|glass [PROPERTY VALUES]...", read_define},
    {"light", "light X Y Z INTENSITY [R G B] [area UX UY UZ VX VY VZ N]", read_light},
    {"material", "material NUMBER|NAME|own [NUMBER|NAME]", read_material},
    {"max_level", "max_level N", read_max_level},
    {"mesh", "mesh PATH [up AXIS] [scale S] [rotate AX AY AZ DEGREES] [translate X Y Z]",
     read_mesh},
    {"normals", "normals flat|smooth [DEGREES]", read_normals},
    {"ply_file", "ply_file PATH", read_ply_file},
    {"sides", "sides one|two", read_sides},
    {"size", "size WIDTH HEIGHT", read_size},
    {"sphere", "sphere X Y Z RADIUS", read_sphere},
    {"sun", "sun X Y Z INTENSITY [R G B]", read_sun},
    {"up", "up X Y Z", read_up},
};
#define STATEMENT_COUNT (sizeof statements / sizeof statements[0])

static bool unknown_statement(const Tokens *tokens, Token token)
{
    const char *keywords[STATEMENT_COUNT];
    char list[256] = "";
    for (size_t i = 0; i < STATEMENT_COUNT; i++) {
        keywords[i] = statements[i].keyword;
        strncat(list, i == 0 ? "" : ", ", 3);
        strncat(list, keywords[i], 16);
    }
    const char *nearest = word_nearest(token.text, token.length, keywords, STATEMENT_COUNT);
    if (nearest == NULL)
        return tokens_fail(tokens, token, "expected a statement (%s)", list);
    return tokens_fail(tokens, token, "unknown statement (did you mean '%s'?)", nearest);
}

static bool read_statement(Parser *parser, Token keyword)
{
    for (size_t i = 0; i < STATEMENT_COUNT; i++) {
        if (token_is(keyword, statements[i].keyword)) {
            parser->tokens.usage = statements[i].usage;
            return statements[i].read(parser) && tokens_end(&parser->tokens);
        }
    }
    return unknown_statement(&parser->tokens, keyword);
}

static bool read_statements(Parser *parser)
{
    for (;;) {
        const Token keyword = tokens_next_statement(&parser->tokens);
        if (keyword.text == NULL)
            break;
        if (!read_statement(parser, keyword))
            return false;
    }
    parser->tokens.usage = "up X Y Z";
    return parser->waiting_up.text == NULL ||
           tokens_fail(&parser->tokens, parser->waiting_up, "no camera follows this 'up'");
}

// Parses the text of a scene file. parser->scene and parser->error must be set. Frees the scene on
// failure.
static bool parse(Parser *parser, const char *text, size_t size, const char *name)
{
    parser->tokens = tokens_of(text, size, name, parser->error);
    parser->material = material_own;
    parser->mesh.crease_degrees = NO_CREASE;
    parser->up = vec3(0, 0, 1);
    KeptFiles kept = {0};
    parser->mesh.kept = &kept;
    bool ok = scene_init(parser->scene, parser->error);
    scene_hash_input(parser->scene, text, size);
    ok = ok && read_statements(parser) && scene_complete(parser->scene, parser->error);
    mesh_load_free_kept(&kept);
    if (!ok)
        scene_free(parser->scene);
    return ok;
}

bool scn_parse(Scene *scene, const char *text, size_t size, const char *name, Error *error)
{
    Parser parser = {.scene = scene, .error = error};
    return parse(&parser, text, size, name);
}

// Frees the parsed scene unless `ok`. Returns `ok`.
static bool keep(Scene *scene, bool ok)
{
    if (!ok)
        scene_free(scene);
    return ok;
}

// Parses a scene file and adds its path to the inputs, after the paths of its meshes.
static bool load_text(Parser *parser, const File *file, const char *path)
{
    return parse(parser, file->bytes, file->size, path) &&
           keep(parser->scene, scene_add_input(parser->scene, path, parser->error));
}

static bool load_mesh(Scene *scene, const File *ply, const char *path,
                      const SceneLoadOptions *options, Error *error)
{
    return scn_parse(scene, mesh_scene_studio, strlen(mesh_scene_studio), "", error) &&
           keep(scene, mesh_scene_fill(scene, ply, path, options, error));
}

// Fails if the options contain choices that are only for lone mesh files.
static bool check_for_text(const SceneLoadOptions *options, const char *name, Error *error)
{
    if (options->up != UP_AUTO)
        return error_set(error,
                         "%s: an up axis can be chosen only for a lone mesh file; in a scene, "
                         "write 'up %s' after the path",
                         name, up_axis_names[options->up]);
    if (options->studio != STUDIO_HARD)
        return error_set(error,
                         "%s: a studio can be chosen only for a lone mesh file; in a scene, write "
                         "'area' after a "
                         "light",
                         name);
    return options->normals == NORMALS_AUTO ||
           error_set(error,
                     "%s: normals can be chosen only for a lone mesh file; in a scene, write "
                     "'normals %s' before the mesh",
                     name, options->normals == NORMALS_FLAT ? "flat" : "smooth");
}

bool scn_take(Scene *scene, const File *file, const char *name, const SceneLoadOptions *options,
              Error *error)
{
    Parser parser = {.scene = scene, .mesh.is_tolerant = options->is_tolerant, .error = error};
    if (file_has_ending(name, ".ply") || mesh_scene_is_mesh(file->bytes, file->size))
        return load_mesh(scene, file, name, options, error);
    return check_for_text(options, name, error) && load_text(&parser, file, name);
}

bool scn_load(Scene *scene, const char *path, const SceneLoadOptions *options, Error *error)
{
    File file = {0};
    if (foreign_format_is(path))
        return load_mesh(scene, NULL, path, options, error);
    const bool ok = file_read(&file, path, error) && scn_take(scene, &file, path, options, error);
    file_free(&file);
    return ok;
}
