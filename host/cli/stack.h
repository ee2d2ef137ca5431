// SPDX-License-Identifier: MIT
// Makes stacks large enough for compilers.
#pragma once

// Calls work(context) with a stack that is large enough for compilers, regardless of `ulimit -s`.
// Returns when `work` has returned. If the limit of `ulimit -s` is below 8 MiB, `work` runs on a
// new thread with a larger stack, and threads of drivers get larger stacks too.
void stack_run(void *(*work)(void *context), void *context);
