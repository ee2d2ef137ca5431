// SPDX-License-Identifier: MIT
// Stacks that are large enough for compilers, whatever `ulimit -s` says.
#pragma once

// Calls work(context) and returns after it.  Where the limit is below what systems set, it runs on
// a thread of its own, and threads that drivers start get larger stacks too.
void stack_run(void (*work)(void *context), void *context);
