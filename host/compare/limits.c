// SPDX-License-Identifier: MIT
// Parses limits by the names that reports also use.
#include "compare/difference.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

const char *const limit_names[LIMIT_KINDS] = {"rmse", "max", "psnr", "share1", "share4", "hits"};

static int kind_named(const char *name, size_t length)
{
    for (int kind = 0; kind < LIMIT_KINDS; kind++)
        if (strlen(limit_names[kind]) == length && strncmp(limit_names[kind], name, length) == 0)
            return kind;
    return -1;
}

// Parses one NAME=VALUE between start and end. Values other than PSNR may be in percent.
static bool parse_limit(Limits *limits, const char *start, const char *end, Error *cause)
{
    const char *equals = memchr(start, '=', (size_t)(end - start));
    const int kind = equals == NULL ? -1 : kind_named(start, (size_t)(equals - start));
    double value;
    const char *stop = kind < 0 ? NULL : number_parse(equals + 1, end, &value);
    if (stop != NULL && stop < end && *stop == '%' && kind != LIMIT_PSNR) {
        value /= 100;
        stop++;
    }
    if (stop != end || !isfinite(value) || value < 0)
        return error_set(cause,
                         "needs limits like rmse=0.01,max=0.1,psnr=40,share1=1%%,share4=0,hits=0, "
                         "not '%.*s'",
                         (int)(end - start), start);
    limits->given[kind] = true;
    limits->values[kind] = value;
    return true;
}

bool limits_parse(Limits *limits, const char *text, Error *cause)
{
    for (;;) {
        const char *end = text + strcspn(text, ",");
        if (!parse_limit(limits, text, end, cause))
            return false;
        if (*end == '\0')
            return true;
        text = end + 1;
    }
}

double limit_measured(LimitKind kind, const Difference *difference)
{
    const double pixels = (double)difference->pixels;
    switch (kind) {
    case LIMIT_RMSE:
        return difference->rmse;
    case LIMIT_MAX:
        return difference->maximum;
    case LIMIT_PSNR:
        return difference_psnr(difference);
    case LIMIT_SHARE1:
        return (double)difference->off_by_1 / pixels;
    case LIMIT_SHARE4:
        return (double)difference->off_by_4 / pixels;
    case LIMIT_HITS:
        return difference->has_hits ? (double)difference->wrong_hits / pixels : NAN;
    case LIMIT_KINDS:
        break;
    }
    return NAN;
}

bool limit_is_kept(const Limits *limits, LimitKind kind, const Difference *difference)
{
    const double measured = limit_measured(kind, difference);
    return kind == LIMIT_PSNR ? measured >= limits->values[kind] : measured <= limits->values[kind];
}
