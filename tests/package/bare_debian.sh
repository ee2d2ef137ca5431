# SPDX-License-Identifier: MIT
# Makes bare Debians for tests, which source this file. Needs root, mmdebstrap and git. Exits with
# status 77 if this machine cannot make bare Debians.
checkout=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)

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

roots=()
namespaces=
# When the first process of a namespace dies, Linux ends the other processes and the mounts.
clean_up() {
    [ -z "$namespaces" ] || { kill -KILL "$namespaces" && wait; } 2>/dev/null || true
    rm -rf "${roots[@]}" || { sleep 1 && rm -rf "${roots[@]}"; }
}
trap clean_up EXIT
trap 'exit 130' INT TERM HUP

# in_namespaces COMMAND...: runs the command. Its mounts and child processes end with the command.
in_namespaces() {
    local status=0
    setpriv --pdeathsig KILL unshare --mount --pid --fork --kill-child --mount-proc "$@" </dev/null &
    namespaces=$!
    wait "$namespaces" || status=$?
    namespaces=
    return $status
}

# make_root SUITE: makes a bare Debian in the new folder $root. It has this machine's package sources,
# proxies and certificates.
make_root() {
    local lists proxies
    root=$(mktemp -d -p "${TMPDIR:-/var/tmp}")
    chmod 755 "$root"
    roots+=("$root")
    mapfile -t lists < <(. /etc/os-release && apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) main' \
        'Created-By: Packages' 'Origin: Debian' | sort -u | sed "s/\b$VERSION_CODENAME\b/$1/")
    mapfile -t proxies < <(apt-config dump | grep -E '^Acquire::https?::Proxy')
    in_namespaces mmdebstrap --mode=root --variant=minbase --dpkgopt=force-unsafe-io \
        "${proxies[@]/#/--aptopt=}" "$1" "$root" "${lists[@]}" || skip "mmdebstrap cannot make a bare Debian ($1)"
    mkdir "$root/root/clrt"
    cp -rT /usr/local/share/ca-certificates "$root/usr/local/share/ca-certificates"
}

# copy_checkout FILE...: copies files of the checkout, or all of them, to /root/clrt of $root.
copy_checkout() {
    (cd "$checkout" && git -c safe.directory='*' ls-files -z -- "$@" | tar -c --null -T -) |
        tar -x --no-same-owner -C "$root/root/clrt"
}

# run_in_root COMMANDS: runs the shell commands in /root/clrt of $root without a terminal. The
# course's files are in /root/shared.
run_in_root() {
    local environment=(HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin) name
    for name in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY PIP_INDEX_URL PIP_CERT; do
        [ -z "${!name-}" ] || environment+=("$name=${!name}")
    done
    in_namespaces bash -euc '
        root=$1 course=$2 commands=$3
        shift 3
        # Some tests mount disks, so the root must be a mount point.
        mount --bind "$root" "$root"
        mount -t proc proc "$root/proc"
        mount -t sysfs -o ro sysfs "$root/sys"
        if [ -d "$course" ]; then
            mkdir -p "$root/root/shared/course"
            mount --bind -o ro "$course" "$root/root/shared/course"
        fi
        exec setsid --wait env -i "$@" chroot "$root" bash -exc "cd /root/clrt; $commands"
    ' bash "$root" "${CLRT_COURSE:-$checkout/../shared/course}" "$1" "${environment[@]}"
}
