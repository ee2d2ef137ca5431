// SPDX-License-Identifier: MIT
// Each pass lists one sample for each open gap (scan_lines.h), and then the first samples of all
// new lines. When all gaps are closed, pixels with new lines may get further lines.
#include "refine/adaptive.h"

#include <stdlib.h>
#include <string.h>

#define PIXELS_MOST ((uint64_t)1 << 31)

// Gaps are bisected until their error is at most GAP_PART of the threshold. The fraction is small,
// because bisecting a gap takes one sample, but a new line takes at least three. Bands are divided
// if the bend of the lines' mean colors causes an error of more than BEND_PART of the threshold.
#define GAP_PART  0.145f
#define BEND_PART 0.17f

// The gaps of a line of level 0, which has samples at its middle and at its ends. Lines of deeper
// levels have twice as many gaps.
#define LINE_GAPS 2

// The places that a pass samples.
typedef ARRAY(SamplePlace) PlaceList;

typedef enum { SIDE_LEFT, SIDE_RIGHT, SIDE_ABOVE, SIDE_BELOW } Side;

// Returns the pixel's neighbor on that side, or the pixel itself at the picture's border.
static uint32_t neighbor_of(const Adaptive *adaptive, uint32_t pixel, Side side)
{
    const uint32_t width = adaptive->frame.width, height = adaptive->frame.height;
    const uint32_t x = pixel % width, y = pixel / width;
    const uint32_t neighbors[] = {pixel - (x > 0), pixel + (x + 1 < width),
                                  y > 0 ? pixel - width : pixel,
                                  y + 1 < height ? pixel + width : pixel};
    return neighbors[side];
}

// Returns whether the pixel's lines are columns. They are if a thin part crosses columns or,
// without a thin part, if colors change more along columns.
static bool has_columns(const Adaptive *adaptive, uint32_t pixel)
{
    const ThinAxis axis = (ThinAxis)adaptive->thin_parts.axes[pixel];
    const SampleData *center = &adaptive->centers[pixel];
    float changes[4];
    for (int side = 0; side < 4; side++)
        changes[side] =
            sample_difference(center, &adaptive->centers[neighbor_of(adaptive, pixel, (Side)side)]);
    return axis <= THIN_TOUCHED ? changes[SIDE_ABOVE] + changes[SIDE_BELOW] >
                                      changes[SIDE_LEFT] + changes[SIDE_RIGHT]
                                : axis == THIN_COLUMNS;
}

static bool add_pixel(Adaptive *adaptive, uint32_t pixel, Error *error)
{
    const ThinParts *parts = &adaptive->thin_parts;
    const size_t first = thin_parts_first_probe(parts, pixel);
    const size_t end = thin_parts_first_probe(parts, pixel + 1);
    const RefinedPixel refined = {.pixel = pixel,
                                  .probes = (uint32_t)first,
                                  .end = (uint32_t)end,
                                  .samples = 1,
                                  .has_columns = has_columns(adaptive, pixel)};
    adaptive->refined[pixel] = (uint32_t)adaptive->lines.pixels.count;
    return scan_lines_add(&adaptive->lines, &refined, error);
}

// Inserts a place into an ascending list, unless the list has the place. The list's first place is
// 0. Returns the new number of places.
static uint32_t insert_place(LineSample *samples, uint32_t count, uint32_t place)
{
    uint32_t i = count;
    while (samples[i - 1].place > place)
        i--;
    if (samples[i - 1].place == place)
        return count;
    memmove(&samples[i + 1], &samples[i], (count - i) * sizeof *samples);
    samples[i].place = place;
    return count + 1;
}

// Stores in `samples` the places at which a new line is sampled, in ascending order. Returns the
// number of these places.
static uint32_t first_places(const Adaptive *adaptive, const ScanLine *line, LineSample *samples)
{
    const Probe *probes = adaptive->lines.probes;
    const RefinedPixel *pixel = &adaptive->lines.pixels.data[line->pixel];
    const uint32_t gaps = line->height < band_height(0) ? 2 * LINE_GAPS : LINE_GAPS;
    uint32_t count = 0;
    for (; count <= gaps; count++)
        samples[count].place = count * (REFINE_GRID - 1) / gaps;
    for (uint32_t i = pixel->probes; i < pixel->end; i++)
        if (probes[i].line == line->middle)
            count = insert_place(samples, count, probes[i].place);
    return count;
}

// Returns the position in the picture of a place on a line.
static SamplePlace position_of(const Adaptive *adaptive, const ScanLine *line, uint32_t place)
{
    const RefinedPixel *pixel = &adaptive->lines.pixels.data[line->pixel];
    const uint32_t x = pixel->pixel % adaptive->frame.width * REFINE_GRID;
    const uint32_t y = pixel->pixel / adaptive->frame.width * REFINE_GRID;
    return pixel->has_columns ? (SamplePlace){x + line->middle, y + place}
                              : (SamplePlace){x + place, y + line->middle};
}

static bool is_center(const ScanLine *line, uint32_t place)
{
    return line->middle == REFINE_GRID / 2 && place == REFINE_GRID / 2;
}

// Lists one sample for each open gap, and then the first samples of new lines.
static bool list_places(const Adaptive *adaptive, PlaceList *places, Error *error)
{
    const ScanLines *lines = &adaptive->lines;
    for (size_t i = 0; i < lines->gaps.count; i++) {
        const Gap *gap = &lines->gaps.data[i];
        const SamplePlace place =
            position_of(adaptive, &lines->lines.data[gap->line], scan_gap_place(gap));
        if (!array_push(places, place, error))
            return false;
    }
    for (size_t i = lines->opened; i < lines->lines.count; i++) {
        const ScanLine *line = &lines->lines.data[i];
        LineSample samples[REFINE_GRID];
        const uint32_t count = first_places(adaptive, line, samples);
        for (uint32_t k = 0; k < count; k++)
            if (!is_center(line, samples[k].place) &&
                !array_push(places, position_of(adaptive, line, samples[k].place), error))
                return false;
    }
    return true;
}

// Adds the pixel's neighbor on a side, unless the neighbor is refined already or its center differs
// from the sample by at most adaptive->most.
static bool spread(Adaptive *adaptive, uint32_t pixel, Side side, const SampleData *sample,
                   Error *error)
{
    const uint32_t neighbor = neighbor_of(adaptive, pixel, side);
    if (adaptive->refined[neighbor] != 0 ||
        !(sample_difference(sample, &adaptive->centers[neighbor]) > adaptive->most))
        return true;
    return add_pixel(adaptive, neighbor, error);
}

// Opens the first line that has no samples yet. Takes the line's samples from `data`, and stores
// the number of these samples in *count.
static bool open_line(Adaptive *adaptive, const SampleData *data, uint32_t *count, Error *error)
{
    const ScanLine line = adaptive->lines.lines.data[adaptive->lines.opened];
    RefinedPixel *pixel = &adaptive->lines.pixels.data[line.pixel];
    const uint32_t place = pixel->pixel, turn = pixel->has_columns ? SIDE_ABOVE : 0;
    LineSample samples[REFINE_GRID];
    const uint32_t all = first_places(adaptive, &line, samples);
    *count = 0;
    for (uint32_t i = 0; i < all; i++)
        samples[i].data =
            is_center(&line, samples[i].place) ? adaptive->centers[place] : data[(*count)++];
    pixel->samples += *count;
    bool ok = scan_lines_open(&adaptive->lines, samples, all, error);
    // Sides are as for rows. If the lines are columns, `turn` exchanges left and above, and right
    // and below.
    for (uint32_t i = 0; i < all; i++) {
        const bool is_beside[] = {i == 0, i + 1 == all, line.middle < line.height,
                                  line.middle + line.height >= REFINE_GRID};
        for (uint32_t side = 0; ok && side < 4; side++)
            if (is_beside[side])
                ok = spread(adaptive, place, (Side)(side ^ turn), &samples[i].data, error);
    }
    return ok;
}

// Traces the samples of open gaps and new lines. If the observer stops the pass, drops all samples
// of the pass.
static bool trace_pass(Adaptive *adaptive, PlaceList *places, Error *error)
{
    ScanLines *lines = &adaptive->lines;
    const size_t end = lines->lines.count;
    places->count = 0;
    if (!list_places(adaptive, places, error))
        return false;
    const uint32_t count = (uint32_t)places->count;
    SampleData *samples = memory_raw(count, sizeof *samples, error), *next = samples;
    const SampleList list = {places->data, samples, count, 0};
    bool ok = samples != NULL && sampler_trace(adaptive->setup.renderer, &adaptive->frame, &list,
                                               adaptive->setup.observer, error);
    if (ok && sampler_is_whole(adaptive->setup.renderer)) {
        adaptive->samples += count;
        next += lines->gaps.count;
        ok = scan_lines_split_gaps(lines, samples, error);
        while (ok && lines->opened < end) {
            uint32_t taken;
            ok = open_line(adaptive, next, &taken, error);
            next += taken;
        }
    }
    free(samples);
    return ok;
}

// Returns the neighbor's line that is nearest to the pixel. If the neighbor has no lines along the
// pixel's axis, returns a line through the neighbor's center with the neighbor's mean color.
static LineMean line_beside(const Adaptive *adaptive, const RefinedPixel *pixel, Side side)
{
    const ScanLines *lines = &adaptive->lines;
    const int shift = side == SIDE_LEFT || side == SIDE_ABOVE ? -REFINE_GRID : REFINE_GRID;
    const uint32_t neighbor = neighbor_of(adaptive, pixel->pixel, side);
    const bool is_there = neighbor != pixel->pixel;
    const RefinedPixel *refined = &lines->pixels.data[is_there ? adaptive->refined[neighbor] : 0];
    uint32_t nearest = 0;
    LineMean mean = {.middle = REFINE_GRID / 2};
    float color[3];
    if (refined->lines != 0 && refined->has_columns == pixel->has_columns) {
        for (uint32_t i = refined->lines; i != 0; i = lines->lines.data[i].next)
            if (i < lines->opened && (nearest == 0 || shift < 0))
                nearest = i;
        mean = scan_line_mean(&lines->lines.data[nearest]);
    } else {
        if (refined->lines == 0 || !scan_lines_color(lines, refined, color))
            memcpy(color, adaptive->centers[neighbor].color, sizeof color);
        for (int channel = 0; channel < 3; channel++)
            mean.color[channel] = (double)color[channel];
    }
    mean.middle += shift;
    return mean;
}

// Visits the opened lines from the index *first on, and adds further lines to their pixels where
// scan_lines_divide requires them. No gap may be open. New lines of a pixel follow each other, so
// each pixel is considered once.
static bool divide(Adaptive *adaptive, uint32_t *first, Error *error)
{
    ScanLines *lines = &adaptive->lines;
    bool ok = true;
    for (const uint32_t end = lines->opened; ok && *first < end; ++*first) {
        const uint32_t number = lines->lines.data[*first].pixel;
        const RefinedPixel *pixel = &lines->pixels.data[number];
        const Side before = pixel->has_columns ? SIDE_LEFT : SIDE_ABOVE;
        if (*first + 1 < end && lines->lines.data[*first + 1].pixel == number)
            continue;
        const LineMean beyond[2] = {line_beside(adaptive, pixel, before),
                                    line_beside(adaptive, pixel, (Side)(before + 1))};
        ok = scan_lines_divide(lines, number, beyond, error);
    }
    return ok;
}

#define ROWS_OF_TASK   16
#define PIXELS_OF_TASK 4096

// Returns whether a pixel differs from a neighbor.
static bool has_contrast(const Adaptive *adaptive, uint32_t x, uint32_t y)
{
    const float most = adaptive->most;
    const uint32_t width = adaptive->frame.width, height = adaptive->frame.height;
    const SampleData *center = &adaptive->centers[y * width + x];
    return (x > 0 && sample_difference(center, center - 1) > most) ||
           (x + 1 < width && sample_difference(center, center + 1) > most) ||
           (y > 0 && sample_difference(center, center - width) > most) ||
           (y + 1 < height && sample_difference(center, center + width) > most);
}

// Marks the pixels in the rows `first` to `end` - 1 that differ from a neighbor or that a thin part
// touches.
static void mark_rows(void *context, uint32_t first, uint32_t end)
{
    Adaptive *adaptive = context;
    uint32_t pixel = first * adaptive->frame.width;
    for (uint32_t y = first; y < end; y++)
        for (uint32_t x = 0; x < adaptive->frame.width; x++, pixel++)
            adaptive->refined[pixel] =
                adaptive->thin_parts.axes[pixel] != THIN_NONE || has_contrast(adaptive, x, y);
}

// The side of the blocks in which pixels are refined.
#define BLOCK_PIXELS 4

// Adds the marked pixels block by block, so that consecutive samples are near each other.
static bool add_marked(Adaptive *adaptive, Error *error)
{
    const uint32_t width = adaptive->frame.width, height = adaptive->frame.height;
    for (uint32_t top = 0; top < height; top += BLOCK_PIXELS)
        for (uint32_t left = 0; left < width; left += BLOCK_PIXELS)
            for (uint32_t y = top; y < height && y < top + BLOCK_PIXELS; y++)
                for (uint32_t x = left; x < width && x < left + BLOCK_PIXELS; x++)
                    if (adaptive->refined[y * width + x] != 0 &&
                        !add_pixel(adaptive, y * width + x, error))
                        return false;
    return true;
}

// Stores the colors of refined pixels in the picture. Pixels without samples keep their centers.
static void store_colors(void *context, uint32_t first, uint32_t end)
{
    const Adaptive *adaptive = context;
    for (uint32_t number = first + 1; number <= end; number++) {
        const RefinedPixel *pixel = &adaptive->lines.pixels.data[number];
        scan_lines_color(&adaptive->lines, pixel, adaptive->setup.picture->pixels[pixel->pixel]);
    }
}

bool adaptive_refine(Adaptive *adaptive, float threshold, Error *error)
{
    // Differences of whole pixels count twice, because different surfaces may have similar colors
    // by chance.
    adaptive->most = threshold / 2;
    ScanLines *lines = &adaptive->lines;
    ThreadPool *pool = adaptive->setup.pool;
    PlaceList places = {0};
    uint32_t divided = 1;
    lines->probes = adaptive->thin_parts.probes.data;
    lines->threshold = GAP_PART * threshold;
    lines->bend = BEND_PART * threshold;
    if (sampler_is_whole(adaptive->setup.renderer))
        thread_pool_share(pool, adaptive->frame.height, ROWS_OF_TASK, mark_rows, adaptive);
    bool ok = add_marked(adaptive, error);
    while (ok && sampler_is_whole(adaptive->setup.renderer)) {
        if (lines->gaps.count == 0 && lines->opened == lines->lines.count)
            ok = divide(adaptive, &divided, error);
        if (lines->gaps.count == 0 && lines->opened == lines->lines.count)
            break;
        ok = ok && trace_pass(adaptive, &places, error);
    }
    free(places.data);
    scan_lines_close_gaps(lines);
    if (ok)
        thread_pool_share(pool, (uint32_t)lines->pixels.count - 1, PIXELS_OF_TASK, store_colors,
                          adaptive);
    return ok;
}

bool adaptive_open(Adaptive *adaptive, const RefineSetup *setup, Error *error)
{
    Renderer *renderer = setup->renderer;
    *adaptive = (Adaptive){.setup = *setup, .frame = renderer_frame(renderer, setup->camera)};
    FrameData *frame = &adaptive->frame;
    const size_t pixels = (size_t)frame->width * frame->height;
    frame->samples = REFINE_GRID;
    renderer->progress = (RenderProgress){0};
    if (pixels > PIXELS_MOST)
        return error_set(error, "a picture of %u x %u pixels is too large to be refined",
                         frame->width, frame->height);
    adaptive->refined = memory_zeroed(pixels, sizeof *adaptive->refined, error);
    adaptive->centers = (const SampleData *)setup->picture->pixels;
    const bool ok =
        adaptive->refined != NULL && scan_lines_make(&adaptive->lines, error) &&
        thin_parts_make(&adaptive->thin_parts, setup, frame, true, error) &&
        sampler_draw_centers(renderer, frame, setup->picture->pixels, setup->observer, error);
    adaptive->samples = pixels;
    if (!ok)
        adaptive_close(adaptive);
    return ok;
}

uint32_t adaptive_pixel_samples(const Adaptive *adaptive, size_t pixel)
{
    const uint32_t number = adaptive->refined[pixel];
    return number == 0 ? 1 : adaptive->lines.pixels.data[number].samples;
}

void adaptive_close(Adaptive *adaptive)
{
    thin_parts_free(&adaptive->thin_parts);
    scan_lines_free(&adaptive->lines);
    free(adaptive->refined);
    *adaptive = (Adaptive){0};
}
