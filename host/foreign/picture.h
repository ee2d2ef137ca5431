// SPDX-License-Identifier: MIT
// Reads a picture file with OpenImageIO.
#pragma once

#include "base/error.h"

#include <stdio.h>

// Sends a record FOREIGN_PICTURE. words holds the file's path, the name of its format in
// OpenImageIO, and the path of the module that calls OpenImageIO. Returns false and stores the
// reason if the file cannot be read.
bool picture_send(FILE *stream, char *const words[3], Error *error);
