// SPDX-License-Identifier: MIT
// Stacks large enough for compilers, regardless of `ulimit -s`.
#pragma once

// Calls work(context) and returns when it does.  If the stack limit is below the usual one, work
// runs on a new thread, and threads that drivers start get larger stacks, too.
void stack_run(void (*work)(void *context), void *context);
