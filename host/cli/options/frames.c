// SPDX-License-Identifier: MIT
// Parses ranges of frames, and names the files of frames. A frame's number replaces the last run of
// # in a file name, or is inserted before the ending.
#include "cli/options/options.h"

#include "base/number.h"
#include "base/text.h"

#include <string.h>

#define DIGITS 4

static bool in_range(int64_t number)
{
    return number >= 1 && number <= FRAMES_MOST;
}

static bool parse_range(Frames *frames, const char *text, const char *end)
{
    int64_t first, last, step = 1;
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

bool frames_parse(Frames *frames, const char *text, Error *error)
{
    const char *end = text + strcspn(text, ","), *share = *end == ',' ? end + 1 : text;
    if (strchr(text, '/') == NULL)
        return parse_range(frames, text, text + strlen(text));
    return (share == text || parse_range(frames, text, end)) &&
           share_parse(&frames->share, share, FRAMES_MOST, error);
}

bool frames_are_many(const Frames *frames)
{
    return frames->last > 0 || frames->turntable > 0 || frames->share.count > 0;
}

bool frames_complete(Frames *frames, Error *error)
{
    Share *share = &frames->share;
    if (frames->last == 0 && frames->turntable == 0)
        return error_set(error, "--frames I/N divides the pictures of a turntable or of a range: "
                                "give --turntable, or --frames A-B,I/N");
    if (frames->last == 0) {
        frames->first = frames->step = 1;
        frames->last = frames->turntable;
    }
    const uint32_t count = frames_count(frames), first = frames->first;
    if (share->count > count)
        return error_set(error,
                         "--frames: %u pictures cannot be divided into %u runs: give at most %u",
                         count, share->count, count);
    if (share->count > 0) {
        frames->first = first + share_begin(share, count) * frames->step;
        share->index++; // this share ends where the next one begins
        frames->last = first + (share_begin(share, count) - 1) * frames->step;
        *share = (Share){0};
    }
    return true;
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
    const char *file = text_file_name(pattern);
    const char *dot = strrchr(file, '.'), *last = strrchr(file, '#');
    const char *end = last != NULL ? last + 1 : dot != NULL ? dot : file + strlen(file);
    const char *start = end;
    while (last != NULL && start > file && start[-1] == '#')
        start--;
    const int digits = last != NULL ? (int)(end - start) : DIGITS;
    return text_format(error, "%.*s%s%0*u%s", (int)(start - pattern), pattern,
                       last != NULL ? "" : ".", digits, number, end);
}
