# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Functions for the command line's tests: counted checks, and runs of clrt with an expected exit
# code. The streams of each run go to the current folder.
failures=0
checks=0

# Counts the check named $1 as passed if the following command succeeds.
check() {
  local name=$1
  shift
  checks=$((checks + 1))
  if ! "$@"; then
    failures=$((failures + 1))
    echo "FAILED: $name" >&2
    sed 's/^/    /' err out >&2
  fi
}

# Runs clrt with the arguments after the expected exit code. Its streams go to the files out and
# err.
run() {
  local expected=$1 code
  shift
  "$CLRT" "$@" >out 2>err </dev/null
  code=$?
  [ "$code" = "$expected" ] || { echo "exit $code instead of $expected" >>err && false; }
}

# Runs clrt with the arguments after $2. It must fail with exit code $1 and print only the message
# $2.
refuses() {
  local code=$1 sentence=$2
  shift 2
  run "$code" "$@" && [ "$(cat err)" = "clrt: $sentence" ]
}
