// SPDX-License-Identifier: MIT
// Rays go one by one, which Embree's documentation calls the reference for its other calls.
#include "peers.h"

#include "check.h"

#include <embree3/rtcore.h>
#include <stdlib.h>

// Lengths in the file's coordinates.
static float in_file(const Normalization *normalization, double length)
{
    return (float)(length / normalization->scale);
}

static float place_in_file(double coordinate, double center, const Normalization *normalization)
{
    return (float)(coordinate / normalization->scale + center);
}

static void fill_point(float place[3], const float point[3], const Normalization *normalization)
{
    const Vec3 c = normalization->center;
    place[0] = place_in_file((double)point[0], c.x, normalization);
    place[1] = place_in_file((double)point[1], c.y, normalization);
    place[2] = place_in_file((double)point[2], c.z, normalization);
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
    peers->plain = make_scene(peers->device, stage, RTC_SCENE_FLAG_NONE);
    peers->robust = make_scene(peers->device, stage, RTC_SCENE_FLAG_ROBUST);
}

void peers_close(Peers *peers)
{
    if (peers->device == NULL)
        return;
    rtcReleaseScene(peers->plain);
    rtcReleaseScene(peers->robust);
    rtcReleaseDevice(peers->device);
    *peers = (Peers){0};
}

static TestHit trace(RTCScene scene, const TestRay *ray, const Normalization *normalization)
{
    float origin[3];
    struct RTCIntersectContext context;
    struct RTCRayHit traced = {.ray.tfar = INFINITY, .ray.mask = UINT32_MAX};
    rtcInitIntersectContext(&context);
    fill_point(origin, ray->origin, normalization);
    traced.ray.org_x = origin[0];
    traced.ray.org_y = origin[1];
    traced.ray.org_z = origin[2];
    traced.ray.dir_x = in_file(normalization, (double)ray->direction[0]);
    traced.ray.dir_y = in_file(normalization, (double)ray->direction[1]);
    traced.ray.dir_z = in_file(normalization, (double)ray->direction[2]);
    traced.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &traced);
    if (traced.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return (TestHit){INFINITY, NOTHING};
    return (TestHit){traced.ray.tfar, traced.hit.primID};
}

static size_t count_wrong(RTCScene scene, const Peers *peers, const TestRay *rays, size_t count,
                          const Judgment *judgment)
{
    Error error = {0};
    TestHit *hits = memory_raw(count, sizeof *hits, &error);
    require(hits != NULL, &error);
    for (size_t i = 0; i < count; i++)
        hits[i] = trace(scene, &rays[i], &peers->normalization);
    const size_t wrong = judgment->count_wrong(judgment->context, rays, hits, count);
    free(hits);
    return wrong;
}

PeerFails peers_judge(const Peers *peers, const TestRay *rays, size_t count,
                      const Judgment *judgment)
{
    if (peers->device == NULL)
        return (PeerFails){0};
    return (PeerFails){true, count_wrong(peers->plain, peers, rays, count, judgment),
                       count_wrong(peers->robust, peers, rays, count, judgment)};
}
