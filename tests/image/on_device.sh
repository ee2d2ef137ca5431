#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs a command on one of PoCL's devices or targets, or on another implementation of OpenCL. Prints
# a message and exits with status 77 if this machine lacks KIND. Each kind has its own kernel cache,
# because PoCL's cache ignores the target. Usage: on_device.sh KIND CACHE_FOLDER COMMAND...
set -eu
kind=$1
cache=$2/$1
shift 2
mkdir -p "$cache"
export POCL_CACHE_DIR=$cache XDG_CACHE_HOME=$cache

pass_over() {
  echo "skipped: $1"
  exit 77
}

# Installs a fixed version of Intel's CPU runtime, once for all tests.
fetch_intel() {
  exec 9>"$1.lock"
  flock 9
  [ ! -e "$1/fetched" ] || return 0
  # Removes Intel's libOpenCL, because it would replace the system's loader.
  python3 -m venv --clear "$1" &&
    "$1/bin/pip" install -q intel-opencl-rt==2026.2.0 intel-cmplr-lib-rt==2026.2.0 tbb==2023.2.0 &&
    mkdir "$1/libraries" "$1/vendors" &&
    ln -s "$1"/lib/*.* "$1/libraries" &&
    rm "$1"/libraries/libOpenCL.* &&
    echo "$1/lib/libintelocl.so" >"$1/vendors/intel.icd" &&
    touch "$1/fetched"
}

case $kind in
serial)
  # PoCL 6.0 calls this device cpu-minimal.
  for name in basic cpu-minimal; do
    export POCL_DEVICES=$name
    "$CLRT" devices >/dev/null 2>&1 && break
  done
  ;;
sse2) export POCL_KERNELLIB_NAME=sse2 ;;
avx2)
  # Without AVX-512, all other tests already compile for AVX2.
  grep -q avx512f /proc/cpuinfo || pass_over "this processor has no AVX-512, so other tests have the code for AVX2"
  export POCL_KERNELLIB_NAME=avx2
  ;;
unoptimized)
  # Without inlining, PoCL takes many minutes, because it visits every path through a kernel's
  # calls.
  export CLRT_TEST_OPTIONS="-cl-opt-disable -Dinline=__attribute__((always_inline))"
  ;;
oclgrind)
  command -v oclgrind >/dev/null || pass_over "oclgrind is not installed (Debian 13 has none)"
  log=$cache/oclgrind.log
  # Oclgrind's optimizer and its inliner generate intrinsics that its interpreter does not support.
  export CLRT_TEST_OPTIONS=-Dalways_inline=unused
  oclgrind --build-options -cl-opt-disable --uninitialized --data-races --log "$log" "$@"
  if [ -s "$log" ]; then
    cat "$log"
    exit 1
  fi
  exit 0
  ;;
intel)
  [ "$(uname -m)" = x86_64 ] || pass_over "Intel's runtime is for x86-64"
  venv=$(realpath "$cache/..")/intel-runtime
  (fetch_intel "$venv") || pass_over "Intel's runtime cannot be fetched from PyPI"
  export OCL_ICD_VENDORS=$venv/vendors LD_LIBRARY_PATH=$venv/libraries
  ;;
rusticl)
  export OCL_ICD_VENDORS=/etc/OpenCL/vendors/rusticl.icd RUSTICL_ENABLE=llvmpipe
  [ -e "$OCL_ICD_VENDORS" ] || pass_over "Mesa's rusticl is not installed (Debian 13: mesa-opencl-icd)"
  ;;
*)
  echo "unknown kind '$kind'" >&2
  exit 2
  ;;
esac
exec "$@"
