// SPDX-License-Identifier: MIT
// The fast path for the body of a binary PLY file, for the layout that nearly every file has. It
// stops before the first unusual or invalid element. The general reader then continues there and
// reports faults.
#pragma once

#include "mesh/mesh.h"
#include "mesh/ply_header.h"

// Reads vertices from reader->index on, if none of their properties is a list and all used ones
// are floats. reader->index and reader->next end after the last vertex read.
void ply_bulk_vertices(PlyReader *reader, PlyProperties properties, int64_t count, Mesh *mesh);

// Returns the size of a triangle in the file, in bytes, or 0 for unusual layouts. In the usual
// layout, the only list of a face holds its corners, with a length of one byte and indices of four.
size_t ply_bulk_triangle_size(const PlyReader *reader, PlyProperties properties);

// Reads these faces from reader->index on, while they have three corners below vertex_count, at
// most room of them. Advances the reader and returns the number of triangles written.
size_t ply_bulk_triangles(PlyReader *reader, PlyProperties properties, int64_t vertex_count,
                          size_t room, uint32_t (*triangles)[3]);
