// SPDX-License-Identifier: MIT
// The kernel of clrt check traces arrays of rays instead of a picture's, with the same search. It
// is compiled after render.cl, and only if requested.

// Returns the lanes that share an origin and can form one packet, as camera rays do. The others
// are traced later.
static inline Mask share_origin(Real3 origin, Mask left)
{
    return left && as_bits(origin.x) == as_bits(first_real(origin.x, left)) &&
           as_bits(origin.y) == as_bits(first_real(origin.y, left)) &&
           as_bits(origin.z) == as_bits(first_real(origin.z, left));
}

// Returns the camera rays of those lanes; the other lanes copy the first.
static inline Ray shared_ray(Real3 origin, Real3 direction, Mask lanes)
{
    const Real3 start = real3_of(first_real(origin.x, lanes), first_real(origin.y, lanes),
                                 first_real(origin.z, lanes));
    const Real3 first = real3_of(first_real(direction.x, lanes), first_real(direction.y, lanes),
                                 first_real(direction.z, lanes));
    return (Ray){start, choose3(lanes, direction, first), NOTHING, NOTHING, RAY_CAMERA, lanes};
}

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
    const Real3 origin = record_real3(&record, 0, 1), direction = record_real3(&record, 4, 1);
    Mask left = place < count;
    while (any_lane(left)) {
        const Mask lanes = share_origin(origin, left);
        const Ray ray = shared_ray(origin, direction, lanes);
        const Hit hit = nearest_hit(&tracer, &ray);
        store_distances(distances + start, lanes, hit.t);
        left = left && !lanes;
    }
}
