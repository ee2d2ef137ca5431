// SPDX-License-Identifier: MIT
// Command line -> Options.
#pragma once

#include "cli/options/options.h"

// Fills options from the words of the command line, or rejects them.
bool options_parse(Options *options, int count, char **words, Error *error);
