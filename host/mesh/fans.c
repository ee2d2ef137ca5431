// SPDX-License-Identifier: MIT
// A union-find over corners.
#include "mesh/fans.h"

#include "base/array.h"

#include <stdlib.h>

bool fans_make(Fans *fans, const Mesh *mesh, const Weld *weld, Error *error)
{
    const size_t corners = 3 * mesh->triangle_count;
    *fans = (Fans){mesh, weld, NULL};
    fans->parents = memory_raw(corners, sizeof *fans->parents, error);
    for (uint32_t corner = 0; fans->parents != NULL && corner < corners; corner++)
        fans->parents[corner] = corner;
    return fans->parents != NULL;
}

void fans_free(Fans *fans)
{
    free(fans->parents);
    *fans = (Fans){0};
}

uint32_t fans_root(const Fans *fans, uint32_t corner)
{
    uint32_t *parents = fans->parents;
    while (parents[corner] != corner) {
        parents[corner] = parents[parents[corner]];
        corner = parents[corner];
    }
    return corner;
}

static uint32_t corner_at(const Fans *fans, uint32_t triangle, uint32_t point)
{
    const uint32_t *corners = fans->mesh->triangles[triangle];
    for (uint32_t corner = 0; corner < 2; corner++)
        if (fans->weld->points[corners[corner]] == point)
            return 3 * triangle + corner;
    return 3 * triangle + 2;
}

void fans_join(const Fans *fans, uint32_t point, uint32_t triangle, uint32_t other)
{
    const uint32_t a = fans_root(fans, corner_at(fans, triangle, point));
    const uint32_t b = fans_root(fans, corner_at(fans, other, point));
    // The lower corner becomes the root, so the root belongs to the fan's first triangle.
    fans->parents[a > b ? a : b] = a > b ? b : a;
}

// The parent of a corner is lower, so it has its number already.
uint32_t fans_number(Fans *fans)
{
    uint32_t count = 0, *parents = fans->parents;
    for (size_t corner = 0; corner < 3 * fans->mesh->triangle_count; corner++)
        parents[corner] = parents[corner] == corner ? count++ : parents[parents[corner]];
    return count;
}
