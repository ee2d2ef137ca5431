// SPDX-License-Identifier: MIT
// Writes one of what the table of options is made into, to standard output:
// make_manual man TEMPLATE | bash | zsh | fish.
#include "bash.h"
#include "fish.h"
#include "man_page.h"
#include "zsh.h"

#include <string.h>

static int usage(void)
{
    fputs("usage: make_manual man TEMPLATE | bash | zsh | fish\n", stderr);
    return 2;
}

int main(int count, char **words)
{
    const char *kind = count > 1 ? words[1] : "";
    bool ok = true;
    if (strcmp(kind, "man") == 0 && count == 3)
        ok = man_page_write(stdout, words[2]);
    else if (strcmp(kind, "bash") == 0)
        bash_write(stdout);
    else if (strcmp(kind, "zsh") == 0)
        zsh_write(stdout);
    else if (strcmp(kind, "fish") == 0)
        fish_write(stdout);
    else
        return usage();
    return ok && fflush(stdout) == 0 ? 0 : 1;
}
