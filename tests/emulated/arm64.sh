#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tests that clrt on 64-bit ARM, emulated by qemu, renders the recorded pictures in one form of the
# kernels. No pictures are recorded for fp64, so this machine's test_hashes renders the expected
# ones. The first run makes a Debian 12 for ARM and cross-builds clrt for it. The script exits with
# 77 if this machine lacks programs or rights. PICTURES are sizes, or "refined".
# Usage: arm64.sh FOLDER TEST_HASHES FORM PICTURES...
set -eu
folder=$(realpath -m "$1") native=$2
export CLRT_TEST_KERNEL=$3
source=$(realpath "$(dirname "$0")/../..")
course=$(realpath -m "${CLRT_COURSE:-$source/../shared/course}")
root=$folder/root build=$folder/build cache=$folder/cache
handlers=/proc/sys/fs/binfmt_misc handler=/usr/lib/binfmt.d/qemu-aarch64.conf
packages=gcc,libc6-dev,dash,coreutils,pocl-opencl-icd,ocl-icd-opencl-dev,libpng-dev,libjansson-dev
packages+=,libxxhash-dev,libopenexr-dev,libdeflate-dev,libcmocka-dev,libembree-dev

skip() {
    echo "skipped: $1"
    exit 77
}

make_root() {
    [ ! -d "$root" ] || return 0
    rm -rf "$root.new"
    mmdebstrap --quiet --arch=arm64 --variant=extract --include=$packages \
        --hook-dir=/usr/share/mmdebstrap/hooks/merged-usr bookworm "$root.new"
    # Makes absolute links relative. The linker would follow them into this machine's libraries.
    find "$root.new/usr/lib" -type l -lname '/*' | while read -r link; do
        ln -sfn "$(realpath -m --relative-to="${link%/*}" "$root.new$(readlink "$link")")" "$link"
    done
    mv "$root.new" "$root"
}

cross_build() {
    export ARM64_ROOT=$root PKG_CONFIG_SYSROOT_DIR=$root
    export PKG_CONFIG_LIBDIR=$root/usr/lib/aarch64-linux-gnu/pkgconfig:$root/usr/share/pkgconfig
    cmake -S "$source" -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$source/tests/emulated/arm64.cmake" \
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_COMPILE_WARNING_AS_ERROR=ON -DCLRT_WITH_MODELS=OFF
    cmake --build "$build"
}

# Makes Linux start ARM programs in qemu until this script ends.
start_emulation() {
    [ -e $handlers/register ] || mount -t binfmt_misc binfmt_misc $handlers
    [ ! -e $handlers/qemu-aarch64 ] || return 0
    cat $handler >$handlers/register
    trap 'echo -1 >$handlers/qemu-aarch64' EXIT
}

# emulated COMMAND...: runs the command in the ARM system.
emulated() {
    chroot "$root" env -i PATH=/usr/bin HOME="$cache" POCL_CACHE_DIR="$cache" \
        XDG_CACHE_HOME="$cache" CLRT_COURSE="$course" CLRT_TEST_KERNEL="$CLRT_TEST_KERNEL" "$@"
}

# records COMMAND...: runs a command of test_hashes, and prints the lines that end with a hash.
records() {
    "$@" | grep -E ' [0-9a-f]{32}$'
}

# compare PICTURES: tests the pictures of one size, or the refined pictures.
compare() {
    if [ "$CLRT_TEST_KERNEL" = fp64 ]; then
        records "$native" list "$1" >"$folder/expected"
        records emulated "$build/test_hashes" list "$1" | diff "$folder/expected" -
        echo "$(wc -l <"$folder/expected") pictures checked against this machine's"
    else
        emulated "$build/test_hashes" "$1"
    fi
}

for program in mmdebstrap aarch64-linux-gnu-gcc qemu-aarch64-static; do
    command -v $program >/dev/null || skip "$program is missing (tools/setup emulated installs it)"
done
[ "$(id -u)" = 0 ] || skip "only root can make the ARM system and run its programs"
# The mounts below end with the new namespace.
[ -n "${is_alone-}" ] || is_alone=yes exec unshare --mount "$0" "$@"

mkdir -p "$cache"
make_root
cross_build
start_emulation
for path in /proc /sys /dev "$source" "$course"; do
    [ ! -e "$path" ] || { mkdir -p "$root$path" && mount --rbind "$path" "$root$path"; }
done
for pictures in "${@:4}"; do
    compare $pictures
done
