// SPDX-License-Identifier: MIT
// libpng's fault handlers. png_create_*_struct takes them, with an Error as the pointer.
#pragma once

#include "base/error.h"

#include <png.h>

// Stores the reason in the Error and jumps to the png_jmpbuf.
void png_faults_take(png_structp png, png_const_charp reason);

// Discards a warning, which libpng would print.
void png_faults_ignore_warning(png_structp png, png_const_charp warning);
