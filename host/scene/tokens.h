// SPDX-License-Identifier: MIT
// Scene text -> tokens with lines and columns for messages. Blanks separate tokens. A token that
// begins with // or # makes the rest of its line a comment.
#pragma once

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

typedef struct {
    const char *text; // not zero-terminated; NULL at the end of the line
    size_t length;
    unsigned line, column; // from 1
} Token;

typedef struct {
    const char *next, *end;
    const char *line_start;
    const char *name;  // the file's name, for messages
    const char *usage; // usage text of the current statement, for messages; NULL before a keyword
    unsigned line;
    Token last;
    Error *error;
} Tokens;

Tokens tokens_of(const char *text, size_t size, const char *name, Error *error);

// Moves to the next line with a token and returns its first token. Returns a token with NULL text
// at the end of the file.
Token tokens_next_statement(Tokens *tokens);

// Returns the next token of the line, or a token with NULL text at the line's end. A token in
// double quotes may contain blanks, and is returned without the quotes.
Token tokens_next(Tokens *tokens);

// Returns whether the line has another token.
bool tokens_have_more(const Tokens *tokens);

// Returns whether the token is exactly `word`.
bool token_is(Token token, const char *word);

// tokens_numbers reads `count` numbers in [-COORDINATE_MOST, COORDINATE_MOST]. tokens_number_within
// reads one number in [low, high]. Both set the error and return false on other tokens.
bool tokens_numbers(Tokens *tokens, int count, double *values);
bool tokens_number_within(Tokens *tokens, double *value, double low, double high);

// Reads an integer in [low, high].
bool tokens_integer(Tokens *tokens, int64_t *value, int64_t low, int64_t high);

// Fails unless the line has ended.
bool tokens_end(Tokens *tokens);

// Sets the error to "NAME:LINE:COLUMN: MESSAGE: found TOKEN; the statement is 'USAGE'" and returns
// false. If the statement is unknown, the text ends after TOKEN.
__attribute__((format(printf, 3, 4))) bool tokens_fail(const Tokens *tokens, Token token,
                                                       const char *format, ...);
