// SPDX-License-Identifier: MIT
// Renders pictures for tests and compares them.
#include "image/rendered.h"

#include "image/form.h"
#include "mesh/ply.h"
#include "mesh/ply_write.h"
#include "scene/scn.h"
#include "unit/cmocka_all.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void rendered_require(bool ok, const Error *error)
{
    if (!ok)
        fail_msg("%s", error->text);
}

Scene rendered_scene(const char *path)
{
    Scene scene;
    Error error = {0};
    rendered_require(scn_load(&scene, path, &(SceneLoadOptions){0}, &error), &error);
    return scene;
}

Framebuffer rendered(const PictureRequest *request)
{
    Framebuffer picture;
    Error error = {0};
    rendered_require(picture_render(&picture, request, &error), &error);
    return picture;
}

Framebuffer rendered_with(PictureRequest request, const char *channels, Layers *layers)
{
    Error error = {0};
    request.aovs = 0;
    request.layers = layers;
    rendered_require(aov_read_list(channels, &request.aovs, &error), &error);
    return rendered(&request);
}

PictureRequest rendered_in_form(PictureRequest request, const KernelChoice *form)
{
    request.choice = *form;
    return request;
}

double layer_float(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

Vec3 layer_vector(const uint32_t bits[3])
{
    return vec3(layer_float(bits[0]), layer_float(bits[1]), layer_float(bits[2]));
}

void rendered_expect_same(const PictureRequest *expected, const PictureRequest *others,
                          size_t count)
{
    FREED_BY(framebuffer_free) Framebuffer first = rendered(expected);
    const size_t size = (size_t)first.width * first.height * sizeof *first.pixels;
    for (size_t i = 0; i < count; i++) {
        FREED_BY(framebuffer_free) Framebuffer other = rendered(&others[i]);
        assert_memory_equal(first.pixels, other.pixels, size);
    }
}

void rendered_expect_same_in_every_form(const PictureRequest *usual)
{
    PictureRequest others[FORMS_FP32];
    for (uint32_t i = 0; i < FORMS_FP32; i++) {
        others[i] = rendered_in_form(*usual, &form_all[i]);
        others[i].threads = i;
        others[i].builder = i % 2 == 0 ? BVH_SAH : BVH_MIDPOINT;
        others[i].specialization = i == 0 ? CLRT_SPECIALIZE_ALWAYS : CLRT_SPECIALIZE_NEVER;
    }
    rendered_expect_same(usual, others, FORMS_FP32);
}

void rendered_expect_same_with_every_tree(PictureRequest usual)
{
    PictureRequest others[FORMS_FP32][3];
    usual = rendered_in_form(usual, &form_all[0]);
    usual.samples = 1;
    for (size_t i = 0; i < FORMS_FP32; i++) {
        PictureRequest *form = others[i];
        form[0] = form[1] = form[2] = rendered_in_form(usual, &form_all[i]);
        form[1].builder = BVH_MIDPOINT;
        form[1].tile_width = 13;
        form[1].tile_height = 7;
        form[2].uses_bvh = false;
    }
    rendered_expect_same(&usual, others[0], FORMS_FP32 * 3);
}

double rendered_error(const Framebuffer *one, const Framebuffer *other)
{
    const size_t values = (size_t)one->width * one->height * 3;
    const float *first = &one->pixels[0][0], *second = &other->pixels[0][0];
    double sum = 0;
    for (size_t i = 0; i < values; i++)
        sum += pow((double)first[i] - (double)second[i], 2);
    return sqrt(sum / (double)values);
}

FILE *temporary_open(char path[TEMPORARY_PATH])
{
    snprintf(path, TEMPORARY_PATH, "%s", "/tmp/clrt-scene-XXXXXX");
    const int file = mkstemp(path);
    assert_true(file >= 0);
    FILE *stream = fdopen(file, "w");
    assert_non_null(stream);
    return stream;
}

void temporary_close(FILE *stream)
{
    assert_int_equal(fclose(stream), 0);
}

void temporary_mesh(char path[TEMPORARY_PATH], const Mesh *mesh)
{
    FILE *stream = temporary_open(path);
    assert_true(ply_write(mesh, stream));
    temporary_close(stream);
}
