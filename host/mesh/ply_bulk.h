// SPDX-License-Identifier: MIT
// The fast path for binary PLY files with the usual layout. It stops before the first unusual or
// invalid element. The general reader continues there and reports faults.
#pragma once

#include "mesh/mesh.h"
#include "mesh/ply_header.h"

// Reads vertices from reader->index up to count. Reads no vertex if a property is a list or a used
// property is not a float. Advances reader->index and reader->next past the vertices read.
void ply_bulk_vertices(PlyReader *reader, PlyProperties properties, int64_t count, Mesh *mesh);

// Returns the size of a triangle in the file in bytes, or 0 for unusual layouts. In the usual
// layout, a face has one list: its corners, with a 1-byte length and 4-byte indices.
size_t ply_bulk_triangle_size(const PlyReader *reader, PlyProperties properties);

// Reads at most room triangles from reader->index on. Stops at a face that has another number of
// corners or a corner outside [0, vertex_count). Advances the reader and returns the number of
// triangles read.
size_t ply_bulk_triangles(PlyReader *reader, PlyProperties properties, int64_t vertex_count,
                          size_t room, uint32_t (*triangles)[3]);
