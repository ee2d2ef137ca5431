// SPDX-License-Identifier: MIT
// Flattens lights, materials and spheres, and derives traits. flat_looks.c, flat_pair.c and
// flat_wide.c flatten the triangles and their tree.
#include "accel/flat.h"

#include "accel/flat_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

BvhLeaves flat_leaves(NodeLayout layout)
{
    return layout == NODES_WIDE ? LEAVES_BLOCKS : LEAVES_SINGLE;
}

static void split_float(double value, float *high, float *low)
{
    *high = (float)value;
    *low = (float)(value - (double)*high);
}

static void flatten_sphere(SphereData *data, const Sphere *sphere,
                           const Normalization *normalization)
{
    const Vec3 center = normalize_point(normalization, sphere->center);
    data->material = sphere->material;
    split_float(center.x, &data->center[0], &data->center_low[0]);
    split_float(center.y, &data->center[1], &data->center_low[1]);
    split_float(center.z, &data->center[2], &data->center_low[2]);
    split_float(sphere->radius * normalization->scale, &data->radius, &data->radius_low);
}

static void flatten_light(PointLight *data, const Light *light, const Normalization *normalization)
{
    const Vec3 position = normalize_point(normalization, light->position);
    vec3_store(data->position, position);
    data->intensity = (float)light->intensity;
    vec3_store(data->color, light->color);
}

static bool allocate(FlatScene *flat, const Scene *scene, Error *error)
{
    flat->light_count = (uint32_t)scene->lights.count;
    flat->material_count = (uint32_t)scene->materials.count;
    flat->sphere_count = (uint32_t)scene->spheres.count;
    flat->triangle_count = (uint32_t)scene_triangle_count(scene);
    flat->lights = memory_zeroed(flat->light_count, sizeof *flat->lights, error);
    flat->materials = memory_zeroed(flat->material_count, sizeof *flat->materials, error);
    flat->spheres = memory_zeroed(flat->sphere_count, sizeof *flat->spheres, error);
    return flat->lights != NULL && flat->materials != NULL && flat->spheres != NULL;
}

static void flatten_constants(FlatScene *flat, const Scene *scene)
{
    vec3_store(flat->background, scene->background);
    flat->ambient = (float)scene->ambient;
    for (uint32_t i = 0; i < flat->material_count; i++)
        flat->materials[i] = scene->materials.data[i];
}

static bool make_all(FlatScene *flat, const FlatSource *source, Error *error)
{
    const Scene *scene = source->scene;
    const Normalization *normalization = source->normalization;
    if (!allocate(flat, scene, error))
        return false;
    flatten_constants(flat, scene);
    for (uint32_t i = 0; i < flat->light_count; i++)
        flatten_light(&flat->lights[i], &scene->lights.data[i], normalization);
    for (uint32_t i = 0; i < flat->sphere_count; i++)
        flatten_sphere(&flat->spheres[i], &scene->spheres.data[i], normalization);
    return flat_looks_make(flat, source, error) &&
           (source->layout == NODES_WIDE ? flat_wide_make(flat, source, error)
                                         : flat_pair_make(flat, source, error));
}

bool flat_make(FlatScene *flat, const FlatSource *source, Error *error)
{
    *flat = (FlatScene){.layout = source->layout};
    if (make_all(flat, source, error))
        return true;
    flat_free(flat);
    return false;
}

void flat_free(FlatScene *flat)
{
    free(flat->lights);
    free(flat->materials);
    free(flat->spheres);
    free(flat->pairs);
    free(flat->triangles);
    free(flat->wides);
    free(flat->blocks);
    free(flat->looks);
    free(flat->normals);
    *flat = (FlatScene){0};
}

void flat_arrays(const FlatScene *flat, FlatArray arrays[FLAT_ARRAYS])
{
    const bool is_wide = flat->layout == NODES_WIDE;
    const FlatArray nodes =
        is_wide ? (FlatArray){"nodes", flat->wides, flat->node_count * sizeof *flat->wides}
                : (FlatArray){"nodes", flat->pairs, flat->node_count * sizeof *flat->pairs};
    const FlatArray triangles =
        is_wide ? (FlatArray){"triangles", flat->blocks, flat->block_count * sizeof *flat->blocks}
                : (FlatArray){"triangles", flat->triangles,
                              flat->triangle_count * sizeof *flat->triangles};
    const size_t looks = is_wide ? flat->triangle_count : 0;
    const FlatArray all[FLAT_ARRAYS] = {
        {"lights", flat->lights, flat->light_count * sizeof *flat->lights},
        {"materials", flat->materials, flat->material_count * sizeof *flat->materials},
        {"spheres", flat->spheres, flat->sphere_count * sizeof *flat->spheres},
        nodes,
        triangles,
        {"looks", flat->looks, looks * sizeof *flat->looks},
        {"normals", flat->normals, flat->normals_count * sizeof *flat->normals}};
    memcpy(arrays, all, sizeof all);
}

static float largest_coordinate(const Box *box)
{
    float largest = 0;
    for (int axis = 0; axis < 3; axis++)
        largest = fmaxf(largest, fmaxf(fabsf(box->low[axis]), fabsf(box->high[axis])));
    return largest;
}

static float rounded_down(double value)
{
    const float nearest = (float)value;
    return (double)nearest <= value ? nearest : nextafterf(nearest, -INFINITY);
}

static float rounded_up(double value)
{
    return -rounded_down(-value);
}

// Moves each plane outward by BVH_SLACK times the box's largest coordinate. The sum is nearly exact
// in fp64 and rounded outward to float. The slack makes the device's culling conservative
// (kernels/search.cl).
static Box box_grow(const Box *box)
{
    const double slack = (double)BVH_SLACK * (double)largest_coordinate(box);
    Box grown;
    for (int axis = 0; axis < 3; axis++) {
        grown.low[axis] = rounded_down((double)box->low[axis] - slack);
        grown.high[axis] = rounded_up((double)box->high[axis] + slack);
    }
    return grown;
}

void box_store(float *planes, uint32_t children, uint32_t child, const Box *box)
{
    const Box grown =
        box != NULL ? box_grow(box)
                    : (Box){{0x1p100f, 0x1p100f, 0x1p100f}, {-0x1p100f, -0x1p100f, -0x1p100f}};
    for (uint32_t axis = 0; axis < 3; axis++) {
        planes[2 * axis * children + child] = grown.low[axis];
        planes[(2 * axis + 1) * children + child] = grown.high[axis];
    }
}

bool scene_compile(FlatScene *flat, CompileStages *stages, const CompileSource *source,
                   Error *error)
{
    CompileStages own = {0}, *kept = stages != NULL ? stages : &own;
    const BvhSettings settings = {source->builder, flat_leaves(source->layout)};
    const FlatSource flat_source = {.scene = source->scene,
                                    .triangles = &kept->triangles,
                                    .bvh = &kept->bvh,
                                    .normalization = source->normalization,
                                    .layout = source->layout,
                                    .pool = source->pool};
    *kept = (CompileStages){0};
    const bool ok = triangles_make(&kept->triangles, source->scene, source->normalization,
                                   source->pool, error) &&
                    (!source->has_tree ||
                     bvh_build(&kept->bvh, &kept->triangles, &settings, source->pool, error)) &&
                    flat_make(flat, &flat_source, error);
    compile_stages_free(&own);
    return ok;
}

void compile_stages_free(CompileStages *stages)
{
    triangles_free(&stages->triangles);
    bvh_free(&stages->bvh);
}

// Called only for materials that primitives use. A defined but unused material sets no trait.
static void add_material(SceneTraits *traits, const Material *material)
{
    traits->mirrors |= material->reflectivity > 0;
    traits->shaded |= material->shader != SHADER_SILHOUETTE;
}

static uint32_t material_of(const FlatScene *flat, uint32_t triangle)
{
    return flat->layout == NODES_WIDE ? flat->looks[triangle].material
                                      : flat->triangles[triangle].material & ~TRIANGLE_MARKS;
}

SceneTraits traits_of(const FlatScene *flat, bool statistics)
{
    SceneTraits traits = {.spheres = flat->sphere_count > 0,
                          .triangles = flat->triangle_count > 0,
                          .bvh = flat->node_count > 0,
                          .statistics = statistics};
    for (uint32_t i = 0; i < flat->sphere_count; i++)
        add_material(&traits, &flat->materials[flat->spheres[i].material]);
    for (uint32_t i = 0; i < flat->triangle_count; i++)
        add_material(&traits, &flat->materials[material_of(flat, i)]);
    return traits;
}

SceneTraits traits_general(bool statistics)
{
    return (SceneTraits){true, true, true, true, true, statistics};
}

void traits_write_options(const SceneTraits *traits, char options[TRAITS_OPTIONS_SIZE])
{
    snprintf(options, TRAITS_OPTIONS_SIZE,
             "-DCLRT_SPHERES=%d -DCLRT_TRIANGLES=%d -DCLRT_BVH=%d -DCLRT_MIRRORS=%d "
             "-DCLRT_SHADED=%d -DCLRT_STATISTICS=%d",
             traits->spheres, traits->triangles, traits->bvh, traits->mirrors, traits->shaded,
             traits->statistics);
}
