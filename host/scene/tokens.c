// SPDX-License-Identifier: MIT
// Splits scene text into tokens and formats the messages about them.
#include "scene/tokens.h"

#include "base/limits.h"
#include "base/number.h"
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

Tokens tokens_of(const char *text, size_t size, const char *name, Error *error)
{
    // Some editors put a byte order mark before UTF-8 text.
    const bool marked = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0;
    return (Tokens){.next = marked ? text + 3 : text,
                    .end = text + size,
                    .line_start = marked ? text + 3 : text,
                    .name = name,
                    .line = 1,
                    .error = error};
}

static bool is_line_end(char c)
{
    return c == '\n' || c == '\r';
}

static void skip_line_end(Tokens *tokens)
{
    const bool pair =
        tokens->end - tokens->next >= 2 && tokens->next[0] == '\r' && tokens->next[1] == '\n';
    tokens->next += pair ? 2 : 1;
    tokens->line_start = tokens->next;
    tokens->line++;
}

static bool at_comment(const Tokens *tokens)
{
    return tokens->next[0] == '#' ||
           (tokens->end - tokens->next >= 2 && tokens->next[0] == '/' && tokens->next[1] == '/');
}

static void skip_blanks_and_comment(Tokens *tokens)
{
    while (tokens->next < tokens->end && (*tokens->next == ' ' || *tokens->next == '\t'))
        tokens->next++;
    if (tokens->next < tokens->end && at_comment(tokens))
        while (tokens->next < tokens->end && !is_line_end(*tokens->next))
            tokens->next++;
}

static bool ends_token(char c, bool quoted)
{
    return quoted ? c == '"' || is_line_end(c) : c == ' ' || c == '\t' || is_line_end(c);
}

// Returns whether the line has a closing quote. If not, the caller makes the opening quote a part
// of the token, so that messages show it.
static bool has_closing_quote(const Tokens *tokens)
{
    const char *c = tokens->next + 1;
    while (c < tokens->end && *c != '"' && !is_line_end(*c))
        c++;
    return c < tokens->end && *c == '"';
}

Token tokens_next(Tokens *tokens)
{
    skip_blanks_and_comment(tokens);
    const unsigned column = (unsigned)(tokens->next - tokens->line_start) + 1;
    Token token = {.line = tokens->line, .column = column};
    if (tokens->next < tokens->end && !is_line_end(*tokens->next)) {
        const bool quoted = *tokens->next == '"' && has_closing_quote(tokens);
        tokens->next += quoted;
        token.text = tokens->next;
        while (tokens->next < tokens->end && !ends_token(*tokens->next, quoted))
            tokens->next++;
        token.length = (size_t)(tokens->next - token.text);
        tokens->next += quoted && tokens->next < tokens->end && *tokens->next == '"';
    }
    tokens->last = token;
    return token;
}

Token tokens_next_statement(Tokens *tokens)
{
    tokens->usage = NULL;
    for (;;) {
        const Token token = tokens_next(tokens);
        if (token.text != NULL || tokens->next == tokens->end)
            return token;
        skip_line_end(tokens);
    }
}

bool tokens_have_more(const Tokens *tokens)
{
    Tokens ahead = *tokens;
    return tokens_next(&ahead).text != NULL;
}

bool token_is(Token token, const char *word)
{
    return token.text != NULL && text_is(token.text, token.length, word);
}

// Writes the token for a message: in quotes and shortened.
static void describe_token(Token token, char *out, size_t size)
{
    if (token.text == NULL) {
        snprintf(out, size, "the end of the line");
        return;
    }
    const int shown = token.length > 40 ? 40 : (int)token.length;
    snprintf(out, size, "'%.*s'%s", shown, token.text, token.length > 40 ? "..." : "");
}

bool tokens_fail(const Tokens *tokens, Token token, const char *format, ...)
{
    char what[256], found[64];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    describe_token(token, found, sizeof found);
    if (tokens->usage == NULL)
        return error_set(tokens->error, "%s:%u:%u: %s: found %s", tokens->name, token.line,
                         token.column, what, found);
    return error_set(tokens->error, "%s:%u:%u: %s: found %s; the statement is '%s'", tokens->name,
                     token.line, token.column, what, found, tokens->usage);
}

bool tokens_number_within(Tokens *tokens, double *value, double low, double high)
{
    const Token token = tokens_next(tokens);
    const char *end = token.text == NULL ? NULL : token.text + token.length;
    if (token.text == NULL || number_parse(token.text, end, value) != end)
        return tokens_fail(tokens, token, "expected a number");
    if (!(*value >= low && *value <= high))
        return tokens_fail(tokens, token, "expected a number between %.10g and %.10g", low, high);
    return true;
}

bool tokens_numbers(Tokens *tokens, int count, double *values)
{
    for (int i = 0; i < count; i++)
        if (!tokens_number_within(tokens, &values[i], -COORDINATE_MOST, COORDINATE_MOST))
            return false;
    return true;
}

bool tokens_integer(Tokens *tokens, int64_t *value, int64_t low, int64_t high)
{
    const Token token = tokens_next(tokens);
    const char *end = token.text == NULL ? NULL : token.text + token.length;
    if (token.text == NULL || integer_parse(token.text, end, value) != end || *value < low ||
        *value > high)
        return tokens_fail(tokens, token, "expected an integer between %lld and %lld",
                           (long long)low, (long long)high);
    return true;
}

bool tokens_end(Tokens *tokens)
{
    const Token token = tokens_next(tokens);
    return token.text == NULL || tokens_fail(tokens, token, "expected nothing more");
}
