// SPDX-License-Identifier: MIT
// Joins the corners of triangles at their points into fans, across the edges that the caller names.
// A corner is a number: 3 * triangle + 0, 1 or 2.
#pragma once

#include "mesh/edges.h"

typedef struct {
    const Mesh *mesh;
    const Weld *weld;
    uint32_t *parents; // by corner: a corner of the same fan, not above it
} Fans;

// Makes a fan of each corner of a mesh with edges.
bool fans_make(Fans *fans, const Mesh *mesh, const Weld *weld, Error *error);
void fans_free(Fans *fans);

// Joins the fans of two triangles at a point that both have.
void fans_join(const Fans *fans, uint32_t point, uint32_t triangle, uint32_t other);

// Returns the lowest corner of the corner's fan.
uint32_t fans_root(const Fans *fans, uint32_t corner);

// Replaces each parent by the number of the corner's fan. Numbers are in the order of the fans'
// lowest corners. Returns the number of fans. Only fans_free may follow.
uint32_t fans_number(Fans *fans);
