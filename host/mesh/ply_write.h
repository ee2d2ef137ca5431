// SPDX-License-Identifier: MIT
// Writes a Mesh as binary PLY, which keeps all bits of the mesh.
#pragma once

#include "mesh/mesh.h"

#include <stdio.h>

// Returns the number of bytes that ply_write writes.
size_t ply_write_size(const Mesh *mesh);

// Writes the mesh. Positions are written as floats if floats represent all of them exactly, and
// otherwise as doubles. Colors are written as uchar if bytes represent all of them exactly, and
// otherwise as floats. Returns false if the stream has failed.
bool ply_write(const Mesh *mesh, FILE *stream);
