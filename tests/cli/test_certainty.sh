#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tests --aov certainty: the channel, the counts, and the repaired pixels. Usage: CLRT=path/to/clrt
# NO_FP64=path/to/no_fp64.so test_certainty.sh SOURCE_FOLDER WORK_FOLDER
# shellcheck source=tests/cli/workplace.sh
. "$(dirname "$0")/workplace.sh"
scene=$source/scenes/reflections.scn

says() { grep -q -- "$1" err; }
draws() { run 0 "$scene" -s 256x192 -o "$@"; }
# Evaluates an expression of the channels of a.exr (plain), c.exr (certain) and d.exr (fp64), and of
# the statistics s.
holds() {
  python3 - "$1" 2>>err <<PYTHON
import json, sys
sys.path.insert(0, "$here")
from read_exr import read_exr
a, c, d = (read_exr(name)[1] for name in ("a.exr", "c.exr", "d.exr"))
s = json.load(open("c.json"))
color = lambda p, i: tuple(p[n][i] for n in "RGB")
kinds = c["certainty"]
sys.exit(not eval(sys.argv[1]))
PYTHON
}

check "the plain picture" draws a.exr
check "that of fp64" draws d.exr --precision fp64
check "a picture with its certainty" draws c.exr --aov certainty --stats=c.json
check "pixels are certified, repaired or open" holds "set(kinds) <= {0, 0.5, 1}"
check "... some certified, some repaired" holds "{0.5, 1} <= set(kinds)"
check "statistics count the certified" holds "s['certainty']['certified'] == kinds.count(1)"
check "... the repaired" holds "s['certainty']['repaired'] == kinds.count(0.5)"
check "... and the open" holds "s['certainty']['open'] == kinds.count(0)"
check "only repaired pixels change" \
  holds "all(k == 0.5 or color(a, i) == color(c, i) for i, k in enumerate(kinds))"
check "... some of them" holds "any(color(a, i) != color(c, i) for i in range(len(kinds)))"
check "... to what fp64 draws" \
  holds "all(color(d, i) == color(c, i) for i, k in enumerate(kinds) if k == 0.5)"
for change in "-j 1" "--tile 16x8" "--kernel ray" "--nodes pair" "--bvh midpoint" "--no-bvh"; do
  # shellcheck disable=SC2086
  check "certainty with $change" draws e.exr --aov certainty $change
  check "... is the same" cmp c.exr e.exr
done
check "statistics as text report the counts" draws e.exr --aov certainty --stats
check "... in a line" says "pixels certified, [0-9]* repaired, [0-9]* open"
check "statistics without certainty" draws e.exr --stats=e.json
check "... tell null" grep -q '"certainty": null' e.json
check "all samples of a pixel count" draws e.exr --aov certainty --aa --stats=e.json
check "... so that fewer pixels are certified" python3 -c "
import json
certified = [json.load(open(name))['certainty']['certified'] for name in ('c.json', 'e.json')]
raise SystemExit(not certified[1] < certified[0])"
check "clrt rejects adaptive samples" \
  refuses 2 "--aov certainty is of the samples of --aa: leave out --aa-adaptive, --error and --time" \
  "$scene" -o e.exr --aov certainty --aa-adaptive
check "fp64 is refused" \
  refuses 2 "--aov certainty is of pictures in fp32: leave out --precision fp64" \
  "$scene" -o e.exr --aov certainty --precision fp64
LD_PRELOAD=$NO_FP64 check "a device without fp64 is exit 4" run 4 "$scene" -s 8x8 -o e.exr --aov certainty
check "... with the reason" says "has no double arithmetic, which --aov certainty needs"

echo "$checks checks, $failures failures"
[ "$failures" = 0 ]
