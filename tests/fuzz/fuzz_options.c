// SPDX-License-Identifier: MIT
// libFuzzer target: parses any bytes as a command line with one word per line. The result must be
// options or a message.
#include "demand.h"

#include "cli/options/options.h"

#include <stdlib.h>
#include <string.h>

#define WORDS_MOST 64

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *words[WORDS_MOST + 1] = {"clrt"};
    int count = 1;
    Options options;
    Error error = {0};
    char *text = malloc(size + 1);
    demand(text != NULL);
    memcpy(text, data, size);
    text[size] = '\0';
    for (char *rest = text, *word; count < WORDS_MOST && (word = strsep(&rest, "\n")) != NULL;)
        words[count++] = word;
    const bool ok = options_parse(&options, count, words, &error);
    demand(ok == (error.text[0] == '\0'));
    free(text);
    return 0;
}
