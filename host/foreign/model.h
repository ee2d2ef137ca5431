// SPDX-License-Identifier: MIT
// A model in any format that Assimp reads -> the records of mesh/foreign_stream.h.
#pragma once

#include "foreign/files.h"

#include <stdio.h>

// Sends all records but a failure's; false with the reason where there is no model in the file or
// nobody receives it.
bool model_send(FILE *stream, Files *files, Error *error);
