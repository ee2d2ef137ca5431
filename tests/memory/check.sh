#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Renders small pictures of scenes under valgrind (release build), and under ASan and UBSan (debug
# build). drivers.supp suppresses findings inside the libraries of drivers. Usage: check.sh SCENE...
set -u
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LSAN_OPTIONS=suppressions=$root/tests/memory/leaks.supp:print_suppressions=0
failed=0
for scene in "$@"; do
  for command in "valgrind -q --error-exitcode=9 --leak-check=full --suppressions=$root/tests/memory/drivers.supp $root/build/release/clrt" \
    "$root/build/debug/clrt"; do
    # shellcheck disable=SC2086
    if $command "$scene" -s 16x16 --aa -o "$work/a.exr" --json="$work/a.json" >"$work/log" 2>&1; then
      echo "clean: ${command##*/build/} $scene"
    else
      failed=1
      echo "FAILED: $command $scene"
      cat "$work/log"
    fi
  done
done
exit $failed
