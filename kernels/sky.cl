// SPDX-License-Identifier: MIT
// Finds blocks of pixels in which certainly no camera ray hits anything. Two kinds of separating
// planes are tested: sides of the box around all primitives, and sides of the pyramid of the
// block's rays. The rays of an orthographic camera fill a prism instead.
//
// Invariant: a block with a ray that may hit something is never sky (docs/numerics.md, B17).

// The range of a block's rays, in half sub-pixels from the picture's center (camera.cl).
typedef struct {
    float left, right, top, bottom;
} RayRange;

static inline RayRange block_range(const FrameData *frame, uint left, uint top)
{
    const int step = 2 * (int)frame->samples;
    const int x = step * (int)(frame->tile_x + left) - (int)(frame->width * frame->samples);
    const int y = step * (int)(frame->tile_y + top) - (int)(frame->height * frame->samples);
    return (RayRange){(float)x, (float)(x + step * BLOCK), (float)y, (float)(y + step * BLOCK)};
}

// Returns whether the eye is beyond a side of the box and all rays lead away from this side.
static inline bool leave_box(const FrameData *frame, const RayRange *range)
{
    const float across = 0.5f * (range->left + range->right), width = range->right - across;
    const float along = 0.5f * (range->top + range->bottom), height = range->bottom - along;
    float size = 0.0f, up = 0.0f, down = 0.0f;
    for (uint axis = 0; axis < 3; axis++) {
        const float x = frame->camera.right_step[axis], y = frame->camera.down_step[axis];
        const float middle = fma(across, x, fma(along, y, frame->camera.forward[axis]));
        const float spread = fma(width, fabs(x), height * fabs(y));
        const float eye = frame->camera.eye[axis];
        size = max(size, fabs(middle) + spread);
        up = eye > frame->high[axis] ? max(up, middle - spread) : up;
        down = eye < frame->low[axis] ? max(down, -middle - spread) : down;
    }
    return max(up, down) > SKY_SLACK * size;
}

// Returns whether the box is outside one of the four planes that bound the block's rays. In
// perspective, the planes contain the eye, and their normals depend on the block's position. In
// orthographic pictures, the normals are constant, and the planes shift with the block.
static inline bool pass_box(const FrameData *frame, const RayRange *range)
{
    const float *right = frame->camera.right_step, *down = frame->camera.down_step;
    const float *forward = frame->camera.forward;
    const float4 places = (float4)(range->left, -range->right, range->top, -range->bottom);
    const float4 turn = frame->camera.orthographic != 0 ? 0.0f : places;
    const float4 move = places - turn;
    float4 height = 0.0f, size = 0.0f, moved = 0.0f;
    float reach = 0.0f;
    for (uint axis = 0; axis < 3; axis++) {
        const uint i = (axis + 1) % 3, j = (axis + 2) % 3;
        const float across = down[i] * forward[j] - down[j] * forward[i];
        const float along = right[i] * forward[j] - right[j] * forward[i];
        const float ahead = down[i] * right[j] - down[j] * right[i];
        const float low = frame->low[axis] - frame->camera.eye[axis];
        const float high = frame->high[axis] - frame->camera.eye[axis];
        // The inward normals of the left, right, upper and lower planes.
        const float4 normal = (float4)(across, -across, -along, along) + turn * ahead;
        const float4 shift = move * ahead * forward[axis];
        height += max(low * normal, high * normal) + shift;
        moved += fabs(shift);
        size += fabs(normal);
        reach = max(reach, max(fabs(low), fabs(high)));
    }
    return any(height < -SKY_SLACK * (reach * size + moved));
}

// Returns true only if no ray of the block at (`left`, `top`) hits anything (docs/numerics.md,
// B17).
static inline bool is_sky(const FrameData *frame, uint left, uint top)
{
    const RayRange range = block_range(frame, left, top);
    return (frame->camera.orthographic == 0 && leave_box(frame, &range)) || pass_box(frame, &range);
}

// Returns the color of rays that hit nothing.
static inline Real3 sky_color(const FrameData *frame)
{
    return scaled3(0x1p-32f, in_steps3(load_private3(frame->background)));
}
