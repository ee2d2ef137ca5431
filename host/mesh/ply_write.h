// SPDX-License-Identifier: MIT
// Mesh -> binary PLY, as ply_parse reads it fastest and with the same bits.
#pragma once

#include "mesh/mesh.h"

#include <stdbool.h>
#include <stdio.h>

// How many bytes that takes.
size_t ply_write_size(const Mesh *mesh);

// Writes the mesh, its positions as floats where all of them are and as doubles otherwise; false
// where the stream has failed.
bool ply_write(const Mesh *mesh, FILE *stream);
