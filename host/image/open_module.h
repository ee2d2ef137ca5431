// SPDX-License-Identifier: MIT
// Finds the module that holds OpenImageIO, and a function in it.
#pragma once

#include "base/error.h"

typedef void ModuleFunction(void);

// The function of that name, to be cast to its type; NULL where the module cannot be opened.
ModuleFunction *open_module(const char *name, Error *cause);
