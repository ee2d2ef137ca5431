// SPDX-License-Identifier: MIT
// Takes the arrays that clrt uploads to its device, so that both renderers use the same floats.
// Embree gets the spheres as points with radii, and the triangles as an indexed mesh, in its own
// buffers.
#include "peer_scene.h"

#include "accel/flat.h"
#include "base/clock.h"
#include "scene/camera.h"
#include "scene/scn.h"

#include <stdio.h>
#include <stdlib.h>

typedef struct {
    const SphereData *spheres;
    uint32_t sphere_count;
    const Triangles *triangles;
} Shapes;

static bool fill_spheres(RTCGeometry geometry, const Shapes *shapes)
{
    float(*points)[4] =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                sizeof *points, shapes->sphere_count);
    for (uint32_t i = 0; points != NULL && i < shapes->sphere_count; i++) {
        for (int axis = 0; axis < 3; axis++)
            points[i][axis] = shapes->spheres[i].center[axis];
        points[i][3] = shapes->spheres[i].radius;
    }
    return points != NULL;
}

// Each triangle has its corners in clrt's stored order, which is also the order of its normals.
static bool fill_triangles(RTCGeometry geometry, const Shapes *shapes)
{
    const Triangles *triangles = shapes->triangles;
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

static void add_geometry(const PeerScene *peer, const Shapes *shapes, PeerGeometry kind,
                         enum RTCBuildQuality quality)
{
    const bool is_round = kind == PEER_SPHERES;
    RTCGeometry geometry = rtcNewGeometry(peer->device, is_round ? RTC_GEOMETRY_TYPE_SPHERE_POINT
                                                                 : RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, quality);
    if (is_round ? fill_spheres(geometry, shapes) : fill_triangles(geometry, shapes))
        rtcAttachGeometryByID(peer->scene, geometry, kind);
    rtcReleaseGeometry(geometry);
}

static bool build(PeerScene *peer, const Shapes *shapes, const PeerSettings *settings, Error *error)
{
    char config[64];
    snprintf(config, sizeof config, "threads=%u" DEVICE_CONFIG, settings->threads);
    peer->device = rtcNewDevice(config);
    peer->scene = rtcNewScene(peer->device);
    rtcSetSceneBuildQuality(peer->scene, settings->quality);
    rtcSetSceneFlags(peer->scene, settings->robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    const bool is_present[] = {
        [PEER_SPHERES] = shapes->sphere_count > 0, [PEER_TRIANGLES] = shapes->triangles->count > 0};
    for (PeerGeometry kind = PEER_SPHERES; kind <= PEER_TRIANGLES; kind++)
        if (is_present[kind])
            add_geometry(peer, shapes, kind, settings->quality);
    const double start = clock_seconds();
    for (PeerGeometry kind = PEER_SPHERES; kind <= PEER_TRIANGLES; kind++)
        if (is_present[kind] && rtcGetGeometry(peer->scene, kind) != NULL)
            rtcCommitGeometry(rtcGetGeometry(peer->scene, kind));
    rtcCommitScene(peer->scene);
    peer->build_seconds = clock_seconds() - start;
    const enum RTCError fault = rtcGetDeviceError(peer->device);
    return fault == RTC_ERROR_NONE || error_set(error, "Embree failed with error %d", fault);
}

static bool take_looks(PeerScene *peer, const FlatScene *flat, Error *error)
{
    if (flat->colors_count > 0)
        return error_set(error, "the peer does not draw colors of vertices");
    const size_t count = (size_t)flat->sphere_count + flat->triangle_count;
    peer->looks = memory_raw(count, sizeof *peer->looks, error);
    if (peer->looks == NULL)
        return false;
    for (uint32_t i = 0; i < flat->sphere_count; i++)
        peer->looks[i] = (TriangleLook){.material = flat->spheres[i].material, .shading = NOTHING};
    for (uint32_t i = 0; i < flat->triangle_count; i++) {
        const TriangleData *triangle = &flat->triangles[i];
        peer->looks[triangle->id] = (TriangleLook){.material = triangle->material & ~TRIANGLE_MARKS,
                                                   .shading = triangle->shading};
    }
    return true;
}

// Moves the arrays for shading from flat to peer.
static bool take_flat(PeerScene *peer, FlatScene *flat, Error *error)
{
    peer->sphere_count = flat->sphere_count;
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
    const bool ok =
        triangles_make(&triangles, scene, &normalization, NULL, error) &&
        flat_make(&flat, &source, error) && take_flat(peer, &flat, error) &&
        build(peer, &(Shapes){flat.spheres, flat.sphere_count, &triangles}, settings, error);
    flat_free(&flat);
    triangles_free(&triangles);
    return ok;
}

bool peer_scene_open(PeerScene *peer, const char *path, const PeerSettings *settings, Error *error)
{
    Scene scene = {0};
    *peer = (PeerScene){0};
    bool ok = scn_load(&scene, path, &(SceneLoadOptions){0}, error);
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
