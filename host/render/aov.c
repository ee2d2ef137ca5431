// SPDX-License-Identifier: MIT
// The table of channels and the functions that compute their values. Compositors expect the names
// Z, N and P. Ids are integers, because float cannot represent all of them exactly. Counts are
// floats, which every program displays unchanged.
#include "render/aov.h"

#include "base/word.h"

#include <string.h>

static uint32_t float_bits(double value)
{
    uint32_t bits;
    const float rounded = (float)value;
    memcpy(&bits, &rounded, sizeof bits);
    return bits;
}

static void take_vector(uint32_t *values, Vec3 v)
{
    values[0] = float_bits(v.x);
    values[1] = float_bits(v.y);
    values[2] = float_bits(v.z);
}

static Vec3 vector_of(const float v[3])
{
    return vec3((double)v[0], (double)v[1], (double)v[2]);
}

static void take_depth(uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    values[0] = float_bits((double)pixel->path->depth / scene->normalization->scale);
}

static void take_normal(uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    (void)scene;
    take_vector(values, vector_of(pixel->path->normal));
}

static void take_position(uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    const Vec3 point = denormalize_point(scene->normalization, vector_of(pixel->path->point));
    take_vector(values, pixel->path->primitive != NOTHING ? point : vec3(0, 0, 0));
}

static void take_primitive(uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    (void)scene;
    values[0] = pixel->path->primitive;
}

static void take_material(uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    (void)scene;
    values[0] = pixel->path->material;
}

static void take_shadow(uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    const double lights = scene->light_count > 0 ? scene->light_count : 1;
    values[0] = float_bits(pixel->path->lights / lights);
}

static void take_bounces(uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    (void)scene;
    values[0] = float_bits(pixel->path->bounces);
}

static void take_samples(uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    (void)scene;
    values[0] = float_bits(pixel->samples);
}

static void take_box_tests(uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    (void)scene;
    values[0] = float_bits(pixel->tests[TALLY_BOX_TESTS]);
}

static void take_triangle_tests(uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    (void)scene;
    values[0] = float_bits(pixel->tests[TALLY_TRIANGLE_TESTS]);
}

static void take_certainty(uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    (void)scene;
    values[0] = float_bits(0.5 * pixel->certainty);
}

static void take_nothing(uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    (void)pixel, (void)scene;
    values[0] = 0;
}

const Aov aov_table[] = {
    {"depth",
     {"Z"},
     false,
     AOV_NEEDS_PATH,
     "distance along the view's axis; infinity if the ray hits nothing",
     take_depth},
    {"normal", {"N.X", "N.Y", "N.Z"}, false, AOV_NEEDS_PATH, "unit shading normal", take_normal},
    {"position", {"P.X", "P.Y", "P.Z"}, false, AOV_NEEDS_PATH, "the hit point", take_position},
    {"primitive",
     {"primitive"},
     true,
     AOV_NEEDS_PATH,
     "number of the sphere or triangle: spheres from 0 on, then triangles",
     take_primitive},
    {"material",
     {"material"},
     true,
     AOV_NEEDS_PATH,
     "number of the material: the course's 0 to 3, then each define",
     take_material},
    {"shadow",
     {"shadow"},
     false,
     AOV_NEEDS_PATH,
     "share of the lights that reach the point",
     take_shadow},
    {"bounces", {"bounces"}, false, AOV_NEEDS_PATH, "reflected rays followed", take_bounces},
    {"samples", {"samples"}, false, AOV_NEEDS_PATH, "samples taken", take_samples},
    {"boxtests",
     {"boxtests"},
     false,
     AOV_NEEDS_TESTS,
     "boxes tested, over all samples",
     take_box_tests},
    {"tritests",
     {"tritests"},
     false,
     AOV_NEEDS_TESTS,
     "triangles tested, over all samples",
     take_triangle_tests},
    {"certainty",
     {"certainty"},
     false,
     AOV_NEEDS_CERTAINTY,
     "1 if no rounding can change a decision, 0.5 if fp64 decided again and replaced the color, 0 "
     "otherwise",
     take_certainty},
    {ERROR_CHANNEL,
     {ERROR_CHANNEL},
     false,
     AOV_NEEDS_REFERENCE,
     "largest difference of the colors from the reference; implies --reference",
     take_nothing},
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
    return error_set(error, "--aov wants names among %s, with commas between, not '%.*s'", list,
                     (int)length, name);
}

static bool read_name(const char *name, size_t length, AovSet *set, Error *error)
{
    const bool is_all = length == 3 && memcmp(name, "all", 3) == 0;
    for (size_t i = 0; i < aov_count; i++)
        if (is_all && aov_table[i].need != AOV_NEEDS_REFERENCE)
            *set |= (AovSet)1 << i;
        else if (strlen(aov_table[i].name) == length &&
                 memcmp(aov_table[i].name, name, length) == 0) {
            if (aov_has(*set, i))
                return error_set(error, "--aov names '%s' twice", aov_table[i].name);
            *set |= (AovSet)1 << i;
            return true;
        }
    return is_all || unknown_name(name, length, error);
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

static uint32_t channel_count(const Aov *aov)
{
    uint32_t count = 0;
    while (count < AOV_COMPONENTS && aov->channels[count] != NULL)
        count++;
    return count;
}

void aov_name_layers(AovSet set, Layers *layers)
{
    for (size_t i = 0; i < aov_count; i++)
        for (uint32_t channel = 0; aov_has(set, i) && channel < channel_count(&aov_table[i]);
             channel++)
            layers->list[layers->count++] =
                (LayerType){aov_table[i].channels[channel], aov_table[i].is_integer};
}

void aov_take(AovSet set, uint32_t *values, const AovPixel *pixel, const AovScene *scene)
{
    for (size_t i = 0; i < aov_count; i++)
        if (aov_has(set, i)) {
            aov_table[i].take(values, pixel, scene);
            values += channel_count(&aov_table[i]);
        }
}
