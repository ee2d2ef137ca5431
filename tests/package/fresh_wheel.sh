#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the Python wheel in a bare Debian, and runs the commands of the conda recipe. Installs the
# wheel in a virtual environment in a second bare Debian, which has only Python and PoCL. Runs and
# times the README's Python example in this environment. Exits with status 77 if this machine cannot
# create bare Debians. Needs root, mmdebstrap, git and PyPI.
# Usage: fresh_wheel.sh SUITE (bookworm or trixie)
set -eu
. "$(dirname "$(readlink -f "$0")")/bare_debian.sh"

# The recipe's commands, with the interpreter of a virtual environment.
recipe=$checkout/tools/package/conda/recipe.yaml
build=$(sed -n 's|^  script: ${{ PYTHON }}|/root/conda/bin/python|p' "$recipe")
try=$(sed -n 's|^      - python -c|/root/conda/bin/python -c|p' "$recipe")
[ -n "$build" ] && [ -n "$try" ] || { echo "recipe.yaml has other commands"; exit 1; }

make_root "$1"
copy_checkout .
run_in_root "
    tools/setup python meshes
    python3 -m venv /root/conda
    /root/conda/bin/pip install -q 'scikit-build-core>=0.10' cffi numpy
    $build >/dev/null
    $try"'
    python3 -m venv /root/build
    time /root/build/bin/pip wheel -q . --no-deps -w /root/wheels
    ls -l /root/wheels
    # pip also installs the checkout itself.
    /root/build/bin/pip install -q .
    cd / && /root/build/bin/python -c "import clrt; print(clrt.__version__, clrt.__file__)"' || exit 1
wheels=$root/root/wheels

make_root "$1"
copy_checkout README.md scenes/ball.scn scenes/plateau.ply scenes/cone.ply
cp -r "$wheels" "$root/root/wheels"
sed -n '/^```python/,/^```/{/^```/d;p}' "$checkout/README.md" >"$root/root/clrt/example.py"
echo 'print(picture.shape, clrt.hash(picture), hits.distance)' >>"$root/root/clrt/example.py"
run_in_root '
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends python3 python3-venv ca-certificates
    python3 -m venv /root/venv
    /root/venv/bin/pip install -q /root/wheels/*.whl
    cat example.py
    # Without libOpenCL or a driver, the message names the packages.
    advice="apt install pocl-opencl-icd ocl-icd-libopencl1 (Debian)"
    ! /root/venv/bin/python example.py 2>message
    cat message && grep -qF "$advice" message
    apt-get install -y -qq --no-install-recommends ocl-icd-libopencl1
    ! /root/venv/bin/python example.py 2>message
    cat message && grep -qF "$advice" message
    apt-get install -y -qq --no-install-recommends pocl-opencl-icd
    time /root/venv/bin/python example.py
    time /root/venv/bin/python example.py' || exit 1
