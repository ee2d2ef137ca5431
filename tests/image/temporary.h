// SPDX-License-Identifier: MIT
// Scene files that a test writes for itself.
#pragma once

#include "mesh/ply.h"

#include <stdio.h>

#define TEMPORARY_PATH 64

// Opens a new file to be written and leaves its path, which the caller removes; what cannot be
// opened fails the test.
FILE *temporary_open(char path[TEMPORARY_PATH]);

// Closes it; what could not be written fails the test.
void temporary_close(FILE *stream);

// Writes the mesh to a new PLY file and leaves its path, which the caller removes.
void temporary_mesh(char path[TEMPORARY_PATH], const Mesh *mesh);
