#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Checks all kernels in all forms with clang, which generates no code. No kernel causes a warning,
# with any of several sets of switches. Devices without fp64 can compile all kernels but those of
# --precision fp64.
set -eu
cd "$(dirname "$(readlink -f "$0")")/../../kernels"
command -v clang >/dev/null || { echo "skipped: clang is not installed"; exit 77; }

# As PoCL does, clang prints the warnings that are on by default.
accepts() {
  source=$1
  shift
  clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -fsyntax-only -Werror "$@" \
    -include render.cl "$source"
}

sources="tile.cl rays.cl samples.cl aov.cl explain.cl"
no_fp64="-Xclang -cl-ext=-cl_khr_fp64"
for form in "0 -DCLRT_PACKET=0" "0 -DCLRT_GPU=1" "1 -DCLRT_PACKET=0" "1 -DCLRT_PACKET=1"; do
  for source in $sources; do
    accepts "$source" $no_fp64 -DCLRT_PLACES=1 -DCLRT_WIDE_NODES=$form
  done
  accepts rays.cl $no_fp64 -DCLRT_RAYS=1 -DCLRT_ALL_HITS=1 -DCLRT_WIDE_NODES=$form
  # Among these seven sets of the scene's switches, any two switches have all four combinations
  # (Kleitman and Spencer, "Families of k-independent sets", 1973).
  for bits in 11111111 11110000 10001110 01001001 00100101 00010010 00000000; do
    switches=
    rest=$bits
    for name in SPHERES TRIANGLES BVH MIRRORS SHADED CHECKERS GLASS STATISTICS; do
      switches+=" -DCLRT_$name=${rest:0:1}"
      rest=${rest:1}
    done
    accepts tile.cl $switches -DCLRT_WIDE_NODES=$form
  done
done
for source in $sources certify.cl certify_rays.cl; do
  accepts "$source" -DCLRT_PLACES=1 -DCLRT_FP64=1
done
accepts rays.cl $no_fp64 -DCLRT_FP64=1 2>&1 | grep -q "'double' requires cl_khr_fp64"
