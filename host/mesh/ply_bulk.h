// SPDX-License-Identifier: MIT
// The fast way through the body of a binary PLY file, for elements laid out as nearly every file
// lays them out.  It reads what it can and stops in front of the first element that is unusual or
// wrong, which is then for the reader that takes value by value and words the faults.
#pragma once

#include "mesh/mesh.h"
#include "mesh/ply_header.h"

// Reads vertices from reader->index on, where none of their properties is a list and all that a
// mesh uses are floats, and leaves reader->index and reader->next behind the last one read.
void ply_bulk_vertices(PlyReader *reader, PlyProperties properties, int64_t count, Mesh *mesh);

// The bytes that a triangle takes in a file of faces whose only list is that of their corners, a
// byte for its length and four for each corner; 0 where faces are laid out in another way.
size_t ply_bulk_triangle_size(const PlyReader *reader, PlyProperties properties);

// Reads such faces from reader->index on while they have three corners below vertex_count, at most
// room of them, and moves the reader on.  Returns how many triangles it has written.
size_t ply_bulk_triangles(PlyReader *reader, PlyProperties properties, int64_t vertex_count,
                          size_t room, uint32_t (*triangles)[3]);
