// SPDX-License-Identifier: MIT
// Opens the module that holds OpenImageIO and finds a function in it.
#pragma once

#include "base/error.h"

typedef void ModuleFunction(void);

// Returns the function of that name, to be cast to its type; NULL if the module cannot be opened.
ModuleFunction *open_module(const char *name, Error *cause);
