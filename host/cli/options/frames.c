// SPDX-License-Identifier: MIT
// File numbers follow the convention of programs that convert films to numbered pictures and back.
#include "cli/options/options.h"

#include "base/array.h"
#include "base/number.h"

#include <stdio.h>
#include <string.h>

#define DIGITS 4

static bool in_range(int64_t number)
{
    return number >= 1 && number <= FRAMES_MOST;
}

bool frames_parse(Frames *frames, const char *text)
{
    int64_t first, last, step = 1;
    const char *end = text + strlen(text);
    const char *next = integer_parse(text, end, &first);
    if (next == NULL || *next != '-')
        return false;
    next = integer_parse(next + 1, end, &last);
    if (next != NULL && *next == ':')
        next = integer_parse(next + 1, end, &step);
    if (next != end || !in_range(first) || !in_range(last) || !in_range(step) || first > last)
        return false;
    frames->first = (uint32_t)first;
    frames->last = (uint32_t)last;
    frames->step = (uint32_t)step;
    return true;
}

bool frames_are_many(const Frames *frames)
{
    return frames->last > 0 || frames->turntable > 0;
}

void frames_complete(Frames *frames)
{
    if (frames->last > 0 || frames->turntable == 0)
        return;
    frames->first = frames->step = 1;
    frames->last = frames->turntable;
}

uint32_t frames_count(const Frames *frames)
{
    return frames_are_many(frames) ? (frames->last - frames->first) / frames->step + 1 : 1;
}

uint32_t frames_at(const Frames *frames, uint32_t place)
{
    return frames->first + place * frames->step;
}

char *frames_name(const char *pattern, uint32_t number, Error *error)
{
    const char *slash = strrchr(pattern, '/');
    const char *file = slash == NULL ? pattern : slash + 1;
    const char *dot = strrchr(file, '.'), *last = strrchr(file, '#');
    const char *end = last != NULL ? last + 1 : dot != NULL ? dot : file + strlen(file);
    const char *start = end;
    while (last != NULL && start > file && start[-1] == '#')
        start--;
    const int digits = last != NULL ? (int)(end - start) : DIGITS;
    const size_t size = strlen(pattern) + (size_t)digits + 16;
    char *name = memory_raw(size, 1, error);
    if (name != NULL)
        snprintf(name, size, "%.*s%s%0*u%s", (int)(start - pattern), pattern,
                 last != NULL ? "" : ".", digits, number, end);
    return name;
}
