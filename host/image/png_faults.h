// SPDX-License-Identifier: MIT
// How libpng tells of faults: to be given to it when it starts, with an Error as its pointer.
#pragma once

#include "base/error.h"

#include <png.h>

// Leaves the reason in the error and jumps to the png_jmpbuf.
void png_faults_take(png_structp png, png_const_charp reason);

// libpng would print them.
void png_faults_ignore_warning(png_structp png, png_const_charp warning);
