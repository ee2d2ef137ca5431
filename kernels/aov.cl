// SPDX-License-Identifier: MIT
// The kernels for the channels of --aov, except certainty (certify.cl). trace_paths writes the
// first hit of the ray through each pixel's center. count_tests writes the cost of each pixel. Both
// follow rays with paths_step (trace.cl). PathData (shared.h) defines the values, which
// host/render/aov.c converts to the scene's units. The kernels are compiled after render.cl, and
// only if requested.

static inline Mask light_reaches(const Tracer *tracer, uint index, const Surface *surface, Mask met)
{
    const LightSample light = sample_light(tracer, index, surface, met);
    if (!any_lane(light.faces))
        return light.faces;
    LightPath path;
    Ray ray = ray_to_light(tracer, surface, &light);
    light_blockers(tracer, &ray, 1, light.position, &path);
    return light.faces && path.blockers->id == NOTHING;
}

static inline UInt lights_reaching(const Tracer *tracer, const Surface *surface, Mask met)
{
    UInt lights = 0;
    for (uint index = 0; index < tracer->frame->light_count; index++)
        lights += light_reaches(tracer, index, surface, met) ? (UInt)(1) : (UInt)(0);
    return lights;
}

// The members of PathData, with one path in each lane.
typedef struct {
    Real3 point, normal;
    Real depth;
    UInt primitive, material, lights, bounces;
} PathLanes;

static inline PathLanes first_hit(const Tracer *tracer, const Path *path, const Hit *hit)
{
    const Mask met = path->met;
    const Real3 zero = real3_of(0.0f, 0.0f, 0.0f);
    return (PathLanes){.point = choose3(met, path->surface.point, zero),
                       .normal = choose3(met, path->surface.normal, zero),
                       .depth = met ? hit->t : (Real)(INFINITY),
                       .primitive = met ? hit->id : (UInt)(NOTHING),
                       .material = met ? path->surface.material : (UInt)(NOTHING),
                       .lights = lights_reaching(tracer, &path->surface, met)};
}

static NOT_INLINE PathLanes describe_path(const Tracer *tracer, Ray ray)
{
    PathLanes data = {.depth = INFINITY, .primitive = NOTHING, .material = NOTHING};
    Paths paths;
    paths_start_one(&paths, ray);
    for (bool any = paths_begin(tracer, &paths); any; any = paths_continue(tracer, &paths)) {
        paths_step(tracer, &paths);
        if (paths.level > 1)
            data.bounces =
                max(data.bounces, paths.rays->active ? last_level(&paths, 0) : (UInt)(0));
        else if (any_lane(paths.paths->met))
            data = first_hit(tracer, paths.paths, paths.hits);
    }
    return data;
}

#define LANE_OF(type, value, lane) (((const type *)&(value))[lane])

static inline void store_path(global PathData *data, const PathLanes *path, uint lane)
{
    store_lane(data->point, &path->point, lane);
    store_lane(data->normal, &path->normal, lane);
    data->depth = (float)LANE_OF(Scalar, path->depth, lane);
    data->primitive = LANE_OF(uint, path->primitive, lane);
    data->material = LANE_OF(uint, path->material, lane);
    data->lights = LANE_OF(uint, path->lights, lane);
    data->bounces = LANE_OF(uint, path->bounces, lane);
}

// Computes the index of a lane's pixel in the tile. Returns false if the pixel lies outside the
// tile.
static inline bool lane_place(const FrameData *frame, uint2 corner, uint lane, size_t *place)
{
    const uint column = corner.x + lane % PACKET_WIDTH, row = corner.y + lane / PACKET_WIDTH;
    *place = (size_t)row * frame->tile_width + column;
    return column < frame->tile_width && row < frame->tile_height;
}

// Fills `paths` with one entry per pixel of the tile. The frame must have one sample per pixel.
kernel void trace_paths(TRACER_ARGUMENTS, global PathData *paths)
{
    Tally tally = {0};
    const Tracer tracer = TRACER(&tally);
    const uint left = BLOCK * (uint)get_global_id(0), top = BLOCK * (uint)get_global_id(1);
    for (uint y = top; y < min(top + BLOCK, frame.tile_height); y += PACKET_HEIGHT)
        for (uint x = left; x < min(left + BLOCK, frame.tile_width); x += PACKET_WIDTH) {
            size_t place;
            const uint2 corner = (uint2)(x, y);
            const Places pixels = places_at(&frame, corner);
            const Ray ray = camera_ray(&frame, pixels.x, pixels.y, pixels.active);
            const PathLanes path = describe_path(&tracer, ray);
            for (uint lane = 0; lane < CLRT_LANES; lane++)
                if (lane_place(&frame, corner, lane, &place))
                    store_path(&paths[place], &path, lane);
        }
}

// Fills `tallies` with TALLY_KINDS counts per pixel of the tile, summed over the pixel's samples.
// Each pixel is traced alone, because the rays of a packet would share tests.
kernel void count_tests(TRACER_ARGUMENTS, global uint *tallies)
{
    const uint left = BLOCK * (uint)get_global_id(0), top = BLOCK * (uint)get_global_id(1);
    for (uint y = top; y < min(top + BLOCK, frame.tile_height); y += PACKET_HEIGHT)
        for (uint x = left; x < min(left + BLOCK, frame.tile_width); x += PACKET_WIDTH)
            for (uint lane = 0; lane < CLRT_LANES; lane++) {
                size_t place;
                if (!lane_place(&frame, (uint2)(x, y), lane, &place))
                    continue;
                Tally tally = {0};
                const Tracer tracer = TRACER(&tally);
                Places pixels[PACKETS];
                Real3 colors[PACKETS];
                for (uint i = 0; i < PACKETS; i++) {
                    pixels[i] = places_at(&frame, (uint2)(x, y));
                    pixels[i].active = i == 0 ? lanes_of(1u << lane) : (Mask)(0);
                }
                pixel_colors(&tracer, pixels, colors);
                store_tally(tallies, place, &tally);
            }
}
