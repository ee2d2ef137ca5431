#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tests clrt check and --bad-geometry: text, JSON, exit codes and messages. Usage: CLRT=path/to/clrt
# test_check.sh SOURCE_FOLDER WORK_FOLDER
# shellcheck source=tests/cli/workplace.sh
. "$(dirname "$0")/workplace.sh"

tells() { grep -qF -- "$1" out; }
json() { python3 -c "import json,sys; d=json.load(open('$1')); m=d['meshes'][0]; sys.exit(not ($2))"; }

# Writes an ASCII PLY file. The arguments are its name, vertices and triangles; each vertex or
# triangle is a line.
mesh() {
  local vertices faces
  vertices=$(printf '%s\n' "$2" | wc -l)
  faces=$(printf '%s\n' "$3" | wc -l)
  printf 'ply\nformat ascii 1.0\nelement vertex %s\nproperty double x\nproperty double y\nproperty double z\nelement face %s\nproperty list uchar int vertex_indices\nend_header\n%s\n%s\n' \
    "$vertices" "$faces" "$2" "$(printf '%s\n' "$3" | sed 's/^/3 /')" >"$1"
}

corners=$'0 0 0\n1 0 0\n0 1 0\n0 0 1'
mesh closed.ply "$corners" $'0 2 1\n0 1 3\n0 3 2\n1 2 3'
mesh open.ply "$corners" $'0 2 1\n0 1 3\n0 3 2'
mesh turned.ply "$corners" $'0 2 1\n0 1 3\n0 3 2\n1 3 2'
mesh equal.ply "$corners" $'0 2 1\n0 1 3\n0 0 2\n0 3 2\n1 2 3\n1 1 1'
mesh line.ply $'0 0 0\n1 0 0\n0 1 0\n0 0 1\n2 0 0' $'0 2 1\n0 1 3\n0 1 4'
mesh nan.ply $'0 0 0\n1 0 0\n0 nan 0\n0 0 1\n1 1 1' $'0 2 1\n0 1 3\n0 3 2\n1 4 3'
mesh twice.ply "$corners" $'0 2 1\n0 1 3\n0 3 2\n1 2 3\n2 3 1'
mesh far.ply $'16777216 0 0\n16777218 0 0\n16777216 2 0\n16777216 0 2' $'0 2 1\n0 1 3\n0 3 2\n1 2 3'
mesh inside.ply "$corners" $'0 1 2\n0 3 1\n0 2 3\n1 3 2'
printf 'ply_file inside.ply\nsphere 0 0 0 1\nsphere 0 0 0 1\ndefine red matte\n' >scene.scn
printf 'ply_file closed.ply\nmesh closed.ply scale 1e8\n' >mixed.scn
printf 'ply_file closed.ply\nsphere 1e20 0 0 1\n' >apart.scn

check "a closed mesh is fine" run 0 check closed.ply
check "... and nothing is said on standard error" test ! -s err
check "... is called closed" tells "closed.ply: 4 triangles, 4 vertices, closed"
check "... and has its edges and points aimed at" tells "of its 10 edges and points: 0 hidden by other parts, 0 pass through"
check "... with the verdict last" test "$(tail -n 1 out)" = "fine"
check "options may stand before the command" run 0 -j 1 check closed.ply
check "quiet says nothing" run 0 check -q closed.ply
check "... at all" test ! -s out
for form in "--kernel ray --nodes pair" "--kernel ray --nodes wide" "--kernel packet" "--precision fp64" "--bvh midpoint" "--no-bvh"; do
  # shellcheck disable=SC2086
  check "$form checks" run 0 check closed.ply $form --json=form.json
  check "... with no leak" json form.json "m['leak_test']['leaks']['count'] == 0 and m['leak_test']['aimed_at'] == 10"
done
check "an open mesh may be meant" run 0 check open.ply
check "... but gives a note" tells "note: 3 edges of a single triangle, the first at triangle 0"
check "... as not closed" tells "open.ply: 3 triangles, 4 vertices, not closed"
check "a mesh with a turned triangle gives a note" run 0 check turned.ply
check "... by its edges" tells "note: 3 edges whose triangles face opposite sides, the first at triangle 0"
check "equal corners fail the check" run 1 check equal.ply
check "... with their number and the first" tells "FAULT: 2 triangles with two equal corners, left out, the first triangle 2"
check "... and the verdict" test "$(tail -n 1 out)" = "1 of 1 findings are faults"
check "three corners on a line fail the check" run 1 check line.ply
check "... and are named" tells "FAULT: 1 triangles of no area, their corners on a line, the first triangle 2"
check "what is not finite fails the check" run 1 check nan.ply
check "... and is named" tells "FAULT: 1 vertices with a coordinate that is not finite or past 1e30, the first vertex 2"
check "... with the triangles there" tells "FAULT: 2 triangles at such a vertex, left out, the first triangle 0"
check "duplicates fail the check" run 1 check twice.ply
check "... and are named" tells "FAULT: 1 triangles with the corners of another, the first triangle 4"
check "a mesh far from the origin gets advice" run 0 check far.ply
check "... to be recentered" tells "note: recenter it before it is written"
check "a scene of mixed scales gets advice" run 0 check mixed.scn
check "... about them" tells "note: the scale is too mixed"
check "a sphere too far away to draw fails the check" run 1 check apart.scn
check "... as drawing would" tells "FAULT: it cannot be drawn: sphere 1 is more than 1e12 times"
check "a scene's faults are found" run 1 check scene.scn
check "... spheres in one place" tells "FAULT: 1 spheres that are the same as another"
check "... materials that nothing has" tells "note: 1 materials that are defined and not used"
check "... fronts that face inwards" tells "note: its fronts face inwards"

for model in creature figure coral; do
  if [ ! -e "$source/scenes/models/$model.ply" ]; then
    echo "$model.ply is missing: its check is skipped"
    continue
  fi
  check "$model is fine" run 0 check "$source/scenes/models/$model.ply" --json=model.json
  check "... closed, and no ray at an edge or point passes through" json model.json \
    "m['closed'] and m['leak_test']['leaks']['count'] == 0 and m['leak_test']['aimed_at'] > 13000"
done

check "JSON goes to standard output" run 1 check equal.ply --json
check "... alone, with every count" json out \
  "m['faults']['equal_corners'] == {'count': 2, 'first': 2} and m['faults']['open_edges'] == {'count': 0, 'first': None}"
check "... a schema and a verdict" json out "d['schema'] == 1 and d['fine'] is False and m['closed'] is True"
check "... and each finding" json out "[f['kind'] for f in d['findings'] if f['fails']] == ['equal_corners']"
check "JSON goes to a file beside the text" run 0 check open.ply --json=open.json
check "... with the counts of edges" json open.json "m['edges'] == 6 and m['faults']['open_edges']['count'] == 3 and not m['closed']"
check "... and of rays that pass where a triangle is missing" json open.json "m['leak_test']['leaks']['count'] >= 3"
check "... and the cap on rays" json open.json "m['leak_test']['cap'] == 1048576"
check "... and the text" tells "open.ply: 3 triangles"
check "JSON tells scales" run 0 check far.ply --json=far.json
check "... in steps of float" json far.json "m['shortest_written_edge']['steps'] == 1 and m['shortest_edge']['steps'] > 1e6"

OCL_ICD_VENDORS=/nonexistent check "without a device the rest is checked" run 1 check equal.ply --json=none.json
check "... and it is said" tells "leaks were not looked for: "
check "... in JSON too" json none.json "d['device'] is None and m['leak_test'] is None and m['closed']"
check "a device that is asked for and not there is exit 4" run 4 check closed.ply --device nosuchdevice

check "check without a scene" refuses 2 "no scene is named; clrt --help shows the usage" check
check "check of two scenes" run 2 check closed.ply open.ply
check "check draws nothing" refuses 2 "clrt check takes no --output" check closed.ply -o a.pfm
check "--json without check" refuses 2 "--json is for clrt check or clrt compare or clrt --explain-pixel or clrt --explain" closed.ply --json -o a.pfm
check "a scene called check is reached by its path" bash -c "cp scene.scn check; '$CLRT' ./check -s 4x4 -o a.pfm -q 2>err"
check "a missing scene is exit 3" \
  refuses 3 "nowhere.scn: cannot be opened: No such file or directory" check nowhere.scn
printf 'ply\nformat ascii 1.0\nelement vertex 2000000000\nproperty float x\n' >lie.ply
check "a lying mesh is exit 3" run 3 check lie.ply
check "... in one sentence" test "$(wc -l <err)" = 1
printf '\000\377ply' >noise.ply
check "noise is exit 3" run 3 check noise.ply
check "... in one sentence" test "$(wc -l <err)" = 1
check "a full disk is exit 5" run 5 check closed.ply --json=/dev/full
check "help tells of check" run 0 --help
check "... and its exit status" tells "faults found by check"

check "rendering reports what it drops" run 0 equal.ply -s 8x8 -o a.pfm
check "... in one sentence" test "$(cat err)" = "clrt: equal.ply: triangle 2, the first of 2 such, has two equal corners and is left out"
check "--bad-geometry drop does the same" run 0 equal.ply -s 8x8 -o b.pfm -q --bad-geometry drop
check "... quietly if asked" test ! -s err
check "... and the same picture" cmp a.pfm b.pfm
check "--bad-geometry fail refuses equal corners" refuses 3 \
  "equal.ply: triangle 2, the first of 2 such, has two equal corners" equal.ply -s 8x8 -o c.pfm --bad-geometry fail
check "... and draws nothing" test ! -e c.pfm
check "--bad-geometry fail refuses corners on a line" refuses 3 \
  "line.ply: triangle 2, the first of 1 such, has its corners on a line" line.ply -s 8x8 -o c.pfm --bad-geometry fail
check "--bad-geometry fail draws what is sound" run 0 closed.ply -s 8x8 -o c.pfm --bad-geometry fail
check "what is not finite is refused as ever" run 3 nan.ply -s 8x8 -o d.pfm
check "another word is not understood" refuses 2 "--bad-geometry wants drop or fail, not 'keep'" closed.ply --bad-geometry keep

echo "$checks checks, $failures failures"
[ "$failures" = 0 ]
