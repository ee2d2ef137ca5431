// SPDX-License-Identifier: MIT
// Command line -> Options.
#pragma once

#include "cli/options/options.h"

// Parses the command line into options, or fails with a message.
bool options_parse(Options *options, int count, char **words, Error *error);
