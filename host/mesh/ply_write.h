// SPDX-License-Identifier: MIT
// Writes a Mesh as binary PLY, which ply_parse reads fastest, and which keeps all bits of the mesh.
#pragma once

#include "mesh/mesh.h"

#include <stdio.h>

// Returns the number of bytes that ply_write writes.
size_t ply_write_size(const Mesh *mesh);

// Writes the mesh. Positions are floats if all fit exactly, else doubles. Returns false if the
// stream has failed.
bool ply_write(const Mesh *mesh, FILE *stream);
