# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Shared by the command line's tests: counted checks, and runs of clrt with an expected exit code.
# Sourced in the folder that the streams of each run go to.
failures=0
checks=0

# Counts the test named $1 as passed where the command after it succeeds.
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

# Runs clrt with the words after the expected exit code; its streams go to the files out and err.
run() {
  local expected=$1 code
  shift
  "$CLRT" "$@" >out 2>err </dev/null
  code=$?
  [ "$code" = "$expected" ] || { echo "exit $code instead of $expected" >>err && false; }
}

# Runs clrt with these words, which must fail with that code and say that one sentence.
refuses() {
  local code=$1 sentence=$2
  shift 2
  run "$code" "$@" && [ "$(cat err)" = "clrt: $sentence" ]
}
