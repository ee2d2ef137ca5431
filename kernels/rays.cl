// SPDX-License-Identifier: MIT
// The kernel of clrt check traces an array of rays with the search that renders pictures. It is
// compiled after render.cl, and only if requested.

static inline void store_distances(global float *distances, Mask lanes, Real t)
{
    const uint bits = lane_bits(lanes);
    for (uint lane = 0; lane < CLRT_LANES; lane++)
        if (bits >> lane & 1)
            distances[lane] = (float)((const Scalar *)&t)[lane];
}

// A ray is eight floats: an origin and a direction, each padded to four components. A work-item
// traces one ray per lane, in consecutive order; rays past the count are ignored. distances
// receives each ray's hit distance, INFINITY without a hit.
kernel void trace_rays(const FrameData frame, global const SphereData *spheres,
                       global const Node *nodes, global const Triangles *triangles,
                       global const float *rays, uint count, global float *distances)
{
    const uint start = CLRT_LANES * (uint)get_global_id(0);
    if (start >= count)
        return;
    Tally tally = {0};
    const Tracer tracer = {0, 0, spheres, nodes, triangles, 0, 0, &frame, &tally};
    const UInt place = start + LANE_Y * PACKET_WIDTH + LANE_X;
    const Record record = record_at(rays, min(place, (UInt)(count - 1)) * 8);
    const Ray ray = {record_real3(&record, 0, 1),
                     record_real3(&record, 4, 1),
                     NOTHING,
                     NOTHING,
                     RAY_CAMERA,
                     place < count};
    store_distances(distances + start, ray.active, nearest_hit(&tracer, &ray).t);
}
