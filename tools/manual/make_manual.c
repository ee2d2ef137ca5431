// SPDX-License-Identifier: MIT
// make_manual man TEMPLATE | bash | zsh | fish: prints the man page or a shell's completions,
// generated from the table of options.
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
