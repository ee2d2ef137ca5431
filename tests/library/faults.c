// SPDX-License-Identifier: MIT
// Checks errors of the library.
#include "library/faults.h"

#include "unit/cmocka_all.h"

#include <string.h>

ClrtError faults_blank(void)
{
    ClrtError error;
    memset(&error, 0x55, sizeof error);
    return error;
}

void faults_assert(bool ok, const ClrtError *error, ClrtFault fault, const char *words)
{
    assert_false(ok);
    assert_int_equal(error->fault, fault);
    assert_non_null(memchr(error->text, '\0', sizeof error->text));
    if (strstr(error->text, words) == NULL)
        fail_msg("'%s' does not say '%s'", error->text, words);
}
