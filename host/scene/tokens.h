// SPDX-License-Identifier: MIT
// Scene text -> tokens, line by line, each with its place for messages.
// Blanks separate tokens; a token that begins with // or # comments out the rest of its line.
#pragma once

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

typedef struct {
    const char *text; // not terminated; NULL at the end of the statement
    size_t length;
    unsigned line, column; // from 1
} Token;

typedef struct {
    const char *next, *end;
    const char *line_start;
    const char *name;  // of the file, for messages
    const char *usage; // of the statement being read, for messages; NULL before its keyword
    unsigned line;
    Token last;
    Error *error;
} Tokens;

Tokens tokens_of(const char *text, size_t size, const char *name, Error *error);

// Moves to the next line that has a token and returns its first; text is NULL at the end.
Token tokens_next_statement(Tokens *tokens);

// The next token of this line; text is NULL where the line ends.  A token that begins with a
// double quote runs to the next one, blanks included, and comes back without the quotes.
Token tokens_next(Tokens *tokens);

// Whether token is exactly that word.
bool token_is(Token token, const char *word);

// Reads count numbers into values, each finite and at least low and at most high.
bool tokens_numbers(Tokens *tokens, int count, double *values);
bool tokens_number_within(Tokens *tokens, double *value, double low, double high);

// Reads an integer between low and high.
bool tokens_integer(Tokens *tokens, int64_t *value, int64_t low, int64_t high);

// Fails unless the line has ended.
bool tokens_end(Tokens *tokens);

// Fails at the token (or at the line's end): "name:line:column: WHAT: found TOKEN; the
// statement is 'USAGE'".
__attribute__((format(printf, 3, 4))) bool tokens_fail(const Tokens *tokens, Token token,
                                                       const char *format, ...);
