// SPDX-License-Identifier: MIT
// Parses shares, and divides items among shares.
#include "cli/options/options.h"

#include "base/number.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

// clrt reads the first of these variables that is set. The variables for ranks of processes come
// last, because Slurm sets SLURM_PROCID in the tasks of job arrays too.
static const struct {
    const char *name;
    int64_t first; // the number of the first task
} variables[] = {
    {"SLURM_ARRAY_TASK_ID", 1},
    {"AWS_BATCH_JOB_ARRAY_INDEX", 0},
    {"JOB_COMPLETION_INDEX", 0},
    {"OMPI_COMM_WORLD_RANK", 0},
    {"PMI_RANK", 0},
    {"SLURM_PROCID", 0},
};
#define VARIABLES (sizeof variables / sizeof variables[0])

static bool read_variable(int64_t *index, int64_t count, Error *error)
{
    size_t i = 0;
    while (i < VARIABLES && getenv(variables[i].name) == NULL)
        i++;
    if (i == VARIABLES)
        return error_set(error,
                         "auto: none of SLURM_ARRAY_TASK_ID (from 1 to %" PRId64
                         "), AWS_BATCH_JOB_ARRAY_INDEX, JOB_COMPLETION_INDEX, "
                         "OMPI_COMM_WORLD_RANK, PMI_RANK and SLURM_PROCID (from 0 to %" PRId64
                         ") is set; outside job arrays, give a number instead of auto",
                         count, count - 1);
    const char *text = getenv(variables[i].name), *end = text + strlen(text);
    const int64_t first = variables[i].first, last = first + count - 1;
    if (integer_parse(text, end, index) != end || *index < first || *index > last)
        return error_set(error, "auto: %s is '%s', not an integer from %" PRId64 " to %" PRId64,
                         variables[i].name, text, first, last);
    *index += 1 - first;
    return true;
}

bool share_parse(Share *share, const char *text, uint32_t most, Error *error)
{
    int64_t index = 1, count;
    const char *end = text + strlen(text);
    const bool is_auto = strncmp(text, "auto/", 5) == 0;
    const char *slash = is_auto ? text + 4 : integer_parse(text, end, &index);
    if (slash == NULL || *slash != '/' || integer_parse(slash + 1, end, &count) != end ||
        count < 1 || count > most || index < 1 || index > count ||
        (is_auto && !read_variable(&index, count, error)))
        return false;
    *share = (Share){(uint32_t)index, (uint32_t)count};
    return true;
}

uint32_t share_begin(const Share *share, uint32_t total)
{
    return (uint32_t)((uint64_t)total * (share->index - 1) / share->count);
}
