// SPDX-License-Identifier: MIT
// Cutting a cell changed its color by so much for its contrast; cutting those that are left would
// change theirs by as much for theirs.  That ratio is the scene's own, level by level, for steps
// and for bends, and errors of cells are as good as independent of each other.  A step lies
// anywhere between the two samples of its seam.
#include "render/cell_sums.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ROWS_OF_TASK   16
#define GROUPS_OF_TASK 512

// The squared ratios where fewer cells were cut than tell them: somewhat above what scenes have,
// which is 0.07 to 0.1 for steps in pixels, 0.02 to 0.06 in cells, where seams tell most of them,
// and 0.04 to 0.2 for bends.
#define FEW_CUTS     64
#define PIXEL_SQUARE (0.1 * 0.1)
#define CELL_SQUARE  (0.06 * 0.06)
#define BEND_SQUARE  (0.1 * 0.1)

typedef struct {
    const RefineTree *tree;
    const PixelContrasts *pixel_contrasts;
    const ThinParts *thin_parts;
    CellSums *parts; // of each task
    uint32_t row_tasks;
} Summing;

static uint32_t tasks_of(size_t whole, uint32_t part)
{
    return (uint32_t)((whole + part - 1) / part);
}

static size_t end_of(uint32_t task, uint32_t part, size_t whole)
{
    const size_t end = (size_t)(task + 1) * part;
    return end < whole ? end : whole;
}

// The bin of contrasts from 8 on is the first.  A float's exponent and two bits of its fraction
// tell the quarter.
#define FIRST_BIN     (0x41000000u >> QUARTER_SHIFT)
#define QUARTER_SHIFT 21

static uint32_t bin_of(float contrast)
{
    uint32_t bits;
    memcpy(&bits, &contrast, sizeof bits);
    const uint32_t quarter = bits >> QUARTER_SHIFT;
    const uint32_t bin = quarter < FIRST_BIN ? FIRST_BIN - quarter : 0;
    return bin < CONTRAST_BINS ? bin : CONTRAST_BINS - 1;
}

// What no contrast of the bin exceeds.
static float top_of_bin(uint32_t bin)
{
    const uint32_t bits = (FIRST_BIN - bin + 1) << QUARTER_SHIFT;
    float top;
    memcpy(&top, &bits, sizeof top);
    return top;
}

static double square(double value)
{
    return value * value;
}

// What is cut: a pixel or a cell.
typedef struct {
    CellContrast contrast;
    uint32_t level, group; // into which it is cut
    float color[3];        // known of it before that
} Part;

static KindSums *kind_of(CellSums *sums, CellContrast contrast, uint32_t level)
{
    return contrast.is_step ? &sums->steps[level] : &sums->bends[level];
}

// What has no contrast is nowhere cut for any.
static inline void add_left(CellSums *sums, CellContrast contrast, uint32_t level)
{
    if (contrast.value <= 0)
        return;
    kind_of(sums, contrast, level)->left += square((double)contrast.value);
    if (level < REFINE_LEVELS)
        sums->counts[bin_of(contrast.value)] += ADAPTIVE_CUT;
}

static void add_cut(const RefineTree *tree, const Part *part, CellSums *sums)
{
    static const double areas[REFINE_LEVELS + 1] = {1, 1 / 9.0, 1 / 81.0, 1 / 729.0, 1 / 6561.0};
    const double area = areas[part->level];
    KindSums *kind = kind_of(sums, part->contrast, part->level);
    float mean[3];
    refine_tree_mean(tree, part->group, mean);
    kind->cut += square((double)part->contrast.value);
    kind->cuts++;
    for (int channel = 0; channel < 3; channel++)
        kind->changed += square(area * ((double)mean[channel] - (double)part->color[channel])) / 3;
}

static void add_seam(const Seam *seam, CellSums *sums)
{
    uint32_t place[2];
    const double contrast = (double)seam_contrast(seam);
    sums->seams += contrast * contrast * (seam->assumed == SEAM_ENDS ? 1 / 12.0 : 1 / 6.0);
    if (seam_asks(seam, place))
        sums->counts[bin_of((float)contrast / ADAPTIVE_SEAM_PART)]++;
}

static void add_pixel_seams(const RefineTree *tree, size_t pixel, CellContrast contrast,
                            CellSums *sums)
{
    contrast.value = contrast_past_seams(contrast.value);
    add_left(sums, contrast, 0);
    for (uint32_t seam = tree->pixel_seams[pixel]; seam != 0; seam = tree->seams.data[seam].next)
        add_seam(&tree->seams.data[seam], sums);
}

static void add_cut_pixel(const Summing *summing, uint32_t x, uint32_t y, CellSums *sums)
{
    const RefineTree *tree = summing->tree;
    const SampleData *sample = &tree->pixels[refine_tree_place(tree, x, y)];
    const Part pixel = {.contrast = pixel_contrast(summing->pixel_contrasts, x, y),
                        .group = tree->pixel_groups[(size_t)y * tree->width + x],
                        .color = {sample->color[0], sample->color[1], sample->color[2]}};
    const uint32_t place[2] = {x * REFINE_GRID, y * REFINE_GRID};
    if (!thin_parts_cut(summing->thin_parts, place, 0))
        add_cut(tree, &pixel, sums);
}

// What was cut for thin parts tells nothing of contrasts.
static void sum_row(const Summing *summing, uint32_t y, CellSums *sums)
{
    const RefineTree *tree = summing->tree;
    const size_t row = (size_t)y * tree->width;
    for (uint32_t x = 0; x < tree->width; x++) {
        const CellContrast contrast = contrast_read(summing->pixel_contrasts->values[row + x]);
        if (tree->pixel_groups[row + x] != 0)
            add_cut_pixel(summing, x, y, sums);
        else if (tree->pixel_seams[row + x] != 0)
            add_pixel_seams(tree, row + x, contrast, sums);
        else
            add_left(sums, contrast, 0);
    }
}

static void sum_rows(const Summing *summing, uint32_t task, CellSums *sums)
{
    const RefineTree *tree = summing->tree;
    const uint32_t end = (uint32_t)end_of(task, ROWS_OF_TASK, tree->height);
    for (uint32_t y = task * ROWS_OF_TASK; y < end; y++)
        sum_row(summing, y, sums);
}

static void add_cut_cell(const Summing *summing, const CellGroup *group, uint32_t cell,
                         const ColorSum known, CellSums *sums)
{
    const uint32_t side = refine_tree_cell_side(group->level);
    uint32_t middle[2];
    Part part = {contrast_read(group->contrasts[cell]), group->level, group->groups[cell], {0}};
    for (int channel = 0; channel < 3; channel++)
        part.color[channel] = (float)known[channel] / (float)(2 * side * side) * 0x1p-32f;
    refine_tree_cell_place(group, cell, middle);
    if (!thin_parts_cut(summing->thin_parts, middle, group->level))
        add_cut(summing->tree, &part, sums);
}

static bool has_cut_cells(const CellGroup *group)
{
    uint32_t any = 0;
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
        any |= group->groups[cell];
    return any != 0;
}

static void add_cells(const Summing *summing, const CellGroup *group, CellSums *sums)
{
    ColorSum known[GROUP_CELLS];
    if (has_cut_cells(group))
        refine_tree_cells(summing->tree, group, known);
    for (uint32_t cell = 0; cell < GROUP_CELLS; cell++)
        if (group->groups[cell] != 0)
            add_cut_cell(summing, group, cell, known[cell], sums);
        else
            add_left(sums, contrast_read(group->contrasts[cell]), group->level);
}

// Whether the cell that the seam passes in is cut: then the group within tells of the step.
static bool is_cut(const CellGroup *group, const Seam *seam)
{
    const uint32_t along = (seam->low + seam->high) / 2u / seam->side;
    const uint32_t first = seam->stride == 1 ? GROUP_SIDE * seam->line : seam->line;
    return group->groups[first + (along < GROUP_SIDE ? along : GROUP_SIDE - 1) * seam->stride] != 0;
}

static void sum_groups(const Summing *summing, uint32_t task, CellSums *sums)
{
    const RefineTree *tree = summing->tree;
    const size_t end = end_of(task, GROUPS_OF_TASK, tree->groups.count - 1);
    for (size_t i = (size_t)task * GROUPS_OF_TASK; i < end; i++) {
        const CellGroup *group = &tree->groups.data[i + 1];
        add_cells(summing, group, sums);
        for (uint32_t seam = group->seams; seam != 0; seam = tree->seams.data[seam].next)
            if (!is_cut(group, &tree->seams.data[seam]))
                add_seam(&tree->seams.data[seam], sums);
    }
}

static void sum_task(void *context, uint32_t task, uint32_t worker)
{
    (void)worker;
    const Summing *summing = context;
    if (task < summing->row_tasks)
        sum_rows(summing, task, &summing->parts[task]);
    else
        sum_groups(summing, task - summing->row_tasks, &summing->parts[task]);
}

static void add_kinds(KindSums sums[], const KindSums parts[])
{
    for (uint32_t level = 0; level <= REFINE_LEVELS; level++) {
        sums[level].cut += parts[level].cut;
        sums[level].left += parts[level].left;
        sums[level].changed += parts[level].changed;
        sums[level].cuts += parts[level].cuts;
    }
}

static void add_sums(CellSums *sums, const CellSums *more)
{
    add_kinds(sums->bends, more->bends);
    add_kinds(sums->steps, more->steps);
    sums->seams += more->seams;
    for (uint32_t bin = 0; bin < CONTRAST_BINS; bin++)
        sums->counts[bin] += more->counts[bin];
}

bool cell_sums_make(CellSums *sums, const Adaptive *adaptive, Error *error)
{
    const RefineTree *tree = &adaptive->tree;
    Summing summing = {.tree = tree,
                       .pixel_contrasts = &adaptive->pixel_contrasts,
                       .thin_parts = &adaptive->thin_parts,
                       .row_tasks = tasks_of(tree->height, ROWS_OF_TASK)};
    const uint32_t tasks = summing.row_tasks + tasks_of(tree->groups.count - 1, GROUPS_OF_TASK);
    *sums = (CellSums){.pixels = (double)tree->width * tree->height};
    summing.parts = memory_zeroed(tasks, sizeof *summing.parts, error);
    if (summing.parts == NULL)
        return false;
    crew_run(adaptive->crew, tasks, sum_task, &summing);
    for (uint32_t task = 0; task < tasks; task++)
        add_sums(sums, &summing.parts[task]);
    free(summing.parts);
    return true;
}

// What cutting the rest of a kind would change, squared.
static double square_left(const KindSums *kind, double usual)
{
    const bool is_known = kind->cuts >= FEW_CUTS && kind->cut > 0;
    return (is_known ? kind->changed / kind->cut : usual) * kind->left;
}

double cell_sums_error(const CellSums *sums)
{
    double squares = sums->seams;
    for (uint32_t level = 0; level <= REFINE_LEVELS; level++)
        squares += square_left(&sums->steps[level], level == 0 ? PIXEL_SQUARE : CELL_SQUARE) +
                   square_left(&sums->bends[level], BEND_SQUARE);
    return sqrt(squares / sums->pixels);
}

float cell_sums_threshold(const CellSums *sums, double samples)
{
    double above = 0;
    for (uint32_t bin = 0; bin < CONTRAST_BINS; bin++) {
        above += (double)sums->counts[bin];
        if (above > samples)
            return top_of_bin(bin);
    }
    return 0;
}
