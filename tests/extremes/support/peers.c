// SPDX-License-Identifier: MIT
// Traces the rays with Embree's call for single rays, which Embree's documentation names as the
// reference for the other calls.
#include "peers.h"

#include "shapes.h"

#ifdef WITH_EMBREE
#include <embree3/rtcore.h>

// Stores the scene coordinates of a normalized point, rounded to float.
static void fill_point(float place[3], const float point[3], const Normalization *normalization)
{
    shape_store(place, denormalize_point(normalization, vec3_of_floats(point)));
}

static void fill_triangles(RTCGeometry geometry, const Stage *stage)
{
    const Triangles *triangles = &stage->triangles;
    float(*points)[3] =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof *points, triangles->point_count);
    uint32_t(*corners)[3] = rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof *corners, triangles->count);
    assert_true(points != NULL && corners != NULL);
    for (size_t i = 0; i < triangles->point_count; i++)
        fill_point(points[i], triangles->points[i], &stage->normalization);
    for (size_t i = 0; i < triangles->count; i++)
        for (int corner = 0; corner < 3; corner++)
            corners[i][corner] = triangles->corners[i][corner];
}

static RTCScene make_scene(RTCDevice device, const Stage *stage, enum RTCSceneFlags flags)
{
    RTCScene scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSceneFlags(scene, flags);
    fill_triangles(geometry, stage);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    assert_int_equal(rtcGetDeviceError(device), RTC_ERROR_NONE);
    return scene;
}

void peers_open(Peers *peers, const Stage *stage)
{
    *peers = (Peers){.normalization = stage->normalization};
    if (getenv("CLRT_TEST_PEERS") == NULL || stage->flat.sphere_count > 0 ||
        stage->triangles.count == 0)
        return;
    peers->device = rtcNewDevice("threads=2");
    assert_non_null(peers->device);
    peers->scenes[BY_EMBREE_DEFAULT] = make_scene(peers->device, stage, RTC_SCENE_FLAG_NONE);
    peers->scenes[BY_EMBREE_ROBUST] = make_scene(peers->device, stage, RTC_SCENE_FLAG_ROBUST);
}

void peers_close(Peers *peers)
{
    if (peers->device == NULL)
        return;
    rtcReleaseScene(peers->scenes[BY_EMBREE_DEFAULT]);
    rtcReleaseScene(peers->scenes[BY_EMBREE_ROBUST]);
    rtcReleaseDevice(peers->device);
    *peers = (Peers){0};
}

static TestHit trace(RTCScene scene, const TestRay *ray, const Normalization *normalization)
{
    float origin[3], direction[3];
    struct RTCIntersectContext context;
    struct RTCRayHit traced = {.ray.tfar = INFINITY, .ray.mask = UINT32_MAX};
    rtcInitIntersectContext(&context);
    fill_point(origin, ray->origin, normalization);
    shape_store(direction, vec3_scale(vec3_of_floats(ray->direction), 1 / normalization->scale));
    traced.ray.org_x = origin[0];
    traced.ray.org_y = origin[1];
    traced.ray.org_z = origin[2];
    traced.ray.dir_x = direction[0];
    traced.ray.dir_y = direction[1];
    traced.ray.dir_z = direction[2];
    traced.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &traced);
    if (traced.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return (TestHit){INFINITY, NOTHING};
    return (TestHit){traced.ray.tfar, traced.hit.primID};
}

TestHit *peers_trace(const Peers *peers, RayTracer tracer, Rays rays)
{
    TestHit *hits = require_memory(rays.count, sizeof *hits);
    for (size_t i = 0; i < rays.count; i++)
        hits[i] = trace(peers->scenes[tracer], &rays.data[i], &peers->normalization);
    return hits;
}
#else
void peers_open(Peers *peers, const Stage *stage)
{
    (void)stage;
    *peers = (Peers){0};
}

void peers_close(Peers *peers)
{
    (void)peers;
}

TestHit *peers_trace(const Peers *peers, RayTracer tracer, Rays rays)
{
    (void)peers, (void)tracer, (void)rays;
    return NULL;
}
#endif
