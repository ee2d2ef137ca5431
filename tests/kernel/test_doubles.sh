#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tests that devices without fp64 can compile the kernels. clang without double arithmetic must
# accept them in every form, and must reject the kernels of --precision fp64.
set -eu
cd "$(dirname "$(readlink -f "$0")")/../../kernels"
command -v clang >/dev/null || { echo "skipped: clang is not installed"; exit 77; }

compiles() {
  source=$1
  shift
  clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -Xclang -cl-ext=-cl_khr_fp64 -w \
    -fsyntax-only -DCLRT_SIGNATURES=1 "$@" -include render.cl "$source"
}

for source in tile.cl rays.cl samples.cl ladder.cl aov.cl explain.cl; do
  compiles "$source" -DCLRT_WIDE_NODES=0 -DCLRT_PACKET=0
  compiles "$source" -DCLRT_WIDE_NODES=1 -DCLRT_PACKET=0
  compiles "$source" -DCLRT_WIDE_NODES=1 -DCLRT_PACKET=1
done
compiles rays.cl -DCLRT_FP64=1 2>&1 | grep -q "'double' requires cl_khr_fp64"
