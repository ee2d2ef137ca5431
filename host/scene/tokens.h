// SPDX-License-Identifier: MIT
// Splits scene text into tokens, line by line, each with its position for messages. Blanks
// separate tokens. A token that begins with // or # comments out the rest of its line.
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
    const char *usage; // of the current statement, for messages; NULL before its keyword
    unsigned line;
    Token last;
    Error *error;
} Tokens;

Tokens tokens_of(const char *text, size_t size, const char *name, Error *error);

// Moves to the next line with a token and returns its first token; text is NULL at the end.
Token tokens_next_statement(Tokens *tokens);

// Returns the next token of this line; text is NULL at the line's end. A token that begins with a
// double quote extends to the next quote, includes blanks, and is returned without the quotes.
Token tokens_next(Tokens *tokens);

// Returns whether token is exactly that word.
bool token_is(Token token, const char *word);

// Reads count numbers into values, each finite and in [low, high].
bool tokens_numbers(Tokens *tokens, int count, double *values);
bool tokens_number_within(Tokens *tokens, double *value, double low, double high);

// Reads an integer between low and high.
bool tokens_integer(Tokens *tokens, int64_t *value, int64_t low, int64_t high);

// Fails unless the line has ended.
bool tokens_end(Tokens *tokens);

// Fails at the token (or at the line's end) with "name:line:column: MESSAGE: found TOKEN; the
// statement is 'USAGE'".
__attribute__((format(printf, 3, 4))) bool tokens_fail(const Tokens *tokens, Token token,
                                                       const char *format, ...);
