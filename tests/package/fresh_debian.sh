#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the README's commands tools/render and tools/test on a copy of this checkout, in a bare
# Debian that has no /dev/pts, no terminal and no locale. Exits with status 77 if this machine
# cannot create bare Debians. Needs root, mmdebstrap and git. Usage: fresh_debian.sh SUITE [FOLDER].
# SUITE is bookworm or trixie. If FOLDER is given, the tests' compiled kernels are copied to it.
set -eu
. "$(dirname "$(readlink -f "$0")")/bare_debian.sh"

commands=$(sed -n '/^## First picture/,/^## First scene/p' "$checkout/README.md" |
    grep -E '^tools/(render .*-o|test)')
[ "$(wc -l <<<"$commands")" = 2 ] || { echo "README.md has other commands: $commands"; exit 1; }
make_root "$1"
copy_checkout .
run_in_root "$commands" || exit 1
[ $# = 1 ] || cp -t "$2" "$root"/root/clrt/build/release/cache/pocl/clrt/*.bin
