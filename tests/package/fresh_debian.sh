#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the README's two commands in a bare Debian without /dev/pts, terminal and locale, on a copy of
# this checkout. Exit status 77: this machine cannot make the root. Needs root, mmdebstrap and git.
# Usage: fresh_debian.sh SUITE (bookworm or trixie)
set -eu
suite=$1
checkout=$(cd "$(dirname "$(readlink -f "$0")")/../.." && pwd)
course=${CLRT_COURSE:-$checkout/../shared/course}

skip() {
    echo "skipped: $1"
    exit 77
}

[ "$(id -u)" = 0 ] || skip "only root can make a bare Debian"
for program in mmdebstrap git; do
    command -v $program >/dev/null || skip "$program is not installed (tools/setup ci)"
done
git -C "$checkout" -c safe.directory='*' ls-files >/dev/null || skip "this is not a git checkout"
unshare --mount --pid --fork true 2>/dev/null || skip "this machine does not permit namespaces"

commands=$(sed -n '/^## First picture/,/^## First scene/p' "$checkout/README.md" |
    grep -E '^tools/(render .*-o|test)')
[ "$(wc -l <<<"$commands")" = 2 ] || { echo "README.md has other commands: $commands"; exit 1; }

root=$(mktemp -d -p "${TMPDIR:-/var/tmp}")
chmod 755 "$root"
namespaces=
# When its first process dies, the kernel kills the namespace's other processes and drops its mounts.
clean_up() {
    [ -z "$namespaces" ] || { kill -KILL "$namespaces" && wait; } 2>/dev/null || true
    rm -rf "$root" || { sleep 1 && rm -rf "$root"; }
}
trap clean_up EXIT
trap 'exit 130' INT TERM HUP

# in_namespaces COMMAND...: runs the command with mounts and processes that end with it.
in_namespaces() {
    local status=0
    setpriv --pdeathsig KILL unshare --mount --pid --fork --kill-child --mount-proc "$@" </dev/null &
    namespaces=$!
    wait "$namespaces" || status=$?
    namespaces=
    return $status
}

# The root gets this machine's package sources, proxies and certificates.
mapfile -t lists < <(. /etc/os-release && apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) main' \
    'Created-By: Packages' 'Origin: Debian' | sort -u | sed "s/\b$VERSION_CODENAME\b/$suite/")
mapfile -t proxies < <(apt-config dump | grep -E '^Acquire::https?::Proxy')
in_namespaces mmdebstrap --mode=root --variant=minbase --dpkgopt=force-unsafe-io "${proxies[@]/#/--aptopt=}" \
    "$suite" "$root" "${lists[@]}" || skip "mmdebstrap cannot make a bare Debian ($suite)"
mkdir "$root/root/clrt"
cp -rT /usr/local/share/ca-certificates "$root/usr/local/share/ca-certificates"
(cd "$checkout" && git -c safe.directory='*' ls-files -z | tar -c --null -T -) |
    tar -x --no-same-owner -C "$root/root/clrt"

environment=(HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin)
for name in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
    [ -z "${!name-}" ] || environment+=("$name=${!name}")
done
in_namespaces bash -euc '
    root=$1 course=$2 commands=$3
    shift 3
    # Tests that mount disks need a root that is a mount point.
    mount --bind "$root" "$root"
    mount -t proc proc "$root/proc"
    mount -t sysfs -o ro sysfs "$root/sys"
    if [ -d "$course" ]; then
        mkdir -p "$root/root/shared/course"
        mount --bind -o ro "$course" "$root/root/shared/course"
    fi
    exec setsid --wait env -i "$@" chroot "$root" bash -exc "cd /root/clrt; $commands"
' bash "$root" "$course" "$commands" "${environment[@]}" || exit 1
