// SPDX-License-Identifier: MIT
// Reads a model in any format of Assimp and writes the records of mesh/foreign_stream.h.
#pragma once

#include "foreign/files.h"

#include <stdio.h>

// Sends all records of a model except FOREIGN_FAILURE. Returns false and stores the reason if the
// model cannot be read or the receiver has closed the stream.
bool model_send(FILE *stream, Files *files, Error *error);
