#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs a command on one of PoCL's devices or targets, or under oclgrind; what this machine does not
# have is passed over in words.  Each kind has a kernel cache of its own: PoCL's does not tell the
# targets apart.
# Usage: on_device.sh KIND CACHE_FOLDER COMMAND...
set -eu
kind=$1
cache=$2/$1
shift 2
mkdir -p "$cache"
export POCL_CACHE_DIR=$cache XDG_CACHE_HOME=$cache

pass_over() {
  echo "passed over: $1"
  exit 0
}

case $kind in
serial)
  # PoCL 6.0 calls it cpu-minimal.
  for name in basic cpu-minimal; do
    export POCL_DEVICES=$name
    "$CLRT" --list-devices >/dev/null 2>&1 && break
  done
  ;;
sse2) export POCL_KERNELLIB_NAME=sse2 ;;
avx2)
  grep -q avx2 /proc/cpuinfo || pass_over "this processor has no AVX2"
  export POCL_KERNELLIB_NAME=avx2
  ;;
unoptimized) export CLRT_TEST_OPTIONS=-cl-opt-disable ;;
oclgrind)
  command -v oclgrind >/dev/null || pass_over "oclgrind is not installed (Debian 13 has none)"
  log=$cache/oclgrind.log
  # Its own optimizer makes an intrinsic that its interpreter does not know.
  oclgrind --build-options -cl-opt-disable --uninitialized --data-races --log "$log" "$@"
  if [ -s "$log" ]; then
    cat "$log"
    exit 1
  fi
  exit 0
  ;;
*)
  echo "unknown kind '$kind'" >&2
  exit 2
  ;;
esac
exec "$@"
