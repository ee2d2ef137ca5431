// SPDX-License-Identifier: MIT
// Temporary files are in /tmp, because failed tests do not remove them.
#include "image/temporary.h"

#include "unit/cmocka_all.h"

#include <stdlib.h>

FILE *temporary_open(char path[TEMPORARY_PATH])
{
    snprintf(path, TEMPORARY_PATH, "%s", "/tmp/clrt-scene-XXXXXX");
    const int file = mkstemp(path);
    assert_true(file >= 0);
    FILE *stream = fdopen(file, "w");
    assert_non_null(stream);
    return stream;
}

void temporary_close(FILE *stream)
{
    assert_int_equal(fclose(stream), 0);
}

void temporary_mesh(char path[TEMPORARY_PATH], const Mesh *mesh)
{
    FILE *stream = temporary_open(path);
    assert_true(ply_write(mesh, stream));
    temporary_close(stream);
}
