// SPDX-License-Identifier: MIT
// The table of channels. A pass over the tiles traces the paths through the pixels' centers. If a
// channel needs counts of tests, another pass counts them. Compositors expect the names Z, N and P.
// Ids are integers, because float cannot represent all of them exactly. Counts are floats, because
// some programs display integers as fractions of the largest integer.
#include "render/aov.h"

#include "base/text.h"
#include "render/tile_pass.h"

#include <string.h>

static uint32_t float_bits(double value)
{
    uint32_t bits;
    const float rounded = (float)value;
    memcpy(&bits, &rounded, sizeof bits);
    return bits;
}

// kernels/aov.cl, embedded at build time.
extern const char aov_source[];

const KernelEntry paths_entry = {"trace_paths", aov_source, NULL, "b", .dimensions = 2};
const KernelEntry tests_entry = {"count_tests", aov_source, NULL, "b", .dimensions = 2};

#define AOV_VALUES 16 // components of all channels in the table

const Aov aov_table[] = {
    {"depth",
     {"Z"},
     false,
     AOV_NEEDS_PATH,
     "distance along the view's axis; infinity if the ray hits nothing"},
    {"normal", {"N.X", "N.Y", "N.Z"}, false, AOV_NEEDS_PATH, "unit shading normal"},
    {"position", {"P.X", "P.Y", "P.Z"}, false, AOV_NEEDS_PATH, "the hit point"},
    {"primitive",
     {"primitive"},
     true,
     AOV_NEEDS_PATH,
     "number of the sphere or triangle: spheres from 0 on, then triangles"},
    {"material",
     {"material"},
     true,
     AOV_NEEDS_PATH,
     "number of the material: 0 to 3, then the materials of define and of meshes"},
    {"shadow", {"shadow"}, false, AOV_NEEDS_PATH, "share of the lights that reach the point"},
    {"bounces", {"bounces"}, false, AOV_NEEDS_PATH, "reflected rays followed"},
    {"samples", {"samples"}, false, AOV_NEEDS_PATH, "samples taken"},
    {"boxtests", {"boxtests"}, false, AOV_NEEDS_TESTS, "boxes tested, over all samples"},
    {"tritests", {"tritests"}, false, AOV_NEEDS_TESTS, "triangles tested, over all samples"},
    {"certainty",
     {"certainty"},
     false,
     AOV_NEEDS_CERTAINTY,
     "1 if rounding cannot change a decision; 0.5 if only that of fp32 can (the color is then "
     "fp64's); 0 otherwise"},
    {ERROR_CHANNEL,
     {ERROR_CHANNEL},
     false,
     AOV_NEEDS_REFERENCE,
     "largest difference of the colors from the reference; implies --reference"},
};

const size_t aov_count = sizeof aov_table / sizeof aov_table[0];

static bool aov_has(AovSet set, size_t place)
{
    return (set >> place & 1) != 0;
}

static bool unknown_name(const char *name, size_t length, Error *error)
{
    const char *names[sizeof aov_table / sizeof aov_table[0]];
    char list[512] = "";
    for (size_t i = 0; i < aov_count; i++) {
        names[i] = aov_table[i].name;
        strncat(list, i == 0 ? "" : ", ", 4);
        strncat(list, names[i], 24);
    }
    const char *nearest = word_nearest(name, length, names, aov_count);
    if (length > 0 && nearest != NULL)
        return error_set(error, "--aov knows no channel '%.*s', perhaps %s", (int)length, name,
                         nearest);
    return error_set(error,
                     "--aov: unknown channel '%.*s': give all or a list of %s, like depth,normal",
                     (int)length, name, list);
}

static bool read_name(const char *name, size_t length, AovSet *set, Error *error)
{
    const bool is_all = text_is(name, length, "all");
    bool is_known = false;
    for (size_t i = 0; i < aov_count; i++) {
        const bool is_named = is_all ? aov_table[i].need != AOV_NEEDS_REFERENCE
                                     : text_is(name, length, aov_table[i].name);
        if (is_named && aov_has(*set, i))
            return error_set(error, "--aov names '%s' twice", aov_table[i].name);
        *set |= (AovSet)is_named << i;
        is_known |= is_named;
    }
    return is_known || unknown_name(name, length, error);
}

bool aov_read_list(const char *list, AovSet *set, Error *error)
{
    AovSet named = 0;
    for (;;) {
        const size_t length = strcspn(list, ",");
        if (!read_name(list, length, &named, error))
            return false;
        if (list[length] == '\0')
            break;
        list += length + 1;
    }
    *set |= named;
    return true;
}

bool aov_needs(AovSet set, AovNeed need)
{
    bool needs = false;
    for (size_t i = 0; i < aov_count; i++)
        needs |= aov_has(set, i) && aov_table[i].need == need;
    return needs;
}

uint32_t aov_channel_count(const Aov *aov)
{
    uint32_t count = 0;
    while (count < AOV_COMPONENTS && aov->channels[count] != NULL)
        count++;
    return count;
}

void aov_name_layers(AovSet set, Layers *layers)
{
    for (size_t i = 0; i < aov_count; i++)
        for (uint32_t channel = 0; aov_has(set, i) && channel < aov_channel_count(&aov_table[i]);
             channel++)
            layers->list[layers->count++] =
                (LayerType){aov_table[i].channels[channel], aov_table[i].is_integer};
}

static void take_vector(uint32_t **values, Vec3 v)
{
    *(*values)++ = float_bits(v.x);
    *(*values)++ = float_bits(v.y);
    *(*values)++ = float_bits(v.z);
}

// Stores the values of all channels, in the table's order. Stores 0 for the counts of tests and for
// the error, because their values come later.
static void take_all(uint32_t values[AOV_VALUES], const AovPass *pass, size_t pixel,
                     const PathData *path)
{
    const RenderSettings *settings = &pass->paths.settings;
    const Vec3 point = denormalize_point(pass->normalization, vec3_of_floats(path->point));
    const double lights = pass->light_count > 0 ? pass->light_count : 1;
    *values++ = float_bits((double)path->depth / pass->normalization->scale);
    take_vector(&values, vec3_of_floats(path->normal));
    take_vector(&values, path->primitive != NOTHING ? point : vec3(0, 0, 0));
    *values++ = path->primitive;
    *values++ = path->material;
    *values++ = float_bits(path->lights / lights);
    *values++ = float_bits(path->bounces);
    *values++ = float_bits(pass->samples != NULL ? pass->samples[pixel]
                                                 : settings->samples * settings->samples);
    *values++ = 0; // the counts of tests
    *values++ = 0;
    *values++ = float_bits(pass->certainty != NULL ? 0.5 * pass->certainty->marks[pixel].certainty
                                                   : 0.5 * CERTAINTY_OPEN);
    *values = 0;
}

static void take_path(const AovPass *pass, size_t pixel, const PathData *path)
{
    uint32_t all[AOV_VALUES], *next = all;
    uint32_t *values = pass->layers->values + pixel * pass->layers->count;
    take_all(all, pass, pixel, path);
    for (size_t i = 0; i < aov_count; next += aov_channel_count(&aov_table[i++]))
        for (uint32_t channel = 0;
             aov_has(pass->set, i) && channel < aov_channel_count(&aov_table[i]); channel++)
            *values++ = next[channel];
}

// Replaces a pixel's counts of tests. `tests` holds the counts over all samples.
static void take_counts(const AovPass *pass, size_t pixel, const uint32_t tests[TALLY_KINDS])
{
    uint32_t *values = pass->layers->values + pixel * pass->layers->count;
    TallyKind kind = TALLY_BOX_TESTS; // aov_table has boxtests before tritests
    for (size_t i = 0; i < aov_count; i++) {
        if (aov_has(pass->set, i) && aov_table[i].need == AOV_NEEDS_TESTS)
            *values = float_bits(tests[kind]);
        if (aov_table[i].need == AOV_NEEDS_TESTS)
            kind = TALLY_TRIANGLE_TESTS;
        if (aov_has(pass->set, i))
            values += aov_channel_count(&aov_table[i]);
    }
}

// Returns the index, in the layers, of the first pixel in a row of the tile.
static size_t first_pixel(const AovPass *pass, const Tile *tile, uint32_t row)
{
    return (size_t)(tile->top + row) * pass->layers->width + tile->left;
}

static void take_paths(void *context, const Tile *tile, void *const values[2])
{
    const PathData *path = values[0];
    for (uint32_t row = 0; row < tile->height; row++)
        for (uint32_t column = 0; column < tile->width; column++)
            take_path(context, first_pixel(context, tile, row) + column, path++);
}

static void take_tests(void *context, const Tile *tile, void *const values[2])
{
    const uint32_t(*tests)[TALLY_KINDS] = values[0];
    for (uint32_t row = 0; row < tile->height; row++)
        for (uint32_t column = 0; column < tile->width; column++)
            take_counts(context, first_pixel(context, tile, row) + column, *tests++);
}

static bool draw_paths(AovPass *pass, const RenderObserver *observer, RenderProgress *progress,
                       Error *error)
{
    TilePass paths = {.frame = renderer_frame(&pass->paths, &pass->center),
                      .sizes = {sizeof(PathData)},
                      .take = take_paths,
                      .context = pass};
    paths.frame.samples = 1;
    return tile_pass_run(&paths, &pass->paths, observer, progress, error);
}

static bool draw_tests(AovPass *pass, const RenderObserver *observer, RenderProgress *progress,
                       Error *error)
{
    Renderer renderer = pass->paths;
    renderer.kernel = pass->tests;
    const TilePass tests = {.frame = renderer_frame(&renderer, &pass->camera),
                            .sizes = {sizeof(uint32_t[TALLY_KINDS])},
                            .take = take_tests,
                            .context = pass};
    return tile_pass_run(&tests, &renderer, observer, progress, error);
}

bool aov_draw(AovPass *pass, const RenderObserver *observer, Error *error)
{
    const uint64_t tiles = tile_count(&pass->paths.settings);
    RenderProgress progress = {.tiles = pass->tests != NULL ? 2 * tiles : tiles};
    return draw_paths(pass, observer, &progress, error) &&
           (pass->tests == NULL || progress.tiles_done < tiles ||
            draw_tests(pass, observer, &progress, error));
}
