// SPDX-License-Identifier: MIT
// Only libpng calls these functions.
#include "image/png_faults.h"

void png_faults_take(png_structp png, png_const_charp reason)
{
    error_set(png_get_error_ptr(png), "%s", reason);
    png_longjmp(png, 1);
}

void png_faults_ignore_warning(png_structp png, png_const_charp warning)
{
    (void)png;
    (void)warning;
}
