// SPDX-License-Identifier: MIT
#include "unit/cmocka_all.h"

int main(void)
{
    return tests_run();
}
