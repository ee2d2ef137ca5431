// SPDX-License-Identifier: MIT
// Takes the arrays that clrt uploads to its device, so that both renderers use the same floats.
// Embree gets the triangles as an indexed mesh in its own buffers.
#include "peer_scene.h"

#include "accel/flat.h"
#include "base/clock.h"
#include "scene/camera.h"
#include "scene/scn.h"

#include <stdio.h>
#include <stdlib.h>

// Adds each triangle's corners in clrt's stored order, which is also the order of its normals.
static bool add_triangles(RTCGeometry geometry, const Triangles *triangles)
{
    float(*points)[3] =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof *points, triangles->point_count);
    uint32_t(*corners)[3] = rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof *corners, triangles->count);
    if (points == NULL || corners == NULL)
        return false;
    for (size_t i = 0; i < triangles->point_count; i++)
        for (int axis = 0; axis < 3; axis++)
            points[i][axis] = triangles->points[i][axis];
    for (size_t i = 0; i < triangles->count; i++)
        for (int corner = 0; corner < 3; corner++)
            corners[i][corner] =
                triangles->corners[i][triangles_order(triangles, i)->places[corner]];
    return true;
}

static bool build(PeerScene *peer, const Triangles *triangles, const PeerSettings *settings,
                  Error *error)
{
    char config[64];
    snprintf(config, sizeof config, "threads=%u" DEVICE_CONFIG, settings->threads);
    peer->device = rtcNewDevice(config);
    peer->scene = rtcNewScene(peer->device);
    rtcSetSceneBuildQuality(peer->scene, settings->quality);
    rtcSetSceneFlags(peer->scene, settings->robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    RTCGeometry geometry = rtcNewGeometry(peer->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, settings->quality);
    const bool filled = add_triangles(geometry, triangles);
    const double start = clock_seconds();
    if (filled) {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(peer->scene, geometry);
        rtcCommitScene(peer->scene);
    }
    peer->build_seconds = clock_seconds() - start;
    rtcReleaseGeometry(geometry);
    const enum RTCError fault = rtcGetDeviceError(peer->device);
    return fault == RTC_ERROR_NONE || error_set(error, "Embree failed with error %d", fault);
}

static bool take_looks(PeerScene *peer, const FlatScene *flat, Error *error)
{
    if (flat->colors_count > 0)
        return error_set(error, "the peer does not draw colors of vertices");
    peer->looks = memory_raw(flat->triangle_count, sizeof *peer->looks, error);
    if (peer->looks == NULL)
        return false;
    for (uint32_t i = 0; i < flat->triangle_count; i++) {
        const TriangleData *triangle = &flat->triangles[i];
        peer->looks[triangle->id - flat->sphere_count] = (TriangleLook){
            .material = triangle->material & ~TRIANGLE_MARKS, .shading = triangle->shading};
    }
    return true;
}

// Moves the arrays for shading from flat to peer.
static bool take_flat(PeerScene *peer, FlatScene *flat, Error *error)
{
    peer->triangle_count = flat->triangle_count;
    peer->light_count = flat->light_count;
    peer->material_count = flat->material_count;
    peer->ambient = flat->ambient;
    for (int channel = 0; channel < 3; channel++)
        peer->background[channel] = flat->background[channel];
    if (!take_looks(peer, flat, error))
        return false;
    peer->normals = flat->normals;
    peer->materials = flat->materials;
    peer->lights = flat->lights;
    flat->normals = NULL;
    flat->materials = NULL;
    flat->lights = NULL;
    return true;
}

static bool knows_materials(const Scene *scene)
{
    for (size_t i = 0; i < scene->materials.count; i++) {
        const Material *material = &scene->materials.data[i];
        if (material->shader == SHADER_BLINN_PHONG && material->exponent == UINT32_MAX)
            return false;
    }
    return true;
}

static bool fill(PeerScene *peer, const Scene *scene, const PeerSettings *settings, Error *error)
{
    const Normalization normalization = normalization_of(scene);
    const Bvh no_tree = {0};
    Triangles triangles = {0};
    FlatScene flat = {0};
    const FlatSource source = {.scene = scene,
                               .triangles = &triangles,
                               .bvh = &no_tree,
                               .normalization = &normalization,
                               .layout = NODES_PAIR};
    peer->camera =
        camera_make(&scene->viewpoints.data[0], &normalization, peer->width, peer->height, 1);
    const bool ok = triangles_make(&triangles, scene, &normalization, NULL, error) &&
                    flat_make(&flat, &source, error) && take_flat(peer, &flat, error) &&
                    build(peer, &triangles, settings, error);
    flat_free(&flat);
    triangles_free(&triangles);
    return ok;
}

bool peer_scene_open(PeerScene *peer, const char *path, const PeerSettings *settings, Error *error)
{
    Scene scene = {0};
    *peer = (PeerScene){0};
    bool ok = scn_load(&scene, path, &(SceneLoadOptions){0}, error);
    if (ok && (scene.spheres.count > 0 || scene_triangle_count(&scene) == 0))
        ok = error_set(error, "%s: embree_peer draws only triangles, at least one", path);
    if (ok && !knows_materials(&scene))
        ok = error_set(error, "%s: embree_peer accepts only integer shininess up to 1024", path);
    peer->width = settings->width > 0 ? settings->width : scene.width;
    peer->height = settings->height > 0 ? settings->height : scene.height;
    peer->max_level = scene.max_level;
    ok = ok && fill(peer, &scene, settings, error);
    scene_free(&scene);
    return ok;
}

void peer_scene_close(PeerScene *peer)
{
    if (peer->scene != NULL)
        rtcReleaseScene(peer->scene);
    if (peer->device != NULL)
        rtcReleaseDevice(peer->device);
    free(peer->looks);
    free(peer->normals);
    free(peer->materials);
    free(peer->lights);
    *peer = (PeerScene){0};
}
