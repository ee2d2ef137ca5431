#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the README's two commands in a bare Debian without /dev/pts, terminal and locale, on a copy of
# this checkout. Exit status 77: this machine cannot make the root. Needs root, mmdebstrap and git.
# Usage: fresh_debian.sh SUITE [FOLDER]; SUITE is bookworm or trixie. Copies the kernels that the tests
# compiled to the folder.
set -eu
. "$(dirname "$(readlink -f "$0")")/bare_debian.sh"

commands=$(sed -n '/^## First picture/,/^## First scene/p' "$checkout/README.md" |
    grep -E '^tools/(render .*-o|test)')
[ "$(wc -l <<<"$commands")" = 2 ] || { echo "README.md has other commands: $commands"; exit 1; }
make_root "$1"
copy_checkout .
run_in_root "$commands" || exit 1
[ $# = 1 ] || cp -t "$2" "$root"/root/clrt/build/release/cache/pocl/clrt/*.bin
