// SPDX-License-Identifier: MIT
// Reports of a picture's costs and results, as text and as JSON, and its hash.
#pragma once

#include "cli/picture_data.h"
#include "image/provenance.h"

// Prints the picture's error against the reference. Prints nothing if no error was measured.
void report_write_error(const MeasuredReference *reference, FILE *stream);

// Prints the scene, the tree, the device and the kernels, before the picture is drawn.
void report_write_setup(const Picture *picture, FILE *stream);

// Prints time, samples, rays and tests.
void report_write_text(const Picture *picture, FILE *stream);

// Writes versioned JSON with sorted keys to the file at `path`, or to standard output if `path` is
// "-".
bool report_write_json(const Picture *picture, const char *path, Error *error);

// Fills the metadata that the picture's file stores.
void report_fill_provenance(Provenance *provenance, const Picture *picture);

// Prints the hash of the pixels if the options request it without an expected hash. Fails if the
// hash is not the expected one.
bool report_print_hash(const Options *options, const char *hash, Error *error);
