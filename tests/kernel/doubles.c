// SPDX-License-Identifier: MIT
// Counts the lines of a kernel source that name a double outside of #if CLRT_FP64. Assumes that
// both branches of any other condition are compiled.
#include "kernel/doubles.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

typedef enum { BRANCH_ANY, BRANCH_FP64, BRANCH_FP32 } Branch;

#define DEPTH_MAX 16

// The branches of conditions around a line, the innermost last.
typedef struct {
    Branch branches[DEPTH_MAX];
    int depth;
} Conditions;

static bool begins(const char *line, const char *word)
{
    return strncmp(line, word, strlen(word)) == 0;
}

static Branch branch_of(const char *condition)
{
    if (begins(condition, "#if CLRT_FP64\n"))
        return BRANCH_FP64;
    return begins(condition, "#if !CLRT_FP64\n") ? BRANCH_FP32 : BRANCH_ANY;
}

static void read_line(Conditions *conditions, const char *line)
{
    Branch *innermost = &conditions->branches[conditions->depth - 1];
    if (begins(line, "#if") && conditions->depth < DEPTH_MAX)
        conditions->branches[conditions->depth++] = branch_of(line);
    else if (begins(line, "#endif") && conditions->depth > 0)
        conditions->depth--;
    else if ((begins(line, "#else") || begins(line, "#elif")) && conditions->depth > 0)
        *innermost = *innermost == BRANCH_FP32 && begins(line, "#else") ? BRANCH_FP64 : BRANCH_ANY;
}

static bool needs_fp64(const Conditions *conditions)
{
    for (int i = 0; i < conditions->depth; i++)
        if (conditions->branches[i] == BRANCH_FP64)
            return true;
    return false;
}

static bool names_double(const char *line, size_t length)
{
    const char *found = strstr(line, "double"), *comment = strstr(line, "//");
    return found != NULL && found < line + length && (comment == NULL || found < comment);
}

size_t doubles_without_fp64(const char *source)
{
    size_t count = 0;
    Conditions conditions = {.depth = 0};
    while (*source != '\0') {
        const size_t length = strcspn(source, "\n");
        read_line(&conditions, source);
        count += !needs_fp64(&conditions) && names_double(source, length);
        source += length + (source[length] == '\n');
    }
    return count;
}
