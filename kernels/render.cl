// SPDX-License-Identifier: MIT
// The kernel of the `ray` family: one work-item renders one pixel of a tile.
#include "trace.cl"

// Samples are summed as integers of 2^-32: exact in any order, so that a constant color stays
// itself however many samples there are.
static inline ulong3 fixed_point(float3 color)
{
    return convert_ulong3_rte(clamp(color, 0.0f, 1.0f) * 0x1p32f);
}

static inline float3 pixel_color(const SceneView *scene, const FrameData *frame, uint2 pixel,
                                 Tally *tally)
{
    ulong3 sum = (ulong3)(0);
    for (uint row = 0; row < frame->samples; row++)
        for (uint column = 0; column < frame->samples; column++) {
            const Ray ray = camera_ray(frame, pixel.x * frame->samples + column,
                                       pixel.y * frame->samples + row);
            sum += fixed_point(trace(scene, frame, ray, tally));
        }
    const ulong count = (ulong)frame->samples * frame->samples;
    if (CLRT_STATISTICS)
        tally->camera_rays += (uint)count;
    return convert_float3((sum + count / 2) / count) * 0x1p-32f;
}

static inline void store_tally(global uint *counts, const Tally *tally)
{
    counts[TALLY_CAMERA_RAYS] = tally->camera_rays;
    counts[TALLY_SHADOW_RAYS] = tally->shadow_rays;
    counts[TALLY_REFLECTED_RAYS] = tally->reflected_rays;
    counts[TALLY_SHADED_POINTS] = tally->shaded_points;
    counts[TALLY_CAMERA_HITS] = tally->camera_hits;
    counts[TALLY_TRIANGLE_TESTS] = tally->triangle_tests;
    counts[TALLY_BOX_TESTS] = tally->box_tests;
    counts[TALLY_SPHERE_TESTS] = tally->sphere_tests;
}

// pixels holds tile_width * tile_height colors of three floats, rows from the top; tallies as many
// times TALLY_KINDS counts, written only where statistics are compiled in.  The range is padded to
// whole work-groups.
kernel void render_tile(const FrameData frame, global const PointLight *lights,
                        global const Material *materials, global const SphereData *spheres,
                        global const BvhPair *nodes, global const TriangleData *triangles,
                        global const TriangleLook *looks, global const CornerNormals *normals,
                        global float *pixels, global uint *tallies)
{
    const uint column = get_global_id(0), row = get_global_id(1);
    if (column >= frame.tile_width || row >= frame.tile_height)
        return;
    const SceneView scene = {lights, materials, spheres, nodes, triangles, normals};
    Tally tally = {0};
    const uint2 pixel = (uint2)(frame.tile_x + column, frame.tile_y + row);
    const float3 color = pixel_color(&scene, &frame, pixel, &tally);
    const size_t place = (size_t)row * frame.tile_width + column;
    vstore3(color, place, pixels);
    if (CLRT_STATISTICS)
        store_tally(tallies + place * TALLY_KINDS, &tally);
}
