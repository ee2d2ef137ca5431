// SPDX-License-Identifier: MIT
// Sorts by what the rays of a packet have in common.
#include "ray_order.h"

#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    uint32_t kind;
    float origin[3]; // zeros for reflected rays, which share none
    uint32_t ray_class, place;
} Key;

uint32_t ray_order_class(const TestRay *ray)
{
    uint32_t longest = 0, signs = 0;
    for (uint32_t axis = 0; axis < 3; axis++) {
        if (fabsf(ray->direction[axis]) > fabsf(ray->direction[longest]))
            longest = axis;
        signs = 2 * signs + (signbit(ray->direction[axis]) != 0);
    }
    return 8 * longest + signs;
}

static int compare_keys(const void *first, const void *second)
{
    return memcmp(first, second, sizeof(Key));
}

void ray_order(const TestRay *rays, size_t count, uint32_t *places)
{
    Error error = {0};
    Key *keys = memory_zeroed(count, sizeof *keys, &error);
    require(keys != NULL, &error);
    for (size_t i = 0; i < count; i++) {
        keys[i].kind = rays[i].kind;
        if (rays[i].kind != RAY_REFLECTED)
            memcpy(keys[i].origin, rays[i].origin, sizeof keys[i].origin);
        keys[i].ray_class = ray_order_class(&rays[i]);
        keys[i].place = (uint32_t)i;
    }
    qsort(keys, count, sizeof *keys, compare_keys);
    for (size_t i = 0; i < count; i++)
        places[i] = keys[i].place;
    free(keys);
}
