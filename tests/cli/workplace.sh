# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# An empty folder to work in, for a test that is called with its source folder and that folder.
# Sourced before all else, so that $0 and the folders may still be relative; sets here, where the
# test itself lies, source and work, the folder.
# shellcheck disable=SC2034 # source and work are for the test
set -u
here=$(cd "$(dirname "$0")" && pwd)
source=$1
rm -rf "$2"
mkdir -p "$2"
cd "$2" || exit 1
work=$PWD
# shellcheck source=tests/cli/checks.sh
. "$here/checks.sh"
